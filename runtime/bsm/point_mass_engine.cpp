// See point_mass_engine.h. Tested by tests/runtime/point_mass_test.cpp.
#include "runtime/bsm/point_mass_engine.h"

#include "runtime/forces/point_mass.h"

namespace twincraft::bsm {
namespace {

double mass_of(const Model& model) {
  double mass = 0.0;
  for (const MassElement& element : model.assembly.links.front().elements) mass += element.mass;
  return mass;
}

class BsmPointMass final : public PointMassEngine {
 public:
  explicit BsmPointMass(const Model& model)
      : PointMassEngine(model, model.gravity.bsm), mass_(mass_of(model)) {}

  std::string_view name() const override { return kBsmKey; }
  std::unique_ptr<Engine> another() const override { return std::make_unique<BsmPointMass>(*this); }

  Eigen::MatrixXd mass_matrix(std::span<const double>) override {
    return mass_ * Matrix3d::Identity();
  }

 private:
  Vector3d acceleration(const Vector3d& r_BN_N, const Vector3d&) override {
    return gravity(r_BN_N) + held_force_N() / mass_;
  }
  double mass() const override { return mass_; }

  double mass_;  // [kg]
};

}  // namespace

std::unique_ptr<Engine> make_point_mass_engine(const Model& model) {
  return std::make_unique<BsmPointMass>(model);
}

}  // namespace twincraft::bsm
