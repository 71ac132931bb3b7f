// From the words of a campaign to a plan: where its paths lead, and what is wrong with it. See
// campaign_members.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compiler/ir/number.h"
#include "compiler/spec/amounts.h"
#include "compiler/spec/as_written.h"
#include "compiler/spec/campaign_members.h"
#include "compiler/syntax/overrides.h"

namespace twincraft {
namespace {

using Form = Place::Form;

bool is_scalars(Form form) {
  return form == Form::kNumber || form == Form::kList || form == Form::kVector;
}

/// What draws a value of this form.
std::string fitting(Form form) {
  if (form == Form::kDirection) return "`cone`";
  if (form == Form::kAttitude) return "`rotation`";
  if (form == Form::kInertia) return "`inertia`";
  return "`normal`, `uniform`, `lognormal`, `triangular` or `choice`";
}

/// Puts a plan together, dispersion by dispersion.
class Planner {
 public:
  Planner(const Spec& spec, Diagnostics& diagnostics)
      : spec_(spec),
        campaign_(*spec.campaign),
        resolved_(spec_table().write(spec)),
        diagnostics_(diagnostics) {}

  CampaignMembers plan() {
    for (const DispersionSpec& dispersion : campaign_.dispersions) add(dispersion);
    correlate();
    add_flight();
    members_.plan.members = static_cast<std::size_t>(campaign_.members);
    members_.plan.seed = static_cast<std::uint64_t>(campaign_.seed);
    members_.plan.sampling = campaign_.sampling;
    members_.columns = columns_.size();
    make_sampler();
    return std::move(members_);
  }

 private:
  /// A number that the sampler gives.
  struct Column {
    std::string name;
    bool is_scalar = false;  // a drawn number follows from it alone
  };

  void add(const DispersionSpec& dispersion) {
    const Span span = path_span(dispersion);
    const std::vector<std::string> path = parse_path(dispersion.set, span, diagnostics_);
    if (path.empty()) return;
    if (path.front() == "campaign" || path.front() == "format") {
      diagnostics_.error(Code::kCampaignPath, span,
                         fmt::format("a campaign cannot draw `{}`", path.front()));
      return;
    }
    const std::size_t first = columns_.size();
    for (Place& place : places_of(spec_, resolved_, path, span, diagnostics_)) {
      if (!is_new(place, span) || !fits(dispersion, place)) continue;
      add(dispersion, std::move(place), first);
    }
  }

  /// Neither drawn before nor part of what is.
  bool is_new(const Place& place, Span span) {
    const auto within = [](const std::string& part, const std::string& whole) {
      return part == whole || part.starts_with(whole + ".");
    };
    for (const auto& [earlier, where] : spans_)
      if (within(place.path, earlier) || within(earlier, place.path)) {
        diagnostics_
            .error(Code::kCampaignPath, span, fmt::format("`{}` is drawn twice", place.path))
            .with_note(where, "it is first drawn here");
        return false;
      }
    spans_.emplace_back(place.path, span);
    return true;
  }

  bool fits(const DispersionSpec& dispersion, const Place& place) {
    const std::string name = distribution_of(dispersion);
    const bool is_scalar = name != "cone" && name != "rotation" && name != "inertia";
    const bool good = is_scalar                        ? is_scalars(place.form)
                      : place.form == Form::kDirection ? name == "cone"
                      : place.form == Form::kAttitude
                          ? name == "rotation"
                          : name == "inertia" && place.form == Form::kInertia;
    if (!good)
      diagnostics_
          .error(Code::kCampaignForm, dispersion.span_of(name),
                 fmt::format("`{}` is {}, which `{}` does not draw", place.path,
                             describe(place.form), name))
          .with_hint("take " + fitting(place.form));
    return good;
  }

  /// @param first  of the columns of this dispersion
  void add(const DispersionSpec& dispersion, Place place, std::size_t first) {
    const std::vector<std::string> suffixes = suffixes_of(place);
    const Draw draw = draw_of(dispersion, place, suffixes);
    const bool shares = dispersion.together && columns_.size() > first;
    const std::size_t count = columns_of(draw);
    if (shares && columns_.size() - first != count) {
      diagnostics_.error(
          Code::kCampaignForm, dispersion.span_of("together"),
          fmt::format("`{}` has not as many numbers as the places before it", place.path));
      return;
    }
    const std::size_t begin = shares ? first : columns_.size();
    const std::string& name = dispersion.together ? dispersion.set : place.path;
    const bool is_scalar = is_scalars(place.form);
    for (std::size_t i = 0; i < count && !shares; ++i)
      columns_.push_back(
          {is_scalar ? name + suffixes[i] : fmt::format("{}#{}", name, i), is_scalar});
    const std::vector<double> nominals = nominal_numbers(place);
    const std::string words = words_of(dispersion);
    for (std::size_t i = 0; i < suffixes.size(); ++i)
      members_.plan.drawn.push_back(
          {place.path + suffixes[i], place.unit, words, nominals[i],
           !dispersion.together && (is_scalar || place.form == Form::kAttitude)});
    members_.places.push_back({std::move(place), draw, begin});
  }

  Draw draw_of(const DispersionSpec& dispersion, const Place& place,
               const std::vector<std::string>& suffixes) {
    if (dispersion.cone) return ConeDraw{dispersion.cone->sigma};
    if (dispersion.rotation) return RotationDraw{dispersion.rotation->sigma};
    if (dispersion.inertia)
      return InertiaDraw{
          read_sigma(dispersion.inertia->sigma, {place.path, "1", 1.0}, diagnostics_),
          dispersion.inertia->tilt};
    ScalarDraws scalars;
    for (std::size_t i = 0; i < suffixes.size(); ++i)
      scalars.each.push_back(read_distribution(
          dispersion, {place.path + suffixes[i], place.unit, place.values[i]}, diagnostics_));
    return scalars;
  }

  /// The column of a drawn number that is named in a correlation; what is none is reported.
  std::optional<std::size_t> find_column(const std::string& name, Span span) {
    std::vector<std::string> scalars;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!columns_[i].is_scalar) continue;
      if (columns_[i].name == name) return i;
      scalars.push_back(columns_[i].name);
    }
    const std::string near = nearest(name, scalars);
    const bool is_drawn = std::ranges::any_of(
        campaign_.dispersions, [&](const DispersionSpec& each) { return each.set == name; });
    diagnostics_
        .error(Code::kCampaignCorrelation, span,
               is_drawn ? fmt::format("{} is not one number", in_backticks(name))
                        : fmt::format("{} is not drawn", in_backticks(name)))
        .with_hint(near.empty() ? "numbers that are drawn can be correlated, one with another"
                                : fmt::format("did you mean `{}`?", near));
    return std::nullopt;
  }

  void correlate() {
    std::vector<draws::Correlation> pairs;
    for (const CorrelationSpec& written : campaign_.correlate) {
      const auto first = find_column(written.first, written.node->items[0].span);
      const auto second = find_column(written.second, written.node->items[1].span);
      if (!first || !second) continue;
      if (is_pair_of_its_own(written, *first, *second, pairs))
        pairs.push_back({*first, *second, written.rho});
      for (DrawnNumber& number : members_.plan.drawn)
        if (number.name == written.first || number.name == written.second)
          number.is_independent = false;
    }
    if (pairs.empty() || pairs.size() < campaign_.correlate.size()) return;
    members_.copula = draws::Copula::of(pairs);
    if (!members_.copula)
      diagnostics_
          .error(Code::kCampaignCorrelation, campaign_.span_of("correlate"),
                 "no numbers can be correlated so: the matrix of correlations is not positive "
                 "definite")
          .with_hint("pairs that are not written have correlation 0; lower the others");
  }

  bool is_pair_of_its_own(const CorrelationSpec& written, std::size_t first, std::size_t second,
                          const std::vector<draws::Correlation>& pairs) {
    const auto is_same = [&](const draws::Correlation& pair) {
      return std::minmax(pair.first, pair.second) == std::minmax(first, second);
    };
    std::string fault;
    Span span = written.node->items[1].span;
    if (first == second) {
      fault = fmt::format("{} with itself", in_backticks(written.first));
    } else if (std::ranges::any_of(pairs, is_same)) {
      fault = "this pair is correlated twice";
    } else if (std::abs(written.rho) >= 1.0) {
      fault = fmt::format("a correlation of {} is not between -1 and 1", shortest(written.rho));
      span = written.node->items[2].span;
    }
    if (fault.empty()) return true;
    diagnostics_.error(Code::kCampaignCorrelation, span, fault);
    return false;
  }

  /// What is asked of the flight. Where the nominal vehicle has faults they are told elsewhere.
  void add_flight() {
    CampaignPlan& plan = members_.plan;
    Diagnostics known;
    const bool asks = !campaign_.outputs.empty() || !campaign_.stop.empty();
    if (const std::optional<Model> model = asks ? lower(spec_, known) : std::nullopt) {
      plan.outputs = plan_of(campaign_.outputs, *model, diagnostics_);
      plan.stops = plan_of(campaign_.stop, *model, diagnostics_);
    }
    plan.twin_every = static_cast<std::size_t>(campaign_.twin.every);
    plan.keep_worst = static_cast<std::size_t>(campaign_.keep.worst);
    plan.keep_by = campaign_.keep.by.value_or("");
    for (const int member : campaign_.keep.members)
      plan.keep_members.push_back(static_cast<std::size_t>(member));
    check_keep();
  }

  void check_keep() {
    const KeepSpec& keep = campaign_.keep;
    std::vector<std::string> names;
    for (const OutputSpec& output : campaign_.outputs) names.push_back(output.name);
    if (keep.worst > 0 && !keep.by)
      diagnostics_
          .error(Code::kMissingKey, keep.span_of("worst"), "`worst` does not say by which output")
          .with_hint("add `by`, the name of an output");
    if (keep.by && std::ranges::find(names, *keep.by) == names.end()) {
      const std::string near = nearest(*keep.by, names);
      diagnostics_
          .error(Code::kCampaignKeep, keep.span_of("by"),
                 fmt::format("`{}` is no output of the campaign", *keep.by))
          .with_hint(near.empty() ? "" : fmt::format("did you mean `{}`?", near));
    }
    for (std::size_t i = 0; i < keep.members.size(); ++i)
      if (keep.members[i] >= campaign_.members)
        diagnostics_.error(Code::kCampaignKeep, keep.node->find("members")->items[i].span,
                           fmt::format("there is no member {}: the last of {} is {}",
                                       keep.members[i], campaign_.members, campaign_.members - 1));
  }

  void make_sampler() {
    if (campaign_.sampling == Sampling::kSobol &&
        columns_.size() > draws::SobolSequence::kMostColumns) {
      diagnostics_
          .error(Code::kCampaignSobol, campaign_.span_of("sampling"),
                 fmt::format("the campaign draws {} numbers, a Sobol' sequence has {} dimensions",
                             columns_.size(), draws::SobolSequence::kMostColumns))
          .with_hint("take `latin_hypercube` or `random`");
      return;
    }
    std::vector<std::string> names;
    for (const Column& column : columns_) names.push_back(column.name);
    members_.sampler.emplace(members_.plan.sampling, members_.plan.seed, members_.plan.members,
                             names);
  }

  const Spec& spec_;
  const CampaignSpec& campaign_;
  Json resolved_;
  Diagnostics& diagnostics_;
  CampaignMembers members_;
  std::vector<Column> columns_;
  std::vector<std::pair<std::string, Span>> spans_;  // of what is drawn already
};

}  // namespace

std::optional<CampaignMembers> members_of(const Spec& spec, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  CampaignMembers members = Planner(spec, diagnostics).plan();
  if (diagnostics.error_count() != errors_before) return std::nullopt;
  return members;
}

}  // namespace twincraft
