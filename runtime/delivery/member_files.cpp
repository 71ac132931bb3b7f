// See member_files.h. Tested by tests/agreement/scsim_test.cpp.
#include "runtime/delivery/member_files.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "compiler/diag/diagnostics.h"

namespace twincraft {
namespace {

constexpr std::size_t kWrittenAtOnce = 1U << 18U;  // bytes of CSV

}  // namespace

MemberFiles::OfEngine::OfEngine(const Bundle& bundle, const std::filesystem::path& folder,
                                bool netcdf, const Provenance& provenance,
                                const std::string& engine)
    : lines_(bundle.model), text_(lines_.header()), csv_(folder / (engine + ".csv")) {
  if (!netcdf) return;
  nc_file_ = std::make_unique<PendingFile>(folder / (engine + ".nc"));
  if (!nc_file_->error().empty()) return;
  write_netcdf([&] {
    nc_ = std::make_unique<NetcdfFile>(nc_file_->temporary().string(), bundle, engine, provenance);
  });
}

/// What the library refuses costs the file, not the run.
void MemberFiles::OfEngine::write_netcdf(const std::function<void()>& work) {
  if (!nc_error_.empty()) return;
  try {
    work();
  } catch (const std::runtime_error& failure) {
    nc_error_ = fmt::format("cannot write {}: {}", in_backticks(nc_file_->target().string()),
                            failure.what());
    nc_.reset();
  }
}

void MemberFiles::OfEngine::take(const Observation& sample) {
  lines_.append(sample, text_);
  if (text_.size() >= kWrittenAtOnce) {
    csv_.append(text_);
    text_.clear();
  }
  if (nc_) write_netcdf([&] { nc_->take(sample); });
}

void MemberFiles::OfEngine::finish() {
  csv_.append(text_);
  text_ = {};
  csv_.finish();
  if (nc_) write_netcdf([&] { nc_->close(); });
  nc_.reset();
  if (nc_file_) nc_file_->finish();
}

std::string MemberFiles::OfEngine::error() const {
  if (!csv_.error().empty()) return csv_.error();
  if (nc_file_ && !nc_file_->error().empty()) return nc_file_->error();
  return nc_error_;
}

void MemberFiles::OfEngine::hand_over(std::vector<PendingFile>& files) {
  files.push_back(std::move(csv_));
  if (nc_file_) files.push_back(std::move(*nc_file_));
}

MemberFiles::MemberFiles(const Bundle& bundle, MemberFilesPlan plan, const Provenance& provenance,
                         SharedOutput& shared)
    : bundle_(bundle),
      plan_(plan),
      provenance_(provenance),
      shared_(shared),
      folder_(shared.folder.of_member(plan.member)) {
  if (plan.member == 0) series_ = std::make_shared<PageSeries>(bundle.model);
}

void MemberFiles::take(std::size_t engine, const Observation& sample, const Books& books) {
  std::unique_ptr<OfEngine>& files = engines_.at(engine);
  if (!files)
    files = std::make_unique<OfEngine>(bundle_, folder_, plan_.netcdf, provenance_,
                                       std::string(kEngines.at(engine).key));
  files->take(sample);
  if (series_) series_->take(engine, sample, books);
}

void MemberFiles::take_pair(const Observation& bsm, const Observation& mujoco,
                            std::span<const double> metrics) {
  if (series_) series_->take_pair(bsm, mujoco, metrics);
}

void MemberFiles::land() {
  for (const std::unique_ptr<OfEngine>& files : engines_)
    if (files) files->finish();
}

void MemberFiles::publish(ReportedMember& member) {
  member.series = std::move(series_);
  std::vector<PendingFile> pending;
  for (const std::unique_ptr<OfEngine>& files : engines_) {
    if (!files) continue;
    if (shared_.error.empty()) shared_.error = files->error();
    files->hand_over(pending);
  }
  if (!shared_.error.empty()) return;
  shared_.error = twincraft::publish(pending);
  for (const PendingFile& file : pending)
    shared_.folder.wrote(plan_.member, file.target().filename().string());
}

}  // namespace twincraft
