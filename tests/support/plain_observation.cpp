// See plain_observation.h. Vectors are in hub axes, and the velocity of B is taken as zero, until
// all is added up.
#include "tests/support/plain_observation.h"

namespace twincraft::test {
namespace {

struct Moving {
  double mass;
  Vector3d r_EB, v_E, spin;
  double spin_energy;
};

Moving moving(const Elements::Placed& element, const bsm::Motion& motion) {
  const LinkPose& pose = motion.poses[element.link];
  const LinkRate& rate = motion.rates[element.link];
  const Vector3d r_EL = pose.dcm_WL * element.r_EL_L();
  const Vector3d omega_L = pose.dcm_WL.transpose() * rate.omega_LN_W;
  const Vector3d spin_L = element.I_PntE_L() * omega_L;
  return {element.mass, pose.r_LB_W + r_EL, rate.v_LB_W + rate.omega_LN_W.cross(r_EL),
          pose.dcm_WL * spin_L, 0.5 * omega_L.dot(spin_L)};
}

}  // namespace

SizedObservation PlainObservation::observe(double time, std::span<const double> state) {
  SizedObservation seen;
  unpack(state, layout_, seen);
  const Matrix3d dcm_NB = seen.q_BN.toRotationMatrix();
  move_to(time, seen);

  seen.time = time;
  add_elements(seen);
  add_rotors(seen);
  seen.r_CN_N = seen.r_BN_N + dcm_NB * seen.r_CN_N;
  seen.v_CN_N = seen.v_BN_N + dcm_NB * seen.v_CN_N;
  seen.H_PntC_N = dcm_NB * seen.H_PntC_N;
  seen.momentum = seen.mass * seen.v_CN_N;
  seen.momentum_scale += seen.mass * seen.v_BN_N.norm();
  seen.kinetic = 0.5 * seen.mass * seen.v_CN_N.squaredNorm() + seen.own_kinetic;
  seen.springs = springs(seen);
  seen.potential =
      seen.springs + forces_.potential(dcm_NB.transpose() * seen.r_BN_N, motion_.poses);
  return seen;
}

void PlainObservation::add_elements(SizedObservation& seen) const {
  std::vector<Moving> all;
  for (const Elements::Placed& element : elements_) all.push_back(moving(element, motion_));
  for (const Moving& e : all) {
    seen.mass += e.mass;
    seen.r_CN_N += e.mass * e.r_EB;
    seen.v_CN_N += e.mass * e.v_E;
  }
  seen.r_CN_N /= seen.mass;
  seen.v_CN_N /= seen.mass;
  for (const Moving& e : all) {
    const Vector3d v_EC = e.v_E - seen.v_CN_N;
    const Vector3d H = (e.r_EB - seen.r_CN_N).cross(e.mass * v_EC) + e.spin;
    seen.H_PntC_N += H;
    seen.H_scale += H.norm();
    seen.momentum_scale += e.mass * e.v_E.norm();
    seen.own_kinetic += 0.5 * e.mass * v_EC.squaredNorm() + e.spin_energy;
    seen.own_kinetic_size += 0.5 * e.mass * e.v_E.squaredNorm() + e.spin_energy;
  }
}

/// Elements carry a wheel's whole tensor at the mount's rate; its own spin comes on top.
void PlainObservation::add_rotors(SizedObservation& seen) const {
  for (std::size_t k = 0; k < tree_.rotors.size(); ++k) {
    const bsm::RotorConstants& rotor = tree_.rotors[k];
    const auto i = static_cast<std::size_t>(rotor.link);
    const Vector3d axis = motion_.poses[i].dcm_WL * rotor.axis_L;
    const double spin = rotor.spin_inertia * seen.wheel_rate[k];
    const double energy = spin * (axis.dot(motion_.rates[i].omega_LN_W) + 0.5 * seen.wheel_rate[k]);
    seen.H_PntC_N += spin * axis;
    seen.H_scale += std::abs(spin);
    seen.own_kinetic += energy;
    seen.own_kinetic_size += std::abs(energy);
  }
}

double PlainObservation::springs(const Observation& seen) const {
  double energy = 0.0;
  for (std::size_t i = 1; i < tree_.links.size(); ++i) {
    const double stretch = seen.joint_position[i - 1] - tree_.links[i].rest;
    energy += 0.5 * tree_.links[i].stiffness * stretch * stretch;
  }
  return energy;
}

}  // namespace twincraft::test
