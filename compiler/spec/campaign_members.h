// A campaign with its paths followed: any member's numbers can be asked for, none is kept.
// Tested by tests/compiler/campaign_test.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compiler/draws/copula.h"
#include "compiler/draws/distribution.h"
#include "compiler/draws/sampler.h"
#include "compiler/spec/places.h"
#include "compiler/spec/spec.h"

namespace twincraft {

/// How the value of one place is drawn.
struct ScalarDraws {
  std::vector<draws::Distribution> each;  // of every number of the place
};
struct ConeDraw {
  double sigma = 0.0;  // [rad]
};
struct RotationDraw {
  double sigma = 0.0;  // [rad]
};
struct InertiaDraw {
  double sigma = 0.0;
  double tilt = 0.0;  // [rad]
};
using Draw = std::variant<ScalarDraws, ConeDraw, RotationDraw, InertiaDraw>;

/// How many uniform numbers it takes.
std::size_t columns_of(const Draw& draw);

/// What the numbers drawn at a place are called, after its path: `.x`, `.xy`, nothing.
std::vector<std::string> suffixes_of(const Place& place);
/// Their nominal values, SI: of an attitude, of which the turn is drawn, zeros.
std::vector<double> nominal_numbers(const Place& place);

struct DrawnPlace {
  Place place;
  Draw draw;
  std::size_t first_column = 0;  // of the sampler
};

struct CampaignMembers {
  CampaignPlan plan;
  std::vector<DrawnPlace> places;
  std::optional<draws::Sampler> sampler;
  std::optional<draws::Copula> copula;
  std::size_t columns = 0;  // of the sampler

  /// In the order of plan.drawn, SI. @pre member < plan.members
  std::vector<double> drawn(std::size_t member) const;
  /// The same as changes of the spec, `PATH=VALUE`, to the last digit.
  std::vector<std::string> settings(std::size_t member) const;
};

/// Report what is wrong with the campaign itself; nothing when there was an error. What is wrong
/// with a member shows when it is compiled. @pre check(spec) reported no error, and it has a
/// campaign
std::optional<CampaignMembers> members_of(const Spec& spec, Diagnostics& diagnostics);

}  // namespace twincraft
