// The files a report is made of, as they were when the program was built.
#pragma once

#include <string_view>

namespace twincraft::assets {

std::string_view page();      // with @PLACES@ for the rest
std::string_view style();     // ours
std::string_view licences();  // of the libraries below, with @PLACES@ too
// Ours, all files in one: of a run or a study, and of a campaign.
std::string_view script();
std::string_view campaign_script();

// Debian's builds of well-known libraries, and the terms they come under.
std::string_view dygraphs();
std::string_view dygraphs_style();
std::string_view dygraphs_licence();
std::string_view three();
std::string_view orbit_controls();
std::string_view three_licence();

}  // namespace twincraft::assets
