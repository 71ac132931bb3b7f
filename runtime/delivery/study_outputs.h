// The numbers that a study asks of every member's flight, made of the samples of the analytic
// engine on their way to the member's files. Tested by tests/agreement/study_test.cpp.
#pragma once

#include <memory>
#include <vector>

#include "compiler/ir/campaign.h"
#include "runtime/campaign/reductions.h"
#include "runtime/study/run_study.h"

namespace twincraft {

class StudyOutputs : public MemberOutput {
 public:
  /// @param next  may be nothing
  StudyOutputs(const Model& model, const std::vector<OutputPlan>& plan,
               std::unique_ptr<MemberOutput> next)
      : plan_(plan), reducer_(model, plan), next_(std::move(next)) {}

  void take(std::size_t engine, const Observation& sample, const Books& books) override;
  void take_pair(const Observation& bsm, const Observation& mujoco,
                 std::span<const double> metrics) override;
  void land() override;
  void publish(ReportedMember& member) override;

 private:
  const std::vector<OutputPlan>& plan_;
  OutputReducer reducer_;
  std::unique_ptr<MemberOutput> next_;
};

}  // namespace twincraft
