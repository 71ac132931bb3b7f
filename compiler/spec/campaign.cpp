// The section `campaign`, key by key. Tested by tests/compiler/campaign_test.cpp.
#include "compiler/spec/campaign.h"

#include <limits>

#include "compiler/schema/own_kind.h"
#include "compiler/spec/as_written.h"
#include "compiler/spec/study.h"

namespace twincraft {
namespace {

constexpr int kMostMembers = static_cast<int>(kMaximumMembers);

Kind<Node> amount() { return any_quantity("quantity, or `%` of the nominal value"); }

const Table<NormalSpec>& normal_table() {
  static const Table<NormalSpec> table{
      "normal",
      "About the nominal value.",
      {
          required("sigma", &NormalSpec::sigma, amount(), "The standard deviation."),
          optional("truncate", &NormalSpec::truncate, maybe(number(Range::kPositive)),
                   "Nothing is drawn further than so many sigmas from the nominal value. `sigma` "
                   "is the standard deviation without that."),
      }};
  return table;
}

const Table<UniformSpec>& uniform_table() {
  static const Table<UniformSpec> table{
      "uniform",
      "Between two bounds.",
      {
          required("low", &UniformSpec::low, amount(), "The smallest value."),
          required("high", &UniformSpec::high, amount(), "The largest value."),
      }};
  return table;
}

const Table<LognormalSpec>& lognormal_table() {
  static const Table<LognormalSpec> table{
      "lognormal",
      "The logarithm is normal, so no value has another sign than the nominal one, which is the "
      "mean.",
      {required("sigma", &LognormalSpec::sigma, amount(),
                "The standard deviation of the value itself, not of its logarithm.")}};
  return table;
}

const Table<TriangularSpec>& triangular_table() {
  static const Table<TriangularSpec> table{
      "triangular",
      "Most likely at `mode`, and linearly less so up to the bounds.",
      {
          required("low", &TriangularSpec::low, amount(), "The smallest value."),
          required("high", &TriangularSpec::high, amount(), "The largest value."),
          optional("mode", &TriangularSpec::mode, maybe(amount()),
                   "The most likely value. Default: the nominal one."),
      }};
  return table;
}

const Table<ChoiceSpec>& choice_table() {
  static const Table<ChoiceSpec> table{
      "choice",
      "One of some values, each as often as the others.",
      {required("values", &ChoiceSpec::values, list_of(amount(), 1), "The values.")}};
  return table;
}

const Table<ConeSpec>& cone_table() {
  static const Table<ConeSpec> table{
      "cone",
      "Of a direction: tilted about the nominal one.",
      {required("sigma", &ConeSpec::sigma, quantity("rad", Range::kNotNegative),
                "The standard deviation of the tilt along each of two directions across the "
                "nominal one. The whole tilt is 1.25 sigma in the mean.")}};
  return table;
}

const Table<RotationSpec>& rotation_table() {
  static const Table<RotationSpec> table{
      "rotation",
      "Of an attitude: turned from the nominal one by a rotation vector in the axes of the body.",
      {required("sigma", &RotationSpec::sigma, quantity("rad", Range::kNotNegative),
                "The standard deviation of each of its three components.")}};
  return table;
}

const Table<InertiaDrawSpec>& inertia_table() {
  static const Table<InertiaDrawSpec> table{
      "inertia draw",
      "Of an inertia tensor: every draw is one that some body has. The second moments of mass "
      "along "
      "the principal axes, the eigenvalues of tr(I)/2 1 - I, are each multiplied by a lognormal "
      "factor of mean 1, then the tensor is turned.",
      {
          required("sigma", &InertiaDrawSpec::sigma, any_quantity("`%`, or a plain number"),
                   "The standard deviation of these factors. A principal moment is the sum of two "
                   "such moments: it spreads by 0.71 sigma where they are alike, up to 1 sigma "
                   "where one is small. Without `tilt` the mean is the nominal tensor."),
          optional("tilt", &InertiaDrawSpec::tilt, quantity("rad", Range::kNotNegative),
                   "The standard deviation of the turn about each axis."),
      }};
  return table;
}

const Table<DispersionSpec>& dispersion_table() {
  static const Table<DispersionSpec> table =
      Table<DispersionSpec>{
          "dispersion",
          "A spec path and how its value is drawn. Numbers, and each number of a vector or list by "
          "itself, take the first five distributions; directions, attitudes and inertia tensors "
          "one "
          "each of the others.",
          {
              required(
                  "set", &DispersionSpec::set, text(),
                  "The path, as in `--set`: `hub.mass`, `panels.*.stiffness`. It leads to a value "
                  "that the spec has, which is the nominal one."),
              optional("normal", &DispersionSpec::normal, maybe(object(normal_table())),
                       "A bell about the nominal value."),
              optional("uniform", &DispersionSpec::uniform, maybe(object(uniform_table())),
                       "All values between bounds alike."),
              optional("lognormal", &DispersionSpec::lognormal, maybe(object(lognormal_table())),
                       "Of one sign."),
              optional("triangular", &DispersionSpec::triangular, maybe(object(triangular_table())),
                       "Bounds and the most likely value."),
              optional("choice", &DispersionSpec::choice, maybe(object(choice_table())),
                       "One of some values."),
              optional("cone", &DispersionSpec::cone, maybe(object(cone_table())),
                       "Of a direction."),
              optional("rotation", &DispersionSpec::rotation, maybe(object(rotation_table())),
                       "Of an attitude: `initial.attitude`, `bodies.arm.orientation`."),
              optional("inertia", &DispersionSpec::inertia, maybe(object(inertia_table())),
                       "Of an inertia tensor."),
              optional(
                  "together", &DispersionSpec::together, boolean(),
                  "All that a path with `*` leads to is drawn once, each about its own nominal "
                  "value. Default: each by itself."),
          }}
          .exactly_one_of({"normal", "uniform", "lognormal", "triangular", "choice", "cone",
                           "rotation", "inertia"});
  return table;
}

std::optional<CorrelationSpec> read_correlation(const Node& node, ReadContext& context) {
  if (!check_list(node, context, 3, 3, "a list `[path, path, number]`",
                  "write for example `[hub.mass, tanks.main.propellant, 0.8]`"))
    return std::nullopt;
  const std::string* first = scalar_text(node.items[0], context, "a path", "");
  const std::string* second = scalar_text(node.items[1], context, "a path", "");
  const std::optional<double> rho = read_number(node.items[2], context);
  if (first == nullptr || second == nullptr || !rho) return std::nullopt;
  return CorrelationSpec{*first, *second, *rho, &node};
}

Kind<CorrelationSpec> correlation() {
  const Json path = {{"type", "string"}};
  return own_kind<CorrelationSpec>({
      .text = "[path, path, number]",
      .schema = {{"type", "array"},
                 {"items", Json::array({path, path, {{"type", "number"}}})},
                 {"minItems", 3},
                 {"maxItems", 3}},
      .read = read_correlation,
      .write = [](const CorrelationSpec& pair) -> Json {
        return Json::array({pair.first, pair.second, pair.rho});
      },
  });
}

const Table<KeepSpec>& keep_table() {
  static const Table<KeepSpec> table{
      "keep",
      "Whose trajectories are kept, beside the table of all members.",
      {
          optional("worst", &KeepSpec::worst, integer(0, kMostMembers),
                   "So many members with the largest `by`."),
          optional("by", &KeepSpec::by, maybe(name()), "The name of an output."),
          optional("members", &KeepSpec::members, list_of(integer(0, kMostMembers - 1)),
                   "These, counted from 0."),
      }};
  return table;
}

const Table<TwinSpec>& twin_table() {
  static const Table<TwinSpec> table{
      "twin",
      "Which members both engines fly and compare; the analytic engine flies the others alone.",
      {optional("every", &TwinSpec::every, integer(1, kMostMembers),
                "Members 0, `every`, twice `every`, and so on. 1: all.")}};
  return table;
}

}  // namespace

const Table<CampaignSpec>& campaign_table() {
  static const Table<CampaignSpec> table{
      "campaign",
      "Many runs of this spec with drawn values (Monte Carlo). What is drawn depends on the seed, "
      "the member and the path alone. A member that cannot be compiled or flown is a row that says "
      "why.",
      {
          required("members", &CampaignSpec::members, integer(1, kMostMembers),
                   "How many; they count from 0."),
          optional("seed", &CampaignSpec::seed, integer(0, std::numeric_limits<int>::max()),
                   "Another one draws other numbers."),
          optional("sampling", &CampaignSpec::sampling,
                   one_of<Sampling>({{"random", Sampling::kRandom},
                                     {"latin_hypercube", Sampling::kLatinHypercube},
                                     {"sobol", Sampling::kSobol}}),
                   "`random`: every member by itself. `latin_hypercube`: each number is drawn once "
                   "from every one of as many equally likely strata as there are members. `sobol`: "
                   "a scrambled Sobol' sequence; best with a power of two of members."),
          required("dispersions", &CampaignSpec::dispersions,
                   list_of(object(dispersion_table()), 1), "What is drawn."),
          optional("correlate", &CampaignSpec::correlate, list_of(correlation()),
                   "Pairs of drawn numbers and the correlation, between -1 and 1, of the normal "
                   "numbers behind them (a Gaussian copula)."),
          optional("outputs", &CampaignSpec::outputs, list_of(object(output_table())),
                   "What is asked of every flight."),
          optional("stop", &CampaignSpec::stop, list_of(object(stop_table())),
                   "What ends a member early."),
          optional("keep", &CampaignSpec::keep, object(keep_table()),
                   "Whose trajectories are kept."),
          optional("twin", &CampaignSpec::twin, object(twin_table()),
                   "How often both engines fly."),
      }};
  return table;
}

}  // namespace twincraft
