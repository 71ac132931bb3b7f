// See kernel.h. This file is compiled once per instruction set. Only what lives in the namespace of
// that set may come out of it: tests/architecture looks. Tested by tests/runtime/kernel_test.cpp.
#include "runtime/bsm/kernel.h"

#include "runtime/bsm/book_page.h"
#include "runtime/bsm/vehicle.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

// In kernel_books.cpp.

/// On the next page. When all are written they are settled.
/// @pre the vehicle's derivative() has last been asked at this state
template <class H, class S>
void write_books(Vehicle<H, S>& vehicle, const Number<H>* state, BookPages<H>& pages,
                 BookRates* rates);
/// Of all pages, which then are free.
template <class H, class S>
void settle_books(const Vehicle<H, S>& vehicle, BookPages<H>& pages);

namespace {

template <class H, class S>
class VehicleKernel final : public Kernel {
 public:
  explicit VehicleKernel(std::span<const Plan* const> plans) : vehicle_(plans) {}

  std::size_t lanes() const override { return kLanes<H>; }
  void hold(std::span<const HeldInputs* const> held) override {
    pages_.clear();  // of a step that did not come to its end
    vehicle_.hold(held);
  }
  void derivative(double time, const double* state, double* rate) override {
    vehicle_.derivative(time, state, rate);
  }
  void derivative_to_book(double time, const double* state, double* rate,
                          BookRates* books) override {
    vehicle_.derivative(time, state, rate);
    write_books(vehicle_, state, pages_, books);
  }
  void settle_books() override { TWINCRAFT_KERNEL::settle_books<H, S>(vehicle_, pages_); }
  void finish_step(double* state) const override { vehicle_.finish_step(state); }

  void hub_equation(std::span<double, 42> equation) const override {
    const Law<H>& hub = vehicle_.last_hub_law();
    const auto at = [](const H& value) { return lane(value, 0); };
    const auto put = [&](int row, int column, const H& value) {
      equation[static_cast<std::size_t>(6 * row + column)] = at(value);
    };
    const auto put_row = [&](int row, int column, const Vec<H>& v) {
      put(row, column, v.x);
      put(row, column + 1, v.y);
      put(row, column + 2, v.z);
    };
    put_row(0, 0, hub.M.column_x());
    put_row(1, 0, hub.M.column_y());
    put_row(2, 0, hub.M.column_z());
    put_row(0, 3, hub.H.x);
    put_row(1, 3, hub.H.y);
    put_row(2, 3, hub.H.z);
    put_row(3, 0, hub.H.row_x());
    put_row(4, 0, hub.H.row_y());
    put_row(5, 0, hub.H.row_z());
    put_row(3, 3, hub.J.column_x());
    put_row(4, 3, hub.J.column_y());
    put_row(5, 3, hub.J.column_z());
    put_row(6, 0, -hub.f0);
    put_row(6, 3, -hub.n0);
  }

 private:
  Vehicle<H, S> vehicle_;
  BookPages<H> pages_;
};

}  // namespace

Kernel* new_kernel(const Plan* plan) {
  return new VehicleKernel<double, Pair>(std::span<const Plan* const>(&plan, 1));
}

Kernel* new_batch_kernel(std::span<const Plan* const> plans) {
  return new VehicleKernel<Batch, Batch>(plans);
}

std::size_t lanes_of_batch() { return kLanes<Batch>; }

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
