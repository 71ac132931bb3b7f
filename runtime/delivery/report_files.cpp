// See report_files.h. Tested by tests/agreement/study_test.cpp.
#include "runtime/delivery/report_files.h"

#include <stdexcept>

#include "runtime/delivery/file_parts.h"
#include "runtime/report/json.h"
#include "runtime/report/page/document.h"

namespace twincraft {

ReportFiles::ReportFiles(const std::filesystem::path& folder)
    : members_(folder / "report.members") {}

void ReportFiles::add(const ReportedMember& member) {
  const std::string text = report_member(member, size_ == 0);
  members_.append(text);
  size_ += text.size();
}

/// @return empty, or what went wrong
std::string ReportFiles::put_json(const Report& report, const Take& take,
                                  const std::function<void(double)>& progress) const {
  if (!members_.error().empty()) return members_.error();
  const ReportFrame frame = report_frame(report);
  take(frame.before);
  std::size_t copied = 0;
  std::string error = read_in_parts(members_.temporary(), [&](std::string_view part) {
    if (progress) progress(static_cast<double>(copied) / static_cast<double>(size_));
    take(part);
    copied += part.size();
  });
  take(frame.after);
  return error;
}

std::string ReportFiles::write(const Report& report, const std::filesystem::path& folder,
                               const std::function<void(double)>& progress) const {
  std::vector<PendingFile> files;
  PendingFile& json = files.emplace_back(folder / "report.json");
  const auto append = [&json](std::string_view part) { json.append(part); };
  if (std::string error = put_json(report, append, progress); !error.empty()) return error;
  json.finish();
  if (!json.error().empty()) return json.error();
  PendingFile& page = files.emplace_back(folder / "report.html");
  page.append(report_html(report));
  page.finish();
  return page.error().empty() ? publish(files) : page.error();
}

std::string ReportFiles::json(const Report& report) const {
  std::string text;
  const auto append = [&text](std::string_view part) { text += part; };
  const std::string error = put_json(report, append, {});
  if (!error.empty()) throw std::runtime_error(error);
  return text;
}

std::vector<std::string> report_paths(const std::string& folder) {
  if (folder.empty()) return {};
  const std::filesystem::path path(folder);
  return {(path / "report.json").string(), (path / "report.html").string()};
}

std::string write_report(const Report& report, const OutputFolder& folder) {
  const std::filesystem::path path = folder.of_member(0);
  ReportFiles files(path);
  for (const ReportedMember& member : report.members) files.add(member);
  std::string error = files.write(report, path);
  if (error.empty()) folder.remove_leftovers();
  return error;
}

}  // namespace twincraft
