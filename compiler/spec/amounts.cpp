// See amounts.h.
#include "compiler/spec/amounts.h"

#include <fmt/format.h>

#include <cmath>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

/// [SI] 0 after a fault.
double read_amount(const Node& written, const char* key, const NominalNumber& of,
                   Diagnostics& diagnostics) {
  ReadContext context{diagnostics, fmt::format("`{}` of `{}`", key, of.name)};
  if (!written.scalar.ends_with('%'))
    return read_quantity(written, of.unit, {}, context).value_or(0.0);
  Node percent = written;
  percent.scalar.pop_back();
  const std::optional<double> value = read_number(percent, context);
  if (value && of.value == 0.0)
    diagnostics
        .error(Code::kCampaignPercent, written.span,
               fmt::format("{} is a part of the nominal value, which is 0", context.where))
        .with_hint(fmt::format("write a quantity [{}]", of.unit));
  return value.value_or(0.0) * of.value / 100.0;
}

bool check_order(double low, double high, Span span, const NominalNumber& of,
                 Diagnostics& diagnostics) {
  if (low <= high) return true;
  diagnostics.error(Code::kCampaignBounds, span,
                    fmt::format("`high` of `{}` is {} {}, below its `low`, {}", of.name,
                                shortest(high), of.unit, shortest(low)));
  return false;
}

draws::Distribution read_normal(const NormalSpec& spec, const NominalNumber& of,
                                Diagnostics& diagnostics) {
  return draws::Normal{of.value, read_sigma(spec.sigma, of, diagnostics), spec.truncate};
}

draws::Distribution read_uniform(const UniformSpec& spec, const NominalNumber& of,
                                 Diagnostics& diagnostics) {
  const draws::Uniform range{read_amount(spec.low, "low", of, diagnostics),
                             read_amount(spec.high, "high", of, diagnostics)};
  check_order(range.low, range.high, spec.span_of("high"), of, diagnostics);
  return range;
}

draws::Distribution read_lognormal(const LognormalSpec& spec, const NominalNumber& of,
                                   Diagnostics& diagnostics) {
  if (of.value == 0.0) {
    diagnostics
        .error(Code::kCampaignBounds, spec.span_of("sigma"),
               fmt::format("the nominal value of `{}` is 0, which no factor changes", of.name))
        .with_hint("`normal` draws about 0");
    return draws::Lognormal{};
  }
  return draws::Lognormal{of.value, read_sigma(spec.sigma, of, diagnostics)};
}

draws::Distribution read_triangular(const TriangularSpec& spec, const NominalNumber& of,
                                    Diagnostics& diagnostics) {
  draws::Triangular triangle{read_amount(spec.low, "low", of, diagnostics),
                             read_amount(spec.high, "high", of, diagnostics), of.value};
  if (spec.mode) triangle.mode = read_amount(*spec.mode, "mode", of, diagnostics);
  if (!check_order(triangle.low, triangle.high, spec.span_of("high"), of, diagnostics))
    return triangle;
  if (triangle.mode < triangle.low || triangle.mode > triangle.high)
    diagnostics.error(Code::kCampaignBounds, spec.span_of("mode"),
                      fmt::format("the mode of `{}`, {} {}, is not between its bounds, {} and {}",
                                  of.name, shortest(triangle.mode), of.unit, shortest(triangle.low),
                                  shortest(triangle.high)));
  return triangle;
}

draws::Distribution read_choice(const ChoiceSpec& spec, const NominalNumber& of,
                                Diagnostics& diagnostics) {
  draws::Choice choice;
  for (const Node& value : spec.values)
    choice.values.push_back(read_amount(value, "values", of, diagnostics));
  return choice;
}

}  // namespace

std::string distribution_of(const DispersionSpec& dispersion) {
  for (const char* name :
       {"normal", "uniform", "lognormal", "triangular", "choice", "cone", "rotation", "inertia"})
    if (dispersion.has(name)) return name;
  return {};
}

std::string words_of(const DispersionSpec& dispersion) {
  std::string words = distribution_of(dispersion);
  const Node& map = *dispersion.node->find(words);
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    std::vector<std::string> texts{map.items[i].scalar};
    if (map.items[i].is_list()) texts.clear();
    for (const Node& item : map.items[i].items) texts.push_back(item.scalar);
    words += fmt::format(", {} {}", map.keys[i].name, fmt::join(texts, " or "));
  }
  return words;
}

draws::Distribution read_distribution(const DispersionSpec& dispersion, const NominalNumber& of,
                                      Diagnostics& diagnostics) {
  if (dispersion.normal) return read_normal(*dispersion.normal, of, diagnostics);
  if (dispersion.uniform) return read_uniform(*dispersion.uniform, of, diagnostics);
  if (dispersion.lognormal) return read_lognormal(*dispersion.lognormal, of, diagnostics);
  if (dispersion.triangular) return read_triangular(*dispersion.triangular, of, diagnostics);
  return read_choice(*dispersion.choice, of, diagnostics);
}

double read_sigma(const Node& written, const NominalNumber& of, Diagnostics& diagnostics) {
  const double sigma =
      read_amount(written, "sigma", {of.name, of.unit, std::abs(of.value)}, diagnostics);
  ReadContext context{diagnostics, fmt::format("`sigma` of `{}`", of.name)};
  check_range(sigma, Range::kNotNegative, written, context);
  return sigma;
}

}  // namespace twincraft
