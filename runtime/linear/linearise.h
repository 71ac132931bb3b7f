// The vehicle's own motion about one state, as a linear system: x = (joint positions, omega_BN_B,
// joint rates, wheel rates), x' = A x + what drives it. Where the vehicle is and how it is turned
// changes none of this in deep space, so gravity is left out. A is differenced from the engine's
// own derivative.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/engine/engine.h"

namespace twincraft {

/// How a mode moves: its eigenvalue s [1/s], and who moves most.
struct Mode {
  std::complex<double> s;       // Im s >= 0: of a pair the one above
  Eigen::VectorXcd shape;       // over x
  std::string coordinate;       // `wing_p.1`, `rotation` of the hub
  bool is_rotation = false;     // the hub's rate leads
  std::complex<double> weight;  // eta: its share in what was asked of decompose()

  double rate() const { return std::abs(s); }  // [rad/s]
  double damping_ratio() const { return -s.real() / std::abs(s); }
  bool is_pair() const { return s.imag() > 0.0; }
};

/// Derivatives of one model without gravity, in the quaternion chart, at states that were observed.
class OwnMotion {
 public:
  /// @param model  outlives it
  explicit OwnMotion(const Model& model);

  int joints() const { return joints_; }
  int size() const { return 2 * joints_ + 3 + wheels_; }
  /// Entry of omega_BN_B in x; a joint's position is entry 0 to joints() - 1.
  int rate() const { return joints_; }

  /// Name of an entry's coordinate: `wing_p.1`, `rotation`, `rw_x`.
  const std::string& coordinate(int entry) const {
    return coordinates_[static_cast<std::size_t>(entry)];
  }

  /// x' at the state of `seen`, with the inputs of `held_at` [s].
  Eigen::VectorXd rates(const Observation& seen, double held_at);

  /// A at the state of `seen`, with the inputs of `held_at` [s].
  Eigen::MatrixXd jacobian(const Observation& seen, double held_at);

 private:
  Eigen::VectorXd reduced(double time, const Eigen::VectorXd& state);
  int state_entry(int entry) const;

  InputFeed feed_;
  std::unique_ptr<Engine> engine_;
  int joints_, wheels_;
  std::vector<std::string> coordinates_;
  Eigen::VectorXd derivative_;
};

/// The eigenvalues of more take seconds an instant: whoever may be asked of a vehicle with more
/// states does without modes.
inline constexpr int kMostStates = 600;

/// Of A; nothing where it is not finite, or where they are not found.
std::optional<Eigen::VectorXcd> eigenvalues(const Eigen::MatrixXd& A);

/// The modes of A, with weights eta of `drive` = sum of eta times shape (least squares). Slower
/// modes than `slowest` [rad/s] are left out.
std::vector<Mode> decompose(const OwnMotion& motion, const Eigen::MatrixXd& A,
                            const Eigen::VectorXd& drive, double slowest);

}  // namespace twincraft
