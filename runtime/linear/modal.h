// The linear half of the verdict: the modes of the vehicle at several instants of a run, what the
// method does to each, and how much of it the motion has.
#pragma once

#include <limits>
#include <vector>

#include "runtime/linear/advice.h"
#include "runtime/linear/linearise.h"

namespace twincraft {

/// Modes about one state, and what sets them going there.
struct ModalInstant {
  double time = 0.0;        // [s]
  bool is_driven = false;   // at the start and at events: weights mean something
  bool near_empty = false;  // one step before an event, while a tank drains
  std::vector<Mode> modes;
};

/// How far a coordinate moves, as a measure of its error.
struct Amplitudes {
  std::vector<double> joint;          // [rad] or [m] over the run
  std::vector<double> joint_between;  // over the stretch that begins at the instant
  double rate = 0.0;                  // [rad/s] of the hub
};

class ModalJudge {
 public:
  ModalJudge(const Model& model, double step);

  /// Judges the modes of one instant until the end of the run.
  void see(const OwnMotion& motion, const ModalInstant& instant, const Amplitudes& amplitudes);

  const std::vector<Finding>& findings() const { return findings_; }
  const std::optional<FastestMotion>& fastest() const { return fastest_; }
  double largest_stable_step() const { return stable_; }  // [s] infinite without modes
  double advised_step() const;                            // [s] infinite when all is well
  double stable_advice() const { return advised_; }       // [s] the same, of stability alone
  /// The advised step of another method, for the modes that were seen.
  double advised_step_of(const Tableau& tableau) const;

  /// The unstable mode whose amplitude grows most in a step: what a failed run died of.
  const std::optional<Finding>& destroyer() const { return destroyer_; }
  /// Of the instants up to here [s].
  void set_destroyed(double time) { destroyed_ = time; }

 private:
  struct Excited {
    std::complex<double> s;
    double remaining;  // [s]
  };
  void judge_stability(const ModalInstant& instant, const Mode& mode);
  void judge_errors(const OwnMotion& motion, const ModalInstant& instant,
                    const Amplitudes& amplitudes);
  void judge_error(const OwnMotion& motion, const ModalInstant& instant, int entry,
                   const Amplitudes& amplitudes, const std::vector<double>& errors);
  std::string stability_words(const ModalInstant& instant, const Mode& mode, double stable) const;
  std::string error_words(const ModalInstant& instant, const Mode& mode, const std::string& name,
                          double error) const;
  void note_fastest(const Mode& mode);

  const Tableau& tableau_;
  double step_, duration_;
  bool is_low_order_;
  std::vector<Finding> findings_;
  std::optional<FastestMotion> fastest_;
  double stable_, advised_;
  std::vector<Excited> excited_;  // what a step has to follow
  std::vector<std::complex<double>> all_;
  double destroyed_ = std::numeric_limits<double>::infinity();  // [s]
  double worst_growth_ = 0.0;  // of a mode in a step, as a logarithm
  std::optional<Finding> destroyer_;
};

}  // namespace twincraft
