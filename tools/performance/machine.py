"""On what it was measured."""

from __future__ import annotations

import os
import platform
import re

import programs

FEATURES = ("sse2", "avx2", "fma", "avx512f", "avx512dq", "avx512vl")


def cache_entry(name: str) -> str:
    text = (programs.BUILD / "CMakeCache.txt").read_text()
    match = re.search(rf"^{name}:\w+=(.*)$", text, re.MULTILINE)
    return match[1] if match else ""


def compiler() -> str:
    return programs.run([cache_entry("CMAKE_CXX_COMPILER"), "--version"]).splitlines()[0]


def flags() -> str:
    own = f"{cache_entry('CMAKE_CXX_FLAGS')} {cache_entry('CMAKE_CXX_FLAGS_RELEASE')}"
    return f"{own} -ffp-contract=off".strip()


def cpu() -> tuple[str, list[str]]:
    """Its model and those of its features that matter here."""
    text = open("/proc/cpuinfo").read()
    model = re.search(r"^model name\s*:\s*(.*)$", text, re.MULTILINE)
    present = re.search(r"^flags\s*:\s*(.*)$", text, re.MULTILINE)
    have = present[1].split() if present else []
    return model[1] if model else platform.machine(), [name for name in FEATURES if name in have]


def load() -> float:
    """Over the last minute."""
    return os.getloadavg()[0]


def revision() -> str:
    try:
        return programs.run(["git", "describe", "--always", "--dirty"]).strip()
    except (programs.Failed, OSError):
        return ""
