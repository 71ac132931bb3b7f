"""What the programs say about a model."""

from __future__ import annotations

import json
import os
from html import escape
from typing import TYPE_CHECKING, Any

from . import _core
from ._trajectory import Trajectory, provenance

if TYPE_CHECKING:
    from ._model import Model


class Finding:
    """What a proof or an attribution found. True when the program would end with 0."""

    def __init__(self, finished: _core.FinishedRun) -> None:
        self._finished = finished
        self._report: dict[str, Any] | None = None

    @property
    def verdict(self) -> str:
        """``proved`` or ``refuted``; ``explained`` or ``unexplained``."""
        return self._finished.verdict

    @property
    def report(self) -> dict[str, Any]:
        """The program's report as a dict."""
        if self._report is None:
            self._report = json.loads(self._finished.json)
        return self._report

    def __bool__(self) -> bool:
        return self._finished.passes

    def __str__(self) -> str:
        return self._finished.text

    def __repr__(self) -> str:
        return f"<twincraft.{type(self).__name__} {self.verdict}>"

    def _repr_html_(self) -> str:
        return f"<b>{escape(self.verdict)}</b><pre>{escape(str(self))}</pre>"


class Run(Finding):
    """A run as ``scsim`` does it. ``str()`` is what the program prints."""

    def __init__(self, finished: _core.FinishedRun, model: Model) -> None:
        super().__init__(finished)
        self._model = model
        self._trajectories: dict[str, Trajectory | None] = {}

    @property
    def model(self) -> Model:
        """The model that was flown."""
        return self._model

    @property
    def verdict(self) -> str:
        """``agree``, ``disagree``, ``unresolved``, ``not_judged``, ``failed``, ``interrupted``."""
        return self._finished.verdict

    @property
    def bsm(self) -> Trajectory | None:
        """Samples of the analytic engine, of a study the first member's. None: not flown."""
        return self._trajectory("bsm")

    @property
    def mujoco(self) -> Trajectory | None:
        """Samples of MuJoCo, of a study the first member's. None: not flown."""
        return self._trajectory("mujoco")

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write the files that ``scsim -o FOLDER`` writes, byte for byte.

        Raises FileError, which is an OSError.
        """
        self._finished.save(os.fspath(folder))

    def _trajectory(self, engine: str) -> Trajectory | None:
        if engine not in self._trajectories:
            signals = self._model._core.outputs
            rows = self._finished.samples(engine, 1 + len(signals))
            self._trajectories[engine] = (
                Trajectory(rows, signals, self._attributes(engine)) if len(rows) else None
            )
        return self._trajectories[engine]

    def _attributes(self, engine: str) -> dict[str, str]:
        """Of the .nc file."""
        report = self.report
        spec = report["spec"]
        member = report["members"][0]
        return {
            "title": spec["name"],
            "summary": member["resolved"].get("description", ""),
            "engine": engine,
            "spec_file": spec["file"],
            "spec_sha256": spec["sha256"],
            **provenance(report),
            "settings": "".join(f"{path}={value}\n" for path, value in member["settings"].items()),
        }
