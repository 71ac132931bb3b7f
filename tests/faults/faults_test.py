#!/usr/bin/env python3
"""What the machine can do to a run: full disks, closed streams, limits, signals, odd surroundings.

    faults_test.py SCCOMPILE SCSIM [sanitized]

Every claim is about what a user is left with: the exit code, the words, the files. Nothing is
mocked: limits are the kernel's, signals are sent, system calls are made to fail by strace. Where
strace may not trace (or is missing) those claims are skipped, and the skip is printed. Programs
built with AddressSanitizer reserve terabytes of addresses, so no limit on memory can be set for
them, and make system calls of their own, so theirs cannot be counted.
"""
import contextlib
import hashlib
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

SCCOMPILE, SCSIM = (os.path.abspath(program) for program in sys.argv[1:3])
SANITIZED = sys.argv[3:] == ["sanitized"]
QUICKSTART = pathlib.Path(__file__).resolve().parents[2] / "models/quickstart.yaml"
SHORT = ["--no-timing", "--duration", "2 s"]
FOREVER = ["--no-timing", "--duration", "1000000000 s", "--set", "simulation.record=1000 s"]
HANG = 600  # [s] a program that is still there then has hung, however busy the machine is


def strace_works():
    try:
        done = subprocess.run(["strace", "-o", os.devnull, "true"], capture_output=True, timeout=HANG)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0


STRACE = strace_works()
COUNTS_CALLS = unittest.skipUnless(STRACE and not SANITIZED, "system calls cannot be counted here")


def failing(injection):
    """The prefix of a command whose system calls fail as strace's `inject` says."""
    # The search for leaks is itself a tracer, and two cannot trace one program.
    return ["strace", "-f", "-o", os.devnull, "-E", "ASAN_OPTIONS=detect_leaks=0",
            "-e", "inject=" + injection]


class Faults(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="twincraft-faults-"))
        self.addCleanup(shutil.rmtree, self.folder, True)

    def run_in(self, command, **more):
        more.setdefault("cwd", self.folder)
        more.setdefault("stdout", subprocess.PIPE)
        more.setdefault("stderr", subprocess.PIPE)
        command = [str(word) for word in command]
        return subprocess.run(command, text=True, timeout=HANG, **more)

    def files(self, folder="out"):
        return sorted(entry.name for entry in (self.folder / folder).iterdir())

    def assert_fails(self, run, code, words):
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertIn(words, run.stderr)


class Disk(Faults):
    def with_old_files(self):
        done = self.run_in([SCCOMPILE, QUICKSTART, "-o", "out"])
        self.assertEqual(done.returncode, 0, done.stderr)
        return {name: (self.folder / "out" / name).read_bytes() for name in self.files()}

    def assert_old_files(self, old):
        self.assertEqual(old, {n: (self.folder / "out" / n).read_bytes() for n in self.files()})

    @COUNTS_CALLS
    def test_a_full_disk_leaves_the_earlier_files_at_any_write(self):
        old = self.with_old_files()
        for when in ("1", "2", "2+"):
            run = self.run_in(failing("write:error=ENOSPC:when=" + when) +
                              [SCCOMPILE, QUICKSTART, "-o", "out", "--set", "hub.mass=700"])
            self.assertEqual(run.returncode, 3, when)
            self.assert_old_files(old)

    def test_a_small_file_system_that_is_full(self):
        (self.folder / "out").mkdir()
        mounted = self.run_in(["mount", "-t", "tmpfs", "-o", "size=64k", "none", "out"])
        if mounted.returncode != 0:
            self.skipTest("nothing can be mounted here")
        self.addCleanup(self.run_in, ["umount", "out"])
        old = self.with_old_files()
        with contextlib.suppress(OSError), open(self.folder / "out/ballast", "wb", 0) as ballast:
            while ballast.write(b"x" * 4096):
                pass
        for program, words in (([SCCOMPILE], "no space left"),
                               ([SCSIM, "--quiet", *SHORT], "bytes are free")):
            run = self.run_in([*program, QUICKSTART, "-o", "out", "--set", "hub.mass=700"])
            self.assert_fails(run, 3, words)
            self.assertEqual(sorted([*old, "ballast"]), self.files())
        (self.folder / "out/ballast").unlink()
        self.assert_old_files(old)

    @unittest.skipUnless(STRACE, "strace cannot trace here")
    def test_a_disk_that_loses_data_at_fsync_is_noticed(self):
        old = self.with_old_files()
        run = self.run_in(failing("fsync:error=EIO:when=2+") +
                          [SCCOMPILE, QUICKSTART, "-o", "out", "--set", "hub.mass=700"])
        self.assert_fails(run, 3, "input/output error")
        self.assert_old_files(old)

    @COUNTS_CALLS
    def test_a_report_on_a_full_disk_keeps_the_old_report(self):
        out = self.folder / "out"
        out.mkdir()
        (out / "report.json").write_text("old")
        run = self.run_in(failing("write:error=ENOSPC:when=3+") +
                          [SCSIM, QUICKSTART, "-o", "out", "--quiet", *SHORT])
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertEqual((out / "report.json").read_text(), "old")
        self.assertFalse([name for name in self.files() if name.endswith(".tmp")])

    @unittest.skipUnless(STRACE, "strace cannot trace here")
    def test_interrupted_system_calls_are_made_again(self):
        for call in ("read", "write"):
            run = self.run_in(failing(call + ":error=EINTR:when=1") +
                              ["-P", QUICKSTART] * (call == "read") +
                              [SCCOMPILE, QUICKSTART, "-o", call])
            self.assertEqual(run.returncode, 0, run.stderr)

    def test_a_file_size_limit_is_an_error_with_words(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        for program in ([SCCOMPILE], [SCSIM, "--quiet", *SHORT]):
            run = self.run_in([*program, QUICKSTART, "-o", "out"], preexec_fn=limit)
            self.assert_fails(run, 3, "file too large")
            # Files that fit are whole; the report, which does not, is not there at all.
            self.assertLessEqual(set(self.files()), {"bsm.csv", "mujoco.csv"})

    def test_an_unwritable_folder_is_noticed_before_the_run(self):
        (self.folder / "file").write_text("")
        (self.folder / "out/report.json").mkdir(parents=True)
        for folder, words in (("file", "not a directory"), ("file/below", "not a directory"),
                              ("/proc/none", "no such file"), ("out", "is a directory")):
            run = self.run_in([SCSIM, QUICKSTART, "-o", folder, *FOREVER])
            self.assert_fails(run, 3, words)
        self.assertEqual(self.files(), ["report.json"])

    def test_what_one_may_not_read_or_write_is_noticed(self):
        """Root may do anything, so root runs this as nobody, who must get at the program."""
        self.folder.chmod(0o755)
        (self.folder / "out").mkdir(mode=0o555)
        spec = self.folder / "spec.yaml"
        shutil.copy(QUICKSTART, spec)
        program = shutil.copy(SCSIM, self.folder)
        more = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        run = self.run_in([program, spec, "-o", "out", *FOREVER], **more)
        self.assert_fails(run, 3, "permission denied")
        spec.chmod(0)
        run = self.run_in([program, spec, *SHORT], **more)
        self.assert_fails(run, 3, "permission denied")


class Streams(Faults):
    def test_a_reader_who_leaves_does_not_cost_the_files(self):
        run = self.run_in(["bash", "-c", '"$@" | true; exit ${PIPESTATUS[0]}', "bash", SCSIM,
                           QUICKSTART, "-o", "out", *SHORT])
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertTrue(json.loads((self.folder / "out/report.json").read_text())["complete"])

    def test_standard_output_that_takes_nothing_is_an_error(self):
        for end, words in ((">&-", "bad file descriptor"), (">/dev/full", "no space left")):
            for command in ([SCSIM, QUICKSTART, *SHORT],
                            [SCCOMPILE, QUICKSTART, "--emit", "bsm", "-o", "-"]):
                run = self.run_in(["bash", "-c", f'"$@" {end}', "bash", *command])
                self.assert_fails(run, 3, words)

    def test_standard_error_that_takes_nothing_changes_no_exit_code(self):
        cases = ((0, [SCSIM, QUICKSTART, "--progress", "always", *SHORT]),
                 (1, [SCCOMPILE, QUICKSTART, "--set", "hub.mass=-1"]),
                 (1, [SCSIM, QUICKSTART, "--set", "hub.mass=-1"]),
                 (2, [SCCOMPILE, "--emmit"]),
                 (3, [SCCOMPILE, "missing.yaml"]))
        for end in ("2>&-", "2>/dev/full"):
            for code, command in cases:
                run = self.run_in(["bash", "-c", f'"$@" {end}', "bash", *command])
                self.assertEqual(run.returncode, code, (end, command))

    def test_all_streams_may_be_closed(self):
        run = self.run_in(["bash", "-c", '"$@" <&- >&- 2>&-', "bash", SCCOMPILE, QUICKSTART, "-o",
                           "out"])
        self.assertEqual(run.returncode, 0)
        # A file that got the descriptor of a closed stream would have its words in it.
        text = (self.folder / "out/wheels_and_panels.xml").read_text()
        self.assertTrue(text.startswith("<!--") and text.endswith("</mujoco>\n"))


class Signals(Faults):
    def interrupted(self, number, times=1):
        """The exit code of a run that is sent a signal once it says that an engine is under way."""
        command = [SCSIM, QUICKSTART, "-o", "out", "--progress", "always", *FOREVER]
        with subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE) as run:
            guard = threading.Timer(HANG, run.kill)
            guard.start()
            self.addCleanup(guard.cancel)
            told = b""
            while b"both    [" not in told:
                more = os.read(run.stderr.fileno(), 4096)
                self.assertTrue(more, told)
                told += more
            for _ in range(times):
                run.send_signal(number)
            run.communicate()
        return run.returncode

    def test_what_was_computed_is_written_and_marked(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.assertEqual(self.interrupted(number), 128 + number)
            report = json.loads((self.folder / "out/report.json").read_text())
            self.assertIs(report["complete"], False)
            self.assertFalse([name for name in self.files() if name.endswith(".tmp")])

    def test_a_second_signal_does_not_wait_and_leaves_nothing_half_written(self):
        self.assertIn(self.interrupted(signal.SIGINT, times=2), (130, -signal.SIGINT))
        report = self.folder / "out/report.json"
        if report.exists():
            self.assertIs(json.loads(report.read_text())["complete"], False)

    def test_after_a_kill_the_next_run_works(self):
        self.assertEqual(self.interrupted(signal.SIGKILL), -signal.SIGKILL)
        run = self.run_in([SCSIM, QUICKSTART, "-o", "out", "--quiet", *SHORT])
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIs(json.loads((self.folder / "out/report.json").read_text())["complete"], True)


class Surroundings(Faults):
    def artefacts(self, name, arguments=(), **more):
        run = self.run_in([SCCOMPILE, QUICKSTART, "--emit", "mjcf,bsm,resolved,dot", *arguments,
                           "-o", self.folder / name], **more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return {file: (self.folder / name / file).read_bytes() for file in self.files(name)}

    def test_artefacts_do_not_depend_on_the_surroundings(self):
        plain = self.artefacts("plain")
        self.assertEqual(plain, self.artefacts("again"))
        self.assertEqual(plain, self.artefacts("root", cwd="/"))
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", self.folder / "de_DE.UTF-8"],
                       check=True, capture_output=True)
        # Reading LOCPATH leaks inside the C library, which sanitizers would blame on us.
        comma = {"LC_ALL": "de_DE.UTF-8", "LOCPATH": str(self.folder),
                 "ASAN_OPTIONS": "detect_leaks=0"}
        printed = self.run_in(["printf", "%.1f", "0,5"], env=comma).stdout
        self.assertEqual(printed, "0,5", "a locale with a comma is what this is about")
        for variables in ({}, comma, {"TZ": "Asia/Tokyo", "TERM": "dumb"},
                          {"LC_ALL": "no_SUCH.locale"}):
            self.assertEqual(plain, self.artefacts("env", env=variables), variables)

    def test_a_report_names_the_bytes_that_ran(self):
        changes = ["--set", "hub.mass=700"]
        artefacts = self.artefacts("emitted", arguments=changes)
        run = self.run_in([SCSIM, QUICKSTART, "-o", "out", "--quiet", *SHORT, *changes])
        self.assertEqual(run.returncode, 0, run.stderr)
        report = json.loads((self.folder / "out/report.json").read_text())
        of = {"mjcf": ".xml", "bsm": ".bsm.json"}
        expected = {target: hashlib.sha256(artefacts["wheels_and_panels" + ending]).hexdigest()
                    for target, ending in of.items()}
        told = report["members"][0]["emitted_sha256"]
        self.assertEqual({target: told[target] for target in of}, expected)
        spec = hashlib.sha256(QUICKSTART.read_bytes()).hexdigest()
        self.assertEqual(report["spec"]["sha256"], spec)

    def study(self):
        spec = self.folder / "study.yaml"
        spec.write_text("extends: base.yaml\n"
                        "study: {sweep: [{set: hub.mass, values: [500, 600, 700, 800]}]}\n")
        shutil.copy(QUICKSTART, self.folder / "base.yaml")
        return spec

    def test_trajectories_do_not_depend_on_the_number_of_jobs(self):
        spec = self.study()
        tables = []
        for jobs in (1, 2, 7):
            run = self.run_in([SCSIM, spec, "-o", f"jobs{jobs}", "--quiet", "--jobs", jobs, *SHORT])
            self.assertEqual(run.returncode, 0, run.stderr)
            folder = self.folder / f"jobs{jobs}"
            tables.append({str(file.relative_to(folder)): file.read_bytes()
                           for file in sorted(folder.rglob("*.csv"))})
        self.assertEqual(len(tables[0]), 8)
        self.assertEqual(tables[0], tables[1])
        self.assertEqual(tables[0], tables[2])

    def test_a_working_directory_that_is_gone(self):
        script = 'mkdir gone; cd gone; rmdir ../gone; "$@"'
        run = self.run_in(["bash", "-c", script, "bash", SCCOMPILE, QUICKSTART, "-o",
                           self.folder / "out"])
        self.assertEqual(run.returncode, 0, run.stderr)
        run = self.run_in(["bash", "-c", script, "bash", SCSIM, QUICKSTART, "-o", "x", *SHORT])
        self.assert_fails(run, 3, "no such file or directory")

    def test_two_runs_into_one_folder(self):
        runs = [subprocess.Popen([SCSIM, QUICKSTART, "-o", "out", "--quiet", *SHORT],
                                 cwd=self.folder) for _ in range(2)]
        self.assertEqual([run.wait(HANG) for run in runs], [0, 0])
        self.assertEqual(self.files(), ["bsm.csv", "mujoco.csv", "report.html", "report.json"])
        self.assertIs(json.loads((self.folder / "out/report.json").read_text())["complete"], True)

    @unittest.skipUnless(STRACE, "strace cannot trace here")
    def test_threads_that_cannot_start_do_not_cost_the_study(self):
        run = self.run_in(failing("clone,clone3:error=EAGAIN") +
                          [SCSIM, self.study(), "-o", "out", "--quiet", "--jobs", "4", *SHORT])
        self.assertEqual(run.returncode, 0, run.stderr)

    @unittest.skipIf(SANITIZED, "the sanitizer takes more than any limit")
    def test_too_little_memory_is_said(self):
        spec = self.folder / "large.yaml"
        loads = "".join(f"  - {{name: l{i}, force: [1, 0, 0]}}\n" for i in range(20000))
        spec.write_text(QUICKSTART.read_text() + "loads:\n" + loads)
        for mebibytes in (40, 45, 60, 80):
            def limit(size=mebibytes << 20):
                resource.setrlimit(resource.RLIMIT_AS, (size, size))
            run = self.run_in([SCCOMPILE, spec, "-o", "out"], preexec_fn=limit)
            self.assert_fails(run, 4, "out of memory")
            self.assertFalse((self.folder / "out").exists() and self.files())


class Bombs(Faults):
    """Refused in a second and 100 MB; the limit on work allows for sanitizers and slow machines."""

    def refused(self, text, code, words):
        def limit():  # of processor time [s], which waiting for a busy machine does not use up
            resource.setrlimit(resource.RLIMIT_CPU, (60, 60))
        self.assert_fails(self.run_in([SCCOMPILE, "-"], input=text, preexec_fn=limit), code, words)

    def test_each_is_refused(self):
        alias = "a: &a [x,x,x,x,x,x,x,x,x]\n" + "".join(
            f"{chr(98 + i)}: &{chr(98 + i)} [{','.join(['*' + chr(97 + i)] * 9)}]\n"
            for i in range(12))
        self.refused(alias, 1, "SC1009")
        self.refused("a: " + "[" * 100_000, 1, "SC1007")
        self.refused("{a: " * 100_000, 1, "SC1007")
        self.refused("".join(f"k{i}: 1\n" for i in range(20_000)), 1, "SC2001")
        self.refused("- x\n" * 300_000, 1, "SC1008")
        self.refused("a: " + "x" * (5 << 20), 3, "larger than 4 MiB")

    def test_a_file_without_end_is_not_read(self):
        os.truncate(os.open(self.folder / "sparse", os.O_CREAT | os.O_WRONLY), 1 << 30)
        os.mkfifo(self.folder / "fifo")
        self.assert_fails(self.run_in([SCCOMPILE, "sparse"]), 3, "larger than 4 MiB")
        self.assert_fails(self.run_in([SCCOMPILE, "/dev/zero"]), 3, "not a regular file")
        self.assert_fails(self.run_in([SCCOMPILE, "fifo"]), 3, "not a regular file")
        with open("/dev/zero", "rb") as endless:
            self.assert_fails(self.run_in([SCCOMPILE, "-"], stdin=endless), 3, "larger than 4 MiB")


if __name__ == "__main__":
    if not STRACE:
        print("SKIPPED: what takes strace, which cannot trace here", file=sys.stderr)
    unittest.main(argv=sys.argv[:1])
