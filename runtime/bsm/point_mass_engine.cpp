// See point_mass_engine.h. Tested by tests/runtime/point_mass_test.cpp.
#include "runtime/bsm/point_mass_engine.h"

#include "runtime/forces/point_mass.h"
#include "runtime/scalar/lanes.h"

namespace twincraft::bsm {
namespace {

using ::twincraft::TWINCRAFT_KERNEL::lane;
using ::twincraft::TWINCRAFT_KERNEL::Pair;
using ::twincraft::TWINCRAFT_KERNEL::two_lanes;

double mass_of(const Model& model) {
  double mass = 0.0;
  for (const MassElement& element : model.assembly.links.front().elements) mass += element.mass;
  return mass;
}

class BsmPointMass final : public PointMassEngine {
 public:
  explicit BsmPointMass(const Model& model)
      : PointMassEngine(model, model.gravity.bsm),
        mass_(mass_of(model)),
        pushed_(held_force_N() / mass_) {}
  BsmPointMass(const BsmPointMass& other)
      : PointMassEngine(other), mass_(other.mass_), pushed_(held_force_N() / mass_) {}

  std::string_view name() const override { return kBsmKey; }
  std::unique_ptr<Engine> another() const override { return std::make_unique<BsmPointMass>(*this); }

  void hold(const Inputs& inputs) override {
    PointMassEngine::hold(inputs);
    pushed_ = held_force_N() / mass_;
  }

  /// The state is read, and its rate put, two numbers at a time, as the stepper puts and reads
  /// them: a register that is read across two earlier stores has to wait for both.
  void derivative(double, std::span<const double> state, std::span<double> rate,
                  BookRates* books) override {
    const Pair r_xy = Pair::load_unaligned(state.data());
    const Pair r_z_v_x = Pair::load_unaligned(state.data() + 2);
    const Pair v_yz = Pair::load_unaligned(state.data() + 4);
    const Vector3d g = gravity({lane(r_xy, 0), lane(r_xy, 1), lane(r_z_v_x, 0)}), a = g + pushed_;
    two_lanes<Pair>(lane(r_z_v_x, 1), lane(v_yz, 0)).store_unaligned(rate.data());
    two_lanes<Pair>(lane(v_yz, 1), a.x()).store_unaligned(rate.data() + 2);
    two_lanes<Pair>(a.y(), a.z()).store_unaligned(rate.data() + 4);
    // Of the velocity as it lies there: what is kept for the books alone slows the bare run.
    if (books != nullptr) *books = book_rates(Vector3d(state.data() + StateLayout::velocity()), g);
  }

  Eigen::MatrixXd mass_matrix(std::span<const double>) override {
    return mass_ * Matrix3d::Identity();
  }

 private:
  double mass() const override { return mass_; }

  double mass_;      // [kg]
  Vector3d pushed_;  // [m/s^2] by what is held
};

}  // namespace

std::unique_ptr<Engine> make_point_mass_engine(const Model& model) {
  return std::make_unique<BsmPointMass>(model);
}

}  // namespace twincraft::bsm
