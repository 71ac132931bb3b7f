// See report_files.h. Tested by tests/agreement/study_test.cpp.
#include "tools/programs/report_files.h"

#include <fmt/format.h>

#include <fstream>
#include <utility>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "runtime/report/json.h"
#include "runtime/report/page/document.h"

namespace twincraft {

ReportFiles::ReportFiles(std::filesystem::path folder)
    : folder_(std::move(folder)), members_(folder_ / "report.members") {}

void ReportFiles::add(const ReportedMember& member) {
  const std::string text = report_member(member, size_ == 0);
  members_.append(text);
  size_ += text.size();
}

std::string ReportFiles::copy_members(PendingFile& to,
                                      const std::function<void(double)>& progress) {
  std::ifstream from(members_.temporary(), std::ios::binary);
  std::vector<char> part(1U << 20U);
  std::size_t copied = 0;
  while (from) {
    if (progress) progress(static_cast<double>(copied) / static_cast<double>(size_));
    from.read(part.data(), static_cast<std::streamsize>(part.size()));
    to.append({part.data(), static_cast<std::size_t>(from.gcount())});
    copied += static_cast<std::size_t>(from.gcount());
  }
  if (from.eof()) return {};
  return fmt::format("cannot read {}", in_backticks(members_.temporary().string()));
}

std::string ReportFiles::write(const Report& report, const std::function<void(double)>& progress) {
  if (!members_.error().empty()) return members_.error();
  const ReportFrame frame = report_frame(report);
  std::vector<PendingFile> files;
  PendingFile& json = files.emplace_back(folder_ / "report.json");
  json.append(frame.before);
  if (std::string error = copy_members(json, progress); !error.empty()) return error;
  json.append(frame.after);
  json.finish();
  if (!json.error().empty()) return json.error();
  PendingFile& page = files.emplace_back(folder_ / "report.html");
  page.append(report_html(report));
  page.finish();
  return page.error().empty() ? publish(files) : page.error();
}

}  // namespace twincraft
