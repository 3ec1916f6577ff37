"""
A map of regimes
================

Where both parameters of a sweep have many values, the plot is a map, of the regimes or of any number.
"""

import numpy as np

import festoon as fs

bead = fs.Bead(run__periods=300, run__rtol=1e-8)
grid = fs.sweep(bead, frequency=np.linspace(2, 30, 36), magnet__depth=np.linspace(0.008, 0.03, 16))
grid.plot()

# %%
# The same grid, coloured by the mean radius. A grid can be indexed like an array: what a single run found undecided
# says why.

grid.plot("mean_r")
undecided = grid[grid.regime == "undecided"]
print(len(undecided), "undecided")
for reason in undecided.reason[:2]:
    print(reason)
