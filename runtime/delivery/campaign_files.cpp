// See campaign_files.h.
#include "runtime/delivery/campaign_files.h"

#include <fmt/format.h>

#include <stdexcept>

#include "compiler/diag/diagnostics.h"
#include "compiler/files/output.h"
#include "runtime/delivery/campaign_shards.h"
#include "runtime/delivery/file_parts.h"
#include "runtime/delivery/report_files.h"
#include "runtime/report/campaign_csv.h"
#include "runtime/report/campaign_json.h"
#include "runtime/report/campaign_netcdf.h"
#include "runtime/report/netcdf.h"
#include "runtime/report/page/document.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kWrittenAtOnce = 1U << 18U;  // bytes

void put_csv(const CampaignTable& table, PendingFile& file) {
  const CampaignCsv csv(table);
  std::string text = csv.header();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    csv.append(row, text);
    if (text.size() < kWrittenAtOnce) continue;
    file.append(text);
    text.clear();
  }
  file.append(text);
}

/// What is kept of a member. @return as write_files
std::string copy_kept(std::size_t member, const fs::path& from, OutputFolder& to) {
  std::vector<PendingFile> copies;
  for (const std::string& name : OutputFolder::trajectory_names()) {
    const fs::path file = from / member_folder(member) / name;
    if (!fs::exists(file)) continue;
    std::string error = copy_in_parts(file, copies.emplace_back(to.of_member(member) / name));
    if (!error.empty()) return error;
    to.wrote(member, name);
  }
  return publish(copies);
}

/// @return empty, or what the library refuses
std::string put_netcdf(const CampaignReport& report, const PendingFile& file) {
  if (!file.error().empty()) return file.error();
  try {
    write_campaign_netcdf(file.temporary().string(), report.campaign.table, report.provenance);
  } catch (const std::runtime_error& failure) {
    return fmt::format("cannot write {}: {}", in_backticks(file.target().string()), failure.what());
  }
  return {};
}

}  // namespace

std::string write_campaign(const CampaignReport& report, const OutputFolder& folder) {
  const fs::path& path = folder.path();
  std::vector<PendingFile> files;
  put_csv(report.campaign.table, files.emplace_back(path / "campaign.csv"));
  if (has_netcdf())
    if (std::string error = put_netcdf(report, files.emplace_back(path / "campaign.nc"));
        !error.empty())
      return error;
  files.emplace_back(path / "report.json").append(campaign_json(report));
  files.emplace_back(path / "report.html").append(campaign_html(report));
  for (PendingFile& file : files) {
    file.finish();
    if (!file.error().empty()) return file.error();
  }
  std::string error = publish(files);
  if (error.empty()) folder.remove_leftovers();
  return error;
}

std::string save_campaign(const CampaignReport& report, const std::string& from,
                          const std::string& folder) {
  if (folder.empty()) return kNoFolder;
  if (std::string error = try_files(campaign_paths(folder)); !error.empty()) return error;
  OutputFolder saved(folder, OutputFolder::First::kApart);
  std::string error = CampaignShards(from).copy_to(CampaignShards(folder));
  for (const std::size_t member : report.kept)
    if (error.empty()) error = copy_kept(member, from, saved);
  return error.empty() ? write_campaign(report, saved) : error;
}

std::vector<std::string> campaign_paths(const std::string& folder) {
  if (folder.empty()) return {};
  std::vector<std::string> paths;
  for (const char* name : {"campaign.csv", "report.json", "report.html"})
    paths.push_back((fs::path(folder) / name).string());
  if (has_netcdf()) paths.push_back((fs::path(folder) / "campaign.nc").string());
  return paths;
}

}  // namespace twincraft
