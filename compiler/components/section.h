// What a section of components answers. Every component has its own
//     void check(const T&, const Context&, Diagnostics&);
//     void lower(const T&, const Vehicle&, ModelBuilder&);  // @pre check() found no error
// and answers the questions below only where they concern it, by an overload beside its struct.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/components/model_builder.h"
#include "compiler/components/names.h"
#include "compiler/schema/table.h"

namespace twincraft {

struct Vehicle;

/// What a component is checked against.
struct Context {
  const Vehicle& vehicle;
  const Names& names;
  double duration;  // of the run [s]
};

template <class T>
const std::string& name_of(const T& component) {
  return component.name;
}
/// Where it was written.
template <class T>
const Written& written(const T& component) {
  return component;
}

/// What must hold between members of a section, or of several; called when each has been checked.
template <class T>
void check_together(const std::vector<T>&, const Context&, Diagnostics&) {}

/// Add what others can be mounted on, before any component is lowered.
template <class T>
void lower_mounts(const std::vector<T>&, ModelBuilder&) {}

/// How many joints and wheels a component brings, and what to point at when they are too many.
struct Coordinates {
  int count = 0;
  Span span = {};
};
template <class T>
Coordinates coordinates_of(const T&) {
  return {};
}

/// What it adds to the mass of the vehicle at t = 0 [kg].
template <class T>
double mass_of(const T&) {
  return 0.0;
}

/// The key that says what it stands on, or that makes it as deep as it is.
template <class T>
std::string_view depth_key(const T&) {
  return "mount";
}

/// Whether a point mass can have it.
template <class T>
bool fits_point_mass(const T&) {
  return false;
}

/// Something a step rule can follow.
struct Oscillator {
  std::string name;
  std::string who;               // for messages: "panel `wing`"
  std::optional<double> period;  // [s]
  std::string lack;              // why there is none: "no hinge of it has stiffness"
  Span span;                     // what to point at then
  double decay = 0.0;            // [1/s] no damper of it decays faster
};
template <class T>
std::vector<Oscillator> oscillators_of(const std::vector<T>&, const Vehicle&) {
  return {};
}

/// Warn of a component that does not act in the run, the half-open [0, duration).
/// @param during  absent: it always acts. @param who  "thruster `main`"
void check_acts(const std::optional<std::vector<Schedule::Interval>>& during, Span span,
                std::string_view who, const Context& context, Diagnostics& diagnostics);

}  // namespace twincraft
