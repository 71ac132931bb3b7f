// The whole spec as C++: a vehicle and the sections of its run, a struct each, filled by its field
// table. The file a section lives in declares its struct; this one puts them together.
// Tested by tests/compiler/spec_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/components/vehicle.h"
#include "compiler/spec/agreement.h"
#include "compiler/spec/campaign.h"
#include "compiler/spec/engines.h"
#include "compiler/spec/environment.h"
#include "compiler/spec/initial.h"
#include "compiler/spec/simulation.h"
#include "compiler/spec/stored.h"
#include "compiler/spec/study.h"

namespace twincraft {

struct Spec : Written, Vehicle {
  // Followed before a spec is read, so never found here; for the schema and the reference.
  std::optional<std::string> extends;
  std::optional<std::vector<std::string>> drop;
  std::string format;
  std::string name;
  std::string description;
  EnvironmentSpec environment;
  InitialSpec initial;
  SimulationSpec simulation;
  EnginesSpec engines;
  AgreementSpec agreement;
  std::vector<ReferenceKind> references;
  std::optional<StoredSpec> stored;
  std::optional<StudySpec> study;
  std::optional<CampaignSpec> campaign;
};

const Table<Spec>& spec_table();

/// Whether this program reads the format that the document names; if not, that is reported. Comes
/// before reading: the keys of another version would all be faults. A missing `format` is left to
/// the table.
bool check_format(const Node& root, Diagnostics& diagnostics);

/// Whether the references make use of the section `stored`.
bool names_stored(const Spec& spec);

/// Every component's own check, that of every section of the run, and what must hold between them.
void check(const Spec& spec, Diagnostics& diagnostics);

/// A point mass (`simulation.mode: translation`) carries and turns nothing. Part of check().
void check_point_mass(const Spec& spec, Diagnostics& diagnostics);

/// Both halves of the model, with its initial state. Nothing when a wheel's token mass leaves no
/// physical mount, which is reported. @pre check reported no error
std::optional<Model> lower(const Spec& spec, Diagnostics& diagnostics);

}  // namespace twincraft
