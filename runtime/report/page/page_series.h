// What the page draws of a member's samples, collected while it is flown.
#pragma once

#include <array>
#include <memory>

#include "runtime/report/page/frames.h"
#include "runtime/report/page/histories.h"
#include "runtime/study/results.h"

namespace twincraft {

class PageSeries : public MemberWatch {
 public:
  explicit PageSeries(const Model& model);

  void take(std::size_t engine, const Observation& sample, const Books& books) override;
  void take_pair(const Observation& bsm, const Observation& mujoco,
                 std::span<const double> metrics) override;

  const Histories& histories() const { return histories_; }
  const Frames& frames(std::size_t engine) const { return frames_.at(engine); }

 private:
  Histories histories_;
  std::array<Frames, 2> frames_;
};

/// Histories::json() of a member.
nlohmann::ordered_json histories_json(const ReportedMember& member);

/// Those of a member, or what its kept samples make.
std::shared_ptr<const PageSeries> series_of(const ReportedMember& member);

}  // namespace twincraft
