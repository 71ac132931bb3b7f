"""Values of Python as the texts that the programs' ``--set`` takes."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from typing import Any

from ._errors import InputError

_PLAIN = re.compile(r"[A-Za-z0-9_.+*/^%() -]+")


def _number(path: str, value: float) -> str:
    if not math.isfinite(value):
        raise InputError(f"{value!r} for `{path}` is not finite")
    return repr(value)


def _text(path: str, value: Any, inside: bool) -> str:
    if hasattr(value, "tolist"):  # of numpy: an array or one of its numbers
        value = value.tolist()
    if isinstance(value, str):
        return value if not inside or _PLAIN.fullmatch(value) else json.dumps(value)
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return repr(value)
    if isinstance(value, float):
        return _number(path, value)
    if isinstance(value, Mapping):
        pairs = (f"{key}: {_text(path, item, True)}" for key, item in value.items())
        return "{" + ", ".join(pairs) + "}"
    try:
        items = [_text(path, item, True) for item in value]
    except TypeError:
        raise InputError(
            f"`{path}` takes a text, a number, a bool or a sequence of them, not {value!r}"
        ) from None
    return "[" + ", ".join(items) + "]"


def overrides(values: Mapping[str, Any] | None) -> list[str]:
    """``PATH=VALUE`` of each entry."""
    return [f"{path}={_text(path, value, False)}" for path, value in (values or {}).items()]
