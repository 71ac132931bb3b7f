// Time histories for the page: figures of like quantities, each with both engines' values beside
// the difference that the agreement table takes its maximum of. They are collected while a member
// is flown.
#pragma once

#include <array>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "runtime/compare/conservation.h"
#include "runtime/report/page/decimate.h"
#include "runtime/study/member.h"

namespace twincraft {

class Histories : public MemberWatch {
 public:
  explicit Histories(const Model& model);

  void take(std::size_t engine, const Observation& sample, const Books& books) override;
  void take_pair(const Observation& bsm, const Observation& mujoco,
                 std::span<const double> metrics) override;

  /// `{samples, points, thinned, times: {bsm, mujoco, difference}, figures: [...]}`; columns of
  /// numbers are base64 of little-endian doubles. An engine without samples has no times and no
  /// values.
  /// @param model, member  those that were flown
  nlohmann::ordered_json json(const Model& model, const Member& member) const;

  struct Series {
    std::string name;
    std::function<double(const Observation&)> value;
  };
  struct Figure {
    std::string title, unit, metric;  // metric: empty when nothing judges it
    std::vector<Series> series;
  };

 private:
  std::vector<Figure> figures_;
  std::vector<std::string> metrics_;  // keys, in the order of take_pair
  // Of an engine: the series of all figures, then imbalances of energy, momentum and angular
  // momentum. Of pairs: the metrics, then differences of the series that no metric judges.
  std::array<Decimator, 2> engines_;
  Decimator pairs_;
  std::array<ConservationMeter, 2> books_;
  std::array<std::vector<double>, 3> row_;  // of each, reused
};

}  // namespace twincraft
