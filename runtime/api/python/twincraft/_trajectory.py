"""Samples of an engine by name."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped, unused-ignore]
    import xarray

_COMPONENTS = {("x", "y", "z"): "xyz", ("w", "x", "y", "z"): "wxyz"}


def hint(name: object, known: Iterable[str]) -> str:
    """The near miss of an unknown name."""
    from difflib import get_close_matches

    near = get_close_matches(str(name), list(known), 1)
    return f"; did you mean `{near[0]}`?" if near else ""


def described(unit: str, meaning: str) -> dict[str, Any]:
    """Attributes of a variable of a .nc file of ours. A unit is a product there: ``kg m-3``."""
    product = re.sub(r"/([^ /0-9]*)([0-9]*)", lambda below: f" {below[1]}-{below[2] or 1}", unit)
    return {"units": product, "long_name": meaning}


def provenance(report: Mapping[str, Any]) -> dict[str, str]:
    """Attributes of a .nc file of ours: which program wrote it."""
    told = report["provenance"]
    keys = {"source": "program", "git": "git", "compiler": "compiler", "compiler_flags": "flags",
            "mujoco": "mujoco", "eigen": "eigen"}
    return {name: told[key] for name, key in keys.items()}


def _grouped(names: list[str]) -> Iterator[tuple[str, slice, str]]:
    """(name, columns, components) of numbers that stand alone and of vectors."""
    i = 0
    while i < len(names):
        stem, _, _ = names[i].rpartition(".")
        for parts, label in _COMPONENTS.items():
            if stem and names[i : i + len(parts)] == [f"{stem}.{part}" for part in parts]:
                yield stem, slice(i, i + len(parts)), label
                i += len(parts)
                break
        else:
            yield names[i], slice(i, i + 1), ""
            i += 1


def _prints_whole(value: float) -> bool:
    """The CSV has it without a point or an exponent."""
    digits = str(abs(int(value))) if value == int(value) and abs(value) < 2**63 else ""
    mantissa = digits.rstrip("0")
    return bool(digits) and len(digits) <= len(mantissa) + (len(mantissa) > 1) + len("e+00")


class Trajectory(Mapping[str, NDArray[np.float64]]):
    """Samples of an engine: a mapping from names to float64 arrays, SI and read-only.

    Vectors are (samples, 3) or (samples, 4), everything else (samples,). Iteration gives the
    variables of the .nc file; components such as ``omega_BN_B.x`` are found, too.
    """

    def __init__(
        self,
        rows: NDArray[np.float64],
        signals: list[tuple[str, str, str]],
        attributes: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        names = [name for name, _, _ in signals]
        self._t = np.ascontiguousarray(rows[:, 0])
        self._t.flags.writeable = False
        self._numbers = rows[:, 1:]
        self._signals = signals
        self._columns = {name: i for i, name in enumerate(names)}
        self._groups = {name: (columns, label) for name, columns, label in _grouped(names)}
        self._attributes = dict(attributes)
        units = {"t": "s", **{name: unit for name, unit, _ in signals}}
        for name, (columns, _) in self._groups.items():
            units[name] = signals[columns.start][1]
        #: Unit of every name, components and ``t`` included, as in the CSV.
        self.units: Mapping[str, str] = MappingProxyType(units)

    @property
    def t(self) -> NDArray[np.float64]:
        """Time of every sample [s], (samples,)."""
        return self._t

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name in self._columns:
            return self._numbers[:, self._columns[name]]
        if name in self._groups:
            return self._numbers[:, self._groups[name][0]]
        if name == "t":
            return self._t
        raise InputError(f"unknown name `{name}`{hint(name, self.units)}")

    def __iter__(self) -> Iterator[str]:
        return iter(self._groups)

    def __len__(self) -> int:
        return len(self._groups)

    def __repr__(self) -> str:
        names = ", ".join(self)
        return f"<twincraft.Trajectory of {len(self._t)} samples: {names}>"

    def to_pandas(self) -> pandas.DataFrame:
        """The CSV, as pandas reads it with ``index_col="t [s]"``: whole numbers are integers."""
        import pandas

        def read(column: NDArray[np.float64]) -> NDArray[Any]:
            is_whole = np.all(column == np.rint(column)) and all(
                map(_prints_whole, np.unique(column).tolist()))
            return column.astype(np.int64) if is_whole else np.array(column)

        columns = {
            f"{name} [{unit}]": read(self._numbers[:, i])
            for i, (name, unit, _) in enumerate(self._signals)
        }
        return pandas.DataFrame(columns, index=pandas.Index(read(self._t), name="t [s]"))

    def to_xarray(self) -> xarray.Dataset:
        """The .nc file, as xarray opens it: dimensions time, xyz and wxyz."""
        import xarray

        variables: dict[str, Any] = {}
        for name, (columns, label) in self._groups.items():
            _, unit, meaning = self._signals[columns.start]
            dimensions = ("time", label) if label else ("time",)
            variables[name] = (dimensions, np.array(self[name]), described(unit, meaning))
        time = ("time", np.array(self._t), described("s", "time since the start"))
        return xarray.Dataset(variables, {"time": time}, self._attributes)
