// What an evaluation leaves to its books. Pages wait until there are as many as lanes, for books of
// all of them cost little more than of one: see kernel_books.cpp.
// Tested by tests/runtime/books_test.cpp.
#pragma once

#include <array>

#include "runtime/bsm/outside.h"
#include "runtime/engine/observation.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// What changes the books of a vehicle, beside motors, efforts and dampers within it.
struct BookCauses {
  bool drive = false;  // loads and mass that leaves: no potential covers them
  bool flow = false;   // mass leaves
  bool fall = false;   // gravity
  bool pull = false;   // gravity that differs from that at B

  bool are_inner() const { return !drive && !fall && !pull; }
};

/// A number and a vector side by side in memory, as sums over lanes come out.
template <class S>
struct Four {
  S value{};
  Vec<S> vector;
};

/// Sums over the vehicle, about B in hub axes, and how the hub is.
template <class S>
struct BookPage {
  Four<S> mass;     // [kg], [kg m] first moment
  Four<S> motion;   // [W] inner power; [kg m/s] momentum seen from the hub's axes
  Four<S> leaving;  // [kg/s], [kg m/s] of limbs, as `mass`
  Four<S> driving;  // [W], [N] by loads but those held on the hub, and by what leaves limbs
  Four<S> turning;  // [N m] torque of these; [W] what is not power on the vehicle's own motion
  Four<S> pulls;    // [W] seen from the hub's axes, [N] by gravity beyond that at B
  Four<S> twists;   // [N m] torque of these; [W] by gradient torques, which no potential covers
  Vec<S> omega, v_BN_N;
  Vec<S> fall;  // [m/s^2] gravity at B, in N
  Mat<S> dcm_NB;
};

/// As many as are taken at once.
template <class H>
class BookPages {
 public:
  /// A scalar with a lane for each page of one spacecraft, or for each spacecraft of one page.
  using T = std::conditional_t<kLanes<H> == 1, Abreast, H>;
  static constexpr std::size_t kPages = kLanes<T> / kLanes<H>;

  /// @param rates  of every spacecraft: where the books of this page are to be put
  BookPage<H>& next(BookRates* rates) {
    rates_[count_] = rates;
    return pages_[count_++];
  }
  bool wait() const { return count_ > 0; }
  bool are_full() const { return count_ == kPages; }
  void clear() { count_ = 0; }

  /// Let those that are free be like the first.
  void fill() {
    for (std::size_t l = count_; l < kPages; ++l) {
      pages_[l] = pages_[0];
      rates_[l] = &nowhere_;
    }
  }
  /// The same number of all. @param number  picks it from a page
  template <class Pick>
  T each(const Pick& number) const {
    if constexpr (kPages == 1) {
      return number(pages_[0]);
    } else {
      std::array<const H*, kPages> numbers;
      for (std::size_t l = 0; l < kPages; ++l) numbers[l] = &number(pages_[l]);
      return entry_of_each(numbers, 0);
    }
  }
  /// Where the books of page l belong.
  BookRates* rates(std::size_t l) { return rates_[l]; }

 private:
  std::array<BookPage<H>, kPages> pages_;
  std::array<BookRates*, kPages> rates_{};
  BookRates nowhere_;
  std::size_t count_ = 0;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
