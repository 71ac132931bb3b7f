// Where what does not move on its own is carried: wheels and welded bodies.
// Tested by tests/compiler/model_builder_test.cpp and verify_test.cpp.
#include "compiler/ir/body_tree.h"

namespace twincraft {
namespace {

// MuJoCo's 1e-6 and a decade, so that how it normalises a quaternion plays no part.
constexpr double kLost = 1.0e-5;  // components of a quaternion, and [m]

bool is_small(const Vector3d& v) { return v.cwiseAbs().maxCoeff() < kLost; }

}  // namespace

std::vector<Seat> seats_of(const BodyTree& tree) {
  std::vector<Seat> seats;
  for (const TreeBody& body : tree.bodies) {
    Seat seat{.link = body.link};
    const bool is_welded = body.parent >= 0 && body.joints.empty();
    if (body.link < 0 || is_welded) {
      const Seat& mount = seats.at(static_cast<std::size_t>(body.parent));
      seat = {.link = mount.link,
              .dcm_LS = mount.dcm_LS * body.quat.toRotationMatrix(),
              .r_SL_L = mount.r_SL_L + mount.dcm_LS * body.pos};
    }
    seats.push_back(seat);
  }
  return seats;
}

std::vector<int> depths_of(const BodyTree& tree) {
  std::vector<int> depths;
  for (const TreeBody& body : tree.bodies) {
    const bool is_hub = body.parent < 0;
    depths.push_back(is_hub ? 0 : depths.at(static_cast<std::size_t>(body.parent)) + 1);
  }
  return depths;
}

PrincipalInertia told_inertia(const MassProperties& inertial) {
  const PrincipalInertia principal = principal_inertia(inertial.I_PntC_L);
  const Vector3d turn = principal.axes.vec();
  const bool loses_turn = is_small(turn) && !turn.isZero(0.0);
  const bool loses_place =
      is_small(turn) && is_small(inertial.r_CL_L) && !inertial.r_CL_L.isZero(0.0);
  if (!loses_turn && !loses_place) return principal;
  const Vector3d& moments = principal.moments;
  return {{moments.y(), moments.z(), moments.x()},
          (principal.axes * Quaterniond(0.5, 0.5, 0.5, 0.5)).normalized()};
}

MassElement seated(const MassElement& element, const Seat& seat) {
  MassElement on_link = element;
  on_link.r_EL_L = seat.r_SL_L + seat.dcm_LS * element.r_EL_L;
  const Matrix3d I = seat.dcm_LS * element.I_PntE_L * seat.dcm_LS.transpose();
  on_link.I_PntE_L = 0.5 * (I + I.transpose());  // rounding must not leave it asymmetric
  return on_link;
}

}  // namespace twincraft
