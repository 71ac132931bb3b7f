// The numbers of a model by name, prepared for Python: what a dict of them is made of, and where a
// name's numbers are.
#pragma once

#include <nanobind/nanobind.h>
#include <twincraft/simulation.h>

#include <cstddef>
#include <string>
#include <vector>

namespace twincraft::python {

namespace nb = nanobind;

class Signals {
 public:
  Signals(const Model& model, tc_signals which);

  std::size_t size() const { return size_; }
  /// Of every number, in order.
  const nb::list& names() const { return names_; }
  /// (name, unit, meaning) of every number.
  const nb::list& described() const { return described_; }

  /// A dict of floats, and of arrays for vectors; `fill` writes the numbers.
  template <class Fill>
  nb::object dict(const Fill& fill) const;

  /// The numbers of a name, of one number or of a vector. @throws InputError: there is none
  Range find(nb::handle name) const;
  bool contains(nb::handle name) const { return known(name) != nullptr; }
  std::string name(std::size_t i) const { return nb::cast<std::string>(names_[i]); }

 private:
  struct Entry {
    nb::object name;
    Range range;
    nb::object slice;  // of a vector
  };
  const Range* known(nb::handle name) const;
  void add_entry(const std::string& name, Range range);
  nb::object dict_of(const nb::object& array, const double* numbers) const;

  Model model_;
  tc_signals which_;
  std::size_t size_;
  nb::list names_, described_;
  std::vector<Entry> entries_;  // in order: numbers that stand alone, and vectors
  nb::dict index_;              // name to place in ranges_
  std::vector<Range> ranges_;
};

}  // namespace twincraft::python

#include "runtime/api/python/arrays.h"

namespace twincraft::python {

template <class Fill>
nb::object Signals::dict(const Fill& fill) const {
  const double* numbers = nullptr;
  const nb::object array = writable_array({size_}, [&](double* to, std::size_t count) {
    fill(to, count);
    numbers = to;
  });
  return dict_of(array, numbers);
}

}  // namespace twincraft::python
