// report.html: one file that opens from a disk, needs no network and shows what a run has to say.
// Everything in it that came from a spec is data: escaped where it is HTML, text where a script
// shows it; and the page's policy lets no other script or style run than ours, by their hashes.
// Tested by tests/runtime/html_test.cpp and, in a browser, by tests/browser.
#pragma once

#include <string>
#include <string_view>

#include "runtime/report/campaign_report.h"
#include "runtime/study/results.h"

namespace twincraft {

/// @pre report.members.front() still has its samples and texts
std::string report_html(const Report& report);

/// The same of a campaign, without a replay: it needs no library.
std::string campaign_html(const CampaignReport& report);

/// `<`, `>`, `&` and quotes as entities.
std::string html_escaped(std::string_view text);

}  // namespace twincraft
