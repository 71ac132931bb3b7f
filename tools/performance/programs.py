"""Building and running the benchmark programs."""

from __future__ import annotations

import concurrent.futures
import dataclasses
import fcntl
import json
import os
import pathlib
import subprocess
import tempfile

import callgrind
from cases import Case

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
STEPS = BUILD / "bin" / "bench_steps"
EVALUATIONS = BUILD / "bin" / "bench_evaluations"

# libc chooses its copies and sines by processor too; these choose for every processor alike.
PLAIN_LIBC = "glibc.cpu.hwcaps=-AVX512F,-AVX2,-AVX,-FMA,-FMA4,-BMI2,-ERMS,-FSRM"
STEP_FUNCTIONS = (
    "twincraft::propagate_bare*",
    "twincraft::RecordedRun::advance_until*",
    "twincraft::bench::run_raw*",
)


class Failed(Exception):
    """A program could not be built or did not end well; the text says why."""


def build(*targets: str) -> None:
    BUILD.mkdir(parents=True, exist_ok=True)
    log = BUILD / "benchmark.log"
    commands = [["cmake", "--build", "--preset", "release", "--target", *targets]]
    if not (BUILD / "build.ninja").exists():
        commands.insert(0, ["cmake", "--preset", "release"])
    with open(BUILD / ".lock", "w") as lock, open(log, "w") as output:
        fcntl.flock(lock, fcntl.LOCK_EX)  # as tools/launch: never two builds at once
        for command in commands:
            if subprocess.run(command, cwd=ROOT, stdout=output, stderr=output).returncode != 0:
                raise Failed(f"{log.read_text()}{' '.join(targets)} could not be built")


def run(command: list[str], environment: dict[str, str] | None = None) -> str:
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def race(case: Case, steps: int, trials: int) -> dict:
    options = ["--steps", str(steps), "--trials", str(trials)]
    return json.loads(run([str(STEPS), *case.arguments, *options]))


def benchmarks(pattern: str, repetitions: int) -> list[dict]:
    """Google Benchmark's own records, one per repetition."""
    options = [f"--benchmark_filter={pattern}", f"--benchmark_repetitions={repetitions}"]
    options += ["--benchmark_min_time=0.1", "--benchmark_format=json"]
    records = json.loads(run([str(EVALUATIONS), *options]))["benchmarks"]
    return [record for record in records if record["run_type"] == "iteration"]


def counted_run(case: Case, engine: str, steps: int, by_instruction: bool = False):
    """@return what the steps, their set-up included, cost under callgrind"""
    environment = {"PATH": "/usr/bin:/bin", "LC_ALL": "C", "GLIBC_TUNABLES": PLAIN_LIBC}
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "callgrind.out")
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={output}"]
        command += ["--compress-strings=no", "--compress-pos=no"]
        command += ["--dump-instr=yes", "--dump-line=no"] if by_instruction else []
        command += [f"--toggle-collect={function}" for function in STEP_FUNCTIONS]
        command += [str(STEPS), *case.arguments, "--engine", engine, "--steps", str(steps)]
        run(command, environment)
        return callgrind.read(output)


@dataclasses.dataclass(frozen=True)
class Count:
    instructions: float  # per step
    heap_calls: float  # of the heap's functions, per step


def count(case: Case, engine: str, fewer: int, more: int) -> Count:
    """The difference of two run lengths: what a step costs without any set-up."""
    first, second = (counted_run(case, engine, steps) for steps in (fewer, more))
    steps = more - fewer
    return Count(
        (callgrind.total(second) - callgrind.total(first)) / steps,
        (second.heap_calls - first.heap_calls) / steps,
    )


def counts(jobs: list[tuple[Case, str]], fewer: int, more: int) -> dict[tuple[str, str], Count]:
    """By name of the case and engine. Counts do not mind company, so all cores work."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        done = pool.map(lambda job: count(job[0], job[1], fewer, more), jobs)
        return {(case.name, engine): result for (case, engine), result in zip(jobs, done)}
