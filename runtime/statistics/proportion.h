// How often something happens, from how often it did.
#pragma once

#include <cstddef>

namespace twincraft::statistics {

struct Interval {
  double lower = 0.0, upper = 1.0;
};

/// The interval of Clopper and Pearson for a probability: it has at least this confidence, whatever
/// the probability is. Of no trials it is [0, 1]. @pre successes <= trials, 0 < confidence < 1
Interval clopper_pearson(std::size_t successes, std::size_t trials, double confidence);

}  // namespace twincraft::statistics
