"""Campaigns: many members of a spec with drawn values."""

from __future__ import annotations

import json
import math
import operator
import os
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._errors import Error, FileError, InputError
from ._run import Finding
from ._trajectory import described, hint, provenance

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped, unused-ignore]
    import xarray

    from ._model import Model

_SECONDS_OF_A_TASK = 0.3  # by an estimate that may be ten times too small or too large
_LEAST_OF_A_TASK = 16  # members, which fly side by side in the lanes of a processor
_MOST_TASKS = 10_000


class Executor(Protocol):
    """What flies tasks: ``concurrent.futures.Executor``, ``dask.distributed.Client`` and the like."""

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Any:
        """A future of ``fn(*args)``, with ``result()``."""


def _count_of(name: str, value: int | None) -> int:
    if value is None:
        return 0
    count = operator.index(value)
    if count <= 0:
        raise ValueError(f"`{name}` must be > 0 or None, not {value}")
    return count


def _fly_shard(
    model: Model, shard: int, shards: int, engine: str, jobs: int, isa: str, version: str
) -> bytes:
    """A task: the records of a part. It leaves nothing behind, so it may be flown twice."""
    if version != _core.version:
        raise Error(f"a campaign of twincraft {version} cannot be flown by a worker's {_core.version}")
    return _core.fly_campaign(
        model._core, engine, jobs, isa, "", shard, shards, False, []).records()


def _tasks_of(model: Model) -> int:
    of_a_task = max(_LEAST_OF_A_TASK, int(_SECONDS_OF_A_TASK / model._core.member_cost))
    return min(math.ceil(model._core.campaign_members / of_a_task), _MOST_TASKS)


def _fly_elsewhere(executor: Executor, task: tuple[Any, ...], tasks: int) -> list[bytes]:
    """The records of all parts, of which each is a task."""
    model, *how = task
    futures: list[Any] = []
    records: list[bytes] = []
    try:
        for shard in range(1, tasks + 1):
            futures.append(executor.submit(_fly_shard, model, shard, tasks, *how))
        for future in futures:
            records.append(future.result())
    except BaseException as error:
        for future in futures[len(records) :]:
            if hasattr(future, "cancel"):
                future.cancel()
        error.add_note(
            f"the campaign ended with {len(records)} of {tasks} tasks done; no file was written")
        raise
    return records


def _check_writable(folder: str) -> None:
    """Before tasks are flown for hours."""
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise FileError(f"cannot make `{folder}`: {error.strerror}") from error
    if not os.access(folder, os.W_OK | os.X_OK):
        raise FileError(f"cannot write into `{folder}`")


def fly(
    model: Model,
    executor: Executor | None,
    jobs: int | None,
    folder: str | os.PathLike[str] | None,
    engine: str | None,
    isa: str,
    tasks: int | None,
    resume: bool,
) -> Campaign:
    """See :meth:`Model.campaign`."""
    place = "" if folder is None else os.fspath(folder)
    if folder is not None and not place:
        raise ValueError("`folder` must have a name")
    if resume and not place:
        raise ValueError("`resume` needs a `folder`")
    threads, parts = _count_of("jobs", jobs), _count_of("tasks", tasks)
    records: list[bytes] = []
    if executor is not None:
        if not hasattr(executor, "submit"):
            raise TypeError(f"an executor has `submit`, which {executor!r} has not")
        if resume:
            raise ValueError("`resume` goes without an executor")
        if place:
            _check_writable(place)
        task = (model, engine or "", threads or 1, isa, _core.version)
        # None where there is no campaign, which is said below.
        count = min(parts or _tasks_of(model), model._core.campaign_members)
        records = _fly_elsewhere(executor, task, count)
    elif parts:
        raise ValueError("`tasks` are an executor's")
    return Campaign(
        _core.fly_campaign(model._core, engine or "", threads, isa, place, 0, 0, resume, records),
        model)


class Campaign(Finding):
    """A campaign as ``scsim`` flies it. ``str()`` is what the program prints.

    ``c[name]`` is a column of its table, a number per member; ``len(c)`` counts the members, and
    iteration gives the names of the columns, as of a table of pandas.
    """

    _finished: _core.FlownCampaign

    def __init__(self, finished: _core.FlownCampaign, model: Model) -> None:
        super().__init__(finished)
        self._model = model
        self._places = {name: i for i, (name, _) in enumerate(finished.columns)}
        self._columns: dict[str, NDArray[np.float64]] = {}
        #: Unit of every column.
        self.units: Mapping[str, str] = MappingProxyType(dict(finished.columns))
        self._members = finished.members()

    @property
    def model(self) -> Model:
        """The model whose campaign it is."""
        return self._model

    @property
    def verdict(self) -> str:
        """The worst of the members: ``agree``, ``disagree``, ``unresolved``, ``not_judged``,
        ``failed``."""
        return self._finished.verdict

    @property
    def exit_code(self) -> int:
        """What the program would end with: 0, 1 or 4."""
        return self._finished.exit_code

    @property
    def members(self) -> NDArray[np.int64]:
        """Number of the member of every row, rising."""
        return self._members

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns of numbers, those of ``campaign.csv`` without units."""
        return tuple(self._places)

    @property
    def verdicts(self) -> list[str]:
        """Verdict of every row."""
        return self._finished.verdicts()

    @property
    def reasons(self) -> list[str]:
        """Why the member of every row is broken, stopped, failed or refused; empty: it is not."""
        return self._finished.reasons()

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name not in self._places:
            raise InputError(f"unknown column `{name}`{hint(name, self._places)}")
        if name not in self._columns:
            self._columns[name] = self._finished.column(self._places[name])
        return self._columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self._places

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._members)

    def __bool__(self) -> bool:
        return self._finished.passes

    def __repr__(self) -> str:
        return f"<twincraft.Campaign {self._model.name}, {len(self)} members, {self.verdict}>"

    def worst(self, k: int = 5, by: str | None = None) -> list[int]:
        """The ``k`` members that break the requirement on output ``by`` by most or come nearest
        to it, worst first; of an output without requirement those with the largest values.

        ``by`` None: the output of ``campaign.keep``, else the first with a requirement, else the
        first. Raises InputError for an unknown output.
        """
        count = operator.index(k)
        if count < 0:
            raise ValueError(f"a number of members must be >= 0, not {k}")
        if by == "":
            raise InputError("an output has a name")
        return self._finished.worst(min(count, len(self)), by or "")

    def member(self, i: int) -> Model:
        """Member ``i`` as a model of its own: the spec with what was drawn for it, and without its
        campaign.

        Raises InputError where there is no such member, SpecError where what was drawn is no
        vehicle.
        """
        return self._model.member(i)

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write the files that ``scsim -o FOLDER`` writes, byte for byte but for times.

        Raises FileError, which is an OSError.
        """
        self._finished.save(os.fspath(folder))

    def to_pandas(self) -> pandas.DataFrame:
        """``campaign.csv``, as pandas reads it with ``index_col="member"``."""
        import io

        import pandas

        return pandas.read_csv(
            io.StringIO(self._finished.csv()), index_col="member")

    def to_xarray(self) -> xarray.Dataset:
        """``campaign.nc``, as xarray opens it: one dimension, member."""
        import xarray

        header = json.loads(self._finished.header())
        variables: dict[str, Any] = {}
        for drawn in header["drawn"]:
            attributes = described(drawn["unit"], drawn["name"])
            attributes |= {key: drawn[key] for key in ("distribution", "nominal")}
            variables[drawn["name"]] = ("member", np.array(self[drawn["name"]]), attributes)
        for output in header["outputs"]:
            attributes = described(output["unit"], output["meaning"])
            attributes |= {
                key: output[key] for key in ("below", "above") if output[key] is not None}
            variables[output["name"]] = ("member", np.array(self[output["name"]]), attributes)
        for name, texts, words in (
            ("verdict", self.verdicts, "verdict on the agreement of the engines"),
            ("reason", self.reasons, "why the member is broken, stopped, failed or refused"),
        ):
            variables[name] = ("member", np.array(texts, dtype=object), {"long_name": words})
        variables["seconds"] = (
            "member", np.array(self["seconds"]), described("s", "time that the member took"))
        members = ("member", np.array(self.members), {"long_name": "number of the member"})
        attributes = {
            "Conventions": "CF-1.8",
            "title": header["name"],
            "spec_sha256": header["spec_sha256"],
            "instructions": header["instructions"],
            **provenance(self.report),
        }
        return xarray.Dataset(variables, {"member": members}, attributes)
