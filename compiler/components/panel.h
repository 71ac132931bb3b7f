// A solar array: N equal rigid segments in a row, joined to the mount and to one another by N
// parallel torsional hinges. A segment's axes are (outboard, hinge, normal = outboard x hinge), its
// origin is its own hinge and its centre of mass lies half a segment outboard of it. Every hinge
// turns by the right hand about `hinge.axis`, relative to what it is hinged to.
// Tested by tests/compiler/panel_test.cpp.
#pragma once

#include <optional>
#include <variant>

#include "compiler/components/section.h"

namespace twincraft {

inline constexpr int kMaximumSegments = 10000;

struct HingeSpec : Written {
  Vector3d position = Vector3d::Zero();   // [m] root hinge, mount axes
  Vector3d axis = Vector3d::UnitY();      // unit, mount axes
  Vector3d outboard = Vector3d::UnitX();  // unit, mount axes: root to tip at angle zero
};

enum class Shape { kBar, kPlate };

/// The inertia of a segment from its shape.
///   bar:   Ib = m l^2/12 across, max(axial_ratio Ib, axial_minimum) along
///   plate: a solid cuboid of length l, width and thickness
struct ShapeSpec : Written {
  Shape shape = Shape::kBar;
  std::optional<double> axial_ratio;    // default 0.05
  std::optional<double> axial_minimum;  // [kg m^2] default 1e-4
  std::optional<double> width;          // [m] along the hinge
  std::optional<double> thickness;      // [m] along the normal
};

struct PanelSpec : Written {
  std::string name;
  std::string mount = "hub";
  HingeSpec hinge;
  int segments = 1;
  double mass = 0.0;                          // [kg] whole panel
  double length = 0.0;                        // [m] whole panel
  std::variant<ShapeSpec, Matrix3d> inertia;  // of one segment about its centre, segment axes
  std::vector<double> stiffness{0.0};         // [N m/rad] one for all hinges, or one each
  std::vector<double> damping{0.0};           // [N m s/rad]
  std::vector<double> rest{0.0};              // [rad]
  std::vector<double> angle{0.0};             // [rad] initial: the root's, or one each
  std::vector<double> rate{0.0};              // [rad/s]
};

const Table<PanelSpec>& panel_table();

double segment_mass(const PanelSpec& panel);       // [kg]
double segment_length(const PanelSpec& panel);     // [m]
Matrix3d segment_inertia(const PanelSpec& panel);  // [kg m^2] about its centre, segment axes

/// Mount, a right-angled hinge frame, list lengths, and an inertia that some body has.
void check(const PanelSpec& panel, const Context& context, Diagnostics& diagnostics);

/// Links `NAME.1` (root) to `NAME.N` (tip), one hinge coordinate each.
void lower(const PanelSpec& panel, const Vehicle& vehicle, ModelBuilder& builder);

Coordinates coordinates_of(const PanelSpec& panel);
double mass_of(const PanelSpec& panel);
inline std::string_view depth_key(const PanelSpec&) { return "segments"; }

/// By the shortest period 2 pi sqrt((I + m d^2)/k) of one segment on one of the hinges.
std::vector<Oscillator> oscillators_of(const std::vector<PanelSpec>& panels,
                                       const Vehicle& vehicle);

}  // namespace twincraft
