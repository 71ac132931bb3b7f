// See values.h.
#include "tests/random/values.h"

#include <fmt/format.h>

#include <map>

#include "compiler/ir/number.h"

namespace twincraft::random_vehicles {
namespace {

struct Unit {
  const char* name;
  double si;
};

const std::vector<Unit>& units_of(const std::string& dimension) {
  static const std::map<std::string, std::vector<Unit>> units{
      {"kg", {{"kg", 1.0}, {"g", 1e-3}, {"t", 1e3}}},
      {"m", {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}}},
      {"rad", {{"rad", 1.0}, {"deg", 3.14159265358979323846 / 180.0}}},
      {"rad/s", {{"rad/s", 1.0}, {"deg/s", 3.14159265358979323846 / 180.0}}},
      {"s", {{"s", 1.0}, {"ms", 1e-3}, {"min", 60.0}}},
      {"N", {{"N", 1.0}, {"mN", 1e-3}, {"kN", 1e3}}},
      {"N m", {{"N m", 1.0}, {"mN m", 1e-3}}},
  };
  const auto found = units.find(dimension);
  static const std::vector<Unit> none;
  return found == units.end() ? none : found->second;
}

/// Three significant digits, as people write.
double rounded(double value) { return std::stod(fmt::format("{:.3g}", value)); }

Json numbers(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json euler(Draw& draw) {
  const std::string sequence = draw.one_of<std::string>(
      {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"});
  return {{"sequence", sequence}, {"angles", vector(draw, draw.vector(3.0), "rad")}};
}

Json align(Draw& draw, bool with_orbit) {
  const std::string sign = draw.chance(0.3) ? "-" : "";
  const std::string first = draw.one_of<std::string>({"x", "y", "z"});
  const std::string second = first == "x" ? "y" : "x";
  if (with_orbit) {
    const std::string to = draw.one_of<std::string>({"velocity", "radial"});
    return {{{"axis", sign + first}, {"to", to}}, {{"axis", second}, {"to", "orbit_normal"}}};
  }
  const Vector3d to = draw.direction();
  return {{{"axis", sign + first}, {"to", direction(draw, to)}},
          {{"axis", second}, {"to", direction(draw, to.unitOrthogonal())}}};
}

}  // namespace

Json quantity(Draw& draw, double value, const std::string& dimension) {
  const std::vector<Unit>& units = units_of(dimension);
  if (units.empty() || draw.chance(0.5)) return rounded(value);
  const Unit unit = draw.one_of(units);
  return fmt::format("{} {}", shortest(rounded(value / unit.si)), unit.name);
}

Json vector(Draw& draw, const Vector3d& value, const std::string& dimension) {
  const std::vector<Unit>& units = units_of(dimension);
  if (!units.empty() && draw.chance(0.2)) {
    const Unit unit = draw.one_of(units);
    return {{"value", numbers((value / unit.si).unaryExpr(&rounded))}, {"unit", unit.name}};
  }
  Json list = Json::array();
  for (const double entry : value) list.push_back(quantity(draw, entry, dimension));
  return list;
}

Json direction(Draw& draw, const Vector3d& value) {
  return numbers(draw.chance(0.5) ? value : Vector3d(value * draw.size(0.01, 100.0)));
}

Json rows(const Matrix3d& m) { return {numbers(m.row(0)), numbers(m.row(1)), numbers(m.row(2))}; }

Json inertia(Draw& draw, double mass, double radius) {
  // Moments are sums of the integrals of x^2, y^2 and z^2, which makes them some body's.
  const Vector3d integrals(draw.size(0.05, 1.0), draw.size(0.05, 1.0), draw.size(0.05, 1.0));
  const Vector3d moments =
      mass * radius * radius * (Vector3d::Constant(integrals.sum()) - integrals);
  if (draw.chance(0.5)) return numbers(moments.unaryExpr(&rounded));
  const Matrix3d axes = draw.rotation().toRotationMatrix();
  const Matrix3d full = axes * moments.asDiagonal() * axes.transpose();
  return rows(0.5 * (full + full.transpose()));
}

Json attitude(Draw& draw, bool with_orbit) {
  const Quaterniond q = draw.rotation();
  switch (draw.integer(5)) {
    case 0:
      return {{"quaternion", {q.w(), q.x(), q.y(), q.z()}}};
    case 1:
      return {{"quaternion_to_body", {q.w(), q.x(), q.y(), q.z()}}};
    case 2:
      return {{"mrp", numbers(draw.vector(0.6).unaryExpr(&rounded))}};
    case 3:
      return {{"dcm_BN", rows(q.toRotationMatrix())}};
    case 4:
      return {{"euler", euler(draw)}};
    default:
      return {{"align", align(draw, with_orbit)}};
  }
}

Json schedule(Draw& draw, double size, double duration, bool positive,
              const std::string& dimension) {
  const auto value = [&] {
    return quantity(draw, positive ? draw.size(0.1, 1.0) * size : draw.between(-size, size),
                    dimension);
  };
  if (draw.chance(0.6)) return value();
  Json steps = Json::array();
  double time = draw.chance(0.5) ? 0.0 : draw.between(0.0, 0.4 * duration);
  for (int i = 0; i <= draw.integer(3); ++i) {
    steps.push_back({rounded(time), value()});
    time = rounded(time) + draw.between(0.1, 0.5) * duration;
  }
  return steps;
}

Json intervals(Draw& draw, double duration) {
  Json all = Json::array();
  double time = draw.between(0.0, 0.3 * duration);
  for (int i = 0; i <= draw.integer(2); ++i) {
    const double start = rounded(time), end = rounded(start + draw.between(0.1, 0.5) * duration);
    all.push_back({start, end});
    time = end + draw.between(0.05, 0.2) * duration;
  }
  return all;
}

}  // namespace twincraft::random_vehicles
