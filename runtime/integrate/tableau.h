// Explicit Runge-Kutta methods as data (Butcher tableaux): everything the stepper knows about a
// method is here. The embedded pairs propagate their lower-order solution, as the published
// comparison does, and judge it by the higher-order one.
// Source of the pairs: E. Fehlberg, NASA TR R-315 (4(5)) and NASA TR R-287 (7(8)).
// Tested by tests/runtime/tableau_test.cpp.
#pragma once

#include <array>
#include <string_view>

#include "compiler/ir/model.h"

namespace twincraft {

/// k_i = f(t + c_i h, y + h sum_j a_ij k_j),  y(t + h) = y + h sum_i b_i k_i.
struct Tableau {
  static constexpr int kMaxStages = 13;
  using Row = std::array<double, kMaxStages>;

  std::string_view name;            // as in the spec
  int stages = 0;                   // s; entries beyond are zero
  int order = 0;                    // of the solution that is propagated
  Row c{};                          // stage times
  std::array<Row, kMaxStages> a{};  // strictly lower triangular
  Row b{};                          // the propagated solution
  Row b_hat{};                      // the comparison solution; all zero without one

  /// An embedded pair controls its step: the error estimate is h sum_i (b_i - b_hat_i) k_i, of
  /// order h^(order + 1), so the next step scales with the error to the power -1/(order + 1).
  bool adaptive = false;
  constexpr double control_exponent() const { return 1.0 / (order + 1); }
};

inline constexpr Tableau kEuler{.name = "euler", .stages = 1, .order = 1, .b = {1.0}};

/// Heun's explicit trapezoid.
inline constexpr Tableau kRk2{.name = "rk2",
                              .stages = 2,
                              .order = 2,
                              .c = {0.0, 1.0},
                              .a = {{{}, {1.0}}},
                              .b = {1.0 / 2, 1.0 / 2}};

/// The classical fourth-order method.
inline constexpr Tableau kRk4{.name = "rk4",
                              .stages = 4,
                              .order = 4,
                              .c = {0.0, 1.0 / 2, 1.0 / 2, 1.0},
                              .a = {{{}, {1.0 / 2}, {0.0, 1.0 / 2}, {0.0, 0.0, 1.0}}},
                              .b = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};

inline constexpr Tableau kRkf45{
    .name = "rkf45",
    .stages = 6,
    .order = 4,
    .c = {0.0, 1.0 / 4, 3.0 / 8, 12.0 / 13, 1.0, 1.0 / 2},
    .a = {{{},
           {1.0 / 4},
           {3.0 / 32, 9.0 / 32},
           {1932.0 / 2197, -7200.0 / 2197, 7296.0 / 2197},
           {439.0 / 216, -8.0, 3680.0 / 513, -845.0 / 4104},
           {-8.0 / 27, 2.0, -3544.0 / 2565, 1859.0 / 4104, -11.0 / 40}}},
    .b = {25.0 / 216, 0.0, 1408.0 / 2565, 2197.0 / 4104, -1.0 / 5},
    .b_hat = {16.0 / 135, 0.0, 6656.0 / 12825, 28561.0 / 56430, -9.0 / 50, 2.0 / 55},
    .adaptive = true};

/// Its error estimate is 41/840 (k_1 + k_11 - k_12 - k_13) h: blind to a right-hand side that
/// depends on time alone, since those stages are at the two ends of the step.
inline constexpr Tableau kRkf78{
    .name = "rkf78",
    .stages = 13,
    .order = 7,
    .c = {0.0, 2.0 / 27, 1.0 / 9, 1.0 / 6, 5.0 / 12, 1.0 / 2, 5.0 / 6, 1.0 / 6, 2.0 / 3, 1.0 / 3,
          1.0, 0.0, 1.0},
    .a = {{{},
           {2.0 / 27},
           {1.0 / 36, 1.0 / 12},
           {1.0 / 24, 0.0, 1.0 / 8},
           {5.0 / 12, 0.0, -25.0 / 16, 25.0 / 16},
           {1.0 / 20, 0.0, 0.0, 1.0 / 4, 1.0 / 5},
           {-25.0 / 108, 0.0, 0.0, 125.0 / 108, -65.0 / 27, 125.0 / 54},
           {31.0 / 300, 0.0, 0.0, 0.0, 61.0 / 225, -2.0 / 9, 13.0 / 900},
           {2.0, 0.0, 0.0, -53.0 / 6, 704.0 / 45, -107.0 / 9, 67.0 / 90, 3.0},
           {-91.0 / 108, 0.0, 0.0, 23.0 / 108, -976.0 / 135, 311.0 / 54, -19.0 / 60, 17.0 / 6,
            -1.0 / 12},
           {2383.0 / 4100, 0.0, 0.0, -341.0 / 164, 4496.0 / 1025, -301.0 / 82, 2133.0 / 4100,
            45.0 / 82, 45.0 / 164, 18.0 / 41},
           {3.0 / 205, 0.0, 0.0, 0.0, 0.0, -6.0 / 41, -3.0 / 205, -3.0 / 41, 3.0 / 41, 6.0 / 41},
           {-1777.0 / 4100, 0.0, 0.0, -341.0 / 164, 4496.0 / 1025, -289.0 / 82, 2193.0 / 4100,
            51.0 / 82, 33.0 / 164, 12.0 / 41, 0.0, 1.0}}},
    .b = {41.0 / 840, 0.0, 0.0, 0.0, 0.0, 34.0 / 105, 9.0 / 35, 9.0 / 35, 9.0 / 280, 9.0 / 280,
          41.0 / 840},
    .b_hat = {0.0, 0.0, 0.0, 0.0, 0.0, 34.0 / 105, 9.0 / 35, 9.0 / 35, 9.0 / 280, 9.0 / 280, 0.0,
              41.0 / 840, 41.0 / 840},
    .adaptive = true};

constexpr const Tableau& tableau_of(Method method) {
  switch (method) {
    case Method::kEuler:
      return kEuler;
    case Method::kRk2:
      return kRk2;
    case Method::kRk4:
      return kRk4;
    case Method::kRkf45:
      return kRkf45;
    case Method::kRkf78:
      break;
  }
  return kRkf78;
}

}  // namespace twincraft
