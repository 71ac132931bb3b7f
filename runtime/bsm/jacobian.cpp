#include "runtime/bsm/jacobian.h"

#include <algorithm>
#include <numeric>

#include "runtime/bsm/recording.h"
#include "runtime/scalar/tangents.h"

namespace twincraft::bsm {
namespace {

/// The states, then the inputs.
std::vector<std::size_t> variables(const RecordedInputs& at) {
  std::vector<std::size_t> all(at.states + at.inputs);
  std::iota(all.begin(), all.end(), at.state(0));
  return all;
}

}  // namespace

struct Differentiator::Inside {
  explicit Inside(const Model& model)
      : places(model),
        in(places.size()),
        tangents(recorded_derivative(model).simplified(), variables(places)) {}

  RecordedInputs places;
  std::vector<double> in;
  Tangents tangents;
};

Differentiator::Differentiator(const Model& model) : inside_(std::make_unique<Inside>(model)) {
  hold(inputs_at(model, 0.0));
}

Differentiator::~Differentiator() = default;

void Differentiator::hold(const Inputs& inputs) { inside_->places.put(inputs, inside_->in); }

void Differentiator::differentiate(double time, std::span<const double> state, Jacobian& jacobian) {
  const RecordedInputs& at = inside_->places;
  inside_->in[RecordedInputs::time()] = time;
  std::ranges::copy(state, inside_->in.begin() + static_cast<std::ptrdiff_t>(at.state(0)));
  const double* const all = inside_->tangents.at(inside_->in).data();
  const auto rows = static_cast<Eigen::Index>(at.states);
  jacobian.A = Eigen::Map<const Eigen::MatrixXd>(all, rows, rows);
  jacobian.B = Eigen::Map<const Eigen::MatrixXd>(all + rows * rows, rows,
                                                 static_cast<Eigen::Index>(at.inputs));
}

}  // namespace twincraft::bsm
