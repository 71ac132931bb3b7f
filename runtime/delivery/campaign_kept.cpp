// See campaign_kept.h.
#include "runtime/delivery/campaign_kept.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include "runtime/delivery/member_files.h"
#include "runtime/study/in_order.h"

namespace twincraft {
namespace {

std::size_t row_of(const CampaignTable& table, std::size_t member) {
  return static_cast<std::size_t>(std::ranges::lower_bound(table.members(), member) -
                                  table.members().begin());
}

bool has_row(const CampaignTable& table, std::size_t member) {
  const std::size_t row = row_of(table, member);
  return row < table.rows() && table.members()[row] == member;
}

/// Rows with the largest values, the first of equal ones first.
std::vector<std::size_t> largest(const CampaignTable& table, std::size_t column,
                                 std::size_t count) {
  const std::span<const double> values = table.output(column);
  std::vector<std::size_t> rows(table.rows());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::erase_if(rows, [&](std::size_t row) { return std::isnan(values[row]); });
  const auto end = rows.begin() + static_cast<std::ptrdiff_t>(std::min(count, rows.size()));
  std::partial_sort(rows.begin(), end, rows.end(), [&](std::size_t a, std::size_t b) {
    return values[a] != values[b] ? values[a] > values[b] : a < b;
  });
  rows.erase(end, rows.end());
  return rows;
}

}  // namespace

std::vector<std::size_t> members_to_keep(const CampaignPlan& plan, const CampaignTable& table) {
  std::set<std::size_t> members;
  for (const std::size_t member : plan.keep_members)
    if (has_row(table, member) && table.is_flown(row_of(table, member))) members.insert(member);
  const std::vector<OutputColumn>& outputs = table.header().outputs;
  const auto by = std::ranges::find(outputs, plan.keep_by, &OutputColumn::name);
  if (by != outputs.end())
    for (const std::size_t row :
         largest(table, static_cast<std::size_t>(by - outputs.begin()), plan.keep_worst))
      members.insert(table.members()[row]);
  return {members.begin(), members.end()};
}

std::string keep_members(const std::vector<std::size_t>& members, const KeepRequest& request,
                         CampaignTable& table) {
  RunOptions options = request.options;
  options.bsm = options.mujoco = true;
  options.trials = 0;
  options.keep_samples = false;
  options.progress = nullptr;
  SharedOutput shared{request.folder != nullptr ? std::move(*request.folder) : OutputFolder({})};
  std::size_t next = 0;
  OrderedWork<FlownMember> plan;
  plan.count = members.size();
  plan.work = [&](std::size_t i) {
    const MakeOutput output = [&](const Bundle& bundle) -> std::unique_ptr<MemberOutput> {
      if (request.folder == nullptr) return nullptr;
      return std::make_unique<MemberFiles>(bundle, MemberFilesPlan{members[i], request.netcdf},
                                           request.provenance, shared);
    };
    return run_one(request.compile(members[i]), options, output);
  };
  plan.deliver = [&](FlownMember flown) {
    const std::size_t row = row_of(table, members[next++]);
    if (flown.member.result.interrupted()) return;
    if (flown.output) flown.output->publish(flown.member);
    const TwinFinding found = twin_finding(flown.member.result);
    if (!table.twin(row)) table.take_twin(row, found.verdict, found.reason);
    request.options.show("keep", static_cast<double>(next) / static_cast<double>(members.size()));
  };
  plan.may_go_on = [&] { return !request.options.stopped(); };
  in_order(plan, request.jobs);
  if (request.folder != nullptr) *request.folder = std::move(shared.folder);
  return shared.error;
}

}  // namespace twincraft
