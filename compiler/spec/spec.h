// The whole spec as C++: one struct per section, filled by its field table. The file a component
// lives in declares its struct; this one puts them together.
// Tested by tests/compiler/spec_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/components/body.h"
#include "compiler/components/hub.h"
#include "compiler/components/load.h"
#include "compiler/components/panel.h"
#include "compiler/components/slosh.h"
#include "compiler/components/tank.h"
#include "compiler/components/thruster.h"
#include "compiler/components/wheel.h"
#include "compiler/spec/agreement.h"
#include "compiler/spec/engines.h"
#include "compiler/spec/environment.h"
#include "compiler/spec/initial.h"
#include "compiler/spec/simulation.h"
#include "compiler/spec/stored.h"
#include "compiler/spec/study.h"

namespace twincraft {

struct Spec : Written {
  // Followed before a spec is read, so never found here; for the schema and the reference.
  std::optional<std::string> extends;
  std::optional<std::vector<std::string>> drop;
  std::string format;
  std::string name;
  std::string description;
  HubSpec hub;
  std::vector<WheelSpec> wheels;
  std::vector<PanelSpec> panels;
  std::vector<BodySpec> bodies;
  std::vector<TankSpec> tanks;
  std::vector<SloshSpec> slosh;
  std::vector<ThrusterSpec> thrusters;
  std::vector<LoadSpec> loads;
  EnvironmentSpec environment;
  InitialSpec initial;
  SimulationSpec simulation;
  EnginesSpec engines;
  AgreementSpec agreement;
  std::vector<ReferenceKind> references;
  std::optional<StoredSpec> stored;
  std::optional<StudySpec> study;
};

const Table<Spec>& spec_table();

/// Whether this program reads the format that the document names; if not, that is reported. Comes
/// before reading: the keys of another version would all be faults. A missing `format` is left to
/// the table.
bool check_format(const Node& root, Diagnostics& diagnostics);

/// Whether the references make use of the section `stored`.
bool names_stored(const Spec& spec);

/// Everything that a step rule can follow.
std::vector<Oscillator> oscillators(const Spec& spec);

/// Unique names, references between components, and every component's own check.
void check(const Spec& spec, Diagnostics& diagnostics);

/// A point mass (`simulation.mode: translation`) carries and turns nothing. Part of check().
void check_point_mass(const Spec& spec, Diagnostics& diagnostics);

/// Both halves of the model, with its initial state. Nothing when a wheel's token mass leaves no
/// physical mount, which is reported. @pre check reported no error
std::optional<Model> lower(const Spec& spec, Diagnostics& diagnostics);

}  // namespace twincraft
