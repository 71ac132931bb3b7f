// See document.h: fills the places of page.html. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/page/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "runtime/report/attribution_table.h"
#include "runtime/report/campaign_table.h"
#include "runtime/report/judgement.h"
#include "runtime/report/page/assets.h"
#include "runtime/report/page/base64.h"
#include "runtime/report/page/campaign_data.h"
#include "runtime/report/page/page_data.h"
#include "runtime/report/study_table.h"
#include "runtime/report/table.h"

namespace twincraft {
namespace {

using Places = std::map<std::string, std::string, std::less<>>;

/// Without the note at the end that leads developer tools to a file that is not there.
std::string_view without_source_map(std::string_view text) {
  constexpr std::size_t kLongest = 200;  // bytes; what is before them is not looked at
  const std::size_t end = text.size() - std::min(text.size(), kLongest);
  for (const std::string_view mark : {"//# sourceMappingURL=", "/*# sourceMappingURL="})
    text = text.substr(0, text.find(mark, end));
  return text;
}

/// Files in one scope of their own.
std::string our_script(std::string_view files) {
  return fmt::format("(() => {{\n\"use strict\";\n{}}})();\n", files);
}

class Policy {
 public:
  std::string script(std::string_view text) {
    scripts_ += fmt::format(" '{}'", csp_hash(text));
    return fmt::format("<script>{}</script>", text);
  }
  std::string style(std::string_view text) {
    styles_ += fmt::format(" '{}'", csp_hash(text));
    return fmt::format("<style>{}</style>", text);
  }
  std::string text() const {
    return fmt::format(
        "default-src 'none'; script-src{}; style-src{}; img-src data:; base-uri 'none'; "
        "form-action 'none'",
        scripts_, styles_);
  }

 private:
  std::string scripts_, styles_;
};

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

std::string verdict_words(const Report& report) {
  switch (report.verdict()) {
    case Verdict::kAgree:
      return capitalised(held_words(report)) + (report.study ? " in every member" : "");
    case Verdict::kDisagree:
      return capitalised(exceeded_words(report.summary()->exceeded()));
    case Verdict::kUnresolved:
      return report.study ? "Members are not resolved"
                          : "The run does not resolve the vehicle's motion";
    case Verdict::kFailed:
      return report.study ? "Members failed" : "The run failed";
    case Verdict::kInterrupted:
      return "Interrupted";
    case Verdict::kNotJudged:
      break;
  }
  return "Not judged";
}

/// As the terminal shows it.
std::string plain_text(const Report& report) {
  if (report.attribution) return attribution_table(report, false);
  return report.study ? study_table(report, false) : report_table(report.members.front(), false);
}

/// Each `@PLACE@` once, so that nothing that is filled in is looked at again.
std::string filled(std::string_view page, const Places& places) {
  std::string text;
  while (true) {
    const std::size_t begin = page.find('@');
    text += page.substr(0, begin);
    if (begin == std::string_view::npos) return text;
    const std::size_t end = page.find('@', begin + 1);
    const auto place = places.find(page.substr(begin + 1, end - begin - 1));
    if (place == places.end()) throw std::logic_error("page.html has an unknown place");
    text += place->second;
    page.remove_prefix(end + 1);
  }
}

/// Of the libraries in a page.
std::string licences() {
  return filled(assets::licences(), {{"DYGRAPHS_LICENCE", html_escaped(assets::dygraphs_licence())},
                                     {"THREE_LICENCE", html_escaped(assets::three_licence())}});
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '&':
        escaped += "&amp;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string report_html(const Report& report) {
  const ReportedMember& first = report.members.front();
  Policy policy;
  Places places;
  places["STYLES"] =
      policy.style(without_source_map(assets::dygraphs_style())) + policy.style(assets::style());
  places["SCRIPTS"] = policy.script(without_source_map(assets::dygraphs())) + "\n" +
                      policy.script(without_source_map(assets::three())) + "\n" +
                      policy.script(assets::orbit_controls()) + "\n" +
                      policy.script(our_script(assets::script()));
  places["POLICY"] = policy.text();
  places["NAME"] = html_escaped(first.bundle.model.name);
  places["DESCRIPTION"] = html_escaped(first.bundle.model.description);
  places["VERDICT"] = html_escaped(verdict_words(report));
  places["VERDICT_KEY"] = verdict_name(report.verdict());
  places["PLAIN"] = html_escaped(plain_text(report));
  places["LICENCES"] = licences();
  places["DATA"] = page_data(report);
  return filled(assets::page(), places);
}

std::string campaign_html(const CampaignReport& report) {
  Policy policy;
  Places places;
  places["STYLES"] = policy.style(assets::style());
  places["SCRIPTS"] = policy.script(our_script(assets::campaign_script()));
  places["POLICY"] = policy.text();
  places["NAME"] = html_escaped(report.campaign.table.header().name);
  places["DESCRIPTION"] = html_escaped(report.description);
  places["VERDICT"] = html_escaped(verdict_words(report));
  places["VERDICT_KEY"] = verdict_name(report.verdict);
  places["PLAIN"] = html_escaped(campaign_table(report));
  places["LICENCES"] = "";
  places["DATA"] = campaign_page_data(report);
  return filled(assets::page(), places);
}

}  // namespace twincraft
