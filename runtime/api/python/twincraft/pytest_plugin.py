"""A fixture ``twincraft`` for pytest: specs that must agree or be proved, as claims of a test.

    def test_my_vehicle(twincraft):
        twincraft.assert_agrees("vehicle.yaml", set={"simulation.step": 0.01})
        twincraft.assert_proves("vehicle.yaml")

Relative paths start from the folder of the test.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from ._model import Model
    from ._run import Finding


class Claims:
    """What a test can claim of a spec. Claims fail with the text of the terminal."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def assert_agrees(
        self, spec: str | os.PathLike[str], set: Mapping[str, Any] | None = None
    ) -> None:
        """Fly the spec as ``scsim`` does: it must end with 0."""
        __tracebackhide__ = True
        self._claim(self._model(spec, set).run())

    def assert_proves(
        self, spec: str | os.PathLike[str], set: Mapping[str, Any] | None = None
    ) -> None:
        """Prove the two targets one machine, as ``sccompile --check`` does."""
        __tracebackhide__ = True
        self._claim(self._model(spec, set).prove())

    def _model(self, spec: str | os.PathLike[str], set: Mapping[str, Any] | None) -> Model:
        __tracebackhide__ = True
        from . import Error, load

        try:
            return load(self._folder / spec, set)
        except Error as error:
            pytest.fail(str(error), pytrace=False)

    @staticmethod
    def _claim(finding: Finding) -> None:
        __tracebackhide__ = True
        if not finding:
            pytest.fail(str(finding), pytrace=False)


@pytest.fixture
def twincraft(request: pytest.FixtureRequest) -> Claims:
    """Claims about specs; see :mod:`twincraft.pytest_plugin`."""
    return Claims(request.path.parent)
