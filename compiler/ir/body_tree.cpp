// Where what does not move on its own is carried: wheels and welded bodies.
// Tested by tests/compiler/model_builder_test.cpp and verify_test.cpp.
#include "compiler/ir/body_tree.h"

namespace twincraft {

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

MassElement seated(const MassElement& element, const Seat& seat) {
  MassElement on_link = element;
  on_link.r_EL_L = seat.r_SL_L + seat.dcm_LS * element.r_EL_L;
  const Matrix3d I = seat.dcm_LS * element.I_PntE_L * seat.dcm_LS.transpose();
  on_link.I_PntE_L = 0.5 * (I + I.transpose());  // rounding must not leave it asymmetric
  return on_link;
}

}  // namespace twincraft
