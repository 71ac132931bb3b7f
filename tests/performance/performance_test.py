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
import cases  # noqa: E402
import claims  # noqa: E402
import document  # noqa: E402
import gate  # noqa: E402
import history  # noqa: E402
import machine  # noqa: E402
import measure  # noqa: E402
import programs  # noqa: E402
import tables  # noqa: E402

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
calls=3 0x10
0x24 5
0x24 2
"""


class Callgrind(unittest.TestCase):
    def setUp(self):
        with tempfile.NamedTemporaryFile("w", suffix=".out") as file:
            file.write(CALLGRIND)
            file.flush()
            self.profile = callgrind.read(file.name)

    def test_the_cost_of_a_call_is_the_callees(self):
        self.assertEqual(self.profile.costs["/bin/program", "step()", "0x24"], 2)
        self.assertEqual(callgrind.total(self.profile), 14)

    def test_calls_of_the_heap_are_seen(self):
        self.assertEqual(self.profile.heap_calls, 3)


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


def results(ratio=60.0, steps=3.0e6, heap=0.0, recorded=1.1, wrapper=1.0, jacobian=5.0, loss=1.0):
    """As if measured, every figure well inside its bounds."""
    engines = ("portable", "bsm", "mujoco", "forward", "minimal", "step")
    counts = {(case.name, e): programs.Count(1000.0, heap) for case in measure.ALL for e in engines}
    for case in cases.RECORDED:
        for engine in ("portable", "bsm", "mujoco"):
            counts[case.recorded().name, engine] = programs.Count(1000.0 * recorded, 0.0)
    for case in measure.ALL:
        counts[case.name, "mujoco"] = programs.Count(1000.0 * wrapper, heap)
    times = {"bsm": 1.0, "avx2": 1.0 / loss, "mujoco": 9.0, "minimal": 9.0}
    times |= {"forward": ratio, "step": 2.0 * ratio}
    race = {
        "degrees_of_freedom": 6,
        "instructions": "AVX-512",
        "sets": {"AVX2": "avx2", "AVX-512": "bsm"},
        "engines": entries(times),
    }
    pairs = {"bsm": 1.0, "bsm_recorded": recorded, "mujoco": 1.0, "mujoco_recorded": 1.5}
    names = [claims.SMALL, claims.LARGE]
    return measure.Results(
        trials=1,
        load=(0.0, 0.0),
        races={case.name: race for case in measure.ALL},
        recorded={case.name: {"engines": entries(pairs)} for case in cases.RECORDED},
        counts=counts,
        shares=[],
        evaluations={name: {"bsm": 1.0, "mujoco": 2.0} for name in names},
        jacobians={"rw_panels": jacobian, **dict.fromkeys(names, 1.0)},
        batches={name: {"AVX2": steps * loss, "AVX-512": steps} for name in names},
        lanes={"AVX2": 4, "AVX-512": 8},
        batch_set="AVX-512",
        history=[
            {"title": "Before", "source": "aaa", "instructions": {"orbit": 1000.0, "torque": 2000.0}},
            {"title": "Fewer", "source": "bbb", "instructions": {"orbit": 900.0, "torque": 2001.0}},
        ],
        basilisk={},
    )


def entries(times):
    return {name: {"best_us_per_step": t, "median_us_per_step": t} for name, t in times.items()}


class Claims(unittest.TestCase):
    def missed(self, **figures):
        return [claim.what for claim in claims.claims(results(**figures)) if not claim.holds]

    def test_hold_when_figures_do(self):
        self.assertEqual(self.missed(), [])

    def test_have_a_row_each(self):
        names = [claim.what for claim in claims.claims(results())]
        self.assertEqual(len(names), len(set(names)))

    def test_each_row_of_the_race_has_its_own_bound(self):
        missed = self.missed(ratio=18.9)
        for name in ("torque", "orbit_compact", "flex, N=16", "flex, N=32"):
            self.assertIn(f"{claims.FORWARD}{name}", missed)
        for name in ("orbit", "rw_panels", "flex, N=8", "bodies, N=16"):
            self.assertNotIn(f"{claims.FORWARD}{name}", missed)

    def test_each_other_figure_fails_alone(self):
        for figure, worse, rows in (
            ("heap", 0.5, 1),
            ("steps", 1.5e6, 1),
            ("recorded", 1.4, len(cases.RECORDED)),  # times alone
            ("recorded", 1.6, 2 * len(cases.RECORDED)),
            ("wrapper", 1.021, 1),
            ("jacobian", 10.1, 1),
            ("loss", 1.06, 2),  # one spacecraft, and batches
        ):
            with self.subTest(figure=figure, worse=worse):
                self.assertEqual(len(self.missed(**{figure: worse})), rows)

    def test_exponent_of_linear_growth_is_one(self):
        self.assertAlmostEqual(claims.exponent(38.0, 70.0), 1.0)


class Tables(unittest.TestCase):
    def test_sets_stand_beside_one_another(self):
        self.assertIn("| orbit | 0.8 | 1 | 1.25 |", tables.set_table(results(loss=1.25)))

    def test_a_processor_with_one_wide_set_has_a_table_too(self):
        one = results()
        for race in one.races.values():
            race["sets"] = {"AVX2": "bsm"}
        self.assertIn("| orbit | 1 |", tables.set_table(one))
        self.assertEqual(claims.loss_of_one(one), 1.0)

    def test_recorded_runs_stand_beside_bare_ones_of_both_engines(self):
        self.assertIn("| rw_panels | 1.10 | 1.10 | 1.10 | 1.50 |", tables.recorded_table(results()))

    def test_a_step_of_the_work_shows_what_it_changed(self):
        table = tables.history_table(results())
        self.assertIn("| Before (aaa) | 1,000 | 2,000 |", table)
        self.assertIn("| Fewer (bbb) | 900 (-10.0 %) |  |", table)
        self.assertIn("| in all | -10.0 % | +0.0 % |", table)

    def test_the_document_is_made_of_all(self):
        with mock.patch.object(document, "machine_text", lambda _: ""):
            with mock.patch.object(basilisk, "section", lambda _: ""):
                text = document.document(results())
        for name in ("`mj_step`", "AVX-512 over AVX2", "recorded over bare", "in all"):
            self.assertIn(name, text)


class History(unittest.TestCase):
    def test_steps_are_appended(self):
        with tempfile.TemporaryDirectory() as folder:
            stored = pathlib.Path(folder) / "history.json"
            with mock.patch.multiple(history, STORED=stored, ROOT=stored.parent):
                with mock.patch.multiple(gate, measured=lambda: {"orbit": 9.0}):
                    with mock.patch.object(machine, "revision", lambda: "abc"), mock.patch("builtins.print"):
                        history.append("First", None)
                        history.append("Second", None)
                self.assertEqual([step["title"] for step in history.steps()], ["First", "Second"])
                self.assertEqual(history.steps()[1]["instructions"], {"orbit": 9.0})

    def test_the_stored_steps_are_of_vehicles_counted(self):
        known = {case.name for case in gate.GATED}
        self.assertTrue(history.steps())
        for step in history.steps():
            self.assertLessEqual(set(step["instructions"]), known)


unittest.main()
