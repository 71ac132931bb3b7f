// Validate generated models in your own GoogleTest suite:
//
//   EXPECT_TRUE(twincraft::proves("vehicle.yaml"));
//   EXPECT_TRUE(twincraft::agrees("vehicle.yaml", {"simulation.step=10 ms"}));
//
// A failure says what the terminal would.
#ifndef TWINCRAFT_TESTING_H
#define TWINCRAFT_TESTING_H

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "simulation.h"

namespace twincraft {
namespace detail {

template <class Ask>
testing::AssertionResult passes(const std::string& spec, const std::vector<std::string>& set,
                                const Ask& ask) {
  try {
    const Run run = ask(Model::load(spec, set));
    if (run.passes()) return testing::AssertionSuccess() << run.text();
    return testing::AssertionFailure() << spec << '\n' << run.text();
  } catch (const Error& error) {
    return testing::AssertionFailure() << spec << '\n' << error.what();
  }
}

}  // namespace detail

/// Both engines fly the spec to the end and no judged tolerance is exceeded: what `scsim` exits
/// with 0 for. @param set  `PATH=VALUE`
inline testing::AssertionResult agrees(const std::string& spec,
                                       const std::vector<std::string>& set = {}) {
  return detail::passes(spec, set, [](const Model& model) { return model.run(); });
}

/// The spec's two targets are one machine: what `sccompile --check` exits with 0 for.
inline testing::AssertionResult proves(const std::string& spec,
                                       const std::vector<std::string>& set = {}) {
  return detail::passes(spec, set, [](const Model& model) { return model.prove(); });
}

}  // namespace twincraft

#endif
