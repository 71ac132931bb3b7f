// See frames.h. How many samples will come is not known: every sample is kept at first, and every
// other one of those is let go when there are several times as many as can be shown.
#include "runtime/report/page/frames.h"

#include <algorithm>
#include <array>

#include "runtime/report/page/base64.h"

namespace twincraft {
namespace {

constexpr std::size_t kMostFrames = 2000;
constexpr std::size_t kMostNumbers = 200'000;  // of both engines: 2.1 MB
constexpr std::size_t kSpare = 4;              // rows kept for one that is shown

std::size_t width_of(const Model& model) {
  return 11 + model.assembly.links.size() - 1 + model.assembly.rotors.size();
}

}  // namespace

Frames::Frames(const Model& model)
    : width_(width_of(model)),
      most_(std::clamp<std::size_t>(kMostNumbers / 2 / width_, 50, kMostFrames)) {}

/// No engine integrates the angle of a balanced wheel: between samples its rate is taken to be
/// linear, which is good enough to look at.
void Frames::turn_wheels(const Observation& sample) {
  wheel_angle_.resize(sample.wheel_rate.size(), 0.0);
  if (samples_ > 0)
    for (std::size_t w = 0; w < wheel_angle_.size(); ++w)
      wheel_angle_[w] += 0.5 * (sample.time - last_time_) * (sample.wheel_rate[w] + wheel_rate_[w]);
  wheel_rate_ = sample.wheel_rate;
  last_time_ = sample.time;
}

void Frames::take(const Observation& sample) {
  turn_wheels(sample);
  last_.clear();
  const auto append = [this](const auto& values) {
    last_.insert(last_.end(), values.begin(), values.end());
  };
  last_.push_back(sample.time);
  append(sample.r_BN_N);
  append(sample.r_CN_N);
  append(std::array{sample.q_BN.w(), sample.q_BN.x(), sample.q_BN.y(), sample.q_BN.z()});
  append(sample.joint_position);
  append(wheel_angle_);
  if (samples_++ % stride_ != 0) return;
  if (kept() == kSpare * most_) halve();
  if ((samples_ - 1) % stride_ == 0) rows_.insert(rows_.end(), last_.begin(), last_.end());
}

void Frames::halve() {
  const std::size_t half = kept() / 2;
  for (std::size_t i = 1; i < half; ++i)
    std::copy_n(&rows_[2 * i * width_], width_, &rows_[i * width_]);
  rows_.resize(half * width_);
  stride_ *= 2;
}

std::size_t Frames::count() const { return std::min(samples_, most_); }

std::string Frames::text() const {
  std::vector<double> all = rows_;
  if (samples_ > 0 && (samples_ - 1) % stride_ != 0)
    all.insert(all.end(), last_.begin(), last_.end());
  const std::size_t rows = all.size() / width_;
  std::vector<double> shown;
  for (std::size_t i = 0; i < count(); ++i) {
    const std::size_t row = count() == 1 ? 0 : i * (rows - 1) / (count() - 1);
    shown.insert(shown.end(), &all[row * width_], &all[row * width_] + width_);
  }
  return base64(shown);
}

}  // namespace twincraft
