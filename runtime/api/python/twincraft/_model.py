"""Compiled specs."""

from __future__ import annotations

import operator
import os
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from types import MappingProxyType
from typing import Any, Literal, NoReturn

import numpy as np
from numpy.typing import NDArray

from . import _core as native
from ._campaign import Campaign, Executor, fly
from ._errors import Error, InputError, warn_of
from ._overrides import overrides
from ._run import Finding, Run


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Mass properties at t = 0, in B axes."""

    #: Mass [kg].
    mass: float
    #: Centre of mass from B [m], (3,).
    center_of_mass: NDArray[np.float64]
    #: Inertia about the centre of mass [kg m2], (3, 3).
    inertia: NDArray[np.float64]


def load(path: str | os.PathLike[str], set: Mapping[str, Any] | None = None) -> Model:
    """Compile a spec.

    ``set`` changes the spec by path, as ``--set`` of the programs does. A value is a text, which
    may carry a unit, or a number (SI), a bool, a sequence or an array.

    >>> import twincraft as tc
    >>> m = tc.load("models/quickstart.yaml", set={"simulation.step": "0.01 s"})
    >>> m.name, m.degrees_of_freedom
    ('wheels_and_panels', 11)

    Raises SpecError for a spec with errors, InputError for a value that is not finite, and
    FileError, which is an OSError. Warnings of the compiler are SpecWarning.
    """
    return Model._made(native.load(os.fspath(path), overrides(set)))


def loads(text: str, set: Mapping[str, Any] | None = None) -> Model:
    """Compile a spec from a text. Diagnostics call it ``<string>``.

    ``extends`` is looked for from the current folder. Otherwise as :func:`load`.
    """
    return Model._made(native.loads(text, overrides(set), "<string>"))


def _unpickled(resolved: str, digest: str, version: str) -> Model:
    try:
        core = native.loads(resolved, [], "<pickle>")
    except Error as error:
        raise Error(
            f"a model pickled by twincraft {version} does not compile in {native.version}: {error}"
        ) from error
    if core.digest != digest:
        raise Error(
            f"a model pickled by twincraft {version} is another one in {native.version}: its digest "
            f"was {digest} and is {core.digest}; load its spec again"
        )
    return Model._of(core)


def _units(signals: list[tuple[str, str, str]]) -> Mapping[str, str]:
    return MappingProxyType({name: unit for name, unit, _ in signals})


class Model:
    """A compiled spec. It is immutable, may be shared by threads, pickles and deep-copies.

    Two models are equal when their ``digest`` is. Made by :func:`load` and :func:`loads`.
    """

    __slots__ = ("__weakref__", "_core", "_inputs", "_outputs", "_states")

    _core: native.CompiledModel
    _inputs: Mapping[str, str]
    _outputs: Mapping[str, str]
    _states: Mapping[str, str]

    def __init__(self) -> None:
        raise TypeError("models are made by twincraft.load and twincraft.loads")

    @classmethod
    def _of(cls, core: native.CompiledModel) -> Model:
        self = object.__new__(cls)
        for name, value in (
            ("_core", core),
            ("_inputs", _units(core.inputs)),
            ("_outputs", _units(core.outputs)),
            ("_states", _units(core.states)),
        ):
            object.__setattr__(self, name, value)
        return self

    @classmethod
    def _made(cls, core: native.CompiledModel) -> Model:
        self = cls._of(core)
        warn_of(core.diagnostics)
        return self

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"a model is immutable: `{name}` cannot be set")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a model is immutable: `{name}` cannot be deleted")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Model) and self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def __copy__(self) -> Model:
        return self

    def __deepcopy__(self, memo: object) -> Model:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self.resolved, self.digest, native.version)

    @property
    def name(self) -> str:
        """Name of the spec."""
        return self._core.name

    @property
    def digest(self) -> str:
        """SHA-256 of :attr:`resolved`, hexadecimal."""
        return self._core.digest

    @property
    def mjcf(self) -> str:
        """What ``sccompile --emit mjcf`` writes."""
        return self._core.mjcf

    @property
    def resolved(self) -> str:
        """What ``sccompile --emit resolved`` writes. It compiles to the same model alone."""
        return self._core.resolved

    @property
    def inputs(self) -> dict[str, str]:
        """Unit of every input, in the order of ``Batch.u``."""
        return dict(self._inputs)

    @property
    def outputs(self) -> dict[str, str]:
        """Unit of every output: the CSV's columns without ``t``, in their order."""
        return dict(self._outputs)

    @property
    def states(self) -> dict[str, str]:
        """Unit of every state, in the order of ``Simulation.state``; one for both engines."""
        return dict(self._states)

    @property
    def degrees_of_freedom(self) -> int:
        """Number of degrees of freedom."""
        return self._core.degrees_of_freedom

    @property
    def step(self) -> float:
        """``simulation.step`` [s]."""
        return self._core.step

    @property
    def duration(self) -> float:
        """``simulation.duration`` [s]. It bounds :meth:`run` alone."""
        return self._core.duration

    def mass_properties(self) -> MassProperties:
        """Mass, centre of mass and inertia at t = 0."""
        return MassProperties(*self._core.mass_properties())

    def prove(self) -> Finding:
        """Are the two targets one machine? What ``sccompile --check`` does."""
        return Finding(self._core.prove())

    def attribute(self) -> Finding:
        """Why do the engines differ? What ``scsim attribute`` does."""
        return Finding(self._core.attribute())

    def run(
        self, engine: Literal["both", "bsm", "mujoco"] = "both", timing: bool = False
    ) -> Run:
        """Fly the spec as ``scsim`` does, and compare.

        A verdict is no exception; a run that fails says so in :attr:`Run.verdict`. Ctrl-C ends it.

        >>> import twincraft as tc
        >>> run = tc.load("models/quickstart.yaml").run()
        >>> run.verdict
        'agree'
        >>> run.bsm["omega_BN_B"].shape
        (241, 3)

        Raises ValueError for an unknown engine.
        """
        return Run(self._core.run(engine, timing), self)

    def campaign(
        self,
        executor: Executor | None = None,
        *,
        jobs: int | None = None,
        folder: str | os.PathLike[str] | None = None,
        engine: Literal["both", "bsm"] | None = None,
        isa: Literal["auto", "portable", "avx2", "avx512"] = "auto",
        tasks: int | None = None,
        resume: bool = False,
    ) -> Campaign:
        """Fly the spec's campaign as ``scsim`` does: many members with drawn values.

        ``executor`` None: in this process, on ``jobs`` threads (None: all cores). Else anything
        that has ``submit``, such as ``concurrent.futures.ProcessPoolExecutor`` or
        ``dask.distributed.Client``: the members are split into ``tasks`` (None: of about a second
        each), each task flies on ``jobs`` threads (None: one), and the table is made here. It is
        the same table, but for ``seconds``.

        ``folder``: write the files of ``scsim -o FOLDER`` there; with ``resume`` the members that
        it has are kept. ``engine``: "both" flies all members in both engines, "bsm" none; None as
        the campaign says. ``isa``: instructions of the analytic engine.

        A verdict is no exception. What a task raises comes through. Ctrl-C ends it; the members
        flown are in ``folder`` then, for ``resume``, unless an executor flew.

        >>> import twincraft as tc
        >>> m = tc.load("models/gallery/dispersed_burn.yaml", set={"campaign.members": 8})
        >>> c = m.campaign()
        >>> len(c), c["delta_v"].shape, c.units["delta_v"]
        (8, (8,), 'm/s')

        Raises SpecError for a spec without a campaign, FileError where ``folder`` cannot be written
        or holds the results of another spec, InputError for an ``isa`` that the processor lacks.
        """
        return fly(self, executor, jobs, folder, engine, isa, tasks, resume)

    def member(self, i: int) -> Model:
        """Member ``i`` of the spec's campaign as a model of its own: the spec with what is drawn
        for it, and without its campaign.

        Raises SpecError for a spec without a campaign, or where what is drawn is no vehicle;
        InputError where there is no such member.
        """
        index = operator.index(i)
        if index < 0:
            raise InputError(f"members count from 0: there is no member {index}")
        return Model._of(self._core.member(index))

    def simulate(self, engine: Literal["bsm", "mujoco"] = "bsm") -> native.Simulation:
        """One engine, at t = 0.

        >>> import twincraft as tc
        >>> sim = tc.load("models/quickstart.yaml").simulate()
        >>> sim.inputs["rw_x.torque"] = "10 mN m"
        >>> sim.run_until(60.0)
        60.0

        Raises ValueError for an unknown engine, InputError for one that cannot fly this model.
        """
        return native.Simulation(self, engine)

    def twin(self, lead: Literal["bsm", "mujoco", "each"] = "bsm") -> native.Twin:
        """Both engines in lock step, at t = 0.

        Controllers see the outputs of ``lead`` and drive both. With ``each``, ``controller`` is
        a dict ``{"bsm": f, "mujoco": g}``: each sees its own engine and drives it alone.
        """
        return native.Twin(self, lead)

    def __repr__(self) -> str:
        return f"<twincraft.Model {self.name}, {self.degrees_of_freedom} DOF, {self.digest[:12]}>"

    def _repr_html_(self) -> str:
        mass = self.mass_properties()
        rows = [
            ("degrees of freedom", str(self.degrees_of_freedom)),
            ("mass", f"{mass.mass:.6g} kg"),
            ("centre of mass", "[" + ", ".join(f"{x:.6g}" for x in mass.center_of_mass) + "] m"),
            ("inertia", "diag " + ", ".join(f"{x:.6g}" for x in mass.inertia.diagonal()) + " kg m2"),
            ("inputs", ", ".join(f"{n} [{u}]" for n, u in self._inputs.items()) or "none"),
            ("step, duration", f"{self.step:.6g} s, {self.duration:.6g} s"),
            ("digest", self.digest[:16]),
        ]
        body = "".join(
            f"<tr><th style='text-align:left'>{escape(k)}</th>"
            f"<td style='text-align:left'>{escape(v)}</td></tr>"
            for k, v in rows
        )
        return f"<table><caption><b>{escape(self.name)}</b></caption>{body}</table>"
