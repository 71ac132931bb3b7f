// Where the vehicle is, what acts on it and how it is run. See generator.h and sections.h.
#include "tests/random/generator.h"

#include <fmt/format.h>

#include "tests/random/sections.h"

namespace twincraft::random_vehicles {

Sections::Sections(std::uint64_t seed) : draw_(seed) {
  spec_["format"] = "spacecraft/1";
  spec_["name"] = fmt::format("vehicle_{}", seed);
}

Json Sections::make() {
  duration_ = draw_.size(0.5, 20.0);
  hub();
  const bool point_mass = draw_.chance(0.02);
  if (!point_mass) vehicle();
  loads(point_mass);
  environment();
  initial(point_mass);
  simulation(point_mass);
  if (draw_.chance(0.5)) engines();
  if (draw_.chance(0.1)) stored(point_mass);
  if (spec_["initial"].is_null()) spec_.erase("initial");
  return spec_;
}

Json Sections::three_schedules(double size, const std::string& dimension) {
  Json all = Json::array();
  for (int i = 0; i < 3; ++i) all.push_back(schedule(draw_, size, duration_, false, dimension));
  return all;
}

void Sections::loads(bool point_mass) {
  const int count = draw_.chance(0.4) ? 0 : 1 + draw_.integer(2);
  for (int i = 0; i < count; ++i) {
    Json load{{"name", fmt::format("load{}", i)}};
    if (!point_mass)
      maybe(
          load, "mount", [&] { return mount(); }, 0.5);
    maybe(load, "force", [&] { return three_schedules(5.0, "N"); });
    if (!point_mass) maybe(load, "torque", [&] { return three_schedules(1.0, "N m"); });
    if (!point_mass)
      maybe(load, "position", [&] { return draw_.chance(0.3) ? Json("com") : place(1.0); });
    maybe(
        load, "during", [&] { return intervals(draw_, duration_); }, 0.4);
    push("loads", load);
  }
}

void Sections::environment() {
  has_gravity_ = draw_.chance(0.6);
  if (!has_gravity_) return;
  Json& gravity = spec_["environment"]["gravity"];
  gravity["mu"] = draw_.chance(0.5) ? Json(3.98600436e14) : Json("398600.436 km3/s2");
  maybe(
      gravity, "application", [&] { return law(); }, 0.9);
}

Json Sections::law() {
  return draw_.one_of<std::string>({"system_com", "body_com", "body_gradient"});
}

void Sections::orbit(Json& initial) {
  if (draw_.chance(0.5)) {
    initial["orbit"] = {{"semi_major_axis", draw_.size(7.0e6, 4.2e7)},
                        {"eccentricity", draw_.chance(0.3) ? 0.0 : draw_.between(0.0, 0.05)},
                        {"inclination", quantity(draw_, draw_.between(0.0, 3.1), "rad")},
                        {"raan", quantity(draw_, draw_.between(0.0, 6.2), "rad")},
                        {"argument_of_periapsis", quantity(draw_, draw_.between(0.0, 6.2), "rad")},
                        {"true_anomaly", quantity(draw_, draw_.between(0.0, 6.2), "rad")}};
    return;
  }
  const Vector3d up = draw_.direction();
  initial["position"] = vector(draw_, draw_.size(6.8e6, 4.2e7) * up, "m");
  initial["velocity"] = vector(draw_, draw_.size(1.0e3, 8.0e3) * up.unitOrthogonal(), "");
}

void Sections::initial(bool point_mass) {
  Json& initial = spec_["initial"];
  if (has_gravity_) {
    orbit(initial);
  } else {
    maybe(
        initial, "position", [&] { return place(1.0e3); }, 0.3);
    maybe(
        initial, "velocity", [&] { return vector(draw_, draw_.vector(10.0), ""); }, 0.3);
  }
  maybe(initial, "point", [&] { return draw_.one_of<std::string>({"com", "hub"}); });
  if (point_mass) return;
  maybe(
      initial, "attitude", [&] { return attitude(draw_, has_gravity_); }, 0.8);
  maybe(
      initial, "rate", [&] { return vector(draw_, draw_.vector(0.2), "rad/s"); }, 0.9);
}

Json Sections::step() {
  if (oscillators_.empty() || draw_.chance(0.7)) return duration_ / (10 + draw_.integer(90));
  return {{"per_period", 200}, {"of", draw_.one_of(oscillators_)}, {"maximum", 0.1 * duration_}};
}

void Sections::simulation(bool point_mass) {
  Json& simulation = spec_["simulation"];
  if (point_mass) simulation["mode"] = "translation";
  maybe(simulation, "integrator", [&] {
    return draw_.one_of<std::string>({"euler", "rk2", "rk4", "rkf45", "rkf78"});
  });
  simulation["step"] = step();
  maybe(
      simulation, "tolerance",
      [&]() -> Json {
        if (draw_.chance(0.5)) return 1.0e-10;
        return {{"attitude", 1.0e-12}, {"joint", {{"absolute", 1.0e-9}, {"relative", 1.0e-10}}}};
      },
      0.4);
  simulation["duration"] = duration_;
  maybe(
      simulation, "record", [&] { return 0.1 * duration_; }, 0.5);
}

void Sections::engines() {
  Json& engines = spec_["engines"];
  engines["bsm"]["attitude"] = draw_.one_of<std::string>({"mrp", "quaternion"});
  maybe(
      engines, "mujoco",
      [&]() -> Json {
        return {{"wheel_mass", draw_.size(1.0e-7, 1.0e-4)}};
      },
      0.3);
  maybe(
      engines["bsm"], "chains",
      [&] {
        return draw_.one_of<std::string>({"planar", "general"});
      },
      0.3);
  if (has_gravity_ && draw_.chance(0.3)) {  // both engines otherwise than the environment says
    engines["bsm"]["gravity"] = engines["mujoco"]["gravity"] = law();
  }
}

void Sections::stored(bool point_mass) {
  Json state{{"time", draw_.between(0.0, 1.0) * duration_}};
  state["position"] = place(10.0);
  maybe(state, "velocity", [&] { return vector(draw_, draw_.vector(10.0), ""); });
  if (!point_mass) maybe(state, "attitude", [&] { return attitude(draw_, false); });
  if (!point_mass) maybe(state, "rate", [&] { return vector(draw_, draw_.vector(0.2), "rad/s"); });
  spec_["references"] = {"stored"};
  spec_["stored"] = {{"source", "nobody"}, {"states", {state}}};
  maybe(spec_["stored"], "tolerance", [&]() -> Json { return {{"position", "1 km"}}; });
}

Json random_spec(std::uint64_t seed) { return Sections(seed).make(); }

}  // namespace twincraft::random_vehicles
