"""What check-wheel runs in a root without our packages: the quickstart, in Python and by commands."""

import os
import subprocess
import sys
from pathlib import Path

import twincraft as tc

assert not Path("/usr/share/xml").exists(), "the root is not bare"

package = Path(tc.__file__).parent
run = tc.load("quickstart.yaml", set={"hub.mass": "1300 lb"}).run()
assert run.verdict == "agree", str(run)
run.save("python")
sim = tc.load("quickstart.yaml").simulate("mujoco")
sim.inputs["rw_x.torque"] = "10 mN m"
assert sim.run_until(1.0) == 1.0
assert list((package / "licences").iterdir())

# The console script's first line names the interpreter of the machine that it was installed on.
commands = {name: [sys.executable, f"/packages/bin/{name}"] for name in ("scsim", "sccompile")}
for command in (
    [*commands["scsim"], "quickstart.yaml", "--set", "hub.mass=1300 lb", "-o", "program", "--no-timing"],
    [*commands["sccompile"], "quickstart.yaml", "--check", "--emit", "mjcf", "-o", "program"],
):
    done = subprocess.run(command, capture_output=True, text=True, env=dict(os.environ))
    assert done.returncode == 0, done.stdout + done.stderr
for name in ("bsm.csv", "mujoco.csv"):
    assert Path("python", name).read_bytes() == Path("program", name).read_bytes(), name
mapped = Path("/proc/self/maps")
if mapped.exists():
    assert "/usr/lib/x86_64-linux-gnu/libmujoco" not in mapped.read_text()
print(f"twincraft {tc.__version__}: the wheel runs in a bare root")
