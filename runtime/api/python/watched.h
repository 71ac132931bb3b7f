// Long calls of the library from Python: other threads go on meanwhile, and a signal ends them.
#pragma once

#include <nanobind/nanobind.h>
#include <twincraft/simulation.h>

#include <optional>
#include <utility>

#include "runtime/api/python/faults.h"

namespace twincraft::python {

namespace nb = nanobind;

/// What `work(options)` gives. A signal ends it and is the exception then.
template <class Options, class Work>
auto watched(Options options, const Work& work) {
  options.poll = poll_signals;
  std::optional<decltype(work(options))> done;
  try {
    const nb::gil_scoped_release others_go_on;
    done.emplace(work(options));
  } catch (const Interrupted&) {
    throw_pending();
    throw;
  }
  throw_pending();
  return *std::move(done);
}

}  // namespace twincraft::python
