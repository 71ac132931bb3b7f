// The batch behind twincraft.Batch, which converts and checks shapes.
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <twincraft/simulation.h>

#include "runtime/api/python/arrays.h"
#include "runtime/api/python/faults.h"
#include "runtime/api/python/model.h"

using namespace nanobind::literals;

namespace twincraft::python {
namespace {

using Rows = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

class Batch {
 public:
  Batch(const CompiledModel& model, std::size_t count, std::size_t threads)
      : batch_(model.model, count, threads) {
    tc_batch_set_poll(batch_.handle(), poll_signals, nullptr);
  }

  std::size_t count() const { return batch_.count(); }
  double time() const { return batch_.time(); }
  nb::object rows(tc_signals which, tc_status (*read)(tc_batch*, double*, std::size_t)) const {
    return read_only_array({count(), batch_.model().count(which)},
                           [&](double* to, std::size_t size) { check(read(handle(), to, size)); });
  }
  void set_states(const Rows& rows) { batch_.set_states(rows.data(), rows.size()); }
  void drive(const Rows& rows) { batch_.drive(rows.data(), rows.size()); }
  void release() { batch_.release(); }
  nb::object status() const {
    return new_array<std::int32_t, const std::int32_t>(
        {count()},
        [&](std::int32_t* to, std::size_t size) { check(tc_batch_status(handle(), to, size)); });
  }
  std::string reason(std::size_t member) const { return batch_.reason(member); }

  void step(std::size_t n) {
    try {
      const nb::gil_scoped_release others_go_on;
      batch_.step(n);
    } catch (const Interrupted&) {
      throw_pending();
      throw;
    }
  }

 private:
  tc_batch* handle() const { return batch_.handle(); }
  void check(tc_status status) const { twincraft::detail::check(status, tc_batch_error(handle())); }

  twincraft::Batch batch_;
};

}  // namespace

void bind_batch(nb::module_& module) {
  nb::class_<Batch>(module, "BatchEngine", "The batch behind a Batch.")
      .def(nb::init<const CompiledModel&, std::size_t, std::size_t>(), "model"_a, "n"_a,
           "threads"_a)
      .def_prop_ro("n", &Batch::count)
      .def_prop_ro("time", &Batch::time)
      .def_prop_ro(
          "x", [](const Batch& self) { return self.rows(TC_STATES, tc_batch_states); },
          nb::sig("def x(self) -> numpy.typing.NDArray[numpy.float64]"))
      .def_prop_ro(
          "u", [](const Batch& self) { return self.rows(TC_INPUTS, tc_batch_inputs); },
          nb::sig("def u(self) -> numpy.typing.NDArray[numpy.float64]"))
      .def_prop_ro(
          "y", [](const Batch& self) { return self.rows(TC_OUTPUTS, tc_batch_outputs); },
          nb::sig("def y(self) -> numpy.typing.NDArray[numpy.float64]"))
      .def_prop_ro("status", &Batch::status,
                   nb::sig("def status(self) -> numpy.typing.NDArray[numpy.int32]"))
      .def("set_states", &Batch::set_states, nb::arg("rows").noconvert(),
           nb::sig("def set_states(self, rows: numpy.typing.NDArray[numpy.float64]) -> None"))
      .def("drive", &Batch::drive, nb::arg("rows").noconvert(),
           nb::sig("def drive(self, rows: numpy.typing.NDArray[numpy.float64]) -> None"))
      .def("release", &Batch::release)
      .def("reason", &Batch::reason, "member"_a)
      .def("step", &Batch::step, "n"_a);
}

}  // namespace twincraft::python
