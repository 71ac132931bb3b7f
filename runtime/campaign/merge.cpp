#include "runtime/campaign/merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace twincraft {

std::string CampaignMerge::add(const std::string& name, std::istream& in) {
  RecordReader reader(in);
  if (!reader.error().empty()) return fmt::format("`{}`: {}", name, reader.error());
  if (!reader.header()) {
    remarks_.push_back(fmt::format("`{}` is empty", name));
    return {};
  }
  if (!table_) table_.emplace(*reader.header());
  if (const std::string why = difference(table_->header(), *reader.header()); !why.empty())
    return fmt::format("`{}`: {}", name, why);
  for (MemberRecord record; reader.next(record);) table_->add(record);
  if (!reader.tail().empty()) remarks_.push_back(fmt::format("`{}`: {}", name, reader.tail()));
  members_ = std::max(members_, reader.members().value_or(0));
  instructions_.insert(reader.header()->instructions);
  return {};
}

std::optional<MergedCampaign> CampaignMerge::finish(std::string& error) && {
  if (!table_) return std::nullopt;
  error = table_->settle(members_);
  if (!error.empty()) return std::nullopt;
  if (instructions_.size() > 1)
    remarks_.push_back(fmt::format("shards flew with {}: last digits may differ",
                                   fmt::join(instructions_, " and ")));
  std::vector<MemberRange> missing = table_->missing(members_);
  return MergedCampaign{std::move(*table_), members_, std::move(missing), std::move(remarks_)};
}

}  // namespace twincraft
