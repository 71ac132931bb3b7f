// What is found of one run, rule by rule, and what is concluded from it: the rules are in
// rules.cpp, the conclusion and the advice in judge.cpp.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/integrate/tableau.h"
#include "runtime/linear/modal.h"
#include "runtime/linear/probes.h"
#include "runtime/linear/resolution.h"

namespace twincraft {

inline bool is_adaptive(const Model& model) { return tableau_of(model.simulation.method).adaptive; }

/// The initial state at every instant that an inspection looks at: masses and inputs are those of
/// the instant, so that modes can be told before there is a run.
std::vector<Observation> foreseen(const Model& model, const Inspection& inspection);

/// All that is found of one run, rule by rule.
class Judge {
 public:
  Judge(const Model& model, const Inspection& inspection, const RunShown& run)
      : model_(model),
        inspection_(inspection),
        run_(run),
        step_(is_adaptive(model) ? run.mean_step : model.simulation.step),
        modal_(model, step_) {}

  /// What destroyed a run that failed is looked for up to here [s].
  void set_destroyed(double time) { modal_.set_destroyed(time); }

  void look_at_modes();
  void look_at_probes();
  void look_at_motion(std::span<const OwnEnergy* const> energies);
  void look_at_accepted_errors();
  Resolution conclude();
  Resolution conclude_failure();

 private:
  struct Probe {
    double time;  // [s]
    LocalError error;
  };
  void see_modes(OwnMotion& motion, const Observation& seen, double inputs_at,
                 const Eigen::VectorXd& drive, bool near_empty);
  Amplitudes amplitudes_at(double time) const;
  std::vector<Probe> made_probes() const;
  void judge_attitude(const std::vector<Probe>& probes);
  void judge_joints(const std::vector<Probe>& probes);
  void judge_center(const std::vector<Probe>& probes);
  double summed(const std::vector<Probe>& probes,
                const std::function<double(const LocalError&)>& part) const;
  void note_joint(ResolutionRule rule, std::size_t joint, double error, std::string_view what);
  void judge_orbit();
  void judge_turning();
  void judge_energy(std::span<const OwnEnergy* const> energies);
  void advise_from(double error, double limit);
  void remark_on_steps(Resolution& resolution) const;
  Method method() const { return model_.simulation.method; }
  int order() const { return tableau_of(method()).order; }
  void advise(Resolution& resolution) const;
  bool is_of_use(double step) const;
  std::optional<double> stable_until_empty(double step) const;
  std::optional<Finding> pole_at_the_end() const;
  std::optional<Finding> fastest_at_the_end();
  std::string cure(const Resolution& resolution) const;
  Resolution told() const;
  double amplitude_of(std::size_t joint) const;

  const Model& model_;
  const Inspection& inspection_;
  const RunShown& run_;
  double step_;
  ModalJudge modal_;
  std::vector<Finding> findings_;
  double advised_ = std::numeric_limits<double>::infinity();  // [s]
  double tolerance_factor_ = 1.0;
  std::optional<double> attitude_deg_;
  std::string worst_coordinate_;
  double worst_error_ = 0.0;
};

}  // namespace twincraft
