// One function per claim, each with its bound and the reason for it. See examine.h.
#include "tests/random/examine.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "compiler/diag/print.h"
#include "compiler/emit/resolved.h"
#include "compiler/pipeline.h"
#include "runtime/bsm/engine.h"
#include "runtime/compare/agreement.h"
#include "runtime/compare/conservation.h"
#include "runtime/compare/proof.h"
#include "runtime/mujoco/engine.h"
#include "runtime/mujoco/handles.h"
#include "tests/random/limited_engine.h"
#include "tests/random/parts.h"
#include "tests/support/asked.h"
#include "tests/support/run_program.h"
#include "tests/support/simbody_oracle.h"

namespace twincraft::random_vehicles {
namespace {

// Each of them relative to what is physically comparable there.
constexpr double kAccelerations =
    1.0e-10;                       // kProofBound: MuJoCo's own factorisation of long chains
constexpr double kRuns = 1.0e-9;   // as kBooks
constexpr double kBooks = 1.0e-9;  // RKF78 at 1e-13, some hundred steps, stiff chains

constexpr long kMostDerivatives = 2'000'000;

class Examination {
 public:
  Examination(const std::string& text, const std::string& name, Record& record)
      : text_(text), name_(name), record_(record) {}

  std::optional<Finding> run() {
    if (!compiles() || !is_resolved_to_itself() || !is_the_sum_of_its_parts()) return finding_;
    if (!is_the_member_of_a_study() || !is_read_back()) return finding_;
    const Model& model = bundle_->model;
    if (!is_proved()) return finding_;
    if (!model.simulation.translation && !is_voted_for()) return finding_;
    const Model tight = short_run();
    const std::optional<Trajectory> a = balanced("bsm", tight);
    const std::optional<Trajectory> b = a ? balanced("mujoco", tight) : std::nullopt;
    if (b) stay_together(tight, *a, *b);
    return finding_;
  }

 private:
  bool fail(std::string check, std::string detail) {
    finding_ = {std::move(check), std::move(detail)};
    return false;
  }

  /// Whether `value` is within `bound`; NaN is not.
  bool judge(const std::string& check, double value, double bound, const std::string& where) {
    Worst& worst = record_[check];
    if (!(value <= worst.value)) worst = {value, name_};
    if (value <= bound) return true;
    return fail(check, fmt::format("{:.2e} at {}, bound {:g}", value, where, bound));
  }

  /// The spec, or the first member of its study.
  static std::optional<Bundle> compile_text(const std::string& text, std::string& faults,
                                            const std::string& file = "vehicle.yaml") {
    Diagnostics diagnostics;
    const LoadResult loaded = load_spec({file, {}, text}, diagnostics);
    const Wanted wanted{kMjcf, kAssemblyJson, kResolved};
    std::optional<Bundle> bundle;
    if (loaded.spec)
      bundle = loaded.spec->study() != nullptr ? loaded.spec->member(0, wanted, diagnostics)
                                               : loaded.spec->compile(wanted, diagnostics);
    faults = to_text(diagnostics, {});
    return bundle;
  }

  /// " SC3101": a shrunk spec must be refused for the same reason.
  static std::string code_in(const std::string& faults) {
    const std::size_t at = faults.find("[SC");
    return at == std::string::npos ? "" : " " + faults.substr(at + 1, 6);
  }

  bool compiles() {
    std::string faults;
    bundle_ = compile_text(text_, faults);
    return bundle_ ? true : fail("compiles" + code_in(faults), faults);
  }

  bool is_resolved_to_itself() {
    std::string faults;
    return is_the_same("resolved spec", compile_text(bundle_->text(kResolved), faults), faults);
  }

  bool is_the_same(const std::string& what, const std::optional<Bundle>& again,
                   const std::string& faults) {
    if (!again) return fail(what + " compiles", faults);
    if (again->text(kMjcf) != bundle_->text(kMjcf)) return fail(what, "another MJCF");
    if (again->text(kAssemblyJson) != bundle_->text(kAssemblyJson))
      return fail(what, "another assembly");
    if (again->text(kResolved) != bundle_->text(kResolved))
      return fail(what, "another resolved spec");
    return true;
  }

  bool is_the_sum_of_its_parts() {
    const test::TemporaryFolder folder;
    Parts parts = deal(Json::parse(bundle_->resolved_json));
    folder.write("base.yaml", emit_resolved(parts.base));
    parts.rest["extends"] = "base.yaml";
    std::string faults;
    const std::optional<Bundle> merged =
        compile_text(emit_resolved(parts.rest), faults, folder.write("rest.yaml", ""));
    return is_the_same("spec in two files", merged, faults);
  }

  bool is_the_member_of_a_study() {
    Json spec = Json::parse(bundle_->resolved_json);
    const Json duration = spec["simulation"]["duration"];
    spec["study"]["sweep"] = {{{"set", "simulation.duration"}, {"values", {duration}}}};
    std::string faults;
    return is_the_same("member of a study", compile_text(emit_resolved(spec), faults), faults);
  }

  bool is_read_back() {
    const MujocoModel m = load_mjcf(bundle_->text(kMjcf));
    const BodyTree& tree = bundle_->model.tree;
    if (m->nbody != static_cast<int>(tree.bodies.size()) + 1)
      return fail("MJCF", fmt::format("{} bodies of {}", m->nbody - 1, tree.bodies.size()));
    for (const TreeBody& body : tree.bodies) {
      const int id = mj_name2id(m.get(), mjOBJ_BODY, body.name.c_str());
      if (id < 0) return fail("MJCF", "no body " + body.name);
      const bool same = m->body_mass[id] == body.inertial.mass &&
                        Vector3d::Map(m->body_ipos + 3 * id) == body.inertial.r_CL_L &&
                        Vector3d::Map(m->body_pos + 3 * id) == body.pos;
      if (!same) return fail("MJCF", "another mass or place of " + body.name);
    }
    return true;
  }

  bool is_proved() {
    bsm_ = make_bsm_engine(bundle_->model);
    mujoco_ = make_mujoco_engine(bundle_->model, bundle_->text(kMjcf));
    for (const ProofLine& line : prove(bundle_->model, *bsm_, *mujoco_).lines)
      if (!judge("BSM and MuJoCo, " + line.what, line.difference, line.bound, line.where))
        return false;
    return true;
  }

  /// Either engine against Simbody, block by block.
  bool is_voted_for() {
    const Model& model = bundle_->model;
    for (const RandomState& state : random_states(model, 2)) {
      const Eigen::VectorXd vote = test::simbody_accelerations(model, model.gravity.bsm, state);
      for (Engine* engine : {bsm_.get(), mujoco_.get()}) {
        const Eigen::VectorXd off = test::accelerations_at(model, *engine, state) - vote;
        const auto relative = [&](Eigen::Index at, Eigen::Index count) {
          // What rates of about 0.1 rad/s make of any acceleration is the least to compare with.
          const double scale = vote.segment(at, count).norm();
          return off.segment(at, count).norm() / std::max(0.01, scale);
        };
        const double worst =
            std::max({relative(0, 3), relative(3, 3), relative(6, vote.size() - 6)});
        const std::string check = fmt::format("{} and Simbody", engine->name());
        if (!judge(check, worst, kAccelerations, fmt::format("t = {} s", state.time))) return false;
      }
    }
    return true;
  }

  /// As exact as doubles allow, and short: what goes wrong does so at once.
  Model short_run() const {
    Model tight = bundle_->model;
    tight.simulation.method = Method::kRkf78;
    const Tolerance fine{1.0e-13, 1.0e-13};
    tight.simulation.tolerance = {fine, fine, fine, fine, fine, fine, fine};
    tight.simulation.duration = std::min(0.3, tight.simulation.duration);
    tight.simulation.step = tight.simulation.record = 0.25 * tight.simulation.duration;
    return tight;
  }

  /// A run, if it keeps momentum, angular momentum and energy.
  std::optional<Trajectory> balanced(const std::string& name, const Model& tight) {
    const auto engine =
        name == "bsm" ? make_bsm_engine(tight) : make_mujoco_engine(tight, bundle_->text(kMjcf));
    LimitedEngine limited(*engine, kMostDerivatives);
    Trajectory run = propagate(limited, tight, {&limited.exhausted(), {}});
    if (run.status != Trajectory::Status::kComplete) {
      const bool is_slow = run.status == Trajectory::Status::kInterrupted;
      fail(name + (is_slow ? " is quick enough" : " runs"), run.failure);
      return std::nullopt;
    }
    const Conservation kept = conservation_of(run);
    const bool balances =
        judge(name + " energy", kept.energy, kBooks, "a short run") &&
        judge(name + " momentum", kept.momentum, kBooks, "a short run") &&
        judge(name + " angular momentum", kept.angular_momentum, kBooks, "a short run");
    return balances ? std::optional(std::move(run)) : std::nullopt;
  }

  /// Two runs of one machine. Angles in degrees, lengths in metres, rates in rad/s of things that
  /// are about 1; the way on orbit is rounding of its radius.
  bool stay_together(const Model& model, const Trajectory& a, const Trajectory& b) {
    const double radius = 1.0 + a.samples.back().r_CN_N.norm();
    for (const Metric& metric : compare(model, a, b).metrics) {
      const bool is_place = metric.key.ends_with("position_m") || metric.key == "velocity_m_s";
      const double size = is_place ? radius : metric.key == "wheel_rate_rad_s" ? 100.0 : 1.0;
      const std::string where = fmt::format("t = {} s", metric.at);
      if (!judge("runs, " + metric.key, metric.maximum / size, kRuns, where)) return false;
    }
    return true;
  }

  const std::string& text_;
  const std::string& name_;
  Record& record_;
  std::optional<Finding> finding_;
  std::optional<Bundle> bundle_;
  std::unique_ptr<Engine> bsm_, mujoco_;
};

}  // namespace

std::optional<Finding> examine(const std::string& text, const std::string& name, Record& record) {
  try {
    return Examination(text, name, record).run();
  } catch (const std::exception& error) {  // NumericalFailure, InternalError
    return Finding{"no exception", error.what()};
  }
}

}  // namespace twincraft::random_vehicles
