// Writes report.html and report.json of a campaign made by hand: what tests/node looks at.
//   campaign_page FOLDER MEMBERS MISSING
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "runtime/report/campaign_json.h"
#include "runtime/report/page/document.h"
#include "tests/runtime/handmade_campaign_report.h"

int main(int count, char** words) {
  if (count != 4) return 2;
  const std::filesystem::path folder = words[1];
  std::filesystem::create_directories(folder);
  const twincraft::CampaignReport report =
      twincraft::test::campaign_report(std::stoul(words[2]), std::stoul(words[3]));
  std::ofstream(folder / "report.html") << twincraft::campaign_html(report);
  std::ofstream(folder / "report.json") << twincraft::campaign_json(report);
}
