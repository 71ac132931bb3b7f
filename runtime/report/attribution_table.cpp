// See attribution_table.h. Tested by tests/runtime/attribution_test.cpp.
#include "runtime/report/attribution_table.h"

#include <fmt/format.h>

#include <cmath>

#include "runtime/report/attribution_words.h"
#include "runtime/report/columns.h"
#include "runtime/report/table.h"
#include "runtime/report/words.h"

namespace twincraft {
namespace {

std::string cell(double value, const std::string& unit) {
  return std::isnan(value) ? "-" : quantity(value, unit);
}

std::string cause_block(const Attribution& attribution, const std::string& unit) {
  std::vector<Row> rows{{"cause", "carries", "without it", "law"}};
  for (const AttributedCause& cause : attribution.causes)
    rows.push_back({cause.cause.name, share_words(cause.share), cell(cause.maximum_without, unit),
                    cause.law ? law_words(*cause.law) : cause.no_law});
  return aligned(rows);
}

std::string removal_block(const Attribution& attribution, const std::string& unit) {
  std::vector<Row> rows{{"as it is", quantity(attribution.maximum, unit), ""}};
  for (const AttributedCause& cause : attribution.causes)
    rows.push_back({"without " + cause.cause.name, cell(cause.maximum_left, unit), ""});
  rows.back()[2] = remainder_words(attribution);
  return aligned(rows);
}

}  // namespace

std::string attribution_table(const Report& report, bool colour) {
  const ReportedMember& member = report.members.front();
  const Model& model = member.bundle.model;
  const Attribution& attribution = *report.attribution;
  const auto [name, unit] = words_of(attribution.subject.metric, model);
  const std::string label = attribution.subject.joint
                                ? fmt::format("{} (`{}`)", name, attribution.subject.coordinate)
                                : name;
  std::string text = heading(model) + agreement_block(member, colour);
  if (!attribution.is_rounding) {
    if (!attribution.causes.empty())
      text += fmt::format("\nwhat carries the difference in {}\n", label) +
              cause_block(attribution, unit);
    text += "\nremoved one after another\n" + removal_block(attribution, unit);
  }
  return text + "\n" + conclusion(attribution, model) + "\n";
}

}  // namespace twincraft
