#!/usr/bin/env python3
"""Twincraft as others use it: installed, moved, found and linked.

    consumers_test.py BUILD CMAKE NM

BUILD is a build folder in which all is built. Nothing here sees the sources of the library: what is
tried is a prefix with the three components, moved after the installation, and the examples.
"""
import ctypes
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest

BUILD, CMAKE, NM = sys.argv[1:4]
ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = ROOT / "tests/consumers"
EXAMPLES = ROOT / "examples"
HEADERS = ["twincraft.h", *(f"twincraft/{name}.h" for name in
                            ("campaign", "error", "model", "simulation", "testing"))]
QUICKSTART = ROOT / "models/quickstart.yaml"
STRICT_C = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror"]
STRICT_CXX = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"]


def run(*command, code=0, **more):
    """Standard output of a command that exits with `code`; None: whatever it exits with."""
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True, **more)
    if code is not None and done.returncode != code:
        raise AssertionError(f"{command} exits with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout if code == 0 else done.stdout + done.stderr


def install(prefix, *components):
    for component in components:
        run(CMAKE, "--install", BUILD, "--prefix", prefix, "--component", component)


def setUpModule():
    global SCRATCH, PREFIX, LIBRARY, ENVIRONMENT
    SCRATCH = pathlib.Path(tempfile.mkdtemp(prefix="twincraft-consumers-"))
    unittest.addModuleCleanup(shutil.rmtree, SCRATCH, True)
    install(SCRATCH / "installed", "programs", "library", "development")
    PREFIX = SCRATCH / "moved"
    (SCRATCH / "installed").rename(PREFIX)
    LIBRARY = next(PREFIX.glob("lib*/**/libtwincraft.so.0"))
    ENVIRONMENT = {**os.environ, "PKG_CONFIG_PATH": str(LIBRARY.parent / "pkgconfig"),
                   "LD_LIBRARY_PATH": str(LIBRARY.parent)}


def configure(source, folder, *more, prefix=None, code=0):
    return run(CMAKE, "-S", source, "-B", folder, f"-DCMAKE_PREFIX_PATH={prefix or PREFIX}",
               "-DCMAKE_BUILD_TYPE=Debug", *more, code=code)


def numbers(lines):
    return {name: float(number) for name, number in map(str.split, lines.splitlines())}


class Prefix(unittest.TestCase):
    def test_holds_what_it_should(self):
        for name in ["bin/scsim", "bin/sccompile", *(f"include/{header}" for header in HEADERS),
                     "share/twincraft/models/quickstart.yaml",
                     "share/twincraft/schemas/spacecraft.schema.json",
                     "share/twincraft/examples/c/mrp_feedback.c", "share/doc/twincraft/LICENSE"]:
            self.assertTrue((PREFIX / name).is_file(), name)
        self.assertEqual((LIBRARY.parent / "libtwincraft.so").readlink(), pathlib.Path(LIBRARY.name))

    def test_names_no_folder_of_the_build(self):
        texts = [path for path in PREFIX.rglob("*")
                 if path.suffix in {".cmake", ".pc"} and path.is_file()]
        self.assertGreater(len(texts), 4)
        for path in texts:
            for folder in (str(ROOT), str(SCRATCH)):
                self.assertNotIn(folder, path.read_text(), path)
        for binary in [LIBRARY, PREFIX / "bin/scsim", PREFIX / "bin/sccompile"]:
            rpaths = re.findall(r"R(?:UN)?PATH\).*\[(.*)\]", run("readelf", "-d", binary))
            self.assertTrue(rpaths, binary)
            for rpath in rpaths:
                self.assertTrue(rpath.startswith("$ORIGIN"), f"{binary}: {rpath}")

    def test_exports_the_library_alone(self):
        targets = "".join(path.read_text() for path in PREFIX.rglob("twincraftTargets*.cmake"))
        self.assertEqual(set(re.findall(r"twincraft::\w+", targets)), {"twincraft::twincraft"})
        self.assertNotRegex(targets, r"(?i)\bsc_|eigen|COMPILE_OPTIONS|COMPILE_DEFINITIONS")

    def test_runs_its_programs(self):
        model = PREFIX / "share/twincraft/models/quickstart.yaml"
        said = run(PREFIX / "bin/scsim", model, "--no-timing", "--duration", "2 s", cwd=SCRATCH)
        self.assertIn("the engines agree", said)
        run(PREFIX / "bin/sccompile", model, "-o", SCRATCH / "out", cwd=SCRATCH)


class Interface(unittest.TestCase):
    def declared(self):
        header = (PREFIX / "include/twincraft.h").read_text()
        return set(re.findall(r"^TC_API [^;]*?\b(tc_\w+)\(", header, re.MULTILINE))

    def test_exports_the_functions_of_the_header_and_nothing_else(self):
        exported, versions = set(), set()
        for line in run(NM, "-D", "--defined-only", LIBRARY).splitlines():
            _, kind, name = line.split()
            if kind == "A":
                versions.add(name)
                continue
            self.assertEqual(kind, "T", line)
            self.assertRegex(name, r"@@TWINCRAFT_\d+$")
            exported.add(name.split("@")[0])
        self.assertGreater(len(exported), 50)
        self.assertEqual(exported, self.declared())
        self.assertTrue(all(re.fullmatch(r"TWINCRAFT_\d+(@@TWINCRAFT_\d+)?", v) for v in versions),
                        versions)

    def compile_alone(self, compiler, flags, header, suffix):
        source = SCRATCH / f"alone{suffix}"
        source.write_text(f"#include <{header}>\n")
        run(compiler, "-fsyntax-only", *flags, "-I", PREFIX / "include", source)

    def test_compiles_alone_as_c99_and_as_cxx17(self):
        self.compile_alone("cc", STRICT_C, "twincraft.h", ".c")
        for header in HEADERS:
            self.compile_alone("c++", STRICT_CXX, header, ".cpp")
        installed = (PREFIX / "include").rglob("*.h")
        self.assertEqual({str(path.relative_to(PREFIX / "include")) for path in installed}, set(HEADERS))

    def test_sets_no_signal_handler_and_prints_nothing(self):
        program, folder = SCRATCH / "quiet", SCRATCH / "quiet-here"
        folder.mkdir()
        run("cc", "-std=gnu99", "-I", PREFIX / "include", HERE / "quiet.c", LIBRARY, "-o", program)
        done = subprocess.run([program, QUICKSTART], cwd=folder, env=ENVIRONMENT,
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(list(folder.iterdir()), [])


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = SCRATCH / "examples"
        configure(EXAMPLES, cls.folder, "-DCMAKE_C_FLAGS=" + " ".join(STRICT_C),
                  "-DCMAKE_CXX_FLAGS=" + " ".join(STRICT_CXX))
        run(CMAKE, "--build", cls.folder)

    def fly(self, program):
        return run(self.folder / program, QUICKSTART)

    def test_give_the_same_numbers_however_they_are_linked(self):
        found = numbers(self.fly("first_flight_c"))
        self.assertEqual(found, numbers(self.fly("first_flight_cpp")))
        self.assertEqual(found, self.by_pkg_config())
        self.assertEqual(found, self.by_ctypes())

    def by_pkg_config(self):
        """With the very command of the documentation."""
        page = (ROOT / "docs/library.md").read_text()
        (command,) = re.findall(r"^cc .*pkg-config.*$", page, re.MULTILINE)
        folder = SCRATCH / "pkg-config"
        folder.mkdir()
        shutil.copy(EXAMPLES / "c/first_flight.c", folder)
        run("sh", "-e", "-c", command, cwd=folder, env=ENVIRONMENT)
        return numbers(run(folder / "first_flight", QUICKSTART, env=ENVIRONMENT))

    def by_ctypes(self):
        tc = ctypes.CDLL(str(LIBRARY))
        tc.tc_model_count.restype = ctypes.c_size_t
        tc.tc_model_signal_name.restype = ctypes.c_char_p
        model, simulation = ctypes.c_void_p(), ctypes.c_void_p()
        self.assertEqual(tc.tc_model_load(bytes(QUICKSTART), None, ctypes.byref(model)), 0)
        self.assertEqual(tc.tc_simulation_new(model, 0, ctypes.byref(simulation)), 0)
        run_until = tc.tc_simulation_run_until
        self.assertEqual(run_until(simulation, ctypes.c_double(60.0), None, None), 0)
        count = tc.tc_model_count(model, 1)
        y = (ctypes.c_double * count)()
        self.assertEqual(tc.tc_simulation_observe(simulation, y, ctypes.c_size_t(count)), 0)
        names = [tc.tc_model_signal_name(model, 1, ctypes.c_size_t(i)).decode()
                 for i in range(count)]
        tc.tc_simulation_free(simulation)
        tc.tc_model_free(model)
        return dict(zip(names, y))

    def test_control_alike_in_every_language(self):
        in_c = self.fly("mrp_feedback_c")
        self.assertEqual(in_c, self.fly("mrp_feedback_cpp"))
        rows = [line.split(" ") for line in in_c.splitlines()]
        self.assertEqual(len(rows), 301)
        for row in rows:
            for word in row:
                self.assertEqual(float.fromhex(word).hex(), word)
        self.assertEqual(float.fromhex(rows[-1][0]), 30.0)

    def test_fly_a_campaign_and_its_worst_members(self):
        said = run(self.folder / "campaign", ROOT / "models/gallery/dispersed_burn.yaml").splitlines()
        self.assertEqual(said[0], "64 members, not_judged")
        self.assertEqual(said[1:], [f"member {number}: agree" for number in (36, 35, 23)])


class Project(unittest.TestCase):
    """A project of a user: its own spec, compiled, tested, and compiled again."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=SCRATCH))
        self.source = self.folder / "a project"
        self.build = self.folder / "build"
        shutil.copytree(EXAMPLES / "cmake_project", self.source)

    def test_builds_tests_and_rebuilds(self):
        configure(self.source, self.build, "-G", "Ninja")
        run(CMAKE, "--build", self.build)
        models = self.build / "models"
        self.assertEqual(sorted(p.name for p in models.iterdir()),
                         ["inspector.resolved.yaml", "inspector.xml"])
        said = run("ctest", "--test-dir", self.build, "--no-tests=error")
        self.assertIn("100% tests passed, 0 tests failed out of 3", said)
        self.assertIn("no work to do", run(CMAKE, "--build", self.build))
        self.break_it()

    def break_it(self):
        """A tolerance that is exceeded fails every test, with the terminal's words."""
        spec = self.source / "vehicle.yaml"
        spec.write_text(spec.read_text().replace("joint: 1.0e-9 deg", "energy: 1.0e-12"))
        said = run("ctest", "--test-dir", self.build, "--output-on-failure", code=8)
        self.assertIn("exceeds its tolerance", said)
        self.assertIn("[  FAILED  ] Vehicle.FliesAlikeInBothEngines", said)

    def vehicle(self, generator, *call):
        """A project with nothing but one twincraft_compile()."""
        arguments = ";".join(["vehicle", "SPEC", str(self.source / "vehicle.yaml"), *call])
        return configure(HERE / "specs", self.build, "-G", generator,
                         "-DFUNCTION=twincraft_compile", f"-DCALL={arguments}")

    def rebuilds(self, generator):
        self.vehicle(generator, "EMIT", "mjcf")
        run(CMAKE, "--build", self.build)
        before = (self.build / "inspector.xml").read_text()
        base, spec = self.source / "base.yaml", self.source / "vehicle.yaml"
        base.write_text(base.read_text().replace("120 kg", "121 kg"))
        run(CMAKE, "--build", self.build)
        self.assertNotEqual((self.build / "inspector.xml").read_text(), before)
        spec.write_text(spec.read_text().replace("name: inspector", "name: surveyor"))
        run(CMAKE, "--build", self.build)
        self.assertTrue((self.build / "surveyor.xml").is_file())

    def test_compiles_again_with_ninja(self):
        self.rebuilds("Ninja")

    def test_compiles_again_with_make(self):
        self.rebuilds("Unix Makefiles")

    def test_knows_the_files_of_every_emitter(self):
        said = self.vehicle("Ninja", "OUTPUT_DIRECTORY", "models", "SET", "name=other")
        self.assertIn(f"outputs: {self.build}/models/other.xml;"
                      f"{self.build}/models/other.bsm.json\n", said)

    def test_says_what_is_wrong_with_a_call(self):
        spec = str(self.source / "vehicle.yaml")
        for call, words in [
                (["twincraft_compile", "v"], "SPEC is missing"),
                (["twincraft_compile", "v", "SPEC"], "`SPEC` has no value"),
                (["twincraft_compile", "v", "SPEC", "no.yaml"], "there is no spec"),
                (["twincraft_compile", "v", "x", "SPEC", spec], "unexpected argument `x`"),
                (["twincraft_compile", "v", "SPEC", spec, "EMIT", "mjfc"], "did you mean `mjcf`?"),
                (["twincraft_compile", "v", "SPEC", spec, "SET", "hub.mas=1"], "SC"),
                (["twincraft_add_test", "SPEC", spec], "NAME is missing"),
                (["twincraft_add_test", "NAME", "n"], "SPEC is missing")]:
            said = configure(HERE / "specs", self.build, f"-DFUNCTION={call[0]}",
                             "-DCALL=" + ";".join(call[1:]), code=1)
            self.assertIn(words, " ".join(said.split()), call)

    def test_shows_faults_of_the_spec_as_the_terminal_does(self):
        base = self.source / "base.yaml"
        base.write_text(base.read_text().replace("mass: 120 kg", "mass: -5 kg"))
        arguments = f"v;SPEC;{self.source / 'vehicle.yaml'}"
        said = configure(HERE / "specs", self.build, "-DFUNCTION=twincraft_compile",
                         f"-DCALL={arguments}", code=1)
        self.assertRegex(said, r"base.yaml:5:\d+: error\[SC\d+\]: ")
        self.assertRegex(said, r"\n +5 \| hub: \{mass: -5 kg.*\n +\| +\^")

    def test_asks_for_the_programs_where_they_are_missing(self):
        bare = self.folder / "bare"
        install(bare, "library", "development")
        configure(EXAMPLES, self.build, prefix=bare)
        said = configure(self.source, self.folder / "other", prefix=bare, code=1)
        self.assertIn("install Twincraft's component `programs`", " ".join(said.split()))

    def test_takes_no_other_minor_version(self):
        text = "cmake_minimum_required(VERSION 3.20)\nproject(p LANGUAGES C)\n"
        (self.source / "CMakeLists.txt").write_text(text + "find_package(twincraft 0.2 REQUIRED)\n")
        self.assertIn("0.1.0", configure(self.source, self.build, code=1))


class Documents(unittest.TestCase):
    def test_show_nothing_that_is_not_tried(self):
        tried = [path.read_text() for path in EXAMPLES.rglob("*") if path.is_file()]
        tried = ["\n".join(map(str.strip, text.splitlines())) for text in tried]
        for page in ["docs/library.md", "README.md"]:
            text = (ROOT / page).read_text()
            for block in re.findall(r"^```(?:c|cpp|cmake)\n(.*?)^```", text, re.DOTALL | re.MULTILINE):
                wanted = "\n".join(map(str.strip, textwrap.dedent(block).strip().splitlines()))
                self.assertTrue(any(wanted in one for one in tried), f"{page}:\n{block}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
