"""Flexible multibody dynamics: mechanisms of rigid bodies, geometrically exact beams and joints.

>>> import lissom
>>> model = lissom.load("pendulum.toml", **{"analysis.end": 2})
>>> result = model.run()
>>> result["bob.x"]            # NumPy, one value per recorded instant [m]

All quantities are in SI units. Exceptions are `ModelError` and `SolutionError`, with the texts of the command line.
"""

import os
import sys

from ._analyses import Buckling, Campbell, Gradient, Modes, Path, Reduced, Response
from ._animation import Animation
from ._linear import LinearModel, StateSpace
from ._lissom import Batch, LissomError, ModelError, Simulation, SolutionError, __version__, set_unit_host
from ._model import Model, ModelWarning, load, loads
from ._result import Result, read
from ._sweep import SolutionWarning, SweepTable, sweep
from ._tables import Table

__all__ = [
    "Animation",
    "Batch",
    "Buckling",
    "Campbell",
    "Gradient",
    "LinearModel",
    "LissomError",
    "Model",
    "ModelError",
    "ModelWarning",
    "Modes",
    "Path",
    "Reduced",
    "Response",
    "Result",
    "Simulation",
    "SolutionError",
    "SolutionWarning",
    "StateSpace",
    "SweepTable",
    "Table",
    "__version__",
    "load",
    "loads",
    "read",
    "sweep",
]

# Units of other programs run in processes of their own: this interpreter again, with this package.
_SERVE = "import sys; sys.path.insert(0, sys.argv[1]); from lissom._lissom import serve_unit; serve_unit()"
if sys.executable:
    set_unit_host(sys.executable, ["-c", _SERVE, os.path.dirname(os.path.dirname(os.path.abspath(__file__)))])
