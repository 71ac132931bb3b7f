// What the verdict on resolution has to know of a run: how far every coordinate went, when it was
// shaken most, and what became of its energy. Built sample by sample; its size does not depend on
// how many there are.
#pragma once

#include <optional>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/reference/kepler.h"
#include "runtime/simulate/propagate.h"

namespace twincraft {

/// Least and greatest value of something.
struct Extent {
  double least = 0.0, greatest = 0.0;
  bool seen = false;

  void see(double value);
  double half() const { return 0.5 * (greatest - least); }
};

/// Energy of the motion about the system's centre of mass and in the springs: an orbit's is apart.
class OwnEnergy {
 public:
  void see(const Observation& sample, const Books& books);

  double drift() const { return drift_; }  // [J] largest |change - work|
  /// [J] The most that changed hands between motion and springs, or with what works on them.
  double exchanged() const;
  /// Enough of it to measure a drift by: a rigid body in deep space exchanges nothing.
  bool is_exchanging() const;
  double relative() const;  // drift over what is exchanged, or over 1e-6 of all if that is more
  double drift_of(const Observation& sample, const Books& books) const;  // [J] signed, now

 private:
  bool started_ = false;
  double kinetic_ = 0.0, springs_ = 0.0, work_ = 0.0;  // [J] at the first sample
  double drift_ = 0.0, largest_ = 0.0;
  Extent springs_span_, work_span_;
};

class MotionRecord {
 public:
  /// @param events  [s] ascending, inside the run: stretches lie between them
  MotionRecord(const Model& model, std::vector<double> events);

  void see(const Observation& sample, const Books& books);

  /// Half of the range [rad] or [m] of a joint over the run, and over the stretch of `time` [s]
  /// (nothing when it has fewer than three samples).
  double half_range(int joint) const;
  std::optional<double> half_range(int joint, double time) const;

  double rate_half_range() const;                            // [rad/s] of omega_BN_B
  double largest_rate() const { return largest_rate_; }      // [rad/s] |omega_BN_B|
  double largest_hinge_rate() const { return hinge_rate_; }  // [rad/s]
  double attitude_excursion() const { return excursion_; }   // [rad] from the first sample
  double travel() const;                                     // [m] half range of C
  double largest_distance() const { return distance_; }      // [m] of C from the origin
  double kepler_error() const { return kepler_error_; }      // [m] largest; 0 unless on an orbit
  bool is_kepler() const { return kepler_.has_value(); }
  double drift_in_orbit() const;  // [rad] along the orbit, from the balance of its energy
  double fastest_orbit_rate() const { return orbit_rate_; }  // [rad/s] |r x v| / r^2 at most

  const OwnEnergy& energy() const { return energy_; }
  const std::optional<Observation>& last() const { return last_; }

  /// Samples before which a rate jumped most, at most about eight, ascending in time.
  std::vector<Observation> jumps() const;

 private:
  struct Jump {
    double size = 0.0;
    Observation before;
  };
  void see_orbit(const Observation& sample, const Books& books);
  void see_jumps(const Observation& sample);
  void see_jump(std::size_t rate, double size);
  std::size_t stretch_of(double time) const;

  const Model& model_;
  std::vector<double> events_;
  std::vector<std::vector<Extent>> joints_;  // per stretch, per joint
  std::vector<long> samples_;                // per stretch
  std::vector<Extent> rates_;                // omega_BN_B
  std::vector<Extent> center_;               // r_CN_N
  double largest_rate_ = 0.0, hinge_rate_ = 0.0, excursion_ = 0.0, distance_ = 0.0;
  double kepler_error_ = 0.0, orbit_rate_ = 0.0, orbit_drift_ = 0.0;
  double energy_0_ = 0.0, last_loss_ = 0.0;
  std::optional<KeplerOrbit> kepler_;
  OwnEnergy energy_;
  std::optional<Observation> first_, last_;
  std::vector<std::vector<Jump>> jumps_;  // per rate, the largest first
  std::vector<Extent> joint_rates_;
};

}  // namespace twincraft
