#include "runtime/statistics/sobol.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include "runtime/statistics/sample.h"

namespace twincraft::statistics {
namespace {

constexpr std::size_t kFewestMembers = 16;
constexpr double kNormal95 = 1.959963984540054;  // of a standard normal, 2.5 % are larger

using Column = std::span<const double>;
/// How often each member was drawn.
using Weights = std::vector<double>;
/// The indices of members with these weights.
using Estimate = std::function<std::vector<double>(const Weights& weights)>;

bool has_hole(Column values) {
  return std::ranges::any_of(values, [](double value) { return std::isnan(value); });
}

bool is_constant(Column values) {
  return std::ranges::adjacent_find(values, std::not_equal_to<>()) == values.end();
}

/// @return no hole, enough members, and something to explain
bool can_be_explained(Column output) {
  return output.size() >= kFewestMembers && !has_hole(output) && !is_constant(output);
}

std::vector<double> centred(Column values, double mean) {
  std::vector<double> off(values.begin(), values.end());
  for (double& value : off) value -= mean;
  return off;
}

void draw_again(std::mt19937_64& random, Weights& weights) {
  std::ranges::fill(weights, 0.0);
  std::uniform_int_distribution<std::size_t> member(0, weights.size() - 1);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[member(random)] += 1.0;
}

/// Each index of all members, with the spread that it has over members drawn again.
std::vector<Index> with_intervals(std::size_t members, const Estimate& estimate,
                                  const Resampling& resampling) {
  Weights weights(members, 1.0);
  const std::vector<double> values = estimate(weights);
  std::vector<std::vector<double>> redrawn(values.size());
  std::mt19937_64 random(resampling.seed);
  for (std::size_t time = 0; time < resampling.times; ++time) {
    draw_again(random, weights);
    const std::vector<double> again = estimate(weights);
    for (std::size_t i = 0; i < values.size(); ++i) redrawn[i].push_back(again[i]);
  }
  std::vector<Index> indices;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double reach = kNormal95 * moments(redrawn[i]).deviation;
    indices.push_back({values[i], values[i] - reach, values[i] + reach});
  }
  return indices;
}

/// Members of similar rank of an input. Members with equal inputs are in one class.
struct Classes {
  std::vector<std::uint8_t> of_member;
  std::size_t count = 1;
};

constexpr std::size_t kMostClasses = 64;

Classes classes_of(Column input) {
  const std::size_t n = input.size();
  const std::size_t wanted =
      std::min(kMostClasses, static_cast<std::size_t>(std::sqrt(static_cast<double>(n))));
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return input[i]; });
  Classes classes{std::vector<std::uint8_t>(n)};
  for (std::size_t place = 0, filled = 0; place < n; ++place, ++filled) {
    const bool is_new = place > 0 && input[order[place]] != input[order[place - 1]];
    if (is_new && filled * wanted >= n) {
      ++classes.count;
      filled = 0;
    }
    classes.of_member[order[place]] = static_cast<std::uint8_t>(classes.count - 1);
  }
  return classes;
}

/// What members have together: how many they are, and the sums of their outputs and squares.
struct Sums {
  double weight = 0.0, sum = 0.0, squares = 0.0;

  void add(double by, double value) {
    weight += by;
    sum += by * value;
    squares += by * value * value;
  }
  double about_mean() const { return squares - sum * sum / weight; }
};

/// Share of the variance that lies between classes, without what noise brings there: `epsilon
/// squared` of an analysis of variance. @param output  of mean 0, so that no digits are lost
double between_classes(const Classes& classes, Column output, const Weights& weights) {
  std::vector<Sums> of_class(classes.count);
  Sums all;
  for (std::size_t i = 0; i < output.size(); ++i) {
    of_class[classes.of_member[i]].add(weights[i], output[i]);
    all.add(weights[i], output[i]);
  }
  double within = 0.0, drawn = 0.0;
  for (const Sums& one : of_class)
    if (one.weight > 0.0) {
      within += one.about_mean();
      drawn += 1.0;
    }
  const double total = all.about_mean();
  if (drawn < 2.0 || !(total > 0.0)) return 0.0;
  const double noise = within / (all.weight - drawn);  // variance
  return (total - within - (drawn - 1.0) * noise) / total;
}

/// First indices, then total ones.
std::vector<double> saltelli_indices(const std::vector<double>& a, const std::vector<double>& b,
                                     const std::vector<std::vector<double>>& a_with_b,
                                     const Weights& weights) {
  Sums all;
  for (std::size_t i = 0; i < a.size(); ++i) {
    all.add(weights[i], a[i]);
    all.add(weights[i], b[i]);
  }
  const double variance = all.about_mean() / all.weight;
  std::vector<double> first, total;
  for (const std::vector<double>& mixed : a_with_b) {
    double carried = 0.0, left = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double change = mixed[i] - a[i];
      carried += weights[i] * b[i] * change;
      left += weights[i] * change * change;
    }
    const double scale = static_cast<double>(a.size()) * variance;
    first.push_back(variance > 0.0 ? carried / scale : 0.0);
    total.push_back(variance > 0.0 ? 0.5 * left / scale : 0.0);
  }
  first.insert(first.end(), total.begin(), total.end());
  return first;
}

}  // namespace

std::optional<std::vector<Index>> sobol_given_data(std::span<const std::span<const double>> inputs,
                                                   std::span<const double> output,
                                                   const Resampling& resampling) {
  if (!can_be_explained(output) || std::ranges::any_of(inputs, has_hole)) return std::nullopt;
  std::vector<Classes> classes;
  for (const Column input : inputs) classes.push_back(classes_of(input));
  const std::vector<double> off = centred(output, moments(output).mean);
  const Estimate estimate = [&](const Weights& weights) {
    std::vector<double> values;
    for (const Classes& one : classes) values.push_back(between_classes(one, off, weights));
    return values;
  };
  return with_intervals(output.size(), estimate, resampling);
}

std::optional<SaltelliIndices> sobol_saltelli(const SaltelliDesign& design,
                                              const Resampling& resampling) {
  if (!can_be_explained(design.a) || has_hole(design.b) ||
      std::ranges::any_of(design.a_with_b, has_hole))
    return std::nullopt;
  const double mean = 0.5 * (moments(design.a).mean + moments(design.b).mean);
  const std::vector<double> a = centred(design.a, mean), b = centred(design.b, mean);
  std::vector<std::vector<double>> a_with_b;
  for (const Column mixed : design.a_with_b) a_with_b.push_back(centred(mixed, mean));
  const Estimate estimate = [&](const Weights& weights) {
    return saltelli_indices(a, b, a_with_b, weights);
  };
  const std::vector<Index> both = with_intervals(a.size(), estimate, resampling);
  const auto middle = both.begin() + static_cast<std::ptrdiff_t>(a_with_b.size());
  return SaltelliIndices{{both.begin(), middle}, {middle, both.end()}};
}

}  // namespace twincraft::statistics
