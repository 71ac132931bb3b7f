// See faults.h.
#include "runtime/api/python/faults.h"

#include <nanobind/stl/string.h>
#include <twincraft/error.h>

namespace twincraft::python {
namespace {

/// Held for the life of the process, as a module is.
PyObject* g_errors = nullptr;

nb::object error_class(const char* name) { return nb::handle(g_errors).attr(name); }

template <class... Arguments>
void set_error(const char* name, const Arguments&... arguments) {
  const nb::object type = error_class(name);
  const nb::object error = type(arguments...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(const std::exception_ptr& exception, void* /*payload*/) {
  try {
    std::rethrow_exception(exception);
  } catch (const SpecError& error) {
    set_error("SpecError", error.what(), error.diagnostics());
  } catch (const UsageError& error) {
    set_error("InputError", error.what());
  } catch (const FileError& error) {
    set_error("FileError", error.what());
  } catch (const NumericalFailure& error) {
    set_error("NumericalError", error.what(), error.time(), error.coordinate());
  } catch (const SnapshotError& error) {
    set_error("SnapshotError", error.what());
  } catch (const BusyError& error) {
    set_error("BusyError", error.what());
  } catch (const Interrupted&) {
    if (!PyErr_Occurred()) PyErr_SetNone(PyExc_KeyboardInterrupt);
  } catch (const Error& error) {
    set_error("Error", error.what());
  }
}

}  // namespace

void refuse_input(const std::string& what) {
  set_error("InputError", what);
  throw nb::python_error();
}

void refuse_value(const std::string& what) { throw nb::value_error(what.c_str()); }

void refuse_busy(const std::string& what) {
  set_error("BusyError", what);
  throw nb::python_error();
}

void translate_faults(nb::module_& /*module*/) {
  g_errors = nb::module_::import_("twincraft._errors").release().ptr();
  nb::register_exception_translator(translate);
}

int poll_signals(void* /*context*/) {
  const nb::gil_scoped_acquire gil;
  return PyErr_CheckSignals();
}

void throw_pending() {
  if (PyErr_Occurred()) throw nb::python_error();
}

}  // namespace twincraft::python
