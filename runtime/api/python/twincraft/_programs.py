"""The commands `scsim` and `sccompile` of the wheel: they become the programs in it."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import NoReturn

_FOLDER = Path(__file__).resolve().parent / "bin"


def _become(program: str) -> NoReturn:
    path = str(_FOLDER / program)
    os.execv(path, [program, *sys.argv[1:]])


def scsim() -> NoReturn:
    _become("scsim")


def sccompile() -> NoReturn:
    _become("sccompile")
