// The vehicle: hub, bodies, and all that can be put on them. See sections.h.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "compiler/ir/propellant.h"
#include "tests/random/sections.h"

namespace twincraft::random_vehicles {

void Sections::vehicle() {
  bodies();
  wheels();
  panels();
  tanks();
  slosh();
  thrusters();
}

void Sections::hub() {
  const double mass = draw_.size(50.0, 2000.0);
  Json& hub = spec_["hub"];
  hub["mass"] = quantity(draw_, mass, "kg");
  hub["inertia"] = inertia(draw_, mass, draw_.size(0.4, 1.5));
  maybe(
      hub, "center_of_mass", [&] { return place(0.5); }, 0.5);
}

Json Sections::joint(const std::string& type) {
  Json joint{{"type", type}};
  maybe(joint, "position", [&] { return place(1.0); });
  if (type == "fixed") return joint;
  const bool slides = type == "prismatic";
  const char* coordinate = slides ? "m" : "rad";
  joint["axis"] =
      direction(draw_, draw_.chance(0.3) ? Vector3d(Vector3d::UnitZ()) : draw_.direction());
  maybe(joint, "stiffness", [&] { return quantity(draw_, draw_.size(1.0, 300.0), ""); });
  maybe(joint, "damping", [&] { return quantity(draw_, draw_.size(0.01, 5.0), ""); });
  maybe(
      joint, "rest", [&] { return quantity(draw_, draw_.between(-0.2, 0.2), coordinate); }, 0.3);
  maybe(joint, slides ? "displacement" : "angle",
        [&] { return quantity(draw_, draw_.between(-0.5, 0.5), coordinate); });
  maybe(
      joint, "rate", [&] { return quantity(draw_, draw_.between(-0.1, 0.1), ""); }, 0.5);
  maybe(
      joint, slides ? "force" : "torque",
      [&] { return schedule(draw_, 1.0, duration_, false, slides ? "N" : "N m"); }, 0.5);
  return joint;
}

void Sections::bodies() {
  const int count = draw_.chance(0.3) ? 0 : draw_.integer(6);
  for (int i = 0; i < count; ++i) {
    const double mass = draw_.size(1.0, 60.0);
    Json body{{"name", fmt::format("body{}", i)}};
    maybe(
        body, "parent", [&] { return mount(); }, 0.8);
    body["joint"] =
        joint(draw_.one_of<std::string>({"revolute", "revolute", "prismatic", "fixed"}));
    maybe(body, "orientation", [&] { return attitude(draw_, false); });
    body["mass"] = quantity(draw_, mass, "kg");
    maybe(body, "center_of_mass", [&] { return place(0.6); });
    body["inertia"] = inertia(draw_, mass, draw_.size(0.1, 0.6));
    mounts_.push_back(body["name"]);
    push("bodies", body);
  }
  // Bodies may come in any order.
  if (count > 1 && draw_.chance(0.3)) std::reverse(spec_["bodies"].begin(), spec_["bodies"].end());
}

void Sections::wheels() {
  const int count = draw_.chance(0.4) ? 0 : draw_.integer(4);
  for (int i = 0; i < count; ++i) {
    const double spin = draw_.size(0.01, 0.2);
    Json wheel{{"name", fmt::format("wheel{}", i)}};
    maybe(wheel, "mount", [&] { return mount(); });
    maybe(wheel, "position", [&] { return place(0.6); });
    wheel["axis"] = direction(draw_, draw_.direction());
    wheel["spin_inertia"] = spin;
    wheel["transverse_inertia"] = draw_.between(0.51, 1.2) * spin;
    maybe(
        wheel, "mass", [&] { return quantity(draw_, draw_.size(1.0, 10.0), "kg"); }, 0.4);
    maybe(wheel, "speed", [&] { return quantity(draw_, draw_.between(-300.0, 300.0), "rad/s"); });
    maybe(wheel, "torque", [&] { return schedule(draw_, 0.2, duration_, false, "N m"); });
    push("wheels", wheel);
  }
}

Json Sections::per_hinge(int hinges, double low, double high) {
  if (draw_.chance(0.6)) return quantity(draw_, draw_.between(low, high), "");
  Json all = Json::array();
  for (int i = 0; i < hinges; ++i) all.push_back(quantity(draw_, draw_.between(low, high), ""));
  return all;
}

Json Sections::segment_inertia(double mass, double length) {
  if (draw_.chance(0.5)) return inertia(draw_, mass, 0.4 * length);
  if (draw_.chance(0.5)) return {{"shape", "bar"}};
  return {{"shape", "plate"},
          {"width", quantity(draw_, draw_.size(0.3, 2.0), "m")},
          {"thickness", quantity(draw_, draw_.size(0.01, 0.1), "m")}};
}

void Sections::panels() {
  const int count = draw_.chance(0.4) ? 0 : draw_.integer(2);
  for (int i = 0; i < count; ++i) {
    const int segments = draw_.chance(0.5) ? 1 : 1 + draw_.integer(5);
    const double mass = draw_.size(2.0, 15.0) * segments, length = draw_.size(0.6, 1.5) * segments;
    const Vector3d axis = draw_.direction();
    const Vector3d outboard =
        Eigen::AngleAxisd(draw_.between(-3.0, 3.0), axis) * axis.unitOrthogonal();
    Json panel{{"name", fmt::format("panel{}", i)}};
    maybe(
        panel, "mount", [&] { return mount(); }, 0.5);
    panel["hinge"] = {{"position", place(1.0)},
                      {"axis", direction(draw_, axis)},
                      {"outboard", direction(draw_, outboard)}};
    if (segments > 1) panel["segments"] = segments;
    panel["mass"] = quantity(draw_, mass, "kg");
    panel["length"] = quantity(draw_, length, "m");
    panel["inertia"] = segment_inertia(mass / segments, length / segments);
    maybe(
        panel, "stiffness", [&] { return per_hinge(segments, 1.0, 300.0); }, 0.8);
    maybe(panel, "damping", [&] { return per_hinge(segments, 0.0, 8.0); });
    maybe(
        panel, "rest", [&] { return per_hinge(segments, -0.2, 0.2); }, 0.3);
    maybe(panel, "angle", [&] { return per_hinge(segments, -0.3, 0.3); });
    maybe(
        panel, "rate", [&] { return per_hinge(segments, -0.1, 0.1); }, 0.3);
    if (panel.contains("stiffness")) oscillators_.push_back(panel["name"]);
    push("panels", panel);
  }
}

void Sections::tanks() {
  const int count = draw_.chance(0.6) ? 0 : 1 + draw_.integer(1);
  for (int i = 0; i < count; ++i) {
    const double radius = draw_.size(0.3, 1.0), length = draw_.size(0.3, 1.5);
    const bool is_sphere = draw_.chance(0.6);
    Json tank{{"name", fmt::format("tank{}", i)}};
    maybe(
        tank, "mount", [&] { return mount(); }, 0.5);
    maybe(tank, "position", [&] { return place(0.8); });
    if (is_sphere)
      tank["shape"] = {{"sphere", {{"radius", radius}}}};
    else
      tank["shape"] = {{"cylinder",
                        {{"radius", radius},
                         {"length", length},
                         {"axis", direction(draw_, draw_.direction())}}}};
    const double propellant = draw_.size(30.0, 600.0);
    tank["propellant"] = quantity(draw_, propellant, "kg");
    const double volume = is_sphere ? 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3)
                                    : std::numbers::pi * radius * radius * length;
    maybe(
        tank, "density", [&] { return 1.1 * propellant / volume; }, 0.3);
    maybe(
        tank, "depletion",
        [&]() -> Json {
          return {{"momentum", draw_.one_of<std::string>({"none", "jet", "jet"})}};
        },
        0.6);
    tanks_.push_back({tank["name"], propellant, 0.6 * propellant});
    push("tanks", tank);
  }
}

double Sections::slosh_mass(Json& slosh) {
  if (tanks_.empty() || draw_.chance(0.2)) {
    maybe(
        slosh, "mount", [&] { return mount(); }, 0.5);
    return draw_.size(2.0, 50.0);
  }
  Tank& tank = tanks_[static_cast<std::size_t>(draw_.integer(static_cast<int>(tanks_.size()) - 1))];
  slosh["tank"] = tank.name;
  const double mass = tank.spare * draw_.between(0.1, 0.4);
  tank.spare -= mass;
  return mass;
}

void Sections::slosh() {
  const int count = draw_.chance(tanks_.empty() ? 0.8 : 0.2) ? 0 : 1 + draw_.integer(3);
  for (int i = 0; i < count; ++i) {
    Json slosh{{"name", fmt::format("slosh{}", i)}};
    const bool is_particle = draw_.chance(0.5);
    slosh["type"] = is_particle ? "particle" : "pendulum";
    slosh["mass"] = quantity(draw_, slosh_mass(slosh), "kg");
    maybe(
        slosh, "position", [&] { return place(0.8); }, 0.5);
    is_particle ? particle(slosh) : pendulum(slosh);
    push("slosh", slosh);
  }
}

void Sections::particle(Json& slosh) {
  slosh["axis"] = direction(draw_, draw_.direction());
  maybe(slosh, "stiffness", [&] { return draw_.size(1.0, 200.0); });
  maybe(slosh, "damping", [&] { return draw_.size(0.01, 10.0); });
  maybe(slosh, "displacement", [&] { return quantity(draw_, draw_.between(-0.1, 0.1), "m"); });
  maybe(
      slosh, "rate", [&] { return draw_.between(-0.02, 0.02); }, 0.5);
  if (slosh.contains("stiffness")) oscillators_.push_back(slosh["name"]);
}

void Sections::pendulum(Json& slosh) {
  const double length = draw_.size(0.1, 1.0);
  const Vector3d rest = draw_.direction();
  slosh["length"] = quantity(draw_, length, "m");
  slosh["rest"] = direction(draw_, rest);
  slosh["reference"] =
      direction(draw_, Eigen::AngleAxisd(draw_.between(-3.0, 3.0), rest) * rest.unitOrthogonal());
  maybe(slosh, "angles", [&]() -> Json {
    return {draw_.between(-0.5, 0.5), draw_.between(-0.4, 0.4)};
  });
  maybe(slosh, "rates", [&]() -> Json {
    return {draw_.between(-0.1, 0.1), draw_.between(-0.1, 0.1)};
  });
  maybe(slosh, "damping", [&] { return draw_.size(0.01, 10.0); });
  maybe(
      slosh, "inertia", [&] { return draw_.size(0.01, 1.0); }, 0.3);
}

void Sections::thrusters() {
  const int count = draw_.chance(tanks_.empty() ? 0.8 : 0.2) ? 0 : 1 + draw_.integer(2);
  for (int i = 0; i < count; ++i) {
    Json thruster{{"name", fmt::format("jet{}", i)}};
    maybe(
        thruster, "mount", [&] { return mount(); }, 0.5);
    maybe(thruster, "position", [&] { return place(1.0); });
    thruster["direction"] = direction(draw_, draw_.direction());
    const double thrust = draw_.size(1.0, 100.0);
    thruster["thrust"] = schedule(draw_, thrust, duration_, true, "N");
    if (!tanks_.empty() && draw_.chance(0.8)) {
      const Tank& tank = draw_.one_of(tanks_);
      // At full thrust three of them leave half of it.
      const double least = 6.0 * thrust * duration_ / (kStandardGravity * tank.propellant);
      thruster["tank"] = tank.name;
      thruster["isp"] =
          quantity(draw_, draw_.size(std::max(1.0, least), std::max(300.0, 2.0 * least)), "s");
    }
    maybe(
        thruster, "during", [&] { return intervals(draw_, duration_); }, 0.5);
    push("thrusters", thruster);
  }
}

}  // namespace twincraft::random_vehicles
