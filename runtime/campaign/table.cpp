#include "runtime/campaign/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace twincraft {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint8_t kNoTwin = 0xff;

template <class Value>
void take_in_order(std::span<const std::size_t> order, std::vector<Value>& values) {
  std::vector<Value> taken;
  taken.reserve(order.size());
  for (const std::size_t row : order) taken.push_back(values[row]);
  values = std::move(taken);
}

bool is_same_number(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

std::string range_words(std::span<const MemberRange> ranges) {
  constexpr std::size_t kShown = 10;
  std::string text;
  std::size_t more = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto [first, last] = ranges[i];
    if (i >= kShown) {
      more += last - first + 1;
      continue;
    }
    if (i > 0) text += ", ";
    text += first == last ? std::to_string(first) : fmt::format("{}-{}", first, last);
  }
  return more == 0 ? text : fmt::format("{} and {} more", text, more);
}

CampaignTable::CampaignTable(RecordsHeader header)
    : header_(std::move(header)), drawn_(header_.drawn.size()), outputs_(header_.outputs.size()) {}

void CampaignTable::add(const MemberRecord& record) {
  if (!record.reason.empty()) reasons_.emplace(members_.size(), record.reason);
  members_.push_back(record.member);
  for (std::size_t i = 0; i < drawn_.size(); ++i) drawn_[i].push_back(record.drawn[i]);
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    outputs_[i].push_back(record.outputs[i].value_or(kNone));
  seconds_.push_back(record.seconds);
  verdicts_.push_back(static_cast<std::uint8_t>(record.verdict));
  twins_.push_back(record.twin ? static_cast<std::uint8_t>(*record.twin) : kNoTwin);
}

std::string CampaignTable::settle(std::size_t count) {
  std::vector<std::size_t> order(rows());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [this](std::size_t row) { return members_[row]; });
  std::vector<std::size_t> kept;
  for (const std::size_t row : order) {
    if (members_[row] >= count) break;
    if (kept.empty() || members_[kept.back()] != members_[row])
      kept.push_back(row);
    else if (!is_same(kept.back(), row))
      return fmt::format("member {} was flown twice, with different results", members_[row]);
  }
  reorder(kept);
  return {};
}

void CampaignTable::take_twin(std::size_t row, Verdict verdict, const std::string& reason) {
  verdicts_[row] = twins_[row] = static_cast<std::uint8_t>(verdict);
  if (reason.empty()) return;
  std::string& all = reasons_[row];
  all += all.empty() ? reason : "; " + reason;
}

bool CampaignTable::is_same(std::size_t row, std::size_t other) const {
  const auto is_same_in = [row, other](const std::vector<double>& column) {
    return is_same_number(column[row], column[other]);
  };
  return std::ranges::all_of(drawn_, is_same_in) && std::ranges::all_of(outputs_, is_same_in) &&
         verdicts_[row] == verdicts_[other] && twins_[row] == twins_[other] &&
         reason(row) == reason(other);
}

void CampaignTable::reorder(std::span<const std::size_t> order) {
  take_in_order(order, members_);
  for (std::vector<double>& column : drawn_) take_in_order(order, column);
  for (std::vector<double>& column : outputs_) take_in_order(order, column);
  take_in_order(order, seconds_);
  take_in_order(order, verdicts_);
  take_in_order(order, twins_);
  std::map<std::size_t, std::string> reasons;
  for (std::size_t row = 0; row < order.size(); ++row)
    if (const auto found = reasons_.find(order[row]); found != reasons_.end())
      reasons.emplace_hint(reasons.end(), row, std::move(found->second));
  reasons_ = std::move(reasons);
}

std::optional<Verdict> CampaignTable::twin(std::size_t row) const {
  if (twins_[row] == kNoTwin) return std::nullopt;
  return static_cast<Verdict>(twins_[row]);
}

std::string_view CampaignTable::reason(std::size_t row) const {
  const auto found = reasons_.find(row);
  return found != reasons_.end() ? std::string_view(found->second) : std::string_view();
}

bool CampaignTable::is_flown(std::size_t row) const {
  return verdict(row) != Verdict::kFailed && verdict(row) != Verdict::kInterrupted;
}

MemberRecord CampaignTable::record(std::size_t row) const {
  MemberRecord record;
  record.member = members_[row];
  for (const std::vector<double>& column : drawn_) record.drawn.push_back(column[row]);
  for (const std::vector<double>& column : outputs_)
    record.outputs.push_back(std::isnan(column[row]) ? std::nullopt : std::optional(column[row]));
  record.verdict = verdict(row);
  record.twin = twin(row);
  record.seconds = seconds_[row];
  record.reason = reason(row);
  return record;
}

std::vector<MemberRange> CampaignTable::missing(std::size_t count) const {
  std::vector<MemberRange> ranges;
  std::size_t next = 0;
  const auto skip_to = [&](std::size_t member) {
    if (next < member) ranges.push_back({next, member - 1});
    next = member + 1;
  };
  for (const std::size_t member : members_)
    if (member < count) skip_to(member);
  skip_to(count);
  return ranges;
}

}  // namespace twincraft
