// See inertia_terms.h. Sizes are added where MuJoCo adds numbers with signs.
#include "runtime/mujoco/inertia_terms.h"

#include <vector>

#include "runtime/mujoco/tree_map.h"

namespace twincraft {
namespace {

using Point = Eigen::Map<const Vector3d>;

/// Of a body, then of all outboard of it as well. A distance from C is rounded as a difference of
/// places seen from the hub's origin, so the sum of both stands for it.
struct Sizes {
  double mass = 0.0;     // [kg]
  double first = 0.0;    // [kg m] of m r
  double second = 0.0;   // [kg m^2] of inertia and m r^2
  double force = 0.0;    // [N] of bias forces
  double torque = 0.0;   // [N m] about C
  double angular = 0.0;  // [rad/s^2] of the bias acceleration, and of the turning's own
  double linear = 0.0;   // [m/s^2] of the body's point at C
};

/// What a unit rate of a degree of freedom moves: turns [1], and shifts the point at C [m] or [1].
struct Motion {
  double turn = 0.0, shift = 0.0;
};

double center_distance(const mjData& data) { return Point(data.subtree_com + 3 * kHubBody).norm(); }

std::vector<Motion> motions_of(const mjModel& model, const mjData& data) {
  const double center = center_distance(data);
  std::vector<Motion> motions(static_cast<std::size_t>(model.nv));
  for (int i = 0; i < model.nv; ++i) {
    const int joint = model.dof_jntid[i];
    const bool shifts = model.jnt_type[joint] == mjJNT_SLIDE || i < 3;
    motions[static_cast<std::size_t>(i)] =
        shifts ? Motion{0.0, 1.0} : Motion{1.0, Point(data.xanchor + 3 * joint).norm() + center};
  }
  return motions;
}

std::vector<Sizes> sizes_of(const mjModel& model, const mjData& data) {
  const double center = center_distance(data);
  std::vector<Sizes> sizes(static_cast<std::size_t>(model.nbody));
  std::vector<double> angular(sizes.size()), linear(sizes.size());  // of cdof_dot * qvel
  for (int body = kHubBody; body < model.nbody; ++body) {
    const auto b = static_cast<std::size_t>(body);
    const auto parent = static_cast<std::size_t>(model.body_parentid[body]);
    angular[b] = angular[parent];
    linear[b] = linear[parent];
    const int first = model.body_dofadr[body];
    for (int i = first; i < first + model.body_dofnum[body]; ++i) {
      angular[b] += Point(data.cdof_dot + 6 * i).norm() * std::abs(data.qvel[i]);
      linear[b] += Point(data.cdof_dot + 6 * i + 3).norm() * std::abs(data.qvel[i]);
    }
    const double rate = Point(data.cvel + 6 * body).norm();
    const double speed = Point(data.cvel + 6 * body + 3).norm();
    const double r = Point(data.xipos + 3 * body).norm() + center;
    Sizes& own = sizes[b];
    own.mass = model.body_mass[body];
    own.first = own.mass * r;
    own.second = Point(model.body_inertia + 3 * body).sum() + own.mass * r * r;
    own.angular = angular[b] + rate * rate;
    own.linear = linear[b] + rate * speed;
    own.force = own.mass * own.linear + own.first * own.angular;
    own.torque = own.first * own.linear + own.second * own.angular;
  }
  for (int body = model.nbody - 1; body > kHubBody; --body) {
    const Sizes& own = sizes[static_cast<std::size_t>(body)];
    Sizes& parent = sizes[static_cast<std::size_t>(model.body_parentid[body])];
    parent.mass += own.mass;
    parent.first += own.first;
    parent.second += own.second;
    parent.force += own.force;
    parent.torque += own.torque;
  }
  return sizes;
}

}  // namespace

RoundingTerms inertia_terms(const mjModel& model, const mjData& data) {
  const std::vector<Motion> motions = motions_of(model, data);
  const std::vector<Sizes> sizes = sizes_of(model, data);
  RoundingTerms terms{Eigen::MatrixXd::Zero(model.nv, model.nv), Eigen::VectorXd::Zero(model.nv)};
  for (int i = 0; i < model.nv; ++i) {
    const Motion& a = motions[static_cast<std::size_t>(i)];
    const Sizes& outboard = sizes[static_cast<std::size_t>(model.dof_bodyid[i])];
    terms.force[i] =
        a.turn * outboard.torque + a.shift * outboard.force + std::abs(data.qfrc_passive[i]);
    for (int j = i; j >= 0; j = model.dof_parentid[j]) {
      const Motion& b = motions[static_cast<std::size_t>(j)];
      terms.mass(i, j) = terms.mass(j, i) = a.turn * b.turn * outboard.second +
                                            (a.turn * b.shift + a.shift * b.turn) * outboard.first +
                                            a.shift * b.shift * outboard.mass;
    }
  }
  return terms;
}

}  // namespace twincraft
