// Does a run say anything about the vehicle? A step that is too long destroys the motion in both
// engines alike, and then their agreement says nothing. Every mode's error over the run is
// predicted from the method's stability function and weighed by how much the mode is excited; a
// few steps are repeated at half the step; attitude, orbit and adaptive methods have rules of
// their own. The file to read first in this room.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/linear/inspection.h"
#include "runtime/linear/motion_record.h"

namespace twincraft {

/// What a run can fail, in the words of report.json.
enum class ResolutionRule {
  kStability,    // the step is beyond 0.9 of what the method can do with a mode
  kModalError,   // the method loses more than 5 % of a coordinate's motion
  kAttitude,     // the steps' own errors turn the hub by more than 0.8 deg
  kProbes,       // the steps' own errors add up to more than 5 % of a coordinate's motion
  kTranslation,  // the centre of mass is not where it would be
  kRotation,     // hub or hinge turns by more than half a turn in a step
  kEnergy,       // the vehicle's own energy is off by more than a tenth of what is exchanged
  kAdaptive,     // the accepted errors add up to more than 5 % of a coordinate's motion
};
std::string_view rule_name(ResolutionRule rule);  // `modal_error`

/// The fastest motion there is.
struct FastestMotion {
  std::string coordinate;      // `wing_p.1`, `rotation`, `orbit`
  double rate = 0.0;           // [rad/s]
  double damping_ratio = 0.0;  // 1: no oscillation
  std::string kind;            // `undamped`, `damped`, `rotation`, `orbit`
};

/// Own-motion energy of one engine's run.
struct EnergyFigures {
  double exchanged = 0.0;  // [J]
  double drift = 0.0;      // [J]
  double relative = 0.0;   // drift over exchanged, or over 1e-6 of the energy if that is more
};
EnergyFigures figures_of(const OwnEnergy& energy);

struct Resolution {
  bool resolved = true;
  std::optional<ResolutionRule> rule;  // that failed first
  std::optional<FastestMotion> fastest;
  std::string worst_coordinate;       // empty when nothing is worth naming
  std::optional<double> worst_error;  // relative to its motion
  std::optional<double> attitude_error_deg;
  double step = 0.0;                          // [s] as given
  std::optional<double> largest_stable_step;  // [s]
  std::optional<double> advised_step;         // [s] of the same method, when unresolved
  std::optional<double> advised_rk4_step;     // [s] when a low-order method needs far more
  std::optional<double> advised_tolerance;    // relative, of an adaptive method
  std::vector<std::string> reasons;           // the gravest first, as sentences
  std::vector<std::string> remarks;           // worth knowing of a resolved run, too
};

/// What the judge is shown of the analytic engine's run.
struct RunShown {
  const MotionRecord* motion = nullptr;
  std::span<const Observation> instants;  // at or after each of Inspection::all()
  double reached = 0.0;                   // [s]
  double mean_step = 0.0;                 // [s] of an adaptive method
  AcceptedErrors accepted = {};           // of an adaptive method
};

/// Of a run that came to its end. @param energies  of every engine that flew, for the backstop
Resolution judge_resolution(const Model& model, const Inspection& inspection, const RunShown& run,
                            std::span<const OwnEnergy* const> energies);

/// Before any run, from the initial state alone: modes and one step. Misses what only the motion
/// brings.
Resolution foresee_resolution(const Model& model);

/// Why a run stopped: the mode that the step destroys, from what was seen of it; the same words for
/// both engines. Not resolved; no reasons when no mode explains it.
Resolution explain_failure(const Model& model, const Inspection& inspection, const RunShown& run);

/// `5 ms`, as one would type it after --step.
std::string step_words(double step);

}  // namespace twincraft
