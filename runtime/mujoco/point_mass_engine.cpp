// Decides what MuJoCo sees of a point mass. In the co-moving frame the slides are at zero and at
// rest, the loads are its only forces, and gravity is added to the answer; in the inertial frame
// they hold the orbital state itself, and gravity is one more force. Only the stages that matter to
// slides are called. Tested by tests/runtime/point_mass_test.cpp.
#include "runtime/mujoco/point_mass_engine.h"

#include <algorithm>

#include "runtime/forces/point_mass.h"
#include "runtime/mujoco/handles.h"
#include "runtime/mujoco/tree_map.h"

namespace twincraft {
namespace {

class MujocoPointMass final : public PointMassEngine {
 public:
  MujocoPointMass(const Model& model, const std::string& mjcf)
      : PointMassEngine(model, model.gravity.mujoco),
        raw_(model.engines.frame == MujocoFrame::kInertial),
        model_(load(model, mjcf)),
        data_(make_data(*model_)) {}
  MujocoPointMass(const MujocoPointMass& other)
      : PointMassEngine(other), raw_(other.raw_), model_(other.model_), data_(make_data(*model_)) {}
  MujocoPointMass& operator=(const MujocoPointMass&) = delete;

  std::string_view name() const override { return kMujocoKey; }
  std::unique_ptr<Engine> another() const override {
    return std::make_unique<MujocoPointMass>(*this);
  }

  void derivative(double, std::span<const double> state, std::span<double> rate,
                  BookRates* books) override {
    const Vector3d r_BN_N(state.data() + StateLayout::position());
    const Vector3d v_BN_N(state.data() + StateLayout::velocity());
    const Vector3d g = gravity(r_BN_N), a = acceleration(r_BN_N, v_BN_N, g);
    std::copy_n(v_BN_N.data(), 3, rate.data() + StateLayout::position());
    std::copy_n(a.data(), 3, rate.data() + StateLayout::velocity());
    if (books != nullptr) *books = book_rates(v_BN_N, g);
  }

  Eigen::MatrixXd mass_matrix(std::span<const double>) override {
    place(Vector3d::Zero(), Vector3d::Zero());
    mj_crb(model_.get(), data_.get());
    Matrix3d matrix;
    mj_fullM(model_.get(), matrix.data(), data_->qM);
    return matrix;
  }

 private:
  static std::shared_ptr<const mjModel> load(const Model& model, const std::string& mjcf) {
    MujocoModel loaded = load_mjcf(mjcf);
    if (loaded->nq != 3 || loaded->nv != 3)
      throw NumericalFailure("mujoco: the MJCF is not that of a point mass");
    restore_exact_masses(model.tree, *loaded);
    hide_pictures(*loaded);
    return loaded;
  }

  /// Of the hub origin [m/s^2]. @param g  gravity there
  Vector3d acceleration(const Vector3d& r_BN_N, const Vector3d& v_BN_N, const Vector3d& g) {
    const mjModel* m = model_.get();
    mjData* d = data_.get();
    place(raw_ ? r_BN_N : Vector3d::Zero(), raw_ ? v_BN_N : Vector3d::Zero());
    mj_crb(m, d);
    mj_factorM(m, d);
    mj_comVel(m, d);
    mj_rne(m, d, 0, d->qfrc_bias);
    Vector3d force = held_force_N();
    if (raw_) force += mass() * g;
    for (int i = 0; i < 3; ++i) d->qacc[i] = force[i] - d->qfrc_bias[i];
    mj_solveM(m, d, d->qacc, d->qacc, 1);
    const Vector3d solved = Eigen::Map<const Vector3d>(d->qacc);
    return raw_ ? solved : Vector3d(solved + g);
  }

  double mass() const override { return model_->body_mass[kHubBody]; }

  void place(const Vector3d& r, const Vector3d& v) {
    std::copy_n(r.data(), 3, data_->qpos);
    std::copy_n(v.data(), 3, data_->qvel);
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
  }

  bool raw_;
  std::shared_ptr<const mjModel> model_;
  MujocoData data_;
};

}  // namespace

std::unique_ptr<Engine> make_mujoco_point_mass_engine(const Model& model, const std::string& mjcf) {
  return std::make_unique<MujocoPointMass>(model, mjcf);
}

}  // namespace twincraft
