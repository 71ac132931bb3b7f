// The handle of what a program of ours would have said, and how all of them are made: work that a
// poll may end.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/api/handles.h"
#include "runtime/delivery/campaign_run.h"
#include "runtime/delivery/scratch_folder.h"
#include "runtime/delivery/spec_run.h"

namespace twincraft::api {

/// A campaign that was flown, or a shard of one, and the folder that has its files.
struct FlownCampaign {
  std::unique_ptr<ScratchFolder> scratch;  // null: the folder is the caller's
  std::filesystem::path folder;
  Shard shard;
  CampaignResult result;
  std::string header, csv, records;  // as they were asked for
};

/// The files of `scsim -o folder`. @return as write_files
std::string save_campaign(const FlownCampaign& flown, const std::string& folder);

/// @return as many threads as `wanted`, or as there are cores for 0
int jobs_of(int wanted);

[[noreturn]] inline void end_interrupted() { throw Fault(TC_INTERRUPTED, "interrupted"); }

/// Do `work(stop)`, which ends early when `stop` becomes true, and meanwhile ask the poll: from
/// this thread, which called the library.
template <class Options, class Work>
void attend(const Options& wanted, const Work& work) {
  check_struct(&wanted);
  std::atomic<bool> stop = false;
  if (wanted.poll == nullptr) return work(stop);
  std::future<void> done = std::async(std::launch::async, [&] { work(stop); });
  while (done.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
    if (!stop && wanted.poll(wanted.context) != 0) stop = true;
  done.get();
}

}  // namespace twincraft::api

/// A run, a campaign, a proof or an attribution, and the texts that were asked for.
struct tc_run {
  std::shared_ptr<const twincraft::api::CompiledModel> model;
  std::optional<twincraft::SpecRun> run;
  std::optional<twincraft::api::FlownCampaign> campaign;
  std::string verdict, text, json;
  bool passes = false;
  twincraft::api::HandleParts parts;

  bool is_whole() const { return !verdict.empty(); }
};

namespace twincraft::api {

/// A handle that `body` fills.
template <class Body>
tc_status make_run(const tc_model* model, tc_run** run, const Body& body) noexcept {
  if (model == nullptr || !model->is_whole() || run == nullptr) return TC_USAGE;
  *run = new (std::nothrow) tc_run;
  if (*run == nullptr) return TC_MEMORY;
  tc_run& handle = **run;
  handle.model = model->model;
  return attempt(handle.parts.error, [&] { body(handle); });
}

}  // namespace twincraft::api
