// See printed_time.h. Tested by tests/runtime/printed_time_test.cpp.
#include "runtime/report/printed_time.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>

namespace twincraft {
namespace {

/// digits * 10^exponent, rounded once.
double decimal(std::int64_t digits, int exponent) {
  const std::string text = fmt::format("{}e{}", digits, exponent);
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

PrintedTime::PrintedTime(double step) : step_(step) {
  constexpr int kDigits = 9;
  if (!(step > 0.0) || !std::isfinite(step)) return;
  const std::string text = fmt::format("{:.{}e}", step, kDigits - 1);  // 1.25000000e-01
  const std::size_t e = text.find('e');
  const std::string mantissa = text.substr(0, 1) + text.substr(2, e - 2);
  std::from_chars(mantissa.data(), mantissa.data() + mantissa.size(), digits_);
  const char* exponent = text.data() + e + (text[e + 1] == '+' ? 2 : 1);
  std::from_chars(exponent, text.data() + text.size(), exponent_);
  exponent_ -= kDigits - 1;
  for (; digits_ % 10 == 0; ++exponent_) digits_ /= 10;
  // A step by a rule, such as a third of a second, has more digits than these.
  if (decimal(digits_, exponent_) != step) digits_ = 0;
  power_ = decimal(1, -exponent_);
}

double PrintedTime::operator()(double time) const {
  constexpr double kMostSteps = 1.0e9;  // times nine digits they are an integer of 64 bits
  const double steps = std::round(time / step_);
  if (digits_ == 0 || !(steps >= 1.0 && steps <= kMostSteps) || steps * step_ != time) return time;
  const std::int64_t product = digits_ * static_cast<std::int64_t>(steps);
  // Both are exact doubles then, so that their quotient is rounded once.
  constexpr std::int64_t kExactInteger = std::int64_t{1} << 53;
  constexpr int kExactPower = 22;
  if (product <= kExactInteger && exponent_ <= 0 && -exponent_ <= kExactPower)
    return static_cast<double>(product) / power_;
  return decimal(product, exponent_);
}

}  // namespace twincraft
