// See run_campaign.h.
#include "runtime/campaign/run_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>
#include <utility>

#include "runtime/bsm/kernel.h"
#include "runtime/campaign/reductions.h"
#include "runtime/linear/screen.h"
#include "runtime/simulate/fleet.h"
#include "runtime/study/in_order.h"

namespace twincraft {
namespace {

using Clock = std::chrono::steady_clock;

void add_reason(std::string& reason, const std::string& further) {
  if (further.empty()) return;
  if (!reason.empty()) reason += "; ";
  reason += further;
}

/// Why the step does not resolve a member that flew to its end; empty: it does.
std::string unresolved_words(const Member& member) {
  std::string words;
  if (!member.failed() && member.resolution)
    for (const std::string& reason : member.resolution->reasons) add_reason(words, reason);
  return words;
}

/// A member on its way to its record.
class Flyer {
 public:
  Flyer(const CampaignPlan& plan, Bundle bundle)
      : bundle_(std::move(bundle)),
        outputs_(bundle_.model, plan.outputs),
        watch_(bundle_.model, plan.stops),
        screen_(bundle_.model) {}

  const Bundle& bundle() const { return bundle_; }

  FleetMember in_fleet() {
    return {&bundle_, [this](const Observation& sample) {
              outputs_.take(sample);
              screen_.see(sample);
              stopped_ = watch_.reason(sample);
              return stopped_.empty();
            }};
  }

  void fill(const FleetEnd& end, std::span<const OutputColumn> columns, MemberRecord& record) {
    if (!end.failure.empty()) {
      record.verdict = Verdict::kFailed;
      record.reason = end.failure;
      return;
    }
    record.outputs = outputs_.results();
    record.reason = stopped_;
    add_reason(record.reason, broken_requirements(columns, record.outputs));
    last_ = end.last;
    accepted_ = end.accepted;
  }

  /// Whether its step is short enough to be seen without a judgement. @pre it has flown
  bool is_surely_resolved() const { return screen_.passes(last_, accepted_); }

 private:
  Bundle bundle_;
  OutputReducer outputs_;
  StopWatch watch_;
  ResolutionScreen screen_;
  Observation last_;
  AcceptedErrors accepted_;
  std::string stopped_;
};

/// Members that one thread flies at a time.
class Squad {
 public:
  Squad(const CampaignRun& run, const RunOptions& options, std::vector<OutputColumn> columns)
      : run_(run), options_(options), columns_(std::move(columns)) {}

  /// Without those that a stop has interrupted.
  std::vector<MemberRecord> fly(std::span<const std::size_t> members) const {
    const Clock::time_point start = Clock::now();
    std::vector<MemberRecord> records;
    std::vector<std::unique_ptr<Flyer>> flyers;  // null: the record says why
    for (const std::size_t member : members) {
      MemberRecord& record = records.emplace_back(empty_record(member));
      flyers.push_back(begin(member, record));
    }
    const std::vector<std::size_t> interrupted = fly_together(flyers, records);
    const std::chrono::duration<double> spent = Clock::now() - start;
    for (MemberRecord& record : records)
      record.seconds = spent.count() / static_cast<double>(members.size());
    std::vector<MemberRecord> finished;
    for (std::size_t i = 0; i < records.size(); ++i)
      if (!std::ranges::binary_search(interrupted, i) && judge(flyers[i].get(), records[i]))
        finished.push_back(std::move(records[i]));
    return finished;
  }

 private:
  MemberRecord empty_record(std::size_t member) const {
    MemberRecord record;
    record.member = member;
    record.drawn = run_.drawn(member);
    record.outputs.resize(columns_.size());
    return record;
  }

  std::unique_ptr<Flyer> begin(std::size_t member, MemberRecord& record) const {
    MemberSpec spec = run_.compile(member, false);
    if (spec.bundle) return std::make_unique<Flyer>(run_.plan, std::move(*spec.bundle));
    record.verdict = Verdict::kFailed;
    record.reason = spec.refusal;
    return nullptr;
  }

  /// @return places of those that were interrupted
  std::vector<std::size_t> fly_together(const std::vector<std::unique_ptr<Flyer>>& flyers,
                                        std::vector<MemberRecord>& records) const {
    std::vector<FleetMember> fleet;
    std::vector<std::size_t> places, interrupted;
    for (std::size_t i = 0; i < flyers.size(); ++i) {
      if (!flyers[i]) continue;
      fleet.push_back(flyers[i]->in_fleet());
      places.push_back(i);
    }
    const std::vector<FleetEnd> ends = fly_fleet(fleet, {options_.stop, options_.instructions.set});
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (ends[k].is_interrupted)
        interrupted.push_back(places[k]);
      else
        flyers[places[k]]->fill(ends[k], columns_, records[places[k]]);
    }
    return interrupted;
  }

  /// In both engines, or in the one that flew it where its step may be too long.
  /// @return false: it was interrupted
  bool judge(const Flyer* flyer, MemberRecord& record) const {
    if (record.verdict == Verdict::kFailed) return true;
    const Clock::time_point start = Clock::now();
    bool is_done = true;
    if (run_.is_twin(record.member))
      is_done = judge_twin(record);
    else if (!flyer->is_surely_resolved())
      is_done = judge_resolution_of(flyer->bundle(), record);
    record.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    return is_done;
  }

  bool judge_twin(MemberRecord& record) const {
    MemberSpec spec = run_.compile(record.member, true);
    if (!spec.bundle) {
      add_reason(record.reason, "not flown by both engines: " + spec.refusal);
      return true;
    }
    const TwinFinding found = twin_finding(run_member(*spec.bundle, options_));
    if (found.verdict == Verdict::kInterrupted) return false;
    record.twin = record.verdict = found.verdict;
    add_reason(record.reason, found.reason);
    return true;
  }

  bool judge_resolution_of(const Bundle& bundle, MemberRecord& record) const {
    RunOptions alone = options_;
    alone.mujoco = false;
    const Member member = run_member(bundle, alone);
    if (member.interrupted()) return false;
    if (member.unresolved()) record.verdict = Verdict::kUnresolved;
    add_reason(record.reason, unresolved_words(member));
    return true;
  }

  const CampaignRun& run_;
  const RunOptions& options_;
  std::vector<OutputColumn> columns_;
};

std::vector<OutputColumn> columns_of(const CampaignPlan& plan) {
  std::vector<OutputColumn> columns;
  for (const OutputPlan& output : plan.outputs) columns.push_back(column_of(output));
  return columns;
}

RunOptions of_a_member(RunOptions options) {
  options.trials = 0;
  options.keep_samples = false;
  options.progress = nullptr;
  return options;
}

}  // namespace

TwinFinding twin_finding(const Member& member) {
  TwinFinding found{member.verdict(), {}};
  for (const EngineRun& engine : member.engines) add_reason(found.reason, engine.reason);
  add_reason(found.reason, unresolved_words(member));
  for (const JudgedFigure& figure : member.exceeded())
    add_reason(found.reason, fmt::format("{} {:.3g} exceeds {:.3g}", figure.key, figure.maximum,
                                         figure.tolerance));
  return found;
}

void run_campaign(const CampaignRun& run, const RunOptions& options) {
  const RunOptions of_member = of_a_member(options);
  const Squad squad(run, of_member, columns_of(run.plan));
  const std::size_t size = 2 * bsm::batch_lanes(options.instructions.set);
  const std::span<const std::size_t> members(run.members);
  options.show("members", 0.0);
  const Clock::time_point start = Clock::now();
  std::size_t done = 0;
  OrderedWork<std::vector<MemberRecord>> plan;
  plan.count = (members.size() + size - 1) / size;
  plan.work = [&](std::size_t i) {
    return squad.fly(members.subspan(i * size, std::min(size, members.size() - i * size)));
  };
  plan.deliver = [&](std::vector<MemberRecord> records) {
    done += records.size();
    for (MemberRecord& record : records) run.finished(std::move(record));
    const std::chrono::duration<double> spent = Clock::now() - start;
    options.show(fmt::format("members  {} of {}, {:.3g}/s", done, members.size(),
                             static_cast<double>(done) / spent.count()),
                 static_cast<double>(done) / static_cast<double>(members.size()));
  };
  plan.may_go_on = [&] { return !options.stopped() && !(run.enough && run.enough()); };
  in_order(plan, run.jobs);
}

}  // namespace twincraft
