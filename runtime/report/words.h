// Metrics, vehicles and durations in words. Tested by tests/runtime/report_test.cpp.
#pragma once

#include <string>
#include <string_view>

#include "compiler/ir/model.h"

namespace twincraft {

/// What people call a metric of report.json, and its unit.
struct MetricWords {
  std::string label;  // `body rate`
  std::string unit;   // `rad/s`
};
MetricWords words_of(std::string_view key, const Model& model);

/// `11 DOF: hub, 3 wheels, 2 panels`
std::string vehicle_words(const Model& model);

/// `120 s`, `30 days`, `10 years`: how long a run is.
std::string span_words(double seconds);

/// `120 s, rk4 at 0.02 s, no gravity`
std::string plan_words(const Model& model);

/// What the propellant that leaves takes along; empty when no tank drains during the run.
std::string depletion_words(const Model& model);

/// `3.1e-13 deg`; an exact zero is `0 deg`.
std::string quantity(double value, std::string_view unit);

/// `620 ns`, `3.6 ms`, `12.1 s`
std::string duration(double seconds);

}  // namespace twincraft
