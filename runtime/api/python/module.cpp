// twincraft._core: what the package has in C++.
#include <nanobind/nanobind.h>

#include "runtime/api/python/faults.h"
#include "runtime/api/python/model.h"

NB_MODULE(_core, module) {
  using namespace twincraft::python;
  module.doc() = "The compiled part of twincraft; use `import twincraft`.";
  module.attr("version") = tc_version();
  nb::set_leak_warnings(false);  // what a program keeps to its end is no leak
  translate_faults(module);
  bind_model(module);
  bind_flyers(module);
  bind_batch(module);
  bind_campaign(module);
}
