// What a run that came to its end and is resolved is judged by, in one list: every figure of the
// report that has a tolerance, whatever it is a figure of.  Tested by
// tests/runtime/verdict_test.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace twincraft {

enum class Verdict {
  kAgree,        // every judged tolerance held
  kDisagree,     // one was exceeded
  kUnresolved,   // the step does not resolve the vehicle: agreement says nothing
  kNotJudged,    // no tolerance was given
  kFailed,       // an engine stopped
  kInterrupted,  // by a signal
};

/// `agree`, `disagree`, `unresolved`, `not_judged`, `failed`, `interrupted`
std::string_view verdict_name(Verdict verdict);

/// A figure and its tolerance, both in the unit that the key ends in.
struct JudgedFigure {
  enum class Of { kAgreement, kConservation, kReference };
  Of of = Of::kAgreement;
  std::string key;        // as in report.json: `attitude_deg`, `energy_relative`
  std::string engine;     // "bsm", "mujoco"; empty for agreement, which is of both
  std::string reference;  // "kepler"; empty for all but references
  double maximum = 0.0;
  double tolerance = 0.0;

  bool held() const { return maximum <= tolerance; }  // false for NaN
};

/// One broken tolerance is enough to disagree, even in half a run; to agree takes a whole run and
/// at least one tolerance.
Verdict judge(std::span<const JudgedFigure> figures, bool whole_run);

}  // namespace twincraft
