// See twin.h.
#include "runtime/api/twin.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "runtime/api/faults.h"

namespace twincraft::api {
namespace {

constexpr std::size_t kStepsPerPoll = 64;

}  // namespace

Twin::Twin(std::shared_ptr<const CompiledModel> model, EngineKind lead)
    : lead_(lead), meter_(metric_laws(model->model())) {
  for (const EngineName& engine : kEngines)
    engines_[static_cast<std::size_t>(engine.kind)] =
        std::make_unique<Simulation>(model, engine.kind);
  see();
}

Twin::Twin(const Twin& other)
    : lead_(other.lead_),
      engines_{other.engines_[0]->copy(), other.engines_[1]->copy()},
      meter_(other.meter_) {}

double Twin::next_landing() const {
  return std::min(of(EngineKind::kBsm).next_landing(), of(EngineKind::kMujoco).next_landing());
}

void Twin::drive(std::size_t first, std::span<const double> values) {
  for (const auto& engine : engines_) engine->drive(first, values);
}

void Twin::release(std::size_t input) {
  for (const auto& engine : engines_) engine->release(input);
}

void Twin::step(std::size_t count, const Poll& poll) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kStepsPerPoll == kStepsPerPoll - 1) ask(poll);
    const std::int64_t point = lead().grid_point();
    while (lead().grid_point() == point) land(next_landing());
  }
}

void Twin::advance_to(double time, const Poll& poll) {
  check_target(time, this->time(), tolerance());
  for (std::size_t i = 0; this->time() < time - tolerance(); ++i) {
    if (i % kStepsPerPoll == kStepsPerPoll - 1) ask(poll);
    const double next = next_landing();
    land(next < time - tolerance() ? next : time);
  }
}

/// Both or none: the second engine's failure takes the first back.
void Twin::land(double time) {
  Simulation& first = of(EngineKind::kBsm);
  const Flight::Snapshot before = first.position();
  first.advance_to(time);
  try {
    of(EngineKind::kMujoco).advance_to(time);
  } catch (...) {
    first.go_on_from(before);
    throw;
  }
  see();
}

std::string Twin::snapshot() const {
  const std::string first = of(EngineKind::kBsm).snapshot();
  const std::uint64_t size = first.size();
  std::string bytes(sizeof size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  return bytes + first + of(EngineKind::kMujoco).snapshot();
}

void Twin::restore(std::string_view bytes) {
  std::uint64_t size = 0;
  if (bytes.size() < sizeof size) throw Fault(TC_SNAPSHOT, "these bytes are no snapshot");
  std::memcpy(&size, bytes.data(), sizeof size);
  bytes.remove_prefix(sizeof size);
  if (size > bytes.size()) throw Fault(TC_SNAPSHOT, "these bytes are no snapshot of a twin");
  const Flight::Snapshot before = of(EngineKind::kBsm).position();
  of(EngineKind::kBsm).restore(bytes.substr(0, size));
  try {
    of(EngineKind::kMujoco).restore(bytes.substr(size));
  } catch (...) {
    of(EngineKind::kBsm).go_on_from(before);
    throw;
  }
  compare_anew();
}

void Twin::reset() {
  for (const auto& engine : engines_) engine->reset();
  compare_anew();
}

void Twin::compare_anew() {
  meter_ = AgreementMeter(metric_laws(model().model()));
  see();
}

}  // namespace twincraft::api
