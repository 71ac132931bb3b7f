// Twincraft in C++17: a spec becomes a Model, and a Model flies as a Simulation (one engine), a
// Twin (both, in lock step), a Batch (many), or as the Run of `scsim`. Header-only over
// twincraft.h, the stable interface; needs nothing but the standard library.
//
//   const auto model = twincraft::Model::load("models/quickstart.yaml");
//   twincraft::Simulation sim(model);
//   sim.drive("rw_x.torque", 0.01);
//   sim.run_until(60.0);
//   const std::vector<double> y = sim.observe();
//
// Numbers are SI and radians; names are those of the CSV's columns. What can go wrong is an
// exception derived from Error; the object is then as it was before. A Model may be shared by
// threads; every other object serves one thread at a time and refuses a second with BusyError.
#ifndef TWINCRAFT_SIMULATION_H
#define TWINCRAFT_SIMULATION_H

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../twincraft.h"

namespace twincraft {

/// What went wrong, in the words that the programs print.
class Error : public std::runtime_error {
 public:
  Error(tc_status status, const std::string& what) : std::runtime_error(what), status_(status) {}
  tc_status status() const { return status_; }

 private:
  tc_status status_;
};

/// The spec has errors: where, what, why.
class SpecError : public Error {
 public:
  SpecError(const std::string& what, std::string diagnostics)
      : Error(TC_SPEC, what), diagnostics_(std::move(diagnostics)) {}
  /// The document of `--diagnostics json`.
  const std::string& diagnostics() const { return diagnostics_; }

 private:
  std::string diagnostics_;
};

/// An unknown name, a value that is not finite or of another size or unit, a time that is over.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& what) : Error(TC_USAGE, what) {}
};

/// A file cannot be read or written.
class FileError : public Error {
 public:
  explicit FileError(const std::string& what) : Error(TC_FILE, what) {}
};

/// The motion is no longer finite. The simulation stands at its last good step end.
class NumericalFailure : public Error {
 public:
  NumericalFailure(const std::string& what, double time, std::string coordinate)
      : Error(TC_NUMERICAL, what), time_(time), coordinate_(std::move(coordinate)) {}
  double time() const { return time_; }  // [s] of that step end
  const std::string& coordinate() const { return coordinate_; }

 private:
  double time_;
  std::string coordinate_;
};

/// Bytes of another vehicle, engine or version, or damaged.
class SnapshotError : public Error {
 public:
  explicit SnapshotError(const std::string& what) : Error(TC_SNAPSHOT, what) {}
};

/// In use by another thread.
class BusyError : public Error {
 public:
  BusyError() : Error(TC_BUSY, "it is in use by another thread") {}
};

/// A poll said so. Everything is usable.
class Interrupted : public Error {
 public:
  Interrupted() : Error(TC_INTERRUPTED, "interrupted") {}
};

enum class Engine { bsm = TC_BSM, mujoco = TC_MUJOCO };
enum class Engines { both = TC_BOTH, bsm = TC_BSM_ALONE, mujoco = TC_MUJOCO_ALONE };

/// Its word in specs, flags, files and reports: `bsm`, `mujoco`.
inline const char* name_of(Engine engine) { return tc_engine_name(static_cast<tc_engine>(engine)); }

namespace detail {

/// @param failure  fills in time and coordinate of a numerical failure
template <class Failure>
void check(tc_status status, const char* error, const Failure& failure) {
  switch (status) {
    case TC_OK:
      return;
    case TC_USAGE:
      throw UsageError(error);
    case TC_FILE:
      throw FileError(error);
    case TC_NUMERICAL: {
      double time = 0.0;
      const char* coordinate = "";
      failure(&time, &coordinate);
      throw NumericalFailure(error, time, coordinate);
    }
    case TC_SNAPSHOT:
      throw SnapshotError(error);
    case TC_BUSY:
      throw BusyError();
    case TC_MEMORY:
      throw std::bad_alloc();
    case TC_INTERRUPTED:
      throw Interrupted();
    default:
      throw Error(status, error);
  }
}
inline void check(tc_status status, const char* error) {
  check(status, error, [](double*, const char**) {});
}

template <class Handle, void (*free)(Handle*)>
struct Freed {
  void operator()(Handle* handle) const { free(handle); }
};
template <class Handle, void (*free)(Handle*)>
using Owned = std::unique_ptr<Handle, Freed<Handle, free>>;

/// A control whose callbacks are function objects; what they throw waits in `thrown`.
struct Callbacks {
  std::function<void(double)> controller;
  std::function<bool(double)> stop;
  std::exception_ptr thrown;

  tc_control control(double every) {
    tc_control c{};
    c.size = sizeof c;
    c.every = every;
    c.context = this;
    if (controller)
      c.controller = [](void* self, double time, const double*, double*) {
        Callbacks& callbacks = *static_cast<Callbacks*>(self);
        try {
          callbacks.controller(time);
          return 0;
        } catch (...) {
          callbacks.thrown = std::current_exception();
          return 1;
        }
      };
    if (stop)
      c.stop = [](void* self, double time, const double*) {
        Callbacks& callbacks = *static_cast<Callbacks*>(self);
        try {
          return callbacks.stop(time) ? 1 : 0;
        } catch (...) {
          callbacks.thrown = std::current_exception();
          return 1;
        }
      };
    return c;
  }
  void rethrow() {
    if (thrown) std::rethrow_exception(thrown);
  }
};

template <class Snapshot>
std::vector<std::uint8_t> bytes_of(const Snapshot& snapshot) {
  std::size_t size = 0;
  snapshot(nullptr, 0, &size);
  std::vector<std::uint8_t> bytes(size);
  snapshot(bytes.data(), bytes.size(), &size);
  return bytes;
}

}  // namespace detail

/// The numbers of a name: one, or those of a vector, which stand together.
struct Range {
  std::size_t first = 0, count = 1;
};

struct Signal {
  std::string name, unit, meaning;
};

struct MassProperties {
  double mass = 0.0;              // [kg]
  double center_of_mass[3] = {};  // [m] from B, B axes
  double inertia[9] = {};         // [kg m2] about the centre of mass, B axes, by rows
};

struct RunOptions {
  Engines engines = Engines::both;
  int trials = 0;  // timed trials per engine; 0: no timing
  int jobs = 0;    // members of a study at a time; 0: all cores
  tc_poll poll = nullptr;
  void* context = nullptr;
};

/// What a program of ours would have said: of scsim, of `sccompile --check`, of `scsim attribute`.
class Run {
 public:
  std::string verdict() const { return tc_run_verdict(handle()); }
  /// The program would end with 0.
  bool passes() const { return tc_run_passes(handle()) != 0; }
  explicit operator bool() const { return passes(); }
  const char* json() const { return tc_run_json(handle()); }
  const char* text() const { return tc_run_text(handle()); }
  /// Of an engine; 0: it did not fly.
  std::size_t samples(Engine engine) const {
    return tc_run_samples(handle(), static_cast<tc_engine>(engine));
  }
  /// Rows of time and outputs. @pre rows has room for samples() times 1 + outputs
  void read(Engine engine, double* rows, std::size_t size) const {
    check(tc_run_read(handle(), static_cast<tc_engine>(engine), rows, size));
  }
  /// Write the files of `scsim -o folder`. @throws FileError
  void save(const std::string& folder) const { check(tc_run_save(handle(), folder.c_str())); }

 protected:
  friend class Model;
  explicit Run(tc_run* run) : run_(run) {}
  tc_run* handle() const { return run_.get(); }
  void check(tc_status status) const { detail::check(status, tc_run_error(handle())); }

 private:
  detail::Owned<tc_run, tc_run_free> run_;
};

enum class Twins { planned = TC_TWINS_PLANNED, all = TC_TWINS_ALL, none = TC_TWINS_NONE };

struct CampaignOptions {
  Twins twins = Twins::planned;       // members that both engines fly
  int jobs = 0;                       // members at a time; 0: all cores
  std::string isa = "auto";           // as --isa
  std::string folder;                 // files are written here; empty: nowhere
  std::size_t shard = 0, shards = 0;  // fly part 1 to `shards` alone; 0: all
  bool resume = false;                // keep the members that `folder` has
  std::vector<std::string> records;   // of shards that were flown elsewhere
  tc_poll poll = nullptr;
  void* context = nullptr;
};

/// A campaign as scsim flies it, or a shard of one, which has records alone.
class Campaign : public Run {
 public:
  std::size_t rows() const { return tc_campaign_rows(handle()); }
  /// Names and units of the drawn numbers, the outputs and `seconds`.
  std::vector<Signal> columns() const {
    std::vector<Signal> all;
    for (std::size_t i = 0; i < tc_campaign_columns(handle()); ++i)
      all.push_back(
          {tc_campaign_column_name(handle(), i), tc_campaign_column_unit(handle(), i), ""});
    return all;
  }
  /// @pre values has room for rows() numbers
  void read(std::size_t column, double* values, std::size_t size) const {
    check(tc_campaign_read(handle(), column, values, size));
  }
  struct Row {
    std::size_t member = 0;
    std::string verdict, reason;
  };
  Row row(std::size_t index) const {
    std::size_t member = 0;
    const char *verdict = "", *reason = "";
    check(tc_campaign_row(handle(), index, &member, &verdict, &reason));
    return {member, verdict, reason};
  }
  /// Members, worst first. @param by  an output; empty: as the campaign keeps members
  std::vector<std::size_t> worst(std::size_t most, const std::string& by = "") const {
    std::vector<std::size_t> members(most);
    std::size_t count = 0;
    check(tc_campaign_worst(handle(), by.empty() ? nullptr : by.c_str(), members.data(), most,
                            &count));
    members.resize(count);
    return members;
  }
  std::string text(tc_campaign_texts which) const {
    std::size_t length = 0;
    const char* text = tc_campaign_text(handle(), which, &length);
    return {text, length};
  }
  using Run::text;
  int exit_code() const { return tc_campaign_exit_code(handle()); }

 private:
  friend class Model;
  using Run::Run;
};

/// A compiled spec. Copies share it.
class Model {
 public:
  /// @param set  `PATH=VALUE`, as the programs' --set @throws SpecError, UsageError, FileError
  static Model load(const std::string& path, const std::vector<std::string>& set = {}) {
    return made(set, "", [&](const tc_load_options* options, tc_model** model) {
      return tc_model_load(path.c_str(), options, model);
    });
  }
  /// @param name  what diagnostics call the text
  static Model loads(const std::string& text, const std::vector<std::string>& set = {},
                     const std::string& name = "<string>") {
    return made(set, name, [&](const tc_load_options* options, tc_model** model) {
      return tc_model_loads(text.data(), text.size(), options, model);
    });
  }

  std::string name() const { return tc_model_text(handle(), TC_NAME, nullptr); }
  /// SHA-256 of resolved(): whoever has the same has the same vehicle.
  std::string digest() const { return tc_model_text(handle(), TC_DIGEST, nullptr); }
  std::string text(tc_text which) const {
    std::size_t length = 0;
    const char* text = tc_model_text(handle(), which, &length);
    return {text, length};
  }
  std::string mjcf() const { return text(TC_MJCF); }
  std::string resolved() const { return text(TC_RESOLVED); }
  /// The compiler's warnings, as the document of `--diagnostics json`.
  std::string diagnostics() const { return tc_model_diagnostics(handle()); }

  std::vector<Signal> inputs() const { return signals(TC_INPUTS); }
  std::vector<Signal> outputs() const { return signals(TC_OUTPUTS); }
  std::vector<Signal> states() const { return signals(TC_STATES); }
  std::size_t count(tc_signals which) const { return tc_model_count(handle(), which); }
  std::vector<Signal> signals(tc_signals which) const {
    std::vector<Signal> all;
    for (std::size_t i = 0; i < count(which); ++i)
      all.push_back({tc_model_signal_name(handle(), which, i),
                     tc_model_signal_unit(handle(), which, i),
                     tc_model_signal_meaning(handle(), which, i)});
    return all;
  }
  /// @throws UsageError that names the nearest
  Range find(tc_signals which, const std::string& name) const {
    Range range;
    check(tc_model_find(handle(), which, name.c_str(), &range.first, &range.count));
    return range;
  }

  /// What a number with a unit, `10 mN m`, is in the unit of an input.
  double read_input(std::size_t input, const std::string& text) const {
    double value = 0.0;
    check(tc_model_read_input(handle(), input, text.c_str(), &value));
    return value;
  }

  int degrees_of_freedom() const { return tc_model_degrees_of_freedom(handle()); }
  double step() const { return tc_model_step(handle()); }          // [s] simulation.step
  double duration() const { return tc_model_duration(handle()); }  // [s] simulation.duration
  MassProperties mass_properties() const {                         // at t = 0
    MassProperties all;
    check(tc_model_mass_properties(handle(), &all.mass, all.center_of_mass, all.inertia));
    return all;
  }

  /// What scsim does: a verdict that is not `agree` is no exception.
  Run run(const RunOptions& how = {}) const { return finished(tc_model_run, how); }
  /// Are the two targets one machine?
  Run prove(const RunOptions& how = {}) const { return finished(tc_model_prove, how); }
  /// Why do the engines differ?
  Run attribute(const RunOptions& how = {}) const { return finished(tc_model_attribute, how); }

  /// Flies the spec's campaign. @throws SpecError: it has none; FileError
  Campaign campaign(const CampaignOptions& how = {}) const {
    std::vector<const char*> records;
    std::vector<std::size_t> sizes;
    for (const std::string& one : how.records) {
      records.push_back(one.data());
      sizes.push_back(one.size());
    }
    const tc_campaign_options options{sizeof options,
                                      static_cast<tc_twins>(how.twins),
                                      how.jobs,
                                      how.isa.c_str(),
                                      how.folder.empty() ? nullptr : how.folder.c_str(),
                                      how.shard,
                                      how.shards,
                                      how.resume ? 1 : 0,
                                      records.data(),
                                      sizes.data(),
                                      records.size(),
                                      how.poll,
                                      how.context};
    tc_run* handle = nullptr;
    const tc_status status = tc_model_campaign(this->handle(), &options, &handle);
    Campaign campaign(handle);
    if (status == TC_SPEC) throw SpecError(tc_run_error(handle), "");
    detail::check(status, tc_run_error(handle));
    return campaign;
  }
  /// 0: it has no campaign.
  std::size_t campaign_members() const { return tc_model_campaign_members(handle()); }
  /// A member of its campaign: the spec with what is drawn for it.
  Model member(std::size_t index) const {
    return checked([&](tc_model** drawn) { return tc_model_member(handle(), index, drawn); });
  }

  tc_model* handle() const { return model_.get(); }

 private:
  explicit Model(tc_model* model) : model_(model, tc_model_free) {}

  template <class Load>
  static Model made(const std::vector<std::string>& set, const std::string& name,
                    const Load& load) {
    std::vector<const char*> overrides;
    for (const std::string& one : set) overrides.push_back(one.c_str());
    const tc_load_options options{sizeof options, overrides.data(), overrides.size(),
                                  name.empty() ? nullptr : name.c_str()};
    return checked([&](tc_model** model) { return load(&options, model); });
  }
  template <class Make>
  static Model checked(const Make& make) {
    tc_model* handle = nullptr;
    const tc_status status = make(&handle);
    Model model(handle);
    if (status == TC_SPEC) throw SpecError(tc_model_error(handle), tc_model_diagnostics(handle));
    detail::check(status, tc_model_error(handle));
    return model;
  }
  using Make = tc_status(const tc_model*, const tc_run_options*, tc_run**);
  Run finished(Make* make, const RunOptions& how) const {
    const tc_run_options options{sizeof options, static_cast<tc_engines>(how.engines),
                                 how.trials,     how.jobs,
                                 how.poll,       how.context};
    tc_run* handle = nullptr;
    const tc_status status = make(this->handle(), &options, &handle);
    Run run(handle);
    detail::check(status, tc_run_error(handle));
    return run;
  }
  void check(tc_status status) const { detail::check(status, tc_model_error(handle())); }

  std::shared_ptr<tc_model> model_;
};

/// One engine of a model on its way, from t = 0. It has no end.
class Simulation {
 public:
  explicit Simulation(const Model& model, Engine engine = Engine::bsm) : model_(model) {
    tc_simulation* handle = nullptr;
    const tc_status status =
        tc_simulation_new(model.handle(), static_cast<tc_engine>(engine), &handle);
    simulation_.reset(handle, tc_simulation_free);
    check(status);
  }
  /// Goes on from the same instant to the same bytes.
  Simulation(const Simulation& other) : model_(other.model_) {
    tc_simulation* handle = nullptr;
    const tc_status status = tc_simulation_copy(other.handle(), &handle);
    simulation_.reset(handle, tc_simulation_free);
    other.check(status);
  }
  Simulation(Simulation&&) = default;
  Simulation& operator=(Simulation&&) = default;

  const Model& model() const { return model_; }
  double time() const { return tc_simulation_time(handle()); }  // [s]
  /// In the order of the model's states.
  std::vector<double> state() const { return read(tc_simulation_state, TC_STATES); }
  /// In the order of the model's outputs.
  std::vector<double> observe() const { return read(tc_simulation_observe, TC_OUTPUTS); }
  /// What acts, in the order of the model's inputs.
  std::vector<double> inputs() const { return read(tc_simulation_inputs, TC_INPUTS); }
  void read_state(double* to, std::size_t n) const { check(tc_simulation_state(handle(), to, n)); }
  void read_outputs(double* to, std::size_t n) const {
    check(tc_simulation_observe(handle(), to, n));
  }
  void read_inputs(double* to, std::size_t n) const {
    check(tc_simulation_inputs(handle(), to, n));
  }
  /// What rounding left over of earlier steps is dropped.
  void set_state(const std::vector<double>& state) {
    check(tc_simulation_set_state(handle(), state.data(), state.size()));
  }

  /// Hold an input at a value from now on, in place of its schedule.
  void drive(std::size_t input, double value) {
    check(tc_simulation_drive(handle(), input, value));
  }
  void drive(std::size_t first, const double* values, std::size_t count) {
    check(tc_simulation_drive_many(handle(), first, values, count));
  }
  void drive(const std::string& name, double value) { drive(one(name), value); }
  /// With a unit: `10 mN m`.
  void drive(const std::string& name, const std::string& value) { drive_text(one(name), value); }
  void drive_text(std::size_t input, const std::string& value) {
    check(tc_simulation_drive_text(handle(), input, value.c_str()));
  }
  /// Give it back to its schedule.
  void release(std::size_t input) { check(tc_simulation_release(handle(), input)); }
  void release(const std::string& name) {
    const Range range = model_.find(TC_INPUTS, name);
    for (std::size_t i = 0; i < range.count; ++i) release(range.first + i);
  }

  /// To the `count`-th next point of the grid k * step.
  void step(std::size_t count = 1) { check(tc_simulation_step(handle(), count)); }
  /// To exactly `time` [s].
  double run_until(double time) {
    double reached = 0.0;
    check(tc_simulation_run_until(handle(), time, nullptr, &reached));
    return reached;
  }
  /// The same, calling at every tick start + k * every, the end left out, `stop` and then
  /// `controller`, and at the end `stop` alone: each with the time; they may ask and drive this
  /// simulation. What they throw comes through. @param every  [s]; 0: every step end
  double run_until(double time, double every, std::function<void(double)> controller,
                   std::function<bool(double)> stop = {}) {
    detail::Callbacks callbacks{std::move(controller), std::move(stop), nullptr};
    const tc_control control = callbacks.control(every);
    double reached = 0.0;
    const tc_status status = tc_simulation_run_until(handle(), time, &control, &reached);
    callbacks.rethrow();
    check(status);
    return reached;
  }

  std::vector<std::uint8_t> snapshot() const {
    return detail::bytes_of([this](void* bytes, std::size_t capacity, std::size_t* size) {
      check(tc_simulation_snapshot(handle(), bytes, capacity, size));
    });
  }
  /// @throws SnapshotError
  void restore(const std::vector<std::uint8_t>& bytes) { restore(bytes.data(), bytes.size()); }
  void restore(const void* bytes, std::size_t size) {
    check(tc_simulation_restore(handle(), bytes, size));
  }
  /// As just made.
  void reset() { check(tc_simulation_reset(handle())); }

  tc_simulation* handle() const { return simulation_.get(); }

 private:
  friend class Twin;
  /// A twin's, which stays as long as this does.
  Simulation(const Model& model, std::shared_ptr<tc_simulation> of_a_twin)
      : model_(model), simulation_(std::move(of_a_twin)) {}

  std::size_t one(const std::string& name) const {
    const Range range = model_.find(TC_INPUTS, name);
    if (range.count != 1) throw UsageError("`" + name + "` is a vector: it takes 3 numbers");
    return range.first;
  }
  std::vector<double> read(tc_status (*from)(tc_simulation*, double*, std::size_t),
                           tc_signals which) const {
    std::vector<double> numbers(model_.count(which));
    check(from(handle(), numbers.data(), numbers.size()));
    return numbers;
  }
  void check(tc_status status) const {
    detail::check(status, tc_simulation_error(handle()),
                  [this](double* time, const char** coordinate) {
                    tc_simulation_failure(handle(), time, coordinate);
                  });
  }

  Model model_;
  std::shared_ptr<tc_simulation> simulation_;
};

/// Both engines in lock step.
class Twin {
 public:
  /// @param lead  whose outputs controllers see
  explicit Twin(const Model& model, Engine lead = Engine::bsm) : model_(model) {
    tc_twin* handle = nullptr;
    const tc_status status = tc_twin_new(model.handle(), static_cast<tc_engine>(lead), &handle);
    twin_.reset(handle, tc_twin_free);
    check(status);
  }
  Twin(const Twin& other) : model_(other.model_) {
    tc_twin* handle = nullptr;
    const tc_status status = tc_twin_copy(other.handle(), &handle);
    twin_.reset(handle, tc_twin_free);
    other.check(status);
  }
  Twin(Twin&&) = default;
  Twin& operator=(Twin&&) = default;

  const Model& model() const { return model_; }
  double time() const { return tc_twin_time(handle()); }
  /// One of the two, to be asked and driven; the twin moves it.
  Simulation simulation(Engine engine) const {
    return {model_, std::shared_ptr<tc_simulation>(
                        twin_, tc_twin_simulation(handle(), static_cast<tc_engine>(engine)))};
  }

  void drive(std::size_t input, double value) { drive(input, &value, 1); }
  void drive(std::size_t first, const double* values, std::size_t count) {
    check(tc_twin_drive_many(handle(), first, values, count));
  }
  void drive_text(std::size_t input, const std::string& value) {
    check(tc_twin_drive_text(handle(), input, value.c_str()));
  }
  void release(std::size_t input) { check(tc_twin_release(handle(), input)); }
  void step(std::size_t count = 1) { check(tc_twin_step(handle(), count)); }
  double run_until(double time) {
    double reached = 0.0;
    check(tc_twin_run_until(handle(), time, nullptr, &reached));
    return reached;
  }
  /// As a simulation's.
  double run_until(double time, double every, std::function<void(double)> controller,
                   std::function<bool(double)> stop = {}) {
    detail::Callbacks callbacks{std::move(controller), std::move(stop), nullptr};
    const tc_control control = callbacks.control(every);
    double reached = 0.0;
    const tc_status status = tc_twin_run_until(handle(), time, &control, &reached);
    callbacks.rethrow();
    check(status);
    return reached;
  }

  /// The same with a controller for each engine, which sees its outputs and drives it alone.
  double run_each_until(double time, double every, std::function<void(double)> bsm,
                        std::function<void(double)> mujoco, std::function<bool(double)> stop = {}) {
    detail::Callbacks first{std::move(bsm), std::move(stop), nullptr};
    detail::Callbacks second{std::move(mujoco), {}, nullptr};
    const tc_control controls[] = {first.control(every), second.control(every)};
    double reached = 0.0;
    const tc_status status =
        tc_twin_run_each_until(handle(), time, &controls[0], &controls[1], &reached);
    first.rethrow();
    second.rethrow();
    check(status);
    return reached;
  }

  std::vector<std::uint8_t> snapshot() const {
    return detail::bytes_of([this](void* bytes, std::size_t capacity, std::size_t* size) {
      check(tc_twin_snapshot(handle(), bytes, capacity, size));
    });
  }
  void restore(const void* bytes, std::size_t size) {
    check(tc_twin_restore(handle(), bytes, size));
  }
  void reset() { check(tc_twin_reset(handle())); }
  /// `agreement` of report.json so far, with `now` beside `max`, as JSON.
  std::string disagreement() const { return tc_twin_disagreement(handle()); }

  tc_twin* handle() const { return twin_.get(); }

 private:
  void check(tc_status status) const {
    detail::check(status, tc_twin_error(handle()), [this](double* time, const char** coordinate) {
      tc_twin_failure(handle(), time, coordinate);
    });
  }

  Model model_;
  std::shared_ptr<tc_twin> twin_;
};

/// Many spacecraft of one model, by the analytic engine.
class Batch {
 public:
  /// @param threads  0: all cores; the same bytes for any number
  Batch(const Model& model, std::size_t count, std::size_t threads = 0) : model_(model) {
    tc_batch* handle = nullptr;
    const tc_status status = tc_batch_new(model.handle(), count, threads, &handle);
    batch_.reset(handle);
    check(status);
  }

  const Model& model() const { return model_; }
  std::size_t count() const { return tc_batch_count(handle()); }
  double time() const { return tc_batch_time(handle()); }
  /// A row per member.
  std::vector<double> states() const { return read(tc_batch_states, TC_STATES); }
  std::vector<double> outputs() const { return read(tc_batch_outputs, TC_OUTPUTS); }
  std::vector<double> inputs() const { return read(tc_batch_inputs, TC_INPUTS); }
  /// One row serves all members.
  void set_states(const double* rows, std::size_t size) {
    check(tc_batch_set_states(handle(), rows, size));
  }
  void drive(const double* rows, std::size_t size) { check(tc_batch_drive(handle(), rows, size)); }
  void release() { check(tc_batch_release(handle())); }
  void step(std::size_t count = 1) { check(tc_batch_step(handle(), count)); }
  /// 0, or TC_NUMERICAL of a member that has failed.
  std::vector<std::int32_t> status() const {
    std::vector<std::int32_t> all(count());
    check(tc_batch_status(handle(), all.data(), all.size()));
    return all;
  }
  std::string reason(std::size_t member) const { return tc_batch_reason(handle(), member); }

  tc_batch* handle() const { return batch_.get(); }

 private:
  std::vector<double> read(tc_status (*from)(tc_batch*, double*, std::size_t),
                           tc_signals which) const {
    std::vector<double> rows(count() * model_.count(which));
    check(from(handle(), rows.data(), rows.size()));
    return rows;
  }
  void check(tc_status status) const { detail::check(status, tc_batch_error(handle())); }

  Model model_;
  detail::Owned<tc_batch, tc_batch_free> batch_;
};

}  // namespace twincraft

#endif
