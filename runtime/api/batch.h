// Many spacecraft of one model by the analytic engine: side by side in SIMD lanes where the model
// lets them, on as many threads as are asked for. Which lane a member has does not depend on
// threads, so neither do its bytes. Tested by tests/api/batch_test.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/api/simulation.h"
#include "runtime/simulate/lanes_flight.h"
#include "runtime/simulate/waiting_samples.h"

namespace twincraft::api {

class Batch {
 public:
  /// @param threads  0: as many as there are cores
  Batch(std::shared_ptr<const CompiledModel> model, std::size_t count, std::size_t threads);
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  const CompiledModel& model() const { return *model_; }
  std::size_t count() const { return count_; }
  double time() const;

  /// A row per member. @pre sizes fit
  void read_states(std::span<double> rows);
  void read_outputs(std::span<double> rows);
  void read_inputs(std::span<double> rows) const;
  /// One row serves all. @throws Fault: another size, not finite; nothing has changed then
  void set_states(std::span<const double> rows);
  void drive(std::span<const double> rows);
  void release();

  void step(std::size_t count, const Poll& poll = {});

  /// Why a member has failed; empty: it has not.
  const std::string& failure(std::size_t member) const;

 private:
  /// Samples, each beside the row that it is read into.
  using WaitingRows = WaitingSamples<std::span<double>>;
  class Reading;
  /// Members that are flown together: those of the lanes, or one.
  class Group;
  class Together;
  class Alone;

  std::size_t rows_of(std::span<const double> rows, std::size_t width, const char* what) const;
  void observe_all(const std::vector<OutputSignal>& signals, std::span<double> rows);
  void step_all(std::size_t count);
  std::size_t group_of(std::size_t member) const { return member / per_group_; }

  std::shared_ptr<const CompiledModel> model_;
  std::size_t count_, threads_, per_group_ = 1;
  std::unique_ptr<bsm::Plan> plan_;  // of lanes
  std::unique_ptr<Engine> observer_;
  WaitingRows waiting_;
  std::vector<std::unique_ptr<Group>> groups_;
};

}  // namespace twincraft::api
