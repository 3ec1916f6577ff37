"""Pictures by matplotlib: every function draws into an Axes, its own or yours, and returns it.

Words, units and colours are those of the program's figures.  The methods `plot` of trajectories, sweeps, orbits,
branches, measurements and fits lead here.  Without matplotlib a plot says which package is missing, and everything
else works.
"""

from ._plot_branches import branch
from ._plot_paths import field, orbit, trajectory
from ._plot_points import fit, measurement
from ._plot_sweeps import sweep

__all__ = ["branch", "field", "fit", "measurement", "orbit", "sweep", "trajectory"]
