// See panel.h. Tested by tests/compiler/panel_test.cpp.
#include "compiler/components/panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compiler/components/physical.h"
#include "compiler/ir/angle.h"
#include "compiler/ir/number.h"

namespace twincraft {
namespace {

// How far from a right angle hinge axis and outboard may be, as the sine.
constexpr double kPerpendicularTolerance = 1.0e-9;

const Table<HingeSpec>& hinge_table() {
  static const Table<HingeSpec> table{
      "hinge",
      "Where a panel begins and how it turns, in the axes of its mount.",
      {
          required("position", &HingeSpec::position, vector3("m"), "Of the root hinge."),
          required("axis", &HingeSpec::axis, direction(),
                   "Positive angles turn by the right hand about it; all hinges are parallel."),
          required("outboard", &HingeSpec::outboard, direction(),
                   "From root to tip at angle zero; perpendicular to `axis`."),
      }};
  return table;
}

const Table<ShapeSpec>& shape_table() {
  static const Table<ShapeSpec> table{
      "segment shape",
      "The inertia of one segment from its shape, mass and length.",
      {
          required("shape", &ShapeSpec::shape,
                   one_of<Shape>({{"bar", Shape::kBar}, {"plate", Shape::kPlate}}),
                   "`bar`: a slender bar. `plate`: a solid cuboid of the segment's length."),
          optional("axial_ratio", &ShapeSpec::axial_ratio, maybe(number(Range::kNotNegative)),
                   "Bar: inertia along the bar as a part of the inertia across it; default 0.05."),
          optional("axial_minimum", &ShapeSpec::axial_minimum,
                   maybe(quantity("kg m2", Range::kNotNegative)),
                   "Bar: the inertia along the bar is never less; default 1e-4 kg m2."),
          optional("width", &ShapeSpec::width, maybe(quantity("m", Range::kPositive)),
                   "Plate: extent along the hinge; required."),
          optional("thickness", &ShapeSpec::thickness, maybe(quantity("m", Range::kPositive)),
                   "Plate: extent along the normal; required."),
      }};
  return table;
}

Matrix3d bar_inertia(const ShapeSpec& shape, double m, double l) {
  const double Ib = m * l * l / 12.0;
  const double axial =
      std::max(shape.axial_ratio.value_or(0.05) * Ib, shape.axial_minimum.value_or(1.0e-4));
  return Vector3d(axial, Ib, Ib).asDiagonal();
}

/// Missing extents count as zero: check() has reported them.
Matrix3d plate_inertia(const ShapeSpec& shape, double m, double l) {
  const double w = shape.width.value_or(0.0);
  const double t = shape.thickness.value_or(0.0);
  const Vector3d sums(w * w + t * t, l * l + t * t, l * l + w * w);
  return (m / 12.0 * sums).asDiagonal();
}

/// Segment axes in mount axes at angle zero. The hinge axis is kept; outboard is made exactly
/// perpendicular to it.
Matrix3d hinge_axes(const HingeSpec& hinge) {
  const Vector3d normal = hinge.outboard.cross(hinge.axis).normalized();
  Matrix3d dcm;
  dcm << hinge.axis.cross(normal), hinge.axis, normal;
  return dcm;
}

/// The value of hinge `i`, counted from the root: one value holds for all hinges.
double of_hinge(const std::vector<double>& values, std::size_t i) {
  return values.size() == 1 ? values.front() : values[i];
}

/// The value of hinge `i`: one value is the root's, the others are zero.
double of_root(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : 0.0;
}

void check_hinge(const HingeSpec& hinge, const std::string& who, Diagnostics& diagnostics) {
  const double cosine = hinge.axis.dot(hinge.outboard);
  if (std::abs(cosine) <= kPerpendicularTolerance) return;
  const double degrees = std::asin(std::min(std::abs(cosine), 1.0)) * kDegrees;
  diagnostics
      .error(Code::kNotPerpendicular, hinge.span_of("outboard"),
             fmt::format("`outboard` and `axis` of {} are off perpendicular by {:.3g} degrees", who,
                         degrees))
      .with_note(hinge.span_of("axis"), "`axis` is written here");
}

void check_shape(const ShapeSpec& shape, const std::string& who, Diagnostics& diagnostics) {
  const bool plate = shape.shape == Shape::kPlate;
  const char* const name = plate ? "plate" : "bar";
  for (const char* key : {"width", "thickness"}) {
    if (plate && !shape.has(key)) {
      diagnostics
          .error(Code::kShapeKey, shape.span(),
                 fmt::format("the plate of {} has no `{}`", who, key))
          .with_hint(fmt::format("add `{}`, or take `shape: bar`", key));
    }
  }
  const auto foreign =
      plate ? std::array{"axial_ratio", "axial_minimum"} : std::array{"width", "thickness"};
  for (const char* key : foreign) {
    if (!shape.has(key)) continue;
    diagnostics
        .error(Code::kShapeKey, shape.span_of(key),
               fmt::format("a {} has no `{}`, in {}", name, key, who))
        .with_hint(fmt::format("delete it, or take `shape: {}`", plate ? "bar" : "plate"));
  }
}

/// A plate thicker than it is wide and long is one in millimetres.
void warn_of_millimetres(const PanelSpec& panel, const ShapeSpec& shape, const std::string& who,
                         Diagnostics& diagnostics) {
  const double extent = std::max(shape.width.value_or(0.0), segment_length(panel));
  if (!shape.thickness || !(*shape.thickness > extent)) return;
  const Node& thickness = *shape.node->find("thickness");
  if (!is_bare_number(thickness)) return;
  warn_of_bare_number(
      thickness,
      fmt::format("{} m is more than the plate's length and width", shortest(*shape.thickness)),
      "mm", "m", {diagnostics, "`thickness` of " + who});
}

void check_inertia_of(const PanelSpec& panel, const std::string& who, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  if (const ShapeSpec* shape = std::get_if<ShapeSpec>(&panel.inertia)) {
    check_shape(*shape, who, diagnostics);
    warn_of_millimetres(panel, *shape, who, diagnostics);
  }
  if (diagnostics.error_count() != errors_before) return;
  check_inertia(segment_inertia(panel), panel.span_of("inertia"), "a segment of " + who,
                diagnostics);
}

/// A value written as a list has one entry per hinge.
void check_length(const PanelSpec& panel, const char* key, const std::vector<double>& values,
                  const std::string& who, Diagnostics& diagnostics) {
  if (!panel.has(key) || !panel.node->find(key)->is_list()) return;
  if (static_cast<int>(values.size()) == panel.segments) return;
  diagnostics
      .error(Code::kHingeCount, panel.span_of(key),
             fmt::format("`{}` of {} lists {} values for {} hinges", key, who, values.size(),
                         panel.segments))
      .with_note(panel.span_of("segments"), "one hinge per segment");
}

Joint hinge_joint(const PanelSpec& panel, std::size_t i) {
  Joint joint;
  joint.axis_L = Vector3d::UnitY();
  joint.stiffness = of_hinge(panel.stiffness, i);
  joint.damping = of_hinge(panel.damping, i);
  joint.rest = of_hinge(panel.rest, i);
  if (i == 0) {
    joint.r_HP_P = panel.hinge.position;
    joint.dcm_PL0 = hinge_axes(panel.hinge);
  } else {
    joint.r_HP_P = Vector3d(segment_length(panel), 0.0, 0.0);
  }
  return joint;
}

/// From hinge to hinge. Where only an inertia is given, as wide as it says about the outboard axis.
Look segment_look(const PanelSpec& panel) {
  const ShapeSpec* given = std::get_if<ShapeSpec>(&panel.inertia);
  const double length = segment_length(panel);
  const double Ix = segment_inertia(panel)(0, 0);
  const double width = std::sqrt(12.0 * Ix / segment_mass(panel));
  const double thin = 0.01 * panel.length;
  Look look;
  look.part = Look::Part::kPanel;
  look.half = 0.5 * Vector3d(length, width, thin);
  if (given != nullptr && given->width) look.half.y() = *given->width / 2.0;
  if (given != nullptr && given->thickness) look.half.z() = *given->thickness / 2.0;
  look.pos.x() = length / 2.0;
  return look;
}

}  // namespace

const Table<PanelSpec>& panel_table() {
  const auto each = [](SiUnit unit, Range range = Range::kAny) {
    return one_or_more_quantities(unit, range);
  };
  static const Table<PanelSpec> table{
      "panel",
      "A solar array of equal rigid segments in a row on parallel torsional hinges. Angles are "
      "relative to the previous segment.",
      {
          required("name", &PanelSpec::name, name(), "Unique in the file."),
          optional("mount", &PanelSpec::mount, reference_to("body"), "What carries the panel."),
          required("hinge", &PanelSpec::hinge, object(hinge_table()), "The root hinge."),
          optional("segments", &PanelSpec::segments, integer(1, kMaximumSegments),
                   "How many segments, and so hinges, the panel has."),
          required("mass", &PanelSpec::mass, quantity("kg", Range::kPositive),
                   "Of the whole panel, shared equally by the segments."),
          required("length", &PanelSpec::length, quantity("m", Range::kPositive),
                   "Of the whole panel from root hinge to tip. The centre of mass of each segment "
                   "is at its middle."),
          required("inertia", &PanelSpec::inertia,
                   either(is_section, object(shape_table()), inertia()),
                   "Of one segment about its own centre of mass, in the axes (outboard, hinge, "
                   "normal = outboard x hinge); or its shape."),
          optional("stiffness", &PanelSpec::stiffness, each("N m/rad", Range::kNotNegative),
                   "Of every hinge, or of each."),
          optional("damping", &PanelSpec::damping, each("N m s/rad", Range::kNotNegative),
                   "Of every hinge, or of each."),
          optional("rest", &PanelSpec::rest, each("rad"),
                   "Spring rest angle of every hinge, or of each."),
          optional("angle", &PanelSpec::angle, each("rad"),
                   "Initial angle of the root hinge (the others 0), or of each."),
          optional("rate", &PanelSpec::rate, each("rad/s"),
                   "Initial rate of the root hinge (the others 0), or of each."),
      }};
  return table;
}

double segment_mass(const PanelSpec& panel) { return panel.mass / panel.segments; }

double segment_length(const PanelSpec& panel) { return panel.length / panel.segments; }

Matrix3d segment_inertia(const PanelSpec& panel) {
  const ShapeSpec* shape = std::get_if<ShapeSpec>(&panel.inertia);
  if (shape == nullptr) return std::get<Matrix3d>(panel.inertia);
  const auto inertia_of = shape->shape == Shape::kBar ? bar_inertia : plate_inertia;
  return inertia_of(*shape, segment_mass(panel), segment_length(panel));
}

namespace {

double inertia_about_hinge(const PanelSpec& panel) {
  const double d = segment_length(panel) / 2.0;
  return segment_inertia(panel)(1, 1) + segment_mass(panel) * d * d;
}

/// [s] Nothing when no hinge has a spring.
std::optional<double> segment_period(const PanelSpec& panel) {
  const double k = *std::max_element(panel.stiffness.begin(), panel.stiffness.end());
  if (!(k > 0.0)) return std::nullopt;
  return 2.0 * std::numbers::pi * std::sqrt(inertia_about_hinge(panel) / k);
}

/// No damper of the panel decays faster than this [1/s]: c/J of a single segment, J about its
/// hinge. In a chain the dampers act as the square of a second difference, whose largest eigenvalue
/// is sixteen; no chain of up to 64 equal segments was found to decay faster.
double fastest_decay(const PanelSpec& panel) {
  const double c = *std::max_element(panel.damping.begin(), panel.damping.end());
  return (panel.segments > 1 ? 16.0 : 1.0) * c / inertia_about_hinge(panel);
}

}  // namespace

void check(const PanelSpec& panel, const Context& context, Diagnostics& diagnostics) {
  const std::string who = fmt::format("panel `{}`", panel.name);
  check_mount(panel.mount, panel.span_of("mount"), who, context.names, diagnostics);
  check_hinge(panel.hinge, who, diagnostics);
  check_mass(segment_mass(panel), panel.span_of("mass"), "a segment of " + who, diagnostics);
  check_inertia_of(panel, who, diagnostics);
  check_length(panel, "stiffness", panel.stiffness, who, diagnostics);
  check_length(panel, "damping", panel.damping, who, diagnostics);
  check_length(panel, "rest", panel.rest, who, diagnostics);
  check_length(panel, "angle", panel.angle, who, diagnostics);
  check_length(panel, "rate", panel.rate, who, diagnostics);
}

void lower(const PanelSpec& panel, const Vehicle&, ModelBuilder& builder) {
  const Vector3d middle(segment_length(panel) / 2.0, 0.0, 0.0);
  const Matrix3d inertia = segment_inertia(panel);
  const auto segments = static_cast<std::size_t>(panel.segments);
  Mount mount = builder.find_mount(panel.mount);
  for (std::size_t i = 0; i < segments; ++i) {
    const std::string name = fmt::format("{}.{}", panel.name, i + 1);
    mount = builder.add_link(mount, name, hinge_joint(panel, i));
    builder.add_mass(mount, {name, segment_mass(panel), middle, inertia});
    builder.draw(mount, segment_look(panel));
    builder.add_coordinate(Coordinate::Kind::kPanel, name, mount.link, of_root(panel.angle, i),
                           of_root(panel.rate, i));
  }
}

Coordinates coordinates_of(const PanelSpec& panel) {
  return {panel.segments, panel.span_of("segments")};
}

double mass_of(const PanelSpec& panel) { return panel.mass; }

std::vector<Oscillator> oscillators_of(const std::vector<PanelSpec>& panels, const Vehicle&) {
  std::vector<Oscillator> all;
  for (const PanelSpec& panel : panels)
    all.push_back({panel.name, fmt::format("panel `{}`", panel.name), segment_period(panel),
                   "no hinge of it has stiffness", panel.span_of("stiffness"),
                   fastest_decay(panel)});
  return all;
}

}  // namespace twincraft
