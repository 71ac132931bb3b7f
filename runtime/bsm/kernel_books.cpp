// The books of kernel.h, compiled like kernel.cpp but apart from it: what is inlined here must not
// keep anything from being inlined into a step. Tested by tests/runtime/books_test.cpp.
#include "runtime/bsm/bookkeeper.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
BooksOf<H> books_of(Vehicle<H, S>& vehicle, const Number<H>* state) {
  return Bookkeeper<H, S>(vehicle, state).books();
}

template BooksOf<double> books_of(Vehicle<double, Pair>&, const double*);
template BooksOf<Batch> books_of(Vehicle<Batch, Batch>&, const double*);

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
