"""Claims about tools/paper: how numbers are judged and written, and what a failed run does.

Run by tools/check: /usr/bin/python3 -B tests/paper/paper_test.py
"""

import contextlib
import io
import json
import math
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "paper"))

import document  # noqa: E402
import plot  # noqa: E402
import runs  # noqa: E402
import verdict  # noqa: E402
from sections import SECTIONS, burn, torque, why  # noqa: E402


class Rules(unittest.TestCase):
    def test_ten_percent_is_reproduced_and_no_more(self):
        self.assertEqual(verdict.within(1.09, 1.0), verdict.REPRODUCED)
        self.assertEqual(verdict.within(0.89, 1.0), verdict.DIFFERS)
        self.assertEqual(verdict.within(-1.0, 1.0), verdict.DIFFERS)

    def test_rounding_is_judged_by_its_magnitude(self):
        self.assertEqual(verdict.magnitude(9e-12, 1e-12), verdict.REPRODUCED)
        self.assertEqual(verdict.magnitude(1.1e-11, 1e-12), verdict.DIFFERS)
        self.assertEqual(verdict.magnitude(0.0, 1e-12), verdict.SMALLER)

    def test_what_is_not_finite_differs_whatever_the_rule(self):
        for key in ("orbit.kepler", "torque.bias.x", "flex.bodies", "torque.axis.drift"):
            section = verdict.Section("a section")
            section.add(key, math.nan)
            self.assertTrue(section.fails, key)

    def test_an_exceeded_bound_fails_the_section(self):
        section = verdict.Section("a section")
        section.add("rw.attitude6", 6.3e-10, 5.1e-12)
        self.assertEqual(section.count(verdict.REPRODUCED), 1)
        self.assertTrue(section.fails)

    def test_a_section_without_results_fails(self):
        self.assertTrue(verdict.Section("a section", failure="no report").fails)


class Published(unittest.TestCase):
    def test_every_number_has_its_place_unit_and_a_known_rule(self):
        for key, entry in verdict.PUBLISHED.items():
            self.assertIn(entry["rule"], verdict.RULES, key)
            self.assertRegex(entry["section"], r"^6\.[1-8]$")
            self.assertTrue(entry["what"] and "unit" in entry, key)

    def test_every_number_is_used(self):
        folder = ROOT / "tools" / "paper" / "sections"
        text = "".join(path.read_text() for path in folder.glob("*.py"))
        wanted = {re.sub(r"\{[^}]*\}", "*", key) for key in re.findall(r'f?"([a-z]+\.[^" ]*)"', text)}
        patterns = [re.compile(re.escape(key).replace(r"\*", ".*") + "$") for key in wanted]
        for key in verdict.PUBLISHED:
            self.assertTrue(any(pattern.match(key) for pattern in patterns), key)


class Metrics(unittest.TestCase):
    def test_the_angle_of_a_small_rotation_keeps_its_digits(self):
        half = 0.5e-12
        angle = runs.principal_angle((1, 0, 0, 0), (math.cos(half), 0, math.sin(half), 0))
        self.assertAlmostEqual(math.radians(angle) / 1e-12, 1.0, places=9)

    def test_a_quaternion_and_its_negative_are_one_attitude(self):
        self.assertEqual(runs.principal_angle((0.6, 0.8, 0, 0), (-0.6, -0.8, 0, 0)), 0.0)

    def test_a_bias_is_read_off_a_turn(self):
        torque_x, t = 3e-6, 10.0
        half = 0.5 * (0.5 * torque_x / 900.0 * t**2)
        columns = {"t": [float(i) for i in range(11)]}
        for axis, value in zip("wxyz", (math.cos(half), math.sin(half), 0.0, 0.0)):
            columns[f"q_BN.{axis}"] = [0.0] * 10 + [value]
        x, y, z = torque.bias(runs.Trajectory(columns))
        self.assertAlmostEqual(x / -torque_x, 1.0, places=9)
        self.assertEqual((y, z), (0.0, 0.0))


class Figures(unittest.TestCase):
    def test_zero_has_no_place_on_a_logarithmic_axis(self):
        figure = plot.Plot("a title", "x", "y", "xy")
        figure.add("curve", [(1.0, 0.0), (2.0, 3.0)], plot.BLUE)
        script = plot.script_of(figure)
        self.assertIn("2.0 3.0", script)
        self.assertNotIn("1.0 0.0", script)

    def test_nothing_to_draw_is_said(self):
        with self.assertRaises(runs.RunFailed):
            plot.script_of(plot.Plot("a title", "x", "y"))

    def test_a_figure_is_an_svg(self):
        figure = plot.Plot("a title", "x [s]", "y [m]")
        figure.add("curve", [(1.0, 1.0), (2.0, 3.0)], plot.BLUE)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "figure.svg"
            plot.draw(figure, path)
            self.assertIn("a title", path.read_text())
            self.assertEqual([path], list(pathlib.Path(folder).iterdir()))


class Runs(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.runner = runs.Runner(pathlib.Path(self.folder.name), quick=True)

    def report(self, code, **entries):
        report = {"complete": True, "verdict": "agree", "provenance": {}, "members": []} | entries
        folder = pathlib.Path(self.folder.name)
        (folder / "report.json").write_text(json.dumps(report))
        return self.runner._report(folder, runs.subprocess.CompletedProcess([], code, "", "why"))

    def test_a_good_run_is_a_report(self):
        self.assertEqual(self.report(0).members, [])

    def test_a_numerical_failure_a_broken_run_and_a_disagreement_are_failures(self):
        for code, entries in ((4, {}), (0, {"complete": False}), (1, {"verdict": "disagree"})):
            with self.assertRaises(runs.RunFailed):
                self.report(code, **entries)

    def test_a_disagreement_that_is_explained_is_no_failure(self):
        self.assertEqual(self.report(0, verdict="disagree", attribution=[]).members, [])

    def test_a_difference_with_another_cause_than_the_papers_is_a_failure(self):
        found = {"cause": "wheel_mass", "name": "token wheel mass", "share": 1.0, "law": None}
        found |= {"no_law": "none", "maximum": 1.0, "maximum_without": 0.0}
        left = {"remainder": 0.0, "remainder_is": "rounding", "remainder_order": None}
        report = runs.Report(pathlib.Path("x"), {"attribution": [found], "explanation": left})
        self.assertEqual(len(why.rows_of("6.3", "wheel_mass", report)), 2)
        with self.assertRaisesRegex(runs.RunFailed, "token wheel mass"):
            why.rows_of("6.3", "bob_inertia", report)
        left["remainder_is"] = "unexplained"
        with self.assertRaisesRegex(runs.RunFailed, "unexplained"):
            why.rows_of("6.3", "wheel_mass", report)

    def test_a_missing_spec_names_the_run(self):
        with contextlib.redirect_stderr(io.StringIO()):
            with self.assertRaisesRegex(runs.RunFailed, "no_such_model"):
                self.runner.run("no_such_model")


class Document(unittest.TestCase):
    def test_numbers_are_plain(self):
        for value, text in ((0, "0"), (45.52, "45.52"), (6.3e-10, "6.30e-10"), (None, "-")):
            self.assertEqual(document.number(value), text)

    def test_a_failed_section_is_named_in_the_summary(self):
        text = document.document([verdict.Section("Burn", failure="no fuel")], {}, "command", True)
        self.assertIn("1 Burn (**failed to run**)", text)
        self.assertIn("no fuel", text)
        self.assertIn("This is a quick run", text)

    def test_a_remark_is_made_once(self):
        section = verdict.Section("a section")
        section.add("torque.attitude", 1e-4)
        section.add("torque.rate", 1e-8)
        self.assertEqual(document.rows_of(section).count("order of magnitude repeats"), 1)

    def test_every_section_can_be_told_apart(self):
        names = [module.NAME for module in SECTIONS]
        self.assertEqual(len(names), len(set(names)))
        self.assertIn(burn.NAME, names)


if __name__ == "__main__":
    unittest.main()
