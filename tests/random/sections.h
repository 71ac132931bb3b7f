// The sections of a random spec and what they must know of one another: what things can be mounted
// on, what a tank can spare, how long the run is. Behind generator.h.
#pragma once

#include <string>
#include <vector>

#include "tests/random/values.h"

namespace twincraft::random_vehicles {

class Sections {
 public:
  explicit Sections(std::uint64_t seed);
  Json make();

 private:
  /// Leaves a key out now and then, so that defaults are met too.
  template <class Make>
  void maybe(Json& map, const char* key, Make make, double probability = 0.7) {
    if (draw_.chance(probability)) map[key] = make();
  }
  void vehicle();
  void push(const char* section, Json component) { spec_[section].push_back(std::move(component)); }
  std::string mount() { return draw_.one_of(mounts_); }
  Json place(double half) { return vector(draw_, draw_.vector(half), "m"); }
  void hub();
  Json joint(const std::string& type);
  void bodies();
  void wheels();
  /// One value for all hinges, or a list.
  Json per_hinge(int hinges, double low, double high);
  Json segment_inertia(double mass, double length);
  void panels();
  void tanks();
  /// Slosh of a tank or of its own, at most what the tank can spare. Returns its mass [kg].
  double slosh_mass(Json& slosh);
  void slosh();
  void particle(Json& slosh);
  void pendulum(Json& slosh);
  void thrusters();
  Json three_schedules(double size, const std::string& dimension);
  void loads(bool point_mass);
  void environment();
  Json law();
  void orbit(Json& initial);
  void initial(bool point_mass);
  Json step();
  void simulation(bool point_mass);
  void engines();
  void stored(bool point_mass);

  struct Tank {
    std::string name;
    double propellant;  // [kg]
    double spare;       // [kg] for slosh
  };

  Draw draw_;
  Json spec_;
  double duration_ = 1.0;  // [s]
  bool has_gravity_ = false;
  std::vector<std::string> mounts_{"hub"};
  std::vector<std::string> oscillators_;  // what a step rule can follow
  std::vector<Tank> tanks_;
};

}  // namespace twincraft::random_vehicles
