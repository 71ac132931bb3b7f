"""A Slurm cluster of one node, for as long as a test needs it.

It lives in a temporary folder and listens on this machine alone, without systemd, cgroups or a database.
It needs root. Its daemons end with us, even when we are killed."""

from __future__ import annotations

import os
import re
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from signal import SIGKILL

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "setpriv")
HOST = socket.gethostname().split(".")[0]

# Sixteen processors, however many there are: tasks of tests mostly wait.
# A requeued task waits until its credential has expired, 120 s by default: hence cred_expire, in seconds.
CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
MailProg=/bin/true
ReturnToService=2
KillWait=1
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs=16 RealMemory=1000
PartitionName=test Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def want_of() -> str | None:
    """Why there can be no node here; None where there can."""
    if os.geteuid() != 0:
        return "a Slurm node needs root"
    if lacking := [program for program in PROGRAMS if not shutil.which(program)]:
        return f"{', '.join(lacking)} not found; tools/setup --clusters installs what is missing"
    return None


@dataclass(frozen=True)
class Task:
    """A job, or one task of an array, as Slurm shows it."""

    state: str  # such as RUNNING
    exit_code: int  # of the script
    signal: int  # that ended the script; 0: none
    restarts: int  # times that it was requeued

    @property
    def is_over(self) -> bool:
        return self.state in {"COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL"}


class Slurm:
    """The commands of a running node. A job is named by its id, such as 7, a task of an array as 7_2.
    Each command raises CalledProcessError where Slurm refuses."""

    def __init__(self, configuration: Path) -> None:
        self.configuration = configuration
        self.mark = f"SLURM_CONF={configuration}"  # in the environment of each process of this cluster
        self.environment = {**os.environ, "SLURM_CONF": str(configuration)}

    def run(self, *command: str | Path, **settings) -> str:
        """Standard output of a command that sees this cluster."""
        settings = {"env": self.environment, "check": True, "text": True, **settings}
        return subprocess.run(command, stdout=subprocess.PIPE, **settings).stdout.strip()

    def submit(self, script: Path, *arguments: str | Path, array: str = "", signal: str = "",
               options: tuple[str, ...] = (), **settings) -> str:
        """The id of the job that runs a script with arguments; settings are those of subprocess.run."""
        options += (f"--array={array}",) * bool(array) + (f"--signal={signal}",) * bool(signal)
        return self.run("sbatch", "--parsable", *options, script, *arguments, **settings)

    def tasks(self, job: str) -> dict[int, Task]:
        """The tasks by their number in the array, 0 where the job is none."""
        lines = self.run("scontrol", "show", "job", "--oneliner", job).splitlines()
        return {number: task for line in lines for number, task in tasks_of(line)}

    def wait(self, job: str) -> dict[int, Task]:
        """The tasks once all are over."""
        wait_until(lambda: all(task.is_over for task in self.tasks(job).values()), f"job {job} is over")
        return self.tasks(job)

    def requeue(self, job: str) -> None:
        self.run("scontrol", "requeue", job)

    def cancel(self, job: str) -> None:
        self.run("scancel", job)

    def signal(self, job: str, name: str) -> None:
        """Signals the script alone, as `--signal=B:NAME` does before the limit."""
        self.run("scancel", "--batch", f"--signal={name}", job)

    def kill(self, job: str, program: str) -> None:
        """Kills a task's program by SIGKILL, as a machine out of memory does. Its script goes on."""
        (number,) = re.findall(r"\bJobId=(\d+)", self.run("scontrol", "show", "job", job))

        def found() -> list[Path]:
            return [process for process in self.processes(f"SLURM_JOB_ID={number}")
                    if program in {Path(word).name for word in strings_of(process / "cmdline")}]

        wait_until(lambda: bool(found()), f"{job} runs {program}")
        for process in found():
            os.kill(int(process.name), SIGKILL)

    def processes(self, *marks: str) -> list[Path]:
        """Folders in /proc of this cluster's processes that have these marks in their environment."""
        wanted = {self.mark, *marks}
        return [folder for folder in Path("/proc").glob("[0-9]*")
                if wanted <= strings_of(folder / "environ")]


def tasks_of(line: str) -> Iterator[tuple[int, Task]]:
    """The tasks of a line of `scontrol show job --oneliner`: several where those that wait share one."""
    fields = dict(re.findall(r"(\w+)=(\S*)", line))
    code, by_signal = map(int, fields["ExitCode"].split(":"))
    task = Task(fields["JobState"], code, by_signal, int(fields["Restarts"]))
    numbers = fields.get("ArrayTaskId", "0").partition("%")[0]  # such as 3,5-7%2
    for first, last in re.findall(r"(\d+)(?:-(\d+))?", numbers):
        for number in range(int(first), int(last or first) + 1):
            yield number, task


def strings_of(file: Path) -> set[str]:
    """The strings of a file in /proc; none where the process has ended."""
    try:
        return set(file.read_bytes().decode(errors="replace").split("\0"))
    except OSError:
        return set()


def wait_until(holds: Callable[[], bool], what: str, limit: float = 180.0) -> None:
    """Returns once it holds; fails after the limit [s]."""
    end = time.monotonic() + limit
    while not holds():
        assert time.monotonic() < end, f"not within {limit:g} s: {what}"
        time.sleep(0.05)


@contextmanager
def slurm_node() -> Iterator[Slurm]:
    """A node that takes jobs. What runs on it ends with it."""
    with tempfile.TemporaryDirectory(prefix="slurm") as name, ExitStack() as stack:
        folder = Path(name)
        slurm = Slurm(write_configuration(folder))
        stack.callback(end_leftovers, slurm)
        key = folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(os.urandom(128))
        start = partial(start_daemon, stack, slurm, folder)
        start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={folder}/munge.socket",
              f"--pid-file={folder}/munged.pid", f"--seed-file={folder}/munge.seed")
        wait_until((folder / "munge.socket").exists, "munged is there", 10.0)
        start("slurmctld", "-D", "-c")
        start("slurmd", "-D", "-N", HOST)
        try:
            wait_until(lambda: is_idle(slurm), "the node is idle", 20.0)
        except AssertionError as late:
            logs = "\n".join(f"{log.name}: {log.read_text()[-2000:]}" for log in folder.glob("*.log"))
            raise AssertionError(f"{late}\n{logs}") from None
        yield slurm


def write_configuration(folder: Path) -> Path:
    with socket.socket() as first, socket.socket() as second:
        for free in (first, second):
            free.bind(("127.0.0.1", 0))
        controller_port, node_port = (free.getsockname()[1] for free in (first, second))
    (folder / "state").mkdir()
    (folder / "spool").mkdir()
    configuration = folder / "slurm.conf"
    configuration.write_text(CONFIGURATION.format(
        folder=folder, host=HOST, controller_port=controller_port, node_port=node_port))
    return configuration


def start_daemon(stack: ExitStack, slurm: Slurm, folder: Path, name: str, *arguments: str) -> None:
    """Starts a daemon in the foreground; the stack ends it."""
    with (folder / f"{name}.log").open("w") as log:
        daemon = subprocess.Popen(["setpriv", "--pdeathsig", "TERM", name, *arguments],
                                  env=slurm.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
    stack.callback(end_daemon, daemon)


def end_daemon(daemon: subprocess.Popen) -> None:
    daemon.terminate()
    try:
        daemon.wait(10)
    except subprocess.TimeoutExpired:
        daemon.kill()
        daemon.wait()


def end_leftovers(slurm: Slurm) -> None:
    """Kills what is left of the jobs: slurmd leaves them running when it ends."""
    def none_is_left() -> bool:
        left = slurm.processes()
        for process in left:
            with suppress(ProcessLookupError):
                os.kill(int(process.name), SIGKILL)
        return not left

    wait_until(none_is_left, "the jobs are dead", 10.0)


def is_idle(slurm: Slurm) -> bool:
    """Whether the node waits for work; false while the controller does not answer either."""
    answer = subprocess.run(["sinfo", "--noheader", "--format=%T"], env=slurm.environment, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=15)
    return answer.stdout.strip() == "idle"
