"""What auditwheel leaves out: libexpat, which it takes every system to have, and the licences of all
that is in the wheel. Prints the path of the completed wheel.

    complete_wheel.py WHEEL FOLDER
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

from auditwheel.wheeltools import InWheel

SYSTEM = Path("/usr/lib/x86_64-linux-gnu")
# Compiled in: headers, and what report.html shows its figures with.
COMPILED_IN = (
    "libboost1.74-dev", "libcli11-dev", "libeigen3-dev", "libjs-dygraphs", "libjs-three",
    "libxsimd-dev", "nlohmann-json3-dev",
)


def run(*command: object) -> str:
    return subprocess.run(
        [str(part) for part in command], check=True, capture_output=True, text=True
    ).stdout


def add_expat(libraries: Path) -> None:
    """Beside libudunits2, which needs it and is told where it is. It keeps its name, so that a
    process that has it already loads no second one."""
    shutil.copy((SYSTEM / "libexpat.so.1").resolve(), libraries / "libexpat.so.1")
    for library in libraries.glob("libudunits2*"):
        run("patchelf", "--force-rpath", "--set-rpath", "$ORIGIN", library)


def packages(libraries: Path) -> set[str]:
    """Debian packages that the bundled libraries come from."""
    found = set()
    for library in libraries.iterdir():
        stem = re.sub(r"-[0-9a-f]{8}(?=\.so|-)", "", library.name).split(".so")[0]
        files = sorted(SYSTEM.glob(f"{stem}.so*")) or sorted(SYSTEM.glob(f"{stem}*.so*"))
        if not files:
            raise SystemExit(f"{library.name}: no library of the system has that name")
        owner = run("dpkg-query", "--search", f"*/{files[-1].resolve().name}")  # /lib is /usr/lib
        found.add(owner.split(":")[0].strip())
    return found


def add_licences(folder: Path, names: set[str]) -> None:
    """Debian's record of each package's terms, and the common licences that these refer to."""
    folder.mkdir()
    common = set()
    for name in sorted(names):
        text = Path("/usr/share/doc", name, "copyright").read_text(errors="replace")
        (folder / f"{name}.txt").write_text(text)
        common |= set(re.findall(r"/usr/share/common-licenses/([A-Za-z0-9.-]*[A-Za-z0-9])", text))
    for name in sorted(common):
        licence = Path("/usr/share/common-licenses", name)
        if licence.is_file():
            (folder / f"common-{name}.txt").write_text(licence.read_text(errors="replace"))


def main(wheel: Path, output: Path) -> None:
    completed = output / wheel.name
    completed.unlink(missing_ok=True)
    with InWheel(wheel, completed) as root:
        libraries = Path(root, "twincraft.libs")
        add_expat(libraries)
        add_licences(Path(root, "twincraft", "licences"), packages(libraries) | set(COMPILED_IN))
    print(completed)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
