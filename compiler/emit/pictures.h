// What the vehicle looks like in MuJoCo's viewer and in reports: geoms that have no mass, touch
// nothing and are skipped when the engine runs. Where a component knows its shape it is drawn; any
// other body is the box that its inertia suggests.
// Tested by tests/runtime/mjcf_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// A geom in MJCF's own terms.
struct Picture {
  std::string type;  // `box`
  std::vector<double> size;
  Vector3d pos;      // [m] body axes
  Quaterniond quat;  // geom to body
  std::string material;
  std::string name = {};  // of what turns with a wheel: the wheel's, before a dot
};

std::vector<Picture> pictures_of(const Model& model, const TreeBody& body);

struct PictureMaterial {
  const char* name;
  const char* rgba;
  const char* specular;
};

/// Every material that a picture names.
const std::vector<PictureMaterial>& picture_materials();

/// Radius [m] of a sphere about the hub's origin that holds the vehicle however its joints turn.
double extent_of(const Model& model);

}  // namespace twincraft
