"""What can go wrong: every exception of the package derives from Error."""

from __future__ import annotations

import json
import os
import warnings
from dataclasses import dataclass
from typing import Any


class Error(Exception):
    """What went wrong, in the words of the programs."""

    def __str__(self) -> str:  # KeyError would show the text in quotes
        return str(self.args[0]) if self.args else ""


@dataclass(frozen=True)
class Diagnostic:
    """One finding of the compiler. The attributes are the keys of ``--diagnostics json``."""

    severity: str
    code: str
    file: str
    line: int
    column: int
    end_column: int
    message: str
    hint: str
    notes: tuple[Any, ...]

    def __str__(self) -> str:
        text = f"{self.file}:{self.line}:{self.column}: {self.severity}[{self.code}]: {self.message}"
        return f"{text}\n  hint: {self.hint}" if self.hint else text


def diagnostics_of(document: str) -> list[Diagnostic]:
    """Diagnostics in a document of ``--diagnostics json``."""
    rows = json.loads(document)["diagnostics"] if document else []
    return [
        Diagnostic(
            severity=row["severity"],
            code=row["code"],
            file=row["file"],
            line=row["line"],
            column=row["column"],
            end_column=row["end_column"],
            message=row["message"],
            hint=row.get("hint") or "",
            notes=tuple(row.get("notes") or ()),
        )
        for row in rows
    ]


class SpecError(Error, ValueError):
    """The spec has errors. ``str()`` is what the programs print.

    ``diagnostics`` is a list of :class:`Diagnostic`, warnings included.
    """

    def __init__(self, text: str, document: str = "") -> None:
        super().__init__(text, document)
        self.diagnostics = diagnostics_of(document)


class InputError(Error, KeyError, ValueError):
    """An unknown name, or a value that is not finite or has another shape or unit."""


class FileError(Error, OSError):
    """A file cannot be read or written."""


class NumericalError(Error, ArithmeticError):
    """The motion is no longer finite. The simulation stands at its last good step end.

    ``time`` is that step end [s]; ``coordinate`` names what failed, or is empty.
    """

    def __init__(self, text: str, time: float = float("nan"), coordinate: str = "") -> None:
        super().__init__(text, time, coordinate)
        self.time = time
        self.coordinate = coordinate


class SnapshotError(Error):
    """Bytes of another model, engine or version, or damaged ones."""


class BusyError(Error, RuntimeError):
    """In use by another thread, or on its way already."""


class SpecWarning(UserWarning):
    """What the compiler warns of."""


_HERE = os.path.dirname(os.path.abspath(__file__)) + os.sep


def warn_of(document: str) -> None:
    """Every warning in a document of ``--diagnostics json`` becomes a :class:`SpecWarning`."""
    import sys

    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_HERE):
        level, frame = level + 1, frame.f_back
    for diagnostic in diagnostics_of(document):
        if diagnostic.severity == "warning":
            warnings.warn(SpecWarning(str(diagnostic)), stacklevel=level)
