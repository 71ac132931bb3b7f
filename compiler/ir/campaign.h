// A campaign as the runtime and the report see it: how many members are drawn, what of each, what
// is asked of its flight, and what is kept. The numbers themselves come from LoadedSpec.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace twincraft {

enum class Sampling { kRandom, kLatinHypercube, kSobol };

/// A number that is drawn for every member: a column of the table.
struct DrawnNumber {
  std::string name;          // full path: `wheels.w.speed`, `hub.inertia.xy`, `initial.attitude.x`
  std::string unit;          // SI; `1` where there is none
  std::string distribution;  // in its own words: `normal, sigma 2 %, truncate 3`
  double nominal = 0.0;      // SI
  // It moves with no other, as correlated numbers, components of a direction or of an inertia, and
  // numbers that are drawn together do.
  bool is_independent = true;
};

enum class Reduce {
  kMax,
  kMin,
  kMaxAbs,
  kMaxNorm,  // of a vector
  kFinal,
  kMean,           // over time
  kRms,            // over time
  kSettlingTime,   // from when on it stays within `within` of its final value
  kFirstCrossing,  // when it first passes `level`
};

/// One number made of a signal over a run.
struct OutputPlan {
  std::string name;    // of the column
  std::string signal;  // one of outputs_of(): a number, or with kMaxNorm a vector
  Reduce reduce = Reduce::kFinal;
  double within = 0.0;                 // SI, of kSettlingTime
  double level = 0.0;                  // SI, of kFirstCrossing
  std::string unit;                    // SI, of the result
  std::optional<double> below, above;  // what it must be, SI
};

/// A member stops early at the first sample in which a signal is beyond a bound.
struct StopPlan {
  std::string signal;
  std::optional<double> below, above;  // SI
};

struct CampaignPlan {
  std::size_t members = 0;
  std::uint64_t seed = 0;
  Sampling sampling = Sampling::kRandom;
  std::vector<DrawnNumber> drawn;  // in the order of the columns
  std::vector<OutputPlan> outputs;
  std::vector<StopPlan> stops;
  std::size_t twin_every = 100;  // members that both engines fly; 1: all
  std::size_t keep_worst = 0;    // trajectories of so many members with the largest `keep_by`
  std::string keep_by;           // an output's name
  std::vector<std::size_t> keep_members;
};

}  // namespace twincraft
