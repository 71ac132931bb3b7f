// See basilisk_code.h. Tested by tests/compiler/basilisk_test.cpp, and flown by tests/basilisk.
#include "compiler/emit/basilisk_code.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compiler/emit/python_text.h"

namespace twincraft {
namespace {

constexpr std::string_view kImports = R"py(
# flake8: noqa: E501
import argparse
import pathlib
import sys
import time
try:
    import Basilisk
    import numpy as np
    from Basilisk.architecture import bskLogging, messaging, sysModel
)py";

constexpr std::string_view kVersion =
    R"py(    assert [int(n) for n in Basilisk.__version__.split(".")[:2]] >= [2, 12], f"this is {Basilisk.__version__}"
except (ImportError, AssertionError) as error:
    sys.exit(f"Basilisk 2.12 or later and numpy are needed (pip install bsk): {error}")
)py";

constexpr std::string_view kVehicle = R"py(

class Vehicle(sysModel.SysModel):
    """In a task after its `modules`: it sets the state of t = 0, again at every Reset, and holds what acts."""

    def __init__(self, engine):
        super().__init__()
        self.modules, self.parts, self.holds = [], {}, []
@kept@        getattr(self, engine)()
        self.modules.append(self.body)
        self.integrator = INTEGRATOR(self.body)
        self.body.setIntegrator(self.integrator)
@halves@
    def link(self, port, kind, say):
        port.subscribeTo(message := getattr(messaging, kind + "Msg")())
        self.holds.append(lambda now: message.write(getattr(messaging, kind + "MsgPayload")(**say(self.acting)), now))

    def Reset(self, now):
        self.acting, self.coming = {}, list(INPUTS)
        self.body.timeBefore, self.body.timeBeforeNanos = 1e-9 * now, now  # an MJScene has that of an earlier run
        for name, (state, row) in self.states.items():
            state, value = self.body.dynManager.getStateObject(state), INITIAL.get(name, 0)
            column = np.array(state.getState())
            column[row:row + np.size(value), 0] = value
            state.setState(column)
)py";

constexpr std::string_view kTolerance =
    R"py(        self.integrator.setAbsoluteTolerance(ABSOLUTE)
        self.integrator.setRelativeTolerance(RELATIVE)
        for name in {"mujocoQpos", "mujocoQvel"} & {state for state, _ in self.states.values()}:
            # all coordinates at once: nothing is relative to an orbit's radius
            self.integrator.setRelativeTolerance(name, 0)
            self.integrator.setAbsoluteTolerance(name, ABSOLUTE + 1e-15 * np.linalg.norm(INITIAL["r_BN_N"]))
)py";

constexpr std::string_view kFlight = R"py(
    def UpdateState(self, now):
        while self.coming and round(1e9 * self.coming[0][0]) <= now:
            self.acting |= self.coming.pop(0)[1]
        for hold in self.holds:
            hold(now)
        for module in self.modules[:-1]:
            module.UpdateState(now)

    def row(self, t):
        com, mass = self.whole(seen := self.seen.read())
        s = np.array(seen.sigma_BN)
        q = np.hstack([1 - s @ s, 2 * s]) / (1 + s @ s)
        places = [self.states[column.split(" ")[0]] for column in COLUMNS[20:-1]]
        joints = [self.body.dynManager.getStateObject(state).getState()[row][0] for state, row in places]
        row = np.hstack([t, @r_BN_N@, seen.v_BN_N, q, seen.omega_BN_B, com, joints, np.ravel(mass)[0]])
        return row if np.isfinite(row).all() else sys.exit(f"the motion is not finite at {t} s")

    def fly(self, step, duration):
        """The lines of our CSV. Steps end at multiples of `step` and where INPUTS change."""
        yield COLUMNS
        for module in [*self.modules, self]:
            module.SelfInit()
        for module in [*self.modules, self]:
            module.Reset(0)
        self.UpdateState(0)
        self.body.UpdateState(0)
        yield self.row(0.0)
@lands@        grid, changes = np.arange(1, duration / step + 1e-9) * step, [t for t, _ in INPUTS if 0 < t < duration]
        times = np.unique(np.rint(1e9 * np.hstack([grid, changes, duration])).astype(int))
        self.steps, self.seconds, samples = len(times), 0, 1
        for now in times.tolist():
            begin = time.perf_counter()
            self.body.UpdateState(now)
            self.seconds += time.perf_counter() - begin
            if now >= round(1e9 * (samples * RECORD)) or now == times[-1]:
                yield self.row(now / 1e9)
                samples = int((now + 1) / 1e9 / RECORD) + 1
            if self.coming and round(1e9 * self.coming[0][0]) <= now:
                self.UpdateState(now)


def build(sim, task, engine="@engine@"):
    """Put the vehicle into a task of your own. INPUTS act from ticks on; after INPUTS.clear() none does. Keep it."""
    vehicle = Vehicle(engine)
    for i, module in enumerate([*vehicle.modules, vehicle]):
        sim.AddModelToTask(task, module, 1000 - i)
    return vehicle

)py";

// Basilisk's adaptive methods try a whole step first, and MJScene stops where that ends nowhere.
constexpr std::string_view kShorter =
    R"py(        if "q_BN" in self.states:  # in MJScene, which stops where the first trial of a step ends nowhere
            step /= 10
)py";

constexpr std::string_view kMain = R"py(
if __name__ == "__main__":
    line = argparse.ArgumentParser(description=__doc__.split("\n")[0].replace("%", "%%"))
    line.add_argument("--engine", choices=["bsm", "mjscene", "both"], default="both")
    line.add_argument("--step", type=float, default=STEP, help="[s]")
    line.add_argument("--duration", type=float, default=DURATION, help="[s]")
    line.add_argument("-o", type=pathlib.Path, default=".", metavar="DIR")
    asked = line.parse_args()
    if not asked.step >= 1e-9 or not 0 < asked.duration < 9e9:
        line.error("--step and --duration are in seconds, and at least a nanosecond")
    for name in HALVES if asked.engine == "both" else [asked.engine]:
        vehicle = sys.exit(f"{name}: {'; '.join(REFUSED[name])}") if name in REFUSED else Vehicle(name)
        try:
            lines = [",".join(map(str, row)) + "\n" for row in vehicle.fly(asked.step, asked.duration)]
        except bskLogging.BasiliskError as error:
            sys.exit(f"{name}: {error}; a shorter --step may help")
        asked.o.mkdir(parents=True, exist_ok=True)
        (asked.o / f"basilisk_{name}.csv").write_text("".join(lines))
        print(f"{name}: {vehicle.steps} steps, {1e6 * vehicle.seconds / vehicle.steps:.2f} us per step")
)py";

}  // namespace

std::string imports_code(const std::set<std::string>& modules) {
  const std::string names = fmt::format("{}", fmt::join(modules, ", "));
  const std::string line = "    from Basilisk.simulation import ";
  const bool fits = line.size() + names.size() <= kScriptLine;
  return std::string(kImports) +
         (fits ? line + names + "\n" : filled(names + ")", line + "(\n        ", "        ")) +
         std::string(kVersion);
}

std::string vehicle_code(const ScriptNeeds& needs, const std::string& halves) {
  const bool keeps = halves.find("self.kept") != std::string::npos;
  std::string text = with(
      kVehicle,
      {{"@halves@\n", halves + "\n"},
       {"@kept@", keeps ? "        self.kept = []  # Basilisk has raw pointers to these\n" : ""}});
  if (needs.is_adaptive) text += kTolerance;
  // Of a point mass one half flies B, the other the centre of mass.
  text +=
      with(kFlight, {{"@r_BN_N@", needs.is_point ? "np.subtract(com[:3], CENTER)" : "seen.r_BN_N"},
                     {"@lands@", needs.is_adaptive ? kShorter : ""},
                     {"@engine@", needs.engine}});
  return text + std::string(kMain);
}

}  // namespace twincraft
