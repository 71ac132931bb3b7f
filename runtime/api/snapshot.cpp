// See snapshot.h.
#include "runtime/api/snapshot.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "runtime/api/faults.h"
#include "runtime/bsm/processor.h"

namespace twincraft::api {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "twincraft-snapshot/1\n";

/// FNV-1a, against damage, not against malice: whoever forges a snapshot flies a forged state.
std::uint64_t sum_of(std::string_view bytes) {
  std::uint64_t sum = 14695981039346656037u;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return sum;
}

class Writer {
 public:
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(const std::string& text) { list(text); }
  void operator()(const std::vector<bool>& flags) {
    size(flags.size());
    for (const bool flag : flags) bytes_.push_back(flag ? 1 : 0);
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    list(values);
  }
  void operator()(const Eigen::VectorXd& values) { list(values); }

  std::string take() && { return std::move(bytes_); }

 private:
  void size(std::size_t count) { (*this)(static_cast<std::uint64_t>(count)); }
  void list(const auto& values) {
    size(static_cast<std::size_t>(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::size_t>(values.size()) * sizeof *values.data());
  }

  std::string bytes_;
};

[[noreturn]] void refuse_damaged() {
  throw Fault(TC_SNAPSHOT, "the snapshot is damaged or cut off");
}

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::string_view bytes = take(sizeof value);
    std::memcpy(&value, bytes.data(), bytes.size());
  }
  void operator()(std::string& text) { text = take(size(1)); }
  void operator()(std::vector<bool>& flags) {
    const std::string_view bytes = take(size(1));
    flags.assign(bytes.size(), false);
    for (std::size_t i = 0; i < bytes.size(); ++i) flags[i] = bytes[i] != 0;
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    list(values);
  }
  void operator()(Eigen::VectorXd& values) { list(values); }

  std::string_view rest() const { return bytes_; }

 private:
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) refuse_damaged();
    const std::string_view head = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return head;
  }
  std::size_t size(std::size_t each) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > bytes_.size() / each) refuse_damaged();
    return static_cast<std::size_t>(count);
  }
  void list(auto& values) {
    using Item = std::remove_reference_t<decltype(*values.data())>;
    const std::string_view bytes = take(size(sizeof(Item)) * sizeof(Item));
    values.resize(static_cast<decltype(values.size())>(bytes.size() / sizeof(Item)));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  }

  std::string_view bytes_;
};

/// Everything of a snapshot, in one order for both directions.
template <class Each, class Snapshot>
void for_each_part(Each& each, Snapshot& s) {
  each(s.time);
  each(s.solution.value);
  each(s.solution.carry);
  each(s.landing.event);
  each(s.landing.index);
  each(s.landing.done);
  each(s.inputs.inputs.layout);
  each(s.inputs.inputs.since);
  each(s.inputs.inputs.u);
  each(s.inputs.inputs.tanks);
  each(s.inputs.next);
  each(s.inputs.is_driven);
  each(s.inputs.driven);
  each(s.inputs.is_empty);
  each(s.counts);
  each(s.accepted.attitude);
  each(s.accepted.joint);
}

/// What a snapshot is of.
struct Origin {
  std::string program = "twincraft " TWINCRAFT_VERSION;
  std::string digest, engine, instructions;

  Origin(const CompiledModel& model, EngineKind kind)
      : digest(model.digest()),
        engine(name_of(kind).key),
        instructions(bsm::name_of(bsm::fastest_instruction_set(bsm::Use::kOne))) {}
};

void check(const std::string& found, const std::string& wanted, const char* what) {
  if (found != wanted)
    throw Fault(TC_SNAPSHOT,
                fmt::format("the snapshot is of another {}: {}, not {}", what, found, wanted));
}

bool have_one_size(const Flight::Snapshot& a, const Flight::Snapshot& b) {
  const auto& x = a.inputs;
  const auto& y = b.inputs;
  return a.solution.value.size() == b.solution.value.size() &&
         a.solution.carry.size() == b.solution.carry.size() &&
         x.inputs.u.size() == y.inputs.u.size() && x.inputs.tanks.size() == y.inputs.tanks.size() &&
         x.next.size() == y.next.size() && x.is_driven.size() == y.is_driven.size() &&
         x.driven.size() == y.driven.size() && x.is_empty.size() == y.is_empty.size();
}

}  // namespace

std::string seal(const Flight::Snapshot& snapshot, const CompiledModel& model, EngineKind engine) {
  Writer writer;
  const Origin origin(model, engine);
  writer(origin.program);
  writer(origin.digest);
  writer(origin.engine);
  writer(origin.instructions);
  for_each_part(writer, snapshot);
  const std::string body = std::move(writer).take();
  Writer seal;
  seal(sum_of(body));
  return std::string(kMagic) + std::move(seal).take() + body;
}

Flight::Snapshot unseal(std::string_view bytes, const CompiledModel& model, EngineKind engine,
                        const Flight::Snapshot& like) {
  if (!bytes.starts_with(kMagic)) throw Fault(TC_SNAPSHOT, "these bytes are no snapshot");
  bytes.remove_prefix(kMagic.size());
  Reader reader(bytes);
  std::uint64_t sum = 0;
  reader(sum);
  if (sum != sum_of(reader.rest())) refuse_damaged();
  const Origin wanted(model, engine);
  Origin found = wanted;
  reader(found.program);
  reader(found.digest);
  reader(found.engine);
  reader(found.instructions);
  check(found.program, wanted.program, "version");
  check(found.engine, wanted.engine, "engine");
  check(found.instructions, wanted.instructions, "instruction set");
  check(found.digest, wanted.digest, "model");
  Flight::Snapshot snapshot;
  for_each_part(reader, snapshot);
  if (!reader.rest().empty() || !have_one_size(snapshot, like)) refuse_damaged();
  return snapshot;
}

}  // namespace twincraft::api
