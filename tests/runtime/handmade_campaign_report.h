// A campaign with all that its report has, made by hand.
#pragma once

#include "runtime/report/campaign_report.h"
#include "tests/campaign/handmade_campaign.h"

namespace twincraft::test {

inline CampaignReport campaign_report(std::size_t members, std::size_t missing = 0,
                                      const RecordsHeader& header = driven_header()) {
  CampaignReport report{driven_campaign(members, missing, header), driven_plan(members), {}};
  report.findings =
      find_all(report.campaign, report.plan, std::vector<bool>(header.drawn.size(), true));
  report.verdict = members >= 400 ? Verdict::kFailed : Verdict::kDisagree;
  report.complete = missing == 0;
  report.provenance.program = "scsim 0.1.0";
  report.provenance.instructions = "AVX2";
  report.description = "A tug with one panel.";
  report.spec_file = "models/my tug.yaml";
  report.spec_sha256 = "abc";
  report.degrees_of_freedom = 8;
  report.kept = {0, 17};
  report.settings = [](std::size_t member) {
    return std::vector<std::string>{"hub.mass=" + std::to_string(600 + member),
                                    "wheels.w.speed=it's 3 rad/s"};
  };
  return report;
}

}  // namespace twincraft::test
