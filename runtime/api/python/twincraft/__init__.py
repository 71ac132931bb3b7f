"""Twincraft: one spacecraft spec, two dynamics engines, one verdict.

>>> import twincraft as tc
>>> m = tc.load("models/quickstart.yaml")
>>> run = m.run()
>>> run.verdict
'agree'
>>> sim = m.simulate()
>>> sim.run_until(1.0, every=0.1, controller=lambda t, y: {"rw_x.torque": 2.0 * y["omega_BN_B"][0]})
1.0

Numbers are SI and radians. Names are those of the CSV's columns: ``rw_x.torque``, ``omega_BN_B.x``,
and ``omega_BN_B`` for the whole vector.
"""

from collections.abc import Mapping as _Mapping

from . import _core
from ._batch import Batch
from ._campaign import Campaign
from ._core import Inputs, Simulation, Twin
from ._errors import (
    BusyError,
    Diagnostic,
    Error,
    FileError,
    InputError,
    NumericalError,
    SnapshotError,
    SpecError,
    SpecWarning,
)
from ._model import MassProperties, Model, load, loads
from ._run import Finding, Run
from ._trajectory import Trajectory

__version__: str = _core.version

__all__ = [
    "Batch",
    "BusyError",
    "Campaign",
    "Diagnostic",
    "Error",
    "FileError",
    "Finding",
    "InputError",
    "Inputs",
    "MassProperties",
    "Model",
    "NumericalError",
    "Run",
    "Simulation",
    "SnapshotError",
    "SpecError",
    "SpecWarning",
    "Trajectory",
    "Twin",
    "load",
    "loads",
]

_Mapping.register(Inputs)
for _name in __all__:  # they are shown, and pickled, as what users import
    if globals()[_name].__module__.startswith("twincraft._") and _name not in ("Inputs", "Simulation", "Twin"):
        globals()[_name].__module__ = "twincraft"
