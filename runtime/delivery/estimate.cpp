// See estimate.h. Tested by tests/agreement/estimate_test.cpp.
#include "runtime/delivery/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>

#include "compiler/diag/diagnostics.h"
#include "compiler/ir/number.h"
#include "runtime/engine/observation.h"
#include "runtime/simulate/flight.h"

namespace twincraft {
namespace {

// A vector that grows has room for twice what it holds, and for a moment both.
constexpr double kGrowth = 2.0;
constexpr double kAllocation = 16.0;  // [bytes] that an allocation takes beside its contents
// Of CSV: half of a vehicle's columns may well be zeros, `0,`; others are up to 20 bytes.
constexpr double kBytesPerCell = 7.0;
constexpr double kFixedColumns = 21.0;
constexpr double kCompression = 0.3;  // of netCDF, at best

double joints_of(const Model& model) {
  return static_cast<double>(model.assembly.links.size()) - 1.0;
}

double wheels_of(const Model& model) { return static_cast<double>(model.assembly.rotors.size()); }

}  // namespace

double samples_of(const Model& model) {
  const SimulationPlan& plan = model.simulation;
  return plan.duration / std::max(plan.record, plan.step) + 2.0 +
         static_cast<double>(model.stored.states.size());
}

double trajectory_bytes(const Model& model) {
  const double vectors = sizeof(double) * (2.0 * joints_of(model) + wheels_of(model));
  const double sample = sizeof(Observation) + sizeof(Books) + vectors + 3.0 * kAllocation;
  return kGrowth * sample * samples_of(model);
}

double file_bytes(const Model& model, bool netcdf) {
  const double cells =
      samples_of(model) * (kFixedColumns + 2.0 * joints_of(model) + wheels_of(model));
  return cells * (kBytesPerCell + (netcdf ? kCompression * sizeof(double) : 0.0));
}

double record_that_fits(const Model& model, double trajectories) {
  const double now = std::max(model.simulation.record, model.simulation.step);
  const double least = now * trajectories * trajectory_bytes(model) / kMostMemory;
  const double digit = std::pow(10.0, std::floor(std::log10(least)) - 1.0);
  return std::ceil(1.01 * least / digit) * digit;
}

std::string check_room(const std::string& folder, double needed, double free, double record) {
  if (needed <= free) return {};
  return fmt::format(
      "cannot write {}: the files of this run take {} or more, and {} are free; raise "
      "`simulation.record` from {} s, or choose another folder",
      in_backticks(folder), size_words(needed), size_words(free), shortest(record));
}

double free_bytes(const std::string& folder) {
  std::error_code error;
  std::filesystem::path path = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(path, error) && path.has_relative_path())
    path = path.parent_path();
  const std::filesystem::space_info space = std::filesystem::space(path, error);
  if (error) return std::numeric_limits<double>::infinity();
  return static_cast<double>(space.available);
}

std::string size_words(double bytes) {
  constexpr std::array<const char*, 6> kUnits{"bytes", "KiB", "MiB", "GiB", "TiB", "PiB"};
  std::size_t unit = 0;
  for (; bytes >= 1024.0 && unit + 1 < kUnits.size(); ++unit) bytes /= 1024.0;
  return fmt::format("{:.3g} {}", bytes, kUnits.at(unit));
}

}  // namespace twincraft
