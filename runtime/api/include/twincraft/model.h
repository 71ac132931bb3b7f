// A spec, compiled: a Model, with its signals, and what the programs would say of it, a Run.
#ifndef TWINCRAFT_MODEL_H
#define TWINCRAFT_MODEL_H

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "../twincraft.h"
#include "error.h"

namespace twincraft {

enum class Engine { bsm = TC_BSM, mujoco = TC_MUJOCO };
enum class Engines { both = TC_BOTH, bsm = TC_BSM_ALONE, mujoco = TC_MUJOCO_ALONE };

/// Its word in specs, flags, files and reports: `bsm`, `mujoco`.
inline const char* name_of(Engine engine) { return tc_engine_name(static_cast<tc_engine>(engine)); }

namespace detail {

template <class Handle, void (*free)(Handle*)>
struct Freed {
  void operator()(Handle* handle) const { free(handle); }
};
template <class Handle, void (*free)(Handle*)>
using Owned = std::unique_ptr<Handle, Freed<Handle, free>>;

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

class Campaign;
struct CampaignOptions;

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

  /// Flies the spec's campaign; twincraft/campaign.h has it. @throws SpecError: it has none;
  /// FileError
  Campaign campaign() const;
  Campaign campaign(const CampaignOptions& how) const;
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

}  // namespace twincraft

#endif
