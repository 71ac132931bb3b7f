// All results of a campaign, column by column, in the order of the members: what is printed and
// what statistics are made of. It holds the numbers and the reasons, and little else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/campaign/records.h"

namespace twincraft {

/// Members `first` to `last`, both of them included.
struct MemberRange {
  std::size_t first = 0, last = 0;
};
/// `3, 17-20, 512`; of more than ten ranges the first ten, and how many members the others have.
std::string range_words(std::span<const MemberRange> ranges);

class CampaignTable {
 public:
  explicit CampaignTable(RecordsHeader header);

  /// Members in any order. @pre as many numbers as the header has columns
  void add(const MemberRecord& record);
  /// Orders the rows; to be called after the last add(). Members from `count` on are left out. One
  /// that came several times is one row, the first to come. @return empty, or which member came
  /// with other results: only `seconds` may differ
  std::string settle(std::size_t count);

  /// Both engines flew a member after all: its verdict, and what is added to its reason.
  void take_twin(std::size_t row, Verdict verdict, const std::string& reason);

  const RecordsHeader& header() const { return header_; }
  std::size_t rows() const { return members_.size(); }
  std::span<const std::size_t> members() const { return members_; }  // of each row
  /// SI. Outputs are NaN where there is none.
  std::span<const double> drawn(std::size_t column) const { return drawn_[column]; }
  std::span<const double> output(std::size_t column) const { return outputs_[column]; }
  std::span<const double> seconds() const { return seconds_; }
  Verdict verdict(std::size_t row) const { return static_cast<Verdict>(verdicts_[row]); }
  std::optional<Verdict> twin(std::size_t row) const;
  std::string_view reason(std::size_t row) const;
  /// The member has flown as far as its plan says, or stopped where it had to: its outputs count.
  bool is_flown(std::size_t row) const;
  /// The row as it was added, and with what take_twin() added to it.
  MemberRecord record(std::size_t row) const;

  /// Of the members 0 to count - 1, those without a row.
  std::vector<MemberRange> missing(std::size_t count) const;

 private:
  bool is_same(std::size_t row, std::size_t other) const;
  void reorder(std::span<const std::size_t> order);

  RecordsHeader header_;
  std::vector<std::size_t> members_;
  std::vector<std::vector<double>> drawn_, outputs_;
  std::vector<double> seconds_;
  std::vector<std::uint8_t> verdicts_, twins_;  // enumerators; twins: kNoTwin
  std::map<std::size_t, std::string> reasons_;  // by row; most have none
};

}  // namespace twincraft
