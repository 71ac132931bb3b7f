#include "compiler/components/vehicle.h"

namespace twincraft {
namespace {

Names names_of(const Vehicle& vehicle, Diagnostics& diagnostics) {
  Names names;
  for_each_section(vehicle, [&](const auto& members, const SectionName& section) {
    for (const auto& each : members)
      names.add(name_of(each), section.noun, written(each).span_of("name"), diagnostics);
  });
  return names;
}

}  // namespace

std::optional<Span> depth_span(const Vehicle& vehicle, const std::string& name) {
  std::optional<Span> found;
  for_each_section(vehicle, [&](const auto& members, const SectionName&) {
    for (const auto& each : members)
      if (name_of(each) == name) found = written(each).span_of(depth_key(each));
  });
  return found;
}

std::optional<Span> name_span(const Vehicle& vehicle, const std::string& name) {
  std::optional<Span> found;
  for_each_section(vehicle, [&](const auto& members, const SectionName&) {
    for (const auto& each : members)
      if (name_of(each) == name) found = written(each).span_of("name");
  });
  return found;
}

Size size_of(const Vehicle& vehicle, int most) {
  Size size;
  const auto add = [&size, most](const Coordinates& more) {
    if (size.too_many_at) return;
    size.coordinates += more.count;
    if (size.coordinates > most) size.too_many_at = more.span;
  };
  for_each_section(vehicle, [&add](const auto& members, const SectionName&) {
    for (const auto& each : members) add(coordinates_of(each));
  });
  return size;
}

double total_mass(const Vehicle& vehicle) {
  double sum = vehicle.hub.mass;
  for_each_section(vehicle, [&sum](const auto& members, const SectionName&) {
    for (const auto& each : members) sum += mass_of(each);
  });
  return sum;
}

std::vector<Oscillator> oscillators(const Vehicle& vehicle) {
  std::vector<Oscillator> all;
  for_each_section(vehicle, [&](const auto& members, const SectionName&) {
    for (Oscillator& each : oscillators_of(members, vehicle)) all.push_back(std::move(each));
  });
  return all;
}

void check(const Vehicle& vehicle, double duration, Diagnostics& diagnostics) {
  const Names names = names_of(vehicle, diagnostics);
  const Context context{vehicle, names, duration};
  check(vehicle.hub, diagnostics);
  for_each_section(vehicle, [&](const auto& members, const SectionName&) {
    for (const auto& each : members) check(each, context, diagnostics);
  });
  for_each_section(vehicle, [&](const auto& members, const SectionName&) {
    check_together(members, context, diagnostics);
  });
}

void lower(const Vehicle& vehicle, ModelBuilder& builder) {
  lower(vehicle.hub, builder);
  for_each_section(vehicle, [&builder](const auto& members, const SectionName&) {
    lower_mounts(members, builder);
  });
  for_each_section(vehicle, [&](const auto& members, const SectionName&) {
    for (const auto& each : members) lower(each, vehicle, builder);
  });
}

}  // namespace twincraft
