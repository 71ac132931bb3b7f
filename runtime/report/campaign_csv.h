// The results of a campaign as comma-separated values: a line per member, the same bytes however
// its members were flown, but for their seconds.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "runtime/campaign/table.h"

namespace twincraft {

/// Lines of the file, row by row. The columns are member, drawn numbers, outputs, verdict, reason,
/// seconds; numbers read back exactly.
class CampaignCsv {
 public:
  /// @param table  outlives the object
  explicit CampaignCsv(const CampaignTable& table) : table_(table) {}

  std::string header() const;  // `name [unit]` of every number; seconds have theirs in their name
  /// An output without a value is an empty cell.
  void append(std::size_t row, std::string& text) const;

 private:
  const CampaignTable& table_;
};

/// A cell that any reader takes for this text: in quotes where it has to be, on one line, and never
/// a formula, which a spreadsheet would run.
std::string text_cell(std::string_view text);

}  // namespace twincraft
