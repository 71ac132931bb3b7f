// The books of kernel.h, compiled like kernel.cpp but apart from it: what is inlined here must not
// keep anything from being inlined into a step. Tested by tests/runtime/books_test.cpp.
#include "runtime/bsm/bookkeeper.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

// Flattened, or sums would pass through memory and be read, wider than they were written, while
// they are on their way there.
template <class H, class S>
[[gnu::flatten]] void put_books(Vehicle<H, S>& vehicle, const Number<H>* state,
                                std::span<BookRates> rates) {
  const BooksOf<H> books = Bookkeeper<H, S>(vehicle, state).books();
  const auto put = [](const Vec<H>& v, std::size_t l, double* to) {
    to[0] = lane(v.x, l);
    to[1] = lane(v.y, l);
    to[2] = lane(v.z, l);
  };
  for (std::size_t l = 0; l < kLanes<H>; ++l) {
    BookRates& to = rates.data()[l];
    to.power = lane(books.power, l);
    to.own_power = lane(books.own_power, l);
    put(books.force_N, l, to.force_N.data());
    put(books.torque_PntC_N, l, to.torque_PntC_N.data());
  }
}

template void put_books(Vehicle<double, Pair>&, const double*, std::span<BookRates>);
template void put_books(Vehicle<Batch, Batch>&, const double*, std::span<BookRates>);

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
