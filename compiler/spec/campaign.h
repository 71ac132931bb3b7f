// A campaign: members that are drawn instead of swept. What is drawn of each, what is asked of its
// flight and what is kept, as the spec says it; campaign_members.h makes members of it.
// Tested by tests/compiler/campaign_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/spec/outputs.h"

namespace twincraft {

// A sigma and a bound are in the unit of what is drawn, or in `%` of its nominal value.
struct NormalSpec : Written {
  Node sigma;
  std::optional<double> truncate;  // at so many sigmas
};

struct UniformSpec : Written {
  Node low, high;
};

struct LognormalSpec : Written {
  Node sigma;
};

struct TriangularSpec : Written {
  Node low, high;
  std::optional<Node> mode;  // absent: the nominal value
};

struct ChoiceSpec : Written {
  std::vector<Node> values;
};

struct ConeSpec : Written {
  double sigma = 0.0;  // [rad] of the tilt in each of two directions
};

struct RotationSpec : Written {
  double sigma = 0.0;  // [rad] of the turn about each body axis
};

struct InertiaDrawSpec : Written {
  Node sigma;         // of the second moments of mass
  double tilt = 0.0;  // [rad] of the turn about each axis
};

/// Exactly one distribution is written.
struct DispersionSpec : Written {
  std::string set;  // a spec path
  std::optional<NormalSpec> normal;
  std::optional<UniformSpec> uniform;
  std::optional<LognormalSpec> lognormal;
  std::optional<TriangularSpec> triangular;
  std::optional<ChoiceSpec> choice;
  std::optional<ConeSpec> cone;
  std::optional<RotationSpec> rotation;
  std::optional<InertiaDrawSpec> inertia;
  bool together = false;
};

/// `[path, path, rho]`
struct CorrelationSpec {
  std::string first, second;
  double rho = 0.0;
  const Node* node = nullptr;
};

struct KeepSpec : Written {
  int worst = 0;
  std::optional<std::string> by;
  std::vector<int> members;
};

struct TwinSpec : Written {
  int every = 100;
};

struct CampaignSpec : Written {
  int members = 0;
  int seed = 0;
  Sampling sampling = Sampling::kRandom;
  std::vector<DispersionSpec> dispersions;
  std::vector<CorrelationSpec> correlate;
  std::vector<OutputSpec> outputs;
  std::vector<StopSpec> stop;
  KeepSpec keep;
  TwinSpec twin;
};

const Table<CampaignSpec>& campaign_table();

}  // namespace twincraft
