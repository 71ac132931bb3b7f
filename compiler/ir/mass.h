// Mass, and where it is. The mass ledger of a vehicle is a list of MassElements: every kilogram and
// every kg m^2 is declared once, by its component, and both halves of the model are built from it.
// Tested by tests/compiler/ir_test.cpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

namespace twincraft {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// One entry of the mass ledger: a lump fixed in the axes of the link that carries it.
struct MassElement {
  std::string name;                      // the component that declares it
  double mass = 0.0;                     // [kg]; zero for the tensor of a massless wheel
  Vector3d r_EL_L = Vector3d::Zero();    // [m] its centre of mass E from the link's origin
  Matrix3d I_PntE_L = Matrix3d::Zero();  // [kg m^2] about E, link axes
  int tank =
      -1;  // Model::tanks entry it drains with: mass and inertia are those of t = 0; -1: none
};

/// Mass, centre of mass and inertia of several elements together.
struct MassProperties {
  double mass = 0.0;                     // [kg]
  Vector3d r_CL_L = Vector3d::Zero();    // [m] centre of mass from the origin; zero without mass
  Matrix3d I_PntC_L = Matrix3d::Zero();  // [kg m^2] about the centre of mass
};

/// Both together; either may have no mass. A negative mass takes the element out again.
MassProperties operator+(const MassProperties& a, const MassProperties& b);
MassProperties properties_of(const MassElement& element);

/// `v` as a cross-product matrix: tilde(v) * w == v.cross(w).
Matrix3d tilde(const Vector3d& v);

/// Inertia about a point displaced by `r` [m] from the centre of mass of `mass` [kg].
Matrix3d parallel_axis(const Matrix3d& I_PntC, double mass, const Vector3d& r);

/// Principal axes of a symmetric tensor: I = R diag(moments) R^T with R the rotation of `axes`.
/// A diagonal tensor keeps its order and gets the identity, so that it survives unchanged.
struct PrincipalInertia {
  Vector3d moments;  // [kg m^2]
  Quaterniond axes;  // principal axes to link axes
};
PrincipalInertia principal_inertia(const Matrix3d& I);

}  // namespace twincraft
