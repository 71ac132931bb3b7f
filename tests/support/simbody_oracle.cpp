// See simbody_oracle.h. Tested by tests/oracles/simbody_test.cpp.
#include "tests/support/simbody_oracle.h"

#include <SimTKsimbody.h>

#include <cmath>

namespace twincraft::test {
namespace {

using SimTK::Inertia;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::Transform;
using SimTK::Vec3;

Vec3 vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d eigen(const Vec3& v) { return {v[0], v[1], v[2]}; }

Rotation rotation(const Matrix3d& R) {
  SimTK::Mat33 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = R(i, j);
  return Rotation(m, true);
}

/// A frame whose x, or z, is `axis`: what Simbody's sliders and pins go by.
Rotation along_x(const Vector3d& axis) {
  Matrix3d frame;
  frame << axis, axis.unitOrthogonal(), axis.cross(axis.unitOrthogonal());
  return rotation(frame);
}
Rotation along_z(const Vector3d& axis) {
  Matrix3d frame;
  frame << axis.unitOrthogonal(), axis.cross(axis.unitOrthogonal()), axis;
  return rotation(frame);
}

struct Lump {
  double mass;
  Vector3d r_L;
  Matrix3d I_PntE_L;
};

class System {
 public:
  System(const Model& model, double time) : model_(model), time_(time) {
    add_hub();
    for (std::size_t i = 1; i < model.assembly.links.size(); ++i) add_link(i);
    for (const Rotor& rotor : model.assembly.rotors) add_rotor(rotor);
    state_ = system_.realizeTopology();
    matter_.setUseEulerAngles(state_, false);
    system_.realizeModel(state_);
  }

  Eigen::VectorXd accelerations(GravityLaw law, const RandomState& at) {
    place(at);
    SimTK::Vector_<SimTK::SpatialVec> wrenches(matter_.getNumBodies(),
                                               SimTK::SpatialVec(Vec3(0), Vec3(0)));
    add_gravity(law, at.r_BN_N, wrenches);
    add_loads(wrenches);
    add_jets(wrenches);
    SimTK::Vector efforts(matter_.getNumMobilities(), 0.0), udot;
    add_efforts(at, efforts);
    SimTK::Vector_<SimTK::SpatialVec> unused;
    matter_.calcAcceleration(state_, efforts, wrenches, udot, unused);
    return answer(udot, at);
  }

 private:
  std::vector<Lump> lumps(std::size_t link) const {
    std::vector<Lump> all;
    for (const MassElement& e : model_.assembly.links[link].elements) {
      const double share =
          e.tank < 0 ? 1.0 : model_.tanks[static_cast<std::size_t>(e.tank)].share(time_);
      all.push_back({share * e.mass, e.r_EL_L, share * e.I_PntE_L});
    }
    return all;
  }

  /// A wheel takes its spin tensor, half of it about the axes across, and a token of mass at the
  /// mount's centre out of its mount: together they are the gyrostat.
  static Matrix3d spin_tensor(const Rotor& rotor) {
    const Matrix3d along = rotor.axis_L * rotor.axis_L.transpose();
    return rotor.spin_inertia * (0.5 * Matrix3d::Identity() + 0.5 * along);
  }
  MassProperties whole(std::size_t link) const {
    MassProperties sum;
    for (const Lump& lump : lumps(link))
      sum = sum + MassProperties{lump.mass, lump.r_L, lump.I_PntE_L};
    return sum;
  }
  double wheel_mass(std::size_t link) const { return 1.0e-3 * whole(link).mass; }

  /// Every body's frame is at its centre of mass, so that no tensor is moved there and back.
  static SimTK::Body::Rigid body_of(double mass, const Matrix3d& I) {
    const Inertia inertia =
        mass == 0.0 ? Inertia(0.0) : Inertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
    return SimTK::Body::Rigid(SimTK::MassProperties(mass, Vec3(0), inertia));
  }
  SimTK::Body::Rigid body(std::size_t link) const {
    MassProperties p = whole(link);
    for (const Rotor& rotor : model_.assembly.rotors) {
      if (rotor.link != static_cast<int>(link)) continue;
      p.mass -= wheel_mass(link);
      p.I_PntC_L -= spin_tensor(rotor);
    }
    return body_of(p.mass, p.I_PntC_L);
  }

  /// A point of a link in the frame of Simbody's body.
  Vec3 in_body(std::size_t link, const Vector3d& r_L) const { return vec(r_L - centers_[link]); }

  void add_hub() {
    centers_.push_back(whole(0).r_CL_L);
    const Transform hub_origin(in_body(0, Vector3d::Zero()));
    links_.push_back(MobilizedBody::Free(matter_.Ground(), Transform(), body(0), hub_origin));
  }

  void add_link(std::size_t index) {
    const Link& link = model_.assembly.links[index];
    const Joint& joint = link.joint;
    const auto on = static_cast<std::size_t>(link.parent);
    centers_.push_back(whole(index).r_CL_L);
    const bool slides = joint.kind == JointKind::kSlide;
    const Rotation axis = slides ? along_x(joint.axis_L) : along_z(joint.axis_L);
    const Transform at_parent(rotation(joint.dcm_PL0) * axis, in_body(on, joint.r_HP_P));
    const Transform at_link(axis, in_body(index, Vector3d::Zero()));
    if (slides)
      links_.push_back(MobilizedBody::Slider(links_[on], at_parent, body(index), at_link));
    else
      links_.push_back(MobilizedBody::Pin(links_[on], at_parent, body(index), at_link));
  }

  void add_rotor(const Rotor& rotor) {
    const auto link = static_cast<std::size_t>(rotor.link);
    const Transform axis(along_z(rotor.axis_L));
    rotors_.push_back(MobilizedBody::Pin(links_[link], axis,
                                         body_of(wheel_mass(link), spin_tensor(rotor)), axis));
  }

  void place(const RandomState& at) {
    // The hub at rest at the origin: what it does there it does anywhere.
    const MobilizedBody& hub = links_[0];
    hub.setQToFitTransform(state_, Transform(rotation(at.q_BN.toRotationMatrix())));
    const Vector3d omega_N = at.q_BN * at.omega_BN_B;
    hub.setUToFitVelocity(state_, SimTK::SpatialVec(vec(omega_N), Vec3(0)));
    for (std::size_t i = 1; i < links_.size(); ++i) {
      links_[i].setOneQ(state_, 0, at.joint_position[i - 1]);
      links_[i].setOneU(state_, 0, at.joint_rate[i - 1]);
    }
    for (std::size_t k = 0; k < rotors_.size(); ++k) {
      rotors_[k].setOneQ(state_, 0, 0.0);
      rotors_[k].setOneU(state_, 0, at.wheel_rate[k]);
    }
    system_.realize(state_, SimTK::Stage::Dynamics);
  }

  Vector3d in_N(std::size_t link, const Vector3d& r_L) const {
    return eigen(links_[link].findStationLocationInGround(state_, in_body(link, r_L)));
  }
  Vector3d velocity(std::size_t link, const Vector3d& r_L) const {
    return eigen(links_[link].findStationVelocityInGround(state_, in_body(link, r_L)));
  }
  Vector3d turned(std::size_t link, const Vector3d& v_L) const {
    return eigen(links_[link].expressVectorInGroundFrame(state_, vec(v_L)));
  }
  /// From B, N components.
  Vector3d center_of_mass() const {
    double mass = 0.0;
    Vector3d moment = Vector3d::Zero();
    for (std::size_t link = 0; link < links_.size(); ++link)
      for (const Lump& lump : lumps(link)) {
        mass += lump.mass;
        moment += lump.mass * in_N(link, lump.r_L);
      }
    return moment / mass;
  }

  void push(std::size_t link, const Vector3d& force_N, const Vector3d& at_N,
            const Vector3d& torque_N, SimTK::Vector_<SimTK::SpatialVec>& wrenches) const {
    const Vector3d origin = eigen(links_[link].getBodyOriginLocation(state_));
    const Vector3d torque = torque_N + (at_N - origin).cross(force_N);
    wrenches[links_[link].getMobilizedBodyIndex()] += SimTK::SpatialVec(vec(torque), vec(force_N));
  }

  /// The plain field, with all the digits of a long double.
  Vector3d field(const Vector3d& r_BN_N, const Vector3d& x_N) const {
    const Eigen::Matrix<long double, 3, 1> r = r_BN_N.cast<long double>() + x_N.cast<long double>();
    const long double d = r.norm();
    return (-static_cast<long double>(model_.gravity.mu) / (d * d * d) * r).cast<double>();
  }

  void add_gravity(GravityLaw law, const Vector3d& r_BN_N,
                   SimTK::Vector_<SimTK::SpatialVec>& wrenches) const {
    if (law == GravityLaw::kNone) return;
    const Vector3d uniform = field(r_BN_N, center_of_mass());
    for (std::size_t link = 0; link < links_.size(); ++link) {
      for (const Lump& lump : lumps(link)) {
        const Vector3d x = in_N(link, lump.r_L);
        const Vector3d g = law == GravityLaw::kSystemCom ? uniform : field(r_BN_N, x);
        Vector3d torque = Vector3d::Zero();
        if (law == GravityLaw::kBodyGradient) {
          const Vector3d r = r_BN_N + x;
          const Vector3d axis_L = eigen(
              links_[link].expressGroundVectorInBodyFrame(state_, vec(Vector3d(r.normalized()))));
          const double size = 3.0 * model_.gravity.mu / std::pow(r.norm(), 3);
          torque = turned(link, size * axis_L.cross(lump.I_PntE_L * axis_L));
        }
        push(link, lump.mass * g, x, torque, wrenches);
      }
    }
  }

  void add_loads(SimTK::Vector_<SimTK::SpatialVec>& wrenches) const {
    for (const Load& load : model_.loads) {
      const auto link = static_cast<std::size_t>(load.link);
      Vector3d force, torque;
      for (int i = 0; i < 3; ++i) {
        force[i] = load.force_L[static_cast<std::size_t>(i)].at(time_);
        torque[i] = load.torque_L[static_cast<std::size_t>(i)].at(time_);
      }
      const Vector3d at = load.r_FL_L ? in_N(link, *load.r_FL_L) : center_of_mass();
      push(link, turned(link, force), at, turned(link, torque), wrenches);
    }
  }

  /// Of every element that drains as a jet: half of the Coriolis force of its stream at either end,
  /// and the turning that it gives back as it draws together.
  void add_jets(SimTK::Vector_<SimTK::SpatialVec>& wrenches) const {
    for (const Nozzle& nozzle : model_.nozzles) {
      const auto out = static_cast<std::size_t>(nozzle.link);
      const Tank& tank = model_.tanks[static_cast<std::size_t>(nozzle.tank)];
      for (std::size_t link = 0; link < links_.size(); ++link) {
        for (const MassElement& e : model_.assembly.links[link].elements) {
          if (e.tank != nozzle.tank) continue;
          const double flow = nozzle.mass_flow.at(time_) * e.mass / tank.content;
          const Vector3d apart = velocity(out, nozzle.r_PL_L) - velocity(link, e.r_EL_L);
          const Vector3d omega_L = eigen(links_[link].expressGroundVectorInBodyFrame(
              state_, links_[link].getBodyAngularVelocity(state_)));
          const Vector3d turning = turned(link, flow / e.mass * e.I_PntE_L * omega_L);
          push(out, -flow * apart, in_N(out, nozzle.r_PL_L), Vector3d::Zero(), wrenches);
          push(link, -flow * apart, in_N(link, e.r_EL_L), turning, wrenches);
        }
      }
    }
  }

  void add_efforts(const RandomState& at, SimTK::Vector& efforts) const {
    for (std::size_t i = 1; i < links_.size(); ++i) {
      const Joint& joint = model_.assembly.links[i].joint;
      double damping = joint.damping;
      if (joint.damped_by_cosine_of >= 0) {
        const auto other = static_cast<std::size_t>(joint.damped_by_cosine_of);
        damping *= std::pow(std::cos(at.joint_position[other - 1]), 2);
      }
      const double effort = joint.effort.at(time_) -
                            joint.stiffness * (at.joint_position[i - 1] - joint.rest) -
                            damping * at.joint_rate[i - 1];
      links_[i].applyOneMobilityForce(state_, 0, effort, efforts);
    }
    for (std::size_t k = 0; k < rotors_.size(); ++k)
      rotors_[k].applyOneMobilityForce(state_, 0, model_.assembly.rotors[k].torque.at(time_),
                                       efforts);
  }

  Eigen::VectorXd answer(const SimTK::Vector& udot, const RandomState& at) const {
    Eigen::VectorXd all(6 + at.joint_rate.size() + at.wheel_rate.size());
    const Vector3d omegaDot_N(udot[0], udot[1], udot[2]);
    all.head<3>() << udot[3], udot[4], udot[5];
    all.segment<3>(3) = at.q_BN.conjugate() * omegaDot_N;
    Eigen::Index entry = 6;
    for (std::size_t i = 1; i < links_.size(); ++i)
      all[entry++] = links_[i].getOneFromUPartition(state_, 0, udot);
    for (const MobilizedBody& rotor : rotors_)
      all[entry++] = rotor.getOneFromUPartition(state_, 0, udot);
    return all;
  }

  const Model& model_;
  double time_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  std::vector<MobilizedBody> links_;
  std::vector<Vector3d> centers_;  // [m] of mass, from each link's origin
  std::vector<MobilizedBody> rotors_;
  SimTK::State state_;
};

}  // namespace

Eigen::VectorXd simbody_accelerations(const Model& model, GravityLaw law,
                                      const RandomState& state) {
  return System(model, state.time).accelerations(law, state);
}

}  // namespace twincraft::test
