"""Claims about tools/performance on files and figures written by hand."""

import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "performance"))

import basilisk  # noqa: E402
import breakdown  # noqa: E402
import callgrind  # noqa: E402
import claims  # noqa: E402
import gate  # noqa: E402
import machine  # noqa: E402
import measure  # noqa: E402
import programs  # noqa: E402

CALLGRIND = """# callgrind format
positions: instr
events: Ir

ob=/lib/libc.so.6
fn=malloc
0x10 5

ob=/bin/program
fn=step()
0x20 7
cob=/lib/libc.so.6
cfn=malloc
calls=1 0x10
0x24 5
0x24 2
"""


class Callgrind(unittest.TestCase):
    def setUp(self):
        with tempfile.NamedTemporaryFile("w", suffix=".out") as file:
            file.write(CALLGRIND)
            file.flush()
            self.costs = callgrind.read(file.name)

    def test_the_cost_of_a_call_is_the_callees(self):
        self.assertEqual(self.costs["/bin/program", "step()", "0x24"], 2)
        self.assertEqual(callgrind.total(self.costs), 14)

    def test_the_heap_is_seen(self):
        self.assertEqual(callgrind.heap(self.costs), 5)


class Breakdown(unittest.TestCase):
    def test_the_innermost_known_function_decides(self):
        chain = "twincraft::bsm::avx2::Chain<double, Pair>::move(double const*)"
        self.assertEqual(breakdown.phase(["sincos<x>", chain]), "sines and cosines")
        self.assertEqual(breakdown.phase(["Vec2::dot", chain]), "chains: angles, rates, places")
        self.assertEqual(breakdown.phase(["main"]), breakdown.OTHER)


class Gate(unittest.TestCase):
    def verdict(self, **now):
        with tempfile.TemporaryDirectory() as folder:
            stored = pathlib.Path(folder) / "instructions.json"
            content = {"compiler": "c++", "instructions": {"orbit": 1000.0}}
            stored.write_text(json.dumps(content))
            with mock.patch.multiple(gate, STORED=stored, measured=lambda: now):
                with mock.patch.object(machine, "compiler", lambda: "c++"), mock.patch("builtins.print"):
                    return gate.check()

    def test_growth_above_two_percent_fails(self):
        self.assertEqual(self.verdict(orbit=1019.0), 0)
        self.assertEqual(self.verdict(orbit=1021.0), 1)

    def test_fewer_pass(self):
        self.assertEqual(self.verdict(orbit=500.0), 0)

    def test_a_vehicle_that_is_not_stored_fails(self):
        self.assertEqual(self.verdict(orbit=1000.0, torque=1.0), 1)

    def test_the_stored_file_is_of_the_vehicles_counted(self):
        stored = json.loads(gate.STORED.read_text())["instructions"]
        self.assertEqual(list(stored), [case.name for case in gate.GATED])


class Basilisk(unittest.TestCase):
    def row(self, factor):
        keys = ("bsm_over_our_bsm", "mjscene_over_our_mujoco", "mjscene_over_our_bsm")
        engines = ("bsm", "mjscene", "special", "our_bsm", "our_mujoco")
        return {
            "basilisk": {"version": "2.12.1", "mujoco": "3.11.0"},
            "provenance": {"program": "scsim", "mujoco": "2.2.2", "cores": 2},
            "cost": {
                "rounds": 6, "load_average": 0.5, "instructions": "AVX2",
                "us_per_step": {name: {"best": 1.0, "median": 1.0} for name in engines},
                "ratios": {key: factor for key in keys},
                "bsm_fastest_us_per_step": 1.0, "bsm_hinges": "HingedRigidBody",
            },
        }  # fmt: skip

    def test_a_row_that_basilisk_wins_fails(self):
        self.assertTrue(basilisk.holds({"a": self.row(1.1)}))
        self.assertFalse(basilisk.holds({"a": self.row(1.1), "b": self.row(0.9)}))

    def test_its_section_alone_is_renewed(self):
        before = f"# Cost\n\n{basilisk.HEADING}\n\nold\n\n## Rest\n\nkept\n"
        after = basilisk.replaced(before, {"quick": self.row(2.0)})
        self.assertNotIn("old", after)
        self.assertIn("| quick | 1 (HingedRigidBody) | 1 | 1 | 1 | 2 | 2 | 2 |", after)
        self.assertTrue(after.startswith("# Cost\n\n## Beside") and after.endswith("\n\n## Rest\n\nkept\n"))
        self.assertEqual(after, basilisk.replaced(after, {"quick": self.row(2.0)}))


class Claims(unittest.TestCase):
    def results(self, ratio=30.0, heap=0.0, steps=1.0e6):
        count = programs.Count(1000.0, heap)
        engines = ("portable", "bsm", "mujoco", "minimal")
        race = {
            "engines": {"bsm": {"best_us_per_step": 1.0}},
            "ratios_of_best": {"forward_over_bsm": ratio},
        }
        races = {case.name: race for case in measure.ALL}
        counts = {(case.name, engine): count for case in measure.ALL for engine in engines}
        batches = {claims.SMALL: {"AVX2": steps}}
        return measure.Results(1, (0.0, 0.0), races, counts, [], {}, batches, {}, {})

    def held(self, **figures):
        return all(claim.holds for claim in claims.claims(self.results(**figures)))

    def test_hold_when_figures_do(self):
        self.assertTrue(self.held())

    def test_fail_below_a_bound(self):
        self.assertFalse(self.held(ratio=3.9))
        self.assertFalse(self.held(heap=0.5))
        self.assertFalse(self.held(steps=0.4e6))

    def test_exponent_of_linear_growth_is_one(self):
        self.assertAlmostEqual(claims.exponent(38.0, 70.0), 1.0)


unittest.main()
