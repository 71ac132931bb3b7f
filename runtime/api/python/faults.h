// What can go wrong, as the package's exceptions: the classes are twincraft/_errors.py's.
#pragma once

#include <nanobind/nanobind.h>

#include <string>

namespace twincraft::python {

namespace nb = nanobind;

/// An unknown name; a value that is not finite or has another shape.
[[noreturn]] void refuse_input(const std::string& what);
[[noreturn]] void refuse_value(const std::string& what);  // ValueError
[[noreturn]] void refuse_busy(const std::string& what);   // RuntimeError

/// Exceptions of the C++ interface become those of Python from here on.
void translate_faults(nb::module_& module);

/// Asked by the library at step ends, from the thread that called it: is there a signal?
int poll_signals(void* context);

/// Throws the exception that a signal's handler, or a callback, has left; otherwise does nothing.
void throw_pending();

}  // namespace twincraft::python
