// A campaign as CSV and as text for people.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "runtime/report/campaign_csv.h"
#include "runtime/report/campaign_table.h"
#include "tests/campaign/handmade.h"
#include "tests/runtime/handmade_campaign_report.h"

namespace twincraft {
namespace {

using test::campaign_header;
using test::failed_member;
using test::member_record;
using testing::HasSubstr;
using testing::Not;

MergedCampaign merged(const std::vector<MemberRecord>& records, std::size_t members,
                      const RecordsHeader& header = campaign_header()) {
  std::string text = header_line(header) + members_line(members);
  for (const MemberRecord& record : records) text += record_line(record);
  std::istringstream in(text);
  CampaignMerge merge;
  EXPECT_EQ(merge.add("a", in), "");
  std::string error;
  std::optional<MergedCampaign> campaign = std::move(merge).finish(error);
  EXPECT_EQ(error, "");
  return std::move(*campaign);
}

std::string text_of(MergedCampaign campaign) {
  CampaignReport report{std::move(campaign), {}, {}};
  report.findings = find_all(report.campaign, report.plan, {false, false});
  return campaign_table(report);
}

std::string csv(const MergedCampaign& campaign) {
  const CampaignCsv lines(campaign.table);
  std::string text = lines.header();
  for (std::size_t row = 0; row < campaign.table.rows(); ++row) lines.append(row, text);
  return text;
}

TEST(CampaignCsv, HasARowPerMemberAndAColumnPerNumber) {
  MemberRecord broken = member_record(1);
  broken.drawn = {1.0 / 3.0, -1e-300};
  broken.outputs = {0.5, 2.0};
  broken.reason = "peak 0.5 rad is not below 0.1 rad";
  EXPECT_EQ(csv(merged({failed_member(2, "no, \"really\""), broken, member_record(0)}, 3)),
            "member,hub.mass [kg],wheels.w.speed [rad/s],peak [rad],touch [s],verdict,reason,"
            "seconds\n"
            "0,600,-0.1,0,,not_judged,,0.25\n"
            "1,0.3333333333333333,-1e-300,0.5,2,not_judged,peak 0.5 rad is not below 0.1 rad,0.25\n"
            "2,600.6666666666666,-0.1,,,failed,\"no, \"\"really\"\"\",0.25\n");
}

TEST(CampaignCsv, NeverHoldsAFormula) {
  for (const char* text : {"=1+1", "+1", "-1", "@x", "\t=1", "\r=1"})
    EXPECT_EQ(text_cell(text)[0], '\'') << text;
  EXPECT_EQ(text_cell("=SUM(a,\"b\")"), "\"'=SUM(a,\"\"b\"\")\"");
  EXPECT_EQ(text_cell("a\nb\x7f"), "a b ");
  EXPECT_EQ(text_cell("a=b"), "a=b");
  EXPECT_EQ(text_cell(""), "");
  RecordsHeader header = campaign_header();
  header.outputs[0].name = "=cmd";
  EXPECT_THAT(csv(merged({}, 1, header)), HasSubstr(",'=cmd [rad],"));
}

TEST(CampaignTableText, ShowsSpreadRequirementsAndFailures) {
  std::vector<MemberRecord> records;
  for (std::size_t member = 0; member < 200; ++member) records.push_back(member_record(member));
  records[0].twin = Verdict::kAgree;
  records.push_back(failed_member(200, "`x` is absurd: 3 m"));
  EXPECT_EQ(
      text_of(merged(records, 205)),
      "quickstart: 200 of 205 members flown\n"
      "\n"
      "  output  unit  min  median  p95    max    requirement  held by flown                    "
      "  held by all\n"
      "  peak    rad   0    0.0995  0.189  0.199  below 0.1    100 of 200, 50.0 % (42.9 to 57.1)"
      "  100 of 205, 48.8 % (41.8 to 55.8)\n"
      "  touch   s     -    -       -      -      -            -                                "
      "  -\n"
      "\n"
      "  Brackets: 95 % confidence (Clopper-Pearson). `all` counts members that were not flown as "
      "broken.\n"
      "\n"
      "  peak follows hub.mass (rank 1.00)\n"
      "  worst peak: 0.199 rad in member 199\n"
      "  1 not flown: `x` is absurd: .. m (first: member 200)\n"
      "  missing: members 201-204\n"
      "  flown by both engines: 1; agree: 1; disagree: 0\n");
}

TEST(CampaignTableText, CountsMembersThatAreNotResolved) {
  std::vector<MemberRecord> records{member_record(0), member_record(1), member_record(2)};
  EXPECT_THAT(text_of(merged(records, 3)), Not(HasSubstr("unresolved")));
  for (MemberRecord* record : {&records[1], &records[2]}) {
    record->verdict = Verdict::kUnresolved;
    record->reason = "w.1 swings at 26.6 rad/s. --step '5 ms' resolves it";
  }
  EXPECT_THAT(text_of(merged(records, 3)),
              HasSubstr("\n  2 unresolved: w.1 swings at 26.6 rad/s. --step '5 ms' resolves it "
                        "(first: member 1)\n"));
}

TEST(CampaignTableText, NamesDriversWithTheirIndicesAndTheCommandOfTheWorst) {
  CampaignReport report = test::campaign_report(300);
  const OutputFindings& peak = report.findings.outputs[0];
  const std::string text = campaign_table(report);
  EXPECT_THAT(text, HasSubstr(fmt::format("  peak follows hub.mass (rank {:.2f}, Sobol' {:.2f}), ",
                                          peak.drivers.drivers[0].rank->coefficient,
                                          peak.drivers.drivers[0].sobol_first->value)));
  EXPECT_THAT(text, Not(HasSubstr("panels.p.stiffness")));  // no more than chance
  EXPECT_THAT(text,
              HasSubstr(fmt::format(" rad in member {}\n    scsim 'models/my tug.yaml' --set ",
                                    peak.worst[0].member)));
}

TEST(CampaignTableText, IsShortWhereNothingIsRequired) {
  RecordsHeader header = campaign_header();
  header.outputs[0].below.reset();
  const std::string text = text_of(merged({member_record(0)}, 1, header));
  EXPECT_THAT(text, Not(HasSubstr("requirement")));
  EXPECT_THAT(text, HasSubstr("  touch   s     -    -       -    -\n"));
  header.outputs.clear();
  MemberRecord bare = member_record(0);
  bare.outputs.clear();
  EXPECT_EQ(text_of(merged({bare}, 1, header)), "quickstart: 1 of 1 members flown\n\n");
}

}  // namespace
}  // namespace twincraft
