"""Many spacecraft of one model."""

from __future__ import annotations

import operator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._errors import InputError
from ._model import Model


class Batch:
    """``n`` spacecraft of one model by the analytic engine, all at t = 0.

    ``threads`` is the number of threads, None for all cores. The results are the same bytes for
    any number.

    >>> import twincraft as tc
    >>> batch = tc.Batch(tc.load("models/quickstart.yaml"), n=4)
    >>> batch.u = [0.01, 0.0, 0.0]  # one row serves all
    >>> batch.step(100)
    >>> batch.y.shape, batch.status.tolist()
    ((4, 27), [0, 0, 0, 0])

    Raises ValueError for n or threads <= 0, InputError for a model that BSM cannot fly.
    """

    def __init__(self, model: Model, n: int, threads: int | None = None) -> None:
        count = operator.index(n)
        workers = 0 if threads is None else operator.index(threads)
        if count <= 0:
            raise ValueError(f"a number of members must be > 0, not {n}")
        if threads is not None and workers <= 0:
            raise ValueError(f"a number of threads must be > 0, or None for all cores, not {threads}")
        self._model = model
        self._engine = _core.BatchEngine(model._core, count, workers)

    @property
    def model(self) -> Model:
        """The model that it is made of."""
        return self._model

    @property
    def n(self) -> int:
        """Number of members."""
        return self._engine.n

    @property
    def time(self) -> float:
        """Time since the start [s]."""
        return self._engine.time

    @property
    def x(self) -> NDArray[np.float64]:
        """States, read-only (n, states), in the order of ``model.states``, SI.

        Set it to start from other states at the batch's time; one row serves all. A member that
        had failed flies again. Raises InputError for another shape or a number not finite.
        """
        return self._engine.x

    @x.setter
    def x(self, rows: ArrayLike) -> None:
        self._engine.set_states(self._rows("x", rows, len(self._model._states)))

    @property
    def u(self) -> NDArray[np.float64]:
        """Inputs that act, read-only (n, inputs), in the order of ``model.inputs``, SI.

        Set it to drive every input from now on; one row serves all. None gives all of them back
        to their schedules. Raises InputError for another shape or a number not finite.
        """
        return self._engine.u

    @u.setter
    def u(self, rows: ArrayLike | None) -> None:
        if rows is None:
            self._engine.release()
        else:
            self._engine.drive(self._rows("u", rows, len(self._model._inputs)))

    @property
    def y(self) -> NDArray[np.float64]:
        """Outputs, read-only (n, outputs), in the order of ``model.outputs``, SI."""
        return self._engine.y

    @property
    def status(self) -> NDArray[np.int32]:
        """0 for every member that flies, 4 for one that has failed, (n,) int32.

        A member that has failed has NaN in its ``x`` and ``y``; the others fly on.
        """
        return self._engine.status

    def reason(self, member: int) -> str:
        """Why a member has failed; empty: it has not."""
        return self._engine.reason(range(self.n)[member])

    def step(self, n: int = 1) -> None:
        """Go to the ``n``-th next point of the grid k * simulation.step.

        Raises ValueError for n <= 0. A member that fails raises nothing.
        """
        count = operator.index(n)
        if count <= 0:
            raise ValueError(f"a number of steps must be > 0, not {n}")
        self._engine.step(count)

    def _rows(self, name: str, rows: ArrayLike, width: int) -> NDArray[np.float64]:
        try:
            given = np.asarray(rows)
            if given.dtype.kind not in "biuf":
                raise ValueError
        except ValueError:
            raise InputError(f"`{name}` takes rows of {width} numbers") from None
        if given.shape not in ((width,), (1, width), (self.n, width)):
            shape = f"({self.n}, {width}) or ({width},)"
            raise InputError(f"`{name}` has the shape {shape}, not {given.shape}")
        numbers: NDArray[np.float64] = np.ascontiguousarray(given, dtype=np.float64)
        if not np.isfinite(numbers).all():
            raise InputError(f"`{name}` has a number that is not finite")
        return numbers

    def __repr__(self) -> str:
        return f"<twincraft.Batch of {self.n} {self._model.name}, t = {self.time!r} s>"
