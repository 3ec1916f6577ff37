"""festoon: what a magnetic bead does on a spinning magnet.

>>> import festoon as fs
>>> bead = fs.Bead(frequency="10.7 Hz")
>>> run = bead.run(periods=60)
>>> run.regime, round(run.mean_r, 3), round(1000 * run.si.mean_r, 2)
('counter-rotating', 0.767, 17.63)
"""

from typing import TYPE_CHECKING

from . import figures, plots
from ._errors import (
    BadInput,
    FestoonError,
    InputOutput,
    Interrupted,
    MaterialWarning,
    MissingFile,
    NoConvergence,
    NotFinite,
    OutOfMemory,
    SceneWarning,
    StepUnderflow,
    Unavailable,
)
from ._native import ffi as _ffi
from ._native import lib as _lib
from ._native import text_of as _text_of
from ._quantities import UNSET
from .beads import Beads
from .beads_orbits import BeadsBranch, BeadsLocked, BeadsOrbit, FloatingStates, WorldOrbit
from .beads_runs import BeadsRun, WorldRun
from .beads_trajectories import BeadsTrajectory
from .bead import Bead
from .branches import Branch
from .critical import Critical
from .files import export, merge, paper, read, schema
from .films import track
from .flows import Flow
from .fitting import Fit, fit
from .groups import Groups
from .measuring import Measurement, Track, measure, read_track, save_points
from .orbits import Locked, LockedStates, Lyapunov, Orbit
from .runs import Run
from .smoothing import SmoothedMap
from .sweeping import sweep
from .sweep_tables import SweepTable
from .sweeps import Sweep
from .trajectories import Trajectory
from .worlds import World

if TYPE_CHECKING:
    from typing import List

__version__ = _text_of(_lib.fst_version())

#: The optional parts of the library, and whether this build and machine have them.
components: str


def __getattr__(name: str) -> str:
    if name != "components":  # looked for when asked, because modules such as that of MPI are loaded for it
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return _text_of(_lib.fst_tools_components(_ffi.new("char[]", _lib.FST_COMPONENTS_SIZE)))


__all__ = [
    "BadInput",
    "Bead",
    "Beads",
    "BeadsBranch",
    "BeadsLocked",
    "BeadsOrbit",
    "BeadsRun",
    "BeadsTrajectory",
    "Branch",
    "Critical",
    "FestoonError",
    "Fit",
    "FloatingStates",
    "Flow",
    "Groups",
    "InputOutput",
    "Interrupted",
    "Locked",
    "LockedStates",
    "Lyapunov",
    "MaterialWarning",
    "Measurement",
    "MissingFile",
    "NoConvergence",
    "NotFinite",
    "Orbit",
    "OutOfMemory",
    "Run",
    "SceneWarning",
    "SmoothedMap",
    "StepUnderflow",
    "Sweep",
    "SweepTable",
    "Track",
    "Trajectory",
    "UNSET",
    "Unavailable",
    "World",
    "WorldOrbit",
    "WorldRun",
    "components",
    "export",
    "figures",
    "fit",
    "measure",
    "merge",
    "paper",
    "plots",
    "read",
    "read_track",
    "save_points",
    "schema",
    "sweep",
    "track",
]


def __dir__() -> "List[str]":
    """What an editor completes: public names, not the modules in which they are."""
    return [*__all__, "__version__"]
