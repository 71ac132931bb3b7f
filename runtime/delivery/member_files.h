// What a member leaves in its folder, written while it is flown: trajectories as CSV and netCDF;
// and for the page what it draws.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "compiler/files/output.h"
#include "runtime/delivery/output_folder.h"
#include "runtime/report/csv.h"
#include "runtime/report/netcdf.h"
#include "runtime/report/page/page_series.h"
#include "runtime/study/run_study.h"

namespace twincraft {

struct MemberFilesPlan {
  std::size_t member = 0;  // the page draws the first
  bool netcdf = false;
};

/// What the files of all members share. Written by publish() alone.
struct SharedOutput {
  OutputFolder folder;
  std::string error = {};  // what went wrong first, after which nothing is published
};

class MemberFiles : public MemberOutput {
 public:
  MemberFiles(const Bundle& bundle, MemberFilesPlan plan, const Provenance& provenance,
              SharedOutput& shared);

  void take(std::size_t engine, const Observation& sample, const Books& books) override;
  void take_pair(const Observation& bsm, const Observation& mujoco,
                 std::span<const double> metrics) override;
  void land() override;
  void publish(ReportedMember& member) override;

 private:
  /// The files of one engine, begun with its first sample.
  class OfEngine {
   public:
    OfEngine(const Bundle& bundle, const std::filesystem::path& folder, bool netcdf,
             const Provenance& provenance, const std::string& engine);
    void take(const Observation& sample);
    void finish();
    /// Empty, or what went wrong first.
    std::string error() const;
    void hand_over(std::vector<PendingFile>& files);

   private:
    void write_netcdf(const std::function<void()>& work);

    CsvLines lines_;
    std::string text_;  // not yet in the file
    PendingFile csv_;
    std::unique_ptr<PendingFile> nc_file_;
    std::unique_ptr<NetcdfFile> nc_;
    std::string nc_error_;
  };

  const Bundle& bundle_;
  MemberFilesPlan plan_;
  const Provenance& provenance_;
  SharedOutput& shared_;
  std::filesystem::path folder_;
  std::array<std::unique_ptr<OfEngine>, 2> engines_;
  std::shared_ptr<PageSeries> series_;
};

}  // namespace twincraft
