// See running.h. Every batch begins with the first sample of all, from which a reference starts.
#include "runtime/reference/running.h"

#include <algorithm>

namespace twincraft {
namespace {

/// A reference is set up once a batch, which costs as much as some ten samples.
constexpr std::size_t kBatch = 512;

}  // namespace

RunningDeviations::RunningDeviations(ReferenceKind kind, const Model& model)
    : kind_(kind), model_(model), batch_(kBatch) {}

void RunningDeviations::take(const Observation& sample) {
  batch_[filled_++] = sample;
  if (filled_ == batch_.size()) judge();
}

void RunningDeviations::judge() {
  const std::vector<Deviation> batch = deviations(kind_, model_, std::span(batch_).first(filled_));
  for (const Deviation& deviation : batch) {
    const auto known = std::ranges::find(found_, deviation.metric, &Deviation::metric);
    if (known == found_.end())
      found_.push_back(deviation);
    else
      known->see(deviation.max, deviation.at);
  }
  filled_ = 1;
  judged_ = true;
}

std::vector<Deviation> RunningDeviations::result() {
  if (filled_ > 1 || (filled_ == 1 && !judged_)) judge();
  return found_;
}

}  // namespace twincraft
