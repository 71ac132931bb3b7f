// Both halves are brought into one plain form, a list of rigid bodies with one coordinate each, and
// their mass matrices are formed column by column: M u is the generalised momentum of rates u.
// Tested by tests/compiler/verify_test.cpp.
#include "compiler/analysis/verify.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>

namespace twincraft {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRandomConfigurations = 3;
constexpr unsigned kSeed = 1;

struct Body {
  int parent = -1;
  Vector3d pos = Vector3d::Zero();  // [m] in the parent's axes
  Matrix3d dcm_PB = Matrix3d::Identity();
  int coordinate = -1;  // entry of the rate vector; -1: the hub, or fixed in its parent
  JointKind kind = JointKind::kHinge;
  Vector3d axis = Vector3d::UnitZ();  // body axes
  MassProperties inertial;
};

/// Rates u are the hub's velocity and angular velocity in hub axes, joint rates, wheel speeds.
struct Machine {
  std::vector<Body> bodies;
  std::vector<Rotor> rotors;  // gyrostats; the tree has none, its wheels are bodies
  int coordinates = 0;
};

template <class T>
auto& at(std::vector<T>& items, int index) {
  return items.at(static_cast<std::size_t>(index));
}
template <class T>
const auto& at(const std::vector<T>& items, int index) {
  return items.at(static_cast<std::size_t>(index));
}

int first_rotor(const Model& model) {
  return 6 + static_cast<int>(model.assembly.links.size()) - 1;
}

/// Of the vehicle as a body that moves freely, also where the run then holds its attitude.
int rigid_coordinates(const Model& model) {
  return first_rotor(model) + static_cast<int>(model.assembly.rotors.size());
}

MassProperties sum_of(const std::vector<MassElement>& elements) {
  MassProperties sum;
  for (const MassElement& element : elements) sum = sum + properties_of(element);
  return sum;
}

/// A wheel body whose mass no component declared.
bool is_token(const Model& model, const TreeBody& body) {
  if (body.link >= 0) return false;
  const int mount = at(model.tree.bodies, body.parent).link;
  for (const MassElement& element : at(model.assembly.links, mount).elements) {
    if (element.name == body.name) return false;
  }
  return true;
}

/// The last joint of a body is its link's own; those before it belong to the links before.
int link_of_joint(const TreeBody& body, std::size_t joint) {
  return body.link - static_cast<int>(body.joints.size() - 1 - joint);
}

Machine machine_of_assembly(const Model& model) {
  Machine machine;
  machine.coordinates = rigid_coordinates(model);
  machine.rotors = model.assembly.rotors;
  for (const Link& link : model.assembly.links) {
    Body body;
    body.parent = link.parent;
    body.inertial = sum_of(link.elements);
    if (link.parent >= 0) {
      body.pos = link.joint.r_HP_P;
      body.dcm_PB = link.joint.dcm_PL0;
      body.coordinate = 5 + static_cast<int>(machine.bodies.size());
      body.kind = link.joint.kind;
      body.axis = link.joint.axis_L;
    }
    machine.bodies.push_back(body);
  }
  for (const TreeBody& body : model.tree.bodies) {
    if (body.token_inertia == 0.0) continue;
    at(machine.bodies, body.link).inertial.I_PntC_L += body.token_inertia * Matrix3d::Identity();
  }
  if (model.engines.compensate) return machine;
  const std::vector<Seat> seats = seats_of(model.tree);
  for (std::size_t i = 0; i < seats.size(); ++i) {
    const TreeBody& body = model.tree.bodies[i];
    if (!is_token(model, body)) continue;
    MassProperties& mount = at(machine.bodies, seats[i].link).inertial;
    mount = mount + MassProperties{body.inertial.mass, seats[i].r_SL_L, Matrix3d::Zero()};
  }
  return machine;
}

Machine machine_of_tree(const Model& model) {
  std::map<std::string, int> rotor_of_joint;
  for (const TreeWheel& wheel : model.tree.wheels) rotor_of_joint[wheel.joint] = wheel.rotor;

  Machine machine;
  machine.coordinates = rigid_coordinates(model);
  std::vector<int> machine_body;  // per tree body; one with several joints is a row of bodies
  for (const TreeBody& tree_body : model.tree.bodies) {
    Body body;
    body.parent = tree_body.parent < 0 ? -1 : at(machine_body, tree_body.parent);
    body.pos = tree_body.pos;
    body.dcm_PB = tree_body.quat.toRotationMatrix();
    for (std::size_t i = 0; i < tree_body.joints.size(); ++i) {
      const TreeJoint& joint = tree_body.joints[i];
      if (i > 0) {
        machine.bodies.push_back(body);
        body = Body{};
        body.parent = static_cast<int>(machine.bodies.size()) - 1;
      }
      body.kind = joint.kind;
      body.axis = joint.axis;
      body.coordinate = tree_body.link >= 0 ? 5 + link_of_joint(tree_body, i)
                                            : first_rotor(model) + rotor_of_joint.at(joint.name);
    }
    body.inertial = tree_body.inertial;
    machine_body.push_back(static_cast<int>(machine.bodies.size()));
    machine.bodies.push_back(body);
  }
  return machine;
}

/// All in hub axes.
struct Pose {
  Matrix3d dcm = Matrix3d::Identity();  // body to hub axes
  Vector3d offset = Vector3d::Zero();   // [m] origin from the parent's origin
  Vector3d axis = Vector3d::Zero();
  Vector3d center = Vector3d::Zero();  // [m] center of mass from the origin
  Matrix3d inertia;                    // [kg m^2] about the center of mass
};

std::vector<Pose> poses_of(const Machine& machine, const VectorXd& q) {
  std::vector<Pose> poses;
  poses.reserve(machine.bodies.size());
  for (const Body& body : machine.bodies) {
    Pose pose;
    if (body.parent >= 0) {
      const Matrix3d dcm_parent = at(poses, body.parent).dcm;
      const Matrix3d dcm_0 = dcm_parent * body.dcm_PB;
      const double coordinate = body.coordinate < 0 ? 0.0 : q[body.coordinate];
      pose.axis = dcm_0 * body.axis;
      pose.offset = dcm_parent * body.pos;
      pose.dcm = dcm_0;
      if (body.kind == JointKind::kHinge) {
        pose.dcm = dcm_0 * Eigen::AngleAxisd(coordinate, body.axis).toRotationMatrix();
      } else {
        pose.offset += coordinate * pose.axis;
      }
    }
    pose.center = pose.dcm * body.inertial.r_CL_L;
    pose.inertia = pose.dcm * body.inertial.I_PntC_L * pose.dcm.transpose();
    poses.push_back(pose);
  }
  return poses;
}

/// Angular and linear: a velocity and rate of a body's origin, or a momentum about it.
struct Motor {
  Vector3d angular = Vector3d::Zero();
  Vector3d linear = Vector3d::Zero();
};

std::vector<Motor> velocities(const Machine& machine, const std::vector<Pose>& poses,
                              const VectorXd& u) {
  std::vector<Motor> motion;
  motion.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Body& body = machine.bodies[i];
    Motor own{u.segment<3>(3), u.segment<3>(0)};
    if (body.parent >= 0) {
      own = at(motion, body.parent);
      own.linear += own.angular.cross(poses[i].offset);
      if (body.coordinate >= 0) {
        (body.kind == JointKind::kHinge ? own.angular : own.linear) +=
            poses[i].axis * u[body.coordinate];
      }
    }
    motion.push_back(own);
  }
  return motion;
}

/// M u.
VectorXd generalised_momentum(const Machine& machine, const std::vector<Pose>& poses,
                              const VectorXd& u) {
  const std::vector<Motor> motion = velocities(machine, poses, u);
  VectorXd momentum = VectorXd::Zero(machine.coordinates);
  std::vector<Motor> carried(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector3d& c = poses[i].center;
    carried[i].linear =
        machine.bodies[i].inertial.mass * (motion[i].linear + motion[i].angular.cross(c));
    carried[i].angular = poses[i].inertia * motion[i].angular + c.cross(carried[i].linear);
  }
  const auto rotors = static_cast<int>(machine.rotors.size());
  for (int i = 0; i < rotors; ++i) {
    const Rotor& rotor = at(machine.rotors, i);
    const int coordinate = machine.coordinates - rotors + i;
    const Vector3d axis = at(poses, rotor.link).dcm * rotor.axis_L;
    const double rate = axis.dot(at(motion, rotor.link).angular) + u[coordinate];
    momentum[coordinate] = rotor.spin_inertia * rate;
    at(carried, rotor.link).angular += rotor.spin_inertia * u[coordinate] * axis;
  }
  for (std::size_t i = poses.size(); i-- > 1;) {
    const Body& body = machine.bodies[i];
    if (body.coordinate >= 0) {
      momentum[body.coordinate] = poses[i].axis.dot(
          body.kind == JointKind::kHinge ? carried[i].angular : carried[i].linear);
    }
    Motor& parent = at(carried, body.parent);
    parent.linear += carried[i].linear;
    parent.angular += carried[i].angular + poses[i].offset.cross(carried[i].linear);
  }
  momentum.segment<3>(0) = carried[0].linear;
  momentum.segment<3>(3) = carried[0].angular;
  return momentum;
}

/// The hub's six and all others; of a very long vehicle evenly spaced ones, because what differs
/// anywhere shows in the rows of all that carries it.
std::vector<int> compared_coordinates(int coordinates) {
  constexpr int kMost = 300;
  std::vector<int> compared(6);
  std::iota(compared.begin(), compared.end(), 0);
  const int stride = 1 + coordinates / kMost;
  for (int i = 6; i < coordinates; i += stride) compared.push_back(i);
  return compared;
}

/// Rows and columns of `compared` only.
MatrixXd mass_matrix(const Machine& machine, const VectorXd& q, const std::vector<int>& compared) {
  const std::vector<Pose> poses = poses_of(machine, q);
  const auto size = static_cast<Eigen::Index>(compared.size());
  MatrixXd M(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const VectorXd u = VectorXd::Unit(machine.coordinates, at(compared, static_cast<int>(i)));
    M.col(i) = generalised_momentum(machine, poses, u)(compared);
  }
  return M;
}

std::string coordinate_name(const Model& model, int i) {
  if (i < 3) return "translation";
  if (i < 6) return "rotation";
  if (i < first_rotor(model)) return at(model.assembly.links, i - 5).name;
  return at(model.assembly.rotors, i - first_rotor(model)).name;
}

/// Entries are compared on the scale sqrt(M_ii M_jj), the largest that entry can be. Both halves
/// round some ten products per entry, and a chain adds an ulp or two for each of its bodies.
double tolerance(const Model& model) {
  return 1e-12 + 1e-15 * static_cast<double>(model.tree.bodies.size());
}

struct Halves {
  Machine assembly, tree;
};

void compare_mass_matrices(const Model& model, const Halves& halves, const VectorXd& q,
                           const std::string& where, std::vector<std::string>& failures) {
  const std::vector<int> compared = compared_coordinates(rigid_coordinates(model));
  const MatrixXd a = mass_matrix(halves.assembly, q, compared);
  const MatrixXd b = mass_matrix(halves.tree, q, compared);
  double worst = 0.0;
  int row = 0;
  int column = 0;
  for (int i = 0; i < a.rows(); ++i) {
    for (int j = 0; j < a.cols(); ++j) {
      const double difference = std::abs(a(i, j) - b(i, j)) / std::sqrt(a(i, i) * a(j, j));
      if (difference <= worst || std::isnan(worst)) continue;  // NaN is the worst there is
      worst = difference;
      row = i;
      column = j;
    }
  }
  if (worst <= tolerance(model)) return;
  failures.push_back(fmt::format("the mass matrices differ by {:.2g} between `{}` and `{}` {}",
                                 worst, coordinate_name(model, at(compared, row)),
                                 coordinate_name(model, at(compared, column)), where));
}

VectorXd initial_configuration(const Model& model) {
  VectorXd q = VectorXd::Zero(rigid_coordinates(model));
  for (std::size_t i = 0; i < model.initial.joint_position.size(); ++i) {
    q[static_cast<Eigen::Index>(6 + i)] = model.initial.joint_position[i];
  }
  return q;
}

void compare_motion(const Model& model, std::vector<std::string>& failures) {
  const Halves halves{machine_of_assembly(model), machine_of_tree(model)};
  VectorXd q = initial_configuration(model);
  compare_mass_matrices(model, halves, q, "in the initial configuration", failures);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int n = 1; n <= kRandomConfigurations && failures.empty(); ++n) {
    for (double& coordinate : q) coordinate = uniform(random);
    compare_mass_matrices(model, halves, q, fmt::format("in random configuration {}", n), failures);
  }
}

bool same_spring(const Joint& joint, const TreeJoint& tree_joint) {
  return joint.kind == tree_joint.kind && joint.stiffness == tree_joint.stiffness &&
         joint.damping == tree_joint.damping && joint.rest == tree_joint.springref;
}

void compare_names(const Model& model, std::vector<std::string>& failures) {
  std::size_t joints = 0;
  for (const TreeBody& body : model.tree.bodies) {
    joints += body.joints.size();
    if (body.link <= 0) continue;
    for (std::size_t i = 0; i < body.joints.size(); ++i) {
      const Link& link = at(model.assembly.links, link_of_joint(body, i));
      const bool matches =
          body.joints[i].name == link.name && same_spring(link.joint, body.joints[i]);
      if (!matches) failures.push_back(fmt::format("the joint of `{}` differs", link.name));
    }
  }
  const std::size_t coordinates = static_cast<std::size_t>(rigid_coordinates(model)) - 6;
  if (joints != coordinates || model.coordinates.size() != coordinates) {
    failures.push_back(
        fmt::format("{} coordinates are named, the assembly has {} and the tree has {} joints",
                    model.coordinates.size(), coordinates, joints));
  }
  for (const TreeWheel& wheel : model.tree.wheels) {
    if (at(model.assembly.rotors, wheel.rotor).name == wheel.joint) continue;
    failures.push_back(fmt::format("wheel `{}` stands for another rotor", wheel.joint));
  }
}

/// Relative to the size of the first; lengths and tensors on the scale of the body.
bool same_properties(const MassProperties& a, const MassProperties& b) {
  constexpr double kRelative = 1e-12;  // a handful of elements, each rounded once or twice
  const double size = a.I_PntC_L.norm() + a.mass * a.r_CL_L.squaredNorm();
  return std::abs(a.mass - b.mass) <= kRelative * a.mass &&
         (a.r_CL_L - b.r_CL_L).norm() <= kRelative * (a.r_CL_L.norm() + std::sqrt(size / a.mass)) &&
         (a.I_PntC_L - b.I_PntC_L).norm() <= kRelative * size;
}

/// Gravity must pull on the same elements in both halves.
void compare_elements(const Model& model, std::vector<std::string>& failures) {
  std::vector<std::vector<MassElement>> in_tree(model.assembly.links.size());
  const std::vector<Seat> seats = seats_of(model.tree);
  for (std::size_t i = 0; i < seats.size(); ++i) {
    const TreeBody& body = model.tree.bodies[i];
    if (is_token(model, body)) continue;
    const Seat& seat = seats[i];
    for (const MassElement& element : body.elements) {
      at(in_tree, seat.link).push_back(seated(element, seat));
    }
  }
  for (std::size_t i = 0; i < in_tree.size(); ++i) {
    const Link& link = model.assembly.links[i];
    if (in_tree[i].empty() && link.elements.empty()) continue;  // a pendulum's first link
    const bool same = in_tree[i].size() == link.elements.size() &&
                      same_properties(sum_of(link.elements), sum_of(in_tree[i]));
    if (!same) failures.push_back(fmt::format("gravity pulls on other masses at `{}`", link.name));
  }
}

}  // namespace

bool is_finite(const Model& model) {
  const VehicleState& initial = model.initial;
  return initial.r_BN_N.allFinite() && initial.v_BN_N.allFinite() &&
         initial.q_BN.coeffs().allFinite() && initial.omega_BN_B.allFinite() &&
         mass_matrix(machine_of_assembly(model), initial_configuration(model),
                     compared_coordinates(rigid_coordinates(model)))
             .allFinite();
}

std::vector<std::string> verify(const Model& model) {
  std::vector<std::string> failures;
  compare_names(model, failures);
  if (!failures.empty()) return failures;  // the matrices need matching coordinates
  compare_elements(model, failures);
  compare_motion(model, failures);
  return failures;
}

}  // namespace twincraft
