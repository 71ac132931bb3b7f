// The numbers of a model's inputs, outputs or states by name. Tested by
// tests/api/simulation_test.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/ir/signals.h"

namespace twincraft::api {

class SignalList {
 public:
  /// @param kind  for messages: `input`
  template <class OneSignal>
  SignalList(std::string kind, const std::vector<OneSignal>& signals) : kind_(std::move(kind)) {
    for (const Signal& signal : signals) add(signal);
  }

  std::size_t size() const { return names_.size(); }
  const std::string& name(std::size_t i) const { return names_[i]; }
  const std::string& unit(std::size_t i) const { return units_[i]; }
  const std::string& meaning(std::size_t i) const { return meanings_[i]; }

  /// Numbers that stand together: one, or those of a vector.
  struct Range {
    std::size_t first = 0, count = 1;
  };
  /// @param name  of one number, `push.force.x`, or of a whole vector, `push.force`
  /// @throws Fault that names the nearest
  Range find(std::string_view name) const;

 private:
  void add(const Signal& signal);

  std::string kind_;
  std::vector<std::string> names_, units_, meanings_;
  std::vector<std::string> vectors_;  // of each number, the vector's name; empty: none
};

}  // namespace twincraft::api
