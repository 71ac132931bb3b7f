// See attitude.h. Tested by tests/compiler/initial_test.cpp.
#include "compiler/components/attitude.h"

#include <fmt/format.h>

#include <cmath>

#include "compiler/ir/number.h"
#include "compiler/ir/rotation.h"

namespace twincraft {
namespace {

constexpr double kQuaternionTolerance = 1.0e-6;  // of the norm
constexpr double kRotationTolerance = 1.0e-9;    // of D D^T - 1
constexpr double kParallelTolerance = 1.0e-9;    // sine between two aligned axes

const Table<EulerSpec>& euler_table() {
  static const Table<EulerSpec> table{
      "euler",
      "Three turns, each about an axis of the frame as the turns before have left it.",
      {
          required("sequence", &EulerSpec::sequence,
                   word({"xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy",
                         "zxz", "zyz"}),
                   "The axes in the order of the turns."),
          required("angles", &EulerSpec::angles, vector3("rad"), "In the order of `sequence`."),
      }};
  return table;
}

const Table<AlignSpec>& align_table() {
  static const Table<AlignSpec> table{
      "alignment",
      "A body axis and the direction it points in.",
      {
          required("axis", &AlignSpec::axis,
                   either(is_scalar, word({"x", "y", "z", "-x", "-y", "-z"}), direction()),
                   "An axis of B, or a vector in B components."),
          required("to", &AlignSpec::to,
                   either(is_scalar,
                          one_of<OrbitDirection>({{"velocity", OrbitDirection::kVelocity},
                                                  {"orbit_normal", OrbitDirection::kOrbitNormal},
                                                  {"radial", OrbitDirection::kRadial}}),
                          direction()),
                   "A direction of the orbit of the point named by `initial.point` (`radial` is "
                   "outward, `orbit_normal` along r x v), or a vector in N components."),
      }};
  return table;
}

Vector3d unit_axis(char letter) { return Vector3d::Unit(letter - 'x'); }

Vector3d body_axis(const AlignSpec& align) {
  if (const Vector3d* axis = std::get_if<Vector3d>(&align.axis)) return *axis;
  const std::string& word = std::get<std::string>(align.axis);
  return word.front() == '-' ? Vector3d(-unit_axis(word.back())) : unit_axis(word.back());
}

/// Not normalised; zero where the orbit has no such direction.
Vector3d target(const AlignSpec& align, const PointState& point) {
  if (const Vector3d* direction = std::get_if<Vector3d>(&align.to)) return *direction;
  switch (std::get<OrbitDirection>(align.to)) {
    case OrbitDirection::kVelocity:
      return point.v_N;
    case OrbitDirection::kOrbitNormal:
      return point.r_N.cross(point.v_N);
    case OrbitDirection::kRadial:
      return point.r_N;
  }
  return Vector3d::Zero();
}

/// Columns: the first direction, the normal of both, and what completes them.
Matrix3d triad(const Vector3d& first, const Vector3d& second) {
  const Vector3d a = first.normalized();
  const Vector3d n = a.cross(second).normalized();
  Matrix3d axes;
  axes << a, n, a.cross(n);
  return axes;
}

bool parallel(const Vector3d& a, const Vector3d& b) {
  return a.normalized().cross(b.normalized()).norm() < kParallelTolerance;
}

Quaterniond from_mrp(const Vector3d& sigma) {
  const double s2 = sigma.squaredNorm();
  Quaterniond q;
  q.w() = (1.0 - s2) / (1.0 + s2);
  q.vec() = 2.0 / (1.0 + s2) * sigma;
  return q;
}

Quaterniond from_euler(const EulerSpec& euler) {
  Quaterniond q = Quaterniond::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = euler.angles[static_cast<Eigen::Index>(i)];
    q = q * Eigen::AngleAxisd(angle, unit_axis(euler.sequence[i]));
  }
  return q;
}

Quaterniond from_align(const std::vector<AlignSpec>& align, const PointState& point) {
  const Matrix3d body = triad(body_axis(align[0]), body_axis(align[1]));
  const Matrix3d inertial = triad(target(align[0], point), target(align[1], point));
  return Quaterniond(Matrix3d(inertial * body.transpose()));
}

Quaterniond from_list(const std::vector<double>& q) { return {q[0], q[1], q[2], q[3]}; }

Quaterniond written(const AttitudeSpec& attitude, const PointState& point) {
  if (attitude.quaternion) return from_list(*attitude.quaternion);
  if (attitude.quaternion_to_body) return from_list(*attitude.quaternion_to_body).conjugate();
  if (attitude.mrp) return from_mrp(*attitude.mrp);
  if (attitude.dcm_BN) {
    return Quaterniond(Matrix3d(nearest_rotation(*attitude.dcm_BN).transpose()));
  }
  if (attitude.euler) return from_euler(*attitude.euler);
  return from_align(attitude.align, point);
}

void check_quaternion(const std::vector<double>& q, Span span, Diagnostics& diagnostics) {
  const Quaterniond quaternion = from_list(q);
  const double norm = quaternion.norm();
  if (std::abs(norm - 1.0) <= kQuaternionTolerance) return;
  const Quaterniond unit = quaternion.normalized();
  const bool has_direction = norm > 0.0 && std::isfinite(norm);
  diagnostics
      .error(Code::kNotUnitQuaternion, span,
             fmt::format("the quaternion has norm {}, not 1", shortest(norm)))
      .with_hint(has_direction ? fmt::format("normalised it is [{}, {}, {}, {}], scalar first",
                                             shortest(unit.w()), shortest(unit.x()),
                                             shortest(unit.y()), shortest(unit.z()))
                               : "scalar first: [1, 0, 0, 0] is no rotation");
}

void check_rotation(const AttitudeSpec& attitude, Diagnostics& diagnostics) {
  const Matrix3d& dcm = *attitude.dcm_BN;
  const Span span = attitude.span_of("dcm_BN");
  const double off = (dcm * dcm.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kRotationTolerance)) {
    diagnostics
        .error(Code::kNotARotation, span,
               fmt::format("`dcm_BN` is off orthonormal by {}", shortest(off)))
        .with_hint("its rows are the axes of B in N: perpendicular, and of length one");
  } else if (dcm.determinant() < 0.0) {
    diagnostics.error(Code::kNotARotation, span, "`dcm_BN` is left-handed: a mirror image")
        .with_hint("change the sign of one row");
  }
}

/// @return whether the entry has a direction to point in
bool check_target(const AlignSpec& align, const PointState* point, Diagnostics& diagnostics) {
  if (std::holds_alternative<Vector3d>(align.to)) return true;
  if (point == nullptr) {
    diagnostics
        .error(Code::kNeedsGravity, align.span_of("to"),
               "a direction of the orbit, but the spec has no gravity")
        .with_hint("give a vector in N components, or `environment.gravity`");
    return false;
  }
  if (target(align, *point).norm() > 0.0) return true;
  diagnostics.error(Code::kAlignImpossible, align.span_of("to"),
                    "the initial position and velocity leave this direction undefined");
  return false;
}

void check_align(const AttitudeSpec& attitude, const PointState* point, Diagnostics& diagnostics) {
  const AlignSpec& first = attitude.align[0];
  const AlignSpec& second = attitude.align[1];
  if (parallel(body_axis(first), body_axis(second))) {
    diagnostics
        .error(Code::kAlignImpossible, second.span_of("axis"),
               "both aligned axes are the same line of the body")
        .with_note(first.span_of("axis"), "the first is written here");
  }
  const bool first_points = check_target(first, point, diagnostics);
  const bool second_points = check_target(second, point, diagnostics);
  if (!first_points || !second_points) return;
  const PointState where = point == nullptr ? PointState{} : *point;
  if (!parallel(target(first, where), target(second, where))) return;
  diagnostics
      .error(Code::kAlignImpossible, second.span_of("to"),
             "both axes are aligned with the same line in space")
      .with_note(first.span_of("to"), "the first is written here");
}

}  // namespace

const Table<AttitudeSpec>& attitude_table() {
  static const Table<AttitudeSpec> table = Table<AttitudeSpec>{
      "attitude",
      "How B is turned from N; exactly one form.",
      {
          optional("quaternion", &AttitudeSpec::quaternion, maybe(list_of(number(), 4, 4)),
                   "Scalar first; takes B components to N."),
          optional("quaternion_to_body", &AttitudeSpec::quaternion_to_body,
                   maybe(list_of(number(), 4, 4)),
                   "Scalar first; takes N components to B: the conjugate of `quaternion`, and how "
                   "NASA's check cases give an attitude."),
          optional("mrp", &AttitudeSpec::mrp, maybe(vector3("1")),
                   "Modified Rodrigues parameters sigma_BN."),
          optional("dcm_BN", &AttitudeSpec::dcm_BN, maybe(matrix3()),
                   "Direction cosines, row by row; takes N components to B."),
          optional("euler", &AttitudeSpec::euler, maybe(object(euler_table())),
                   "Three turns from N to B."),
          optional("align", &AttitudeSpec::align, list_of(object(align_table()), 2, 2),
                   "Two body axes and where they point: the first exactly, the second as near "
                   "as it can be."),
      }}.exactly_one_of({"quaternion", "quaternion_to_body", "mrp", "dcm_BN", "euler", "align"});
  return table;
}

void check(const AttitudeSpec& attitude, const PointState* point, Diagnostics& diagnostics) {
  for (const auto& [key, quaternion] :
       {std::pair{"quaternion", &attitude.quaternion},
        std::pair{"quaternion_to_body", &attitude.quaternion_to_body}}) {
    if (*quaternion) check_quaternion(**quaternion, attitude.span_of(key), diagnostics);
  }
  if (attitude.dcm_BN) check_rotation(attitude, diagnostics);
  if (!attitude.align.empty()) check_align(attitude, point, diagnostics);
}

Quaterniond orientation(const AttitudeSpec& attitude, const PointState& point) {
  Quaterniond q = written(attitude, point).normalized();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

}  // namespace twincraft
