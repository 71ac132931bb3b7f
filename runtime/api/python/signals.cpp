// See signals.h.
#include "runtime/api/python/signals.h"

#include <nanobind/stl/string.h>

#include "runtime/api/python/faults.h"

namespace twincraft::python {
namespace {

/// The vector that a number belongs to, and where; itself where it stands alone.
std::pair<std::string, Range> whole_of(const Model& model, tc_signals which,
                                       const std::string& name, std::size_t i) {
  const std::size_t dot = name.rfind('.');
  if (dot != std::string::npos) {
    std::size_t first = 0, count = 0;
    const std::string vector = name.substr(0, dot);
    if (tc_model_find(model.handle(), which, vector.c_str(), &first, &count) == TC_OK &&
        count > 1 && first <= i && i < first + count)
      return {vector, {first, count}};
  }
  return {name, {i, 1}};
}

}  // namespace

Signals::Signals(const Model& model, tc_signals which)
    : model_(model), which_(which), size_(model.count(which)) {
  const std::vector<Signal> all = model.signals(which);
  for (std::size_t i = 0; i < all.size(); ++i) {
    names_.append(all[i].name);
    described_.append(nb::make_tuple(all[i].name, all[i].unit, all[i].meaning));
    const auto [vector, range] = whole_of(model, which, all[i].name, i);
    if (range.first == i) add_entry(vector, range);
    index_[names_[i]] = ranges_.size();
    ranges_.push_back({i, 1});
  }
}

void Signals::add_entry(const std::string& name, Range range) {
  Entry entry{nb::steal(PyUnicode_InternFromString(name.c_str())), range, {}};
  if (range.count > 1) {
    const nb::int_ begin(range.first), end(range.first + range.count);
    entry.slice = nb::steal(PySlice_New(begin.ptr(), end.ptr(), nullptr));
    index_[entry.name] = ranges_.size();
    ranges_.push_back(range);
  }
  entries_.push_back(std::move(entry));
}

nb::object Signals::dict_of(const nb::object& array, const double* numbers) const {
  nb::dict all;
  for (const Entry& entry : entries_) {
    const nb::object value =
        nb::steal(entry.range.count == 1 ? PyFloat_FromDouble(numbers[entry.range.first])
                                         : PyObject_GetItem(array.ptr(), entry.slice.ptr()));
    if (!value.is_valid() || PyDict_SetItem(all.ptr(), entry.name.ptr(), value.ptr()) != 0)
      throw nb::python_error();
  }
  return all;
}

const Range* Signals::known(nb::handle name) const {
  if (!PyUnicode_Check(name.ptr())) return nullptr;
  PyObject* place = PyDict_GetItemWithError(index_.ptr(), name.ptr());
  return place == nullptr ? nullptr : &ranges_[PyLong_AsSize_t(place)];
}

Range Signals::find(nb::handle name) const {
  if (const Range* range = known(name)) return *range;
  if (!PyUnicode_Check(name.ptr()))
    refuse_input("a name is a str, not " + nb::cast<std::string>(nb::repr(name)));
  try {
    return model_.find(which_, nb::cast<std::string>(name));
  } catch (const UsageError& error) {
    refuse_input(error.what());  // it says which name is near
  }
}

}  // namespace twincraft::python
