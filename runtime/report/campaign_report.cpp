#include "runtime/report/campaign_report.h"

#include <fmt/format.h>

namespace twincraft {
namespace {

/// A word as a POSIX shell takes it for itself.
std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=:,+-@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) c == '\'' ? (word += "'\\''") : (word += c);
  return word + "'";
}

std::size_t count_of(const CampaignTable& table, Verdict verdict) {
  std::size_t count = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) count += table.verdict(row) == verdict;
  return count;
}

std::string members_words(const CampaignReport& report, Verdict verdict, std::string_view one,
                          std::string_view several) {
  const std::size_t count = count_of(report.campaign.table, verdict);
  return fmt::format("{} of {} members {}", count, report.campaign.members,
                     count == 1 ? one : several);
}

std::string twin_words(const TwinCount& twins) {
  const std::size_t judged = twins.agree + twins.disagree;
  if (judged == 0) return "Not judged";
  if (twins.disagree > 0)
    return fmt::format("The engines disagree in {} of {} members that both flew", twins.disagree,
                       judged);
  if (judged == 1) return "The engines agree in the one member that both flew";
  return fmt::format("The engines agree in all {} members that both flew", judged);
}

}  // namespace

std::string member_folder(std::size_t member) { return fmt::format("{:04}", member); }

std::string reproducing_command(const CampaignReport& report, std::size_t member) {
  if (!report.settings) return {};
  std::string command = "scsim " + shell_word(report.spec_file);
  for (const std::string& setting : report.settings(member))
    command += " --set " + shell_word(setting);
  return command;
}

std::string_view sampling_name(Sampling sampling) {
  switch (sampling) {
    case Sampling::kRandom:
      return "random";
    case Sampling::kLatinHypercube:
      return "latin_hypercube";
    case Sampling::kSobol:
      break;
  }
  return "sobol";
}

std::string verdict_words(const CampaignReport& report) {
  switch (report.verdict) {
    case Verdict::kFailed:
      return members_words(report, Verdict::kFailed, "failed", "failed");
    case Verdict::kUnresolved:
      return members_words(report, Verdict::kUnresolved, "is not resolved", "are not resolved");
    case Verdict::kInterrupted:
      return "Interrupted";
    case Verdict::kAgree:
    case Verdict::kDisagree:
    case Verdict::kNotJudged:
      break;
  }
  return twin_words(report.findings.twins.count);
}

}  // namespace twincraft
