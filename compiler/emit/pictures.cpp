// See pictures.h. Tested by tests/runtime/mjcf_test.cpp.
#include "compiler/emit/pictures.h"

#include <algorithm>
#include <cmath>

#include "compiler/ir/rotation.h"

namespace twincraft {
namespace {

constexpr double kLeastHalfSide = 0.02;  // [m]

// Half sides [m] of the solid box of this mass and these moments.
Vector3d equivalent_box(double mass, const Vector3d& moments) {
  const Vector3d squares = 1.5 / mass * (Vector3d::Constant(moments.sum()) - 2.0 * moments);
  return squares.cwiseMax(kLeastHalfSide * kLeastHalfSide).cwiseSqrt();
}

Picture box_of(const MassProperties& properties, const char* material) {
  const PrincipalInertia principal = principal_inertia(properties.I_PntC_L);
  const Vector3d half = equivalent_box(properties.mass, principal.moments);
  return {"box", {half.x(), half.y(), half.z()}, properties.r_CL_L, principal.axes, material};
}

// The shortest half side of the hub: what parts of no known size are measured by.
double hub_size(const Model& model) {
  const MassProperties& hub = model.tree.bodies.front().inertial;
  if (!(hub.mass > 0.0)) return kLeastHalfSide;
  return equivalent_box(hub.mass, principal_inertia(hub.I_PntC_L).moments).minCoeff();
}

const TreeWheel* wheel_of(const Model& model, const TreeBody& body) {
  if (body.link >= 0) return nullptr;
  const auto wheel = std::ranges::find(model.tree.wheels, body.name, &TreeWheel::joint);
  return wheel == model.tree.wheels.end() ? nullptr : &*wheel;
}

// A disc a quarter as wide as the hub, as a token mass says nothing of its size, with a bar across
// it, so that it can be seen to turn.
std::vector<Picture> wheel_pictures(const Model& model, const TreeBody& wheel,
                                    const Vector3d& middle) {
  const double radius = 0.25 * hub_size(model), half_height = 0.2 * radius;
  const Quaterniond along = shortest_rotation(Vector3d::UnitZ(), wheel.joints.front().axis);
  return {{"cylinder", {radius, half_height}, middle, along, "wheel", wheel.name},
          {"box",
           {0.85 * radius, 0.08 * radius, 1.12 * half_height},
           middle,
           along,
           "wheel_mark",
           wheel.name + ".mark"}};
}

// The wheels whose bodies are tokens are drawn on their mounts, where they are.
void add_carried_wheels(const Model& model, const TreeBody& mount, std::vector<Picture>& pictures) {
  const std::vector<TreeBody>& bodies = model.tree.bodies;
  for (const TreeWheel& wheel : model.tree.wheels) {
    if (!wheel.center) continue;
    const TreeBody& body = bodies[static_cast<std::size_t>(wheel.body)];
    if (&bodies[static_cast<std::size_t>(body.parent)] != &mount) continue;
    for (Picture& each : wheel_pictures(model, body, *wheel.center))
      pictures.push_back(std::move(each));
  }
}

// A ball on a rod, whose volume is the mass's share of hub and ball.
std::vector<Picture> slosh_pictures(const Model& model, const TreeBody& body) {
  const double hub = model.tree.bodies.front().inertial.mass;
  const double mass = body.inertial.mass;
  const double radius = std::max(0.5 * hub_size(model) * std::cbrt(mass / (mass + hub)), 0.01);
  const Vector3d arm = body.look->pos;
  std::vector<Picture> pictures{{"sphere", {radius}, arm, Quaterniond::Identity(), "slosh"}};
  if (arm.norm() > radius)
    pictures.push_back({"cylinder",
                        {0.06 * radius, arm.norm() / 2.0},
                        arm / 2.0,
                        shortest_rotation(Vector3d::UnitZ(), arm),
                        "slosh"});
  return pictures;
}

Picture look_picture(const Look& look) {
  const char* const material = look.part == Look::Part::kPanel  ? "panel"
                               : look.part == Look::Part::kTank ? "tank"
                                                                : "body";
  const Vector3d half = look.half.cwiseMax(1.0e-3);
  switch (look.form) {
    case Look::Form::kSphere:
      return {"sphere", {half.x()}, look.pos, look.quat, material};
    case Look::Form::kCylinder:
      return {"cylinder", {half.x(), half.y()}, look.pos, look.quat, material};
    case Look::Form::kBox:
      break;
  }
  return {"box", {half.x(), half.y(), half.z()}, look.pos, look.quat, material};
}

std::vector<Picture> body_pictures(const Model& model, const TreeBody& body) {
  if (body.look && body.look->part == Look::Part::kSlosh) return slosh_pictures(model, body);
  if (body.look) return {look_picture(*body.look)};
  if (!(body.inertial.mass > 0.0)) return {};
  return {box_of(body.inertial, body.parent < 0 ? "hub" : "body")};
}

double radius_of(const Picture& picture) {
  double sum = 0.0;
  for (const double half : picture.size) sum += half * half;
  return picture.pos.norm() + std::sqrt(sum);
}

}  // namespace

std::vector<Picture> pictures_of(const Model& model, const TreeBody& body) {
  if (const TreeWheel* const wheel = wheel_of(model, body); wheel != nullptr) {
    if (wheel->center) return {};  // drawn on its mount
    return wheel_pictures(model, body, body.inertial.r_CL_L);
  }
  std::vector<Picture> pictures = body_pictures(model, body);
  add_carried_wheels(model, body, pictures);
  return pictures;
}

const std::vector<PictureMaterial>& picture_materials() {
  // The hub lets see what is in it.
  static const std::vector<PictureMaterial> materials{
      {"hub", "0.80 0.83 0.86 0.42", "0.3"},   {"body", "0.62 0.70 0.78 1", "0.3"},
      {"panel", "0.13 0.24 0.45 1", "0.8"},    {"wheel", "0.86 0.62 0.28 1", "0.6"},
      {"wheel_mark", "0.30 0.20 0.08 1", "0"}, {"tank", "0.72 0.64 0.46 0.38", "0.4"},
      {"slosh", "0.25 0.55 0.80 1", "0.6"},
  };
  return materials;
}

double extent_of(const Model& model) {
  std::vector<double> reach;  // of a body's origin from the hub's; travel of slides left out
  double extent = kLeastHalfSide;
  for (const TreeBody& body : model.tree.bodies) {
    const double parent = body.parent < 0 ? 0.0 : reach[static_cast<std::size_t>(body.parent)];
    reach.push_back(parent + body.pos.norm());
    for (const Picture& picture : pictures_of(model, body))
      extent = std::max(extent, reach.back() + radius_of(picture));
  }
  return extent;
}

}  // namespace twincraft
