// numpy arrays of numbers that nobody else holds.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <memory>

namespace twincraft::python {

namespace nb = nanobind;

/// @param fill  writes all numbers, and may throw
template <class Number, class Shown, class Fill>
nb::object new_array(std::initializer_list<std::size_t> shape, const Fill& fill) {
  std::size_t count = 1;
  for (const std::size_t n : shape) count *= n;
  auto numbers = std::make_unique<Number[]>(count > 0 ? count : 1);
  fill(numbers.get(), count);
  Number* data = numbers.release();
  const nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<Number*>(p); });
  return nb::cast(nb::ndarray<nb::numpy, Shown>(data, shape, owner));
}

template <class Fill>
nb::object writable_array(std::initializer_list<std::size_t> shape, const Fill& fill) {
  return new_array<double, double>(shape, fill);
}

template <class Fill>
nb::object read_only_array(std::initializer_list<std::size_t> shape, const Fill& fill) {
  return new_array<double, const double>(shape, fill);
}

}  // namespace twincraft::python
