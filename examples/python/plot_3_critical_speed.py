"""
The critical speed
==================

A sweep runs a bead over a grid of parameters, on all processors at once. Over one parameter the colours of the points
are the regimes; over two, few values of one of them make curves.
"""

import numpy as np

import festoon as fs

bead = fs.Bead()
speeds = fs.sweep(bead, frequency=np.linspace(3, 25, 56))
speeds.plot("mean_r")

# %%
# Negative: the bead circles against the magnet. A weaker bead gives up sooner.

strengths = fs.sweep(bead, frequency=np.linspace(3, 25, 56), kappa=[1.2, 1.5, 1.8])
strengths.plot("mean_alpha_dot")

# %%
# The drives between which the bead turns back, of each strength:

frequency, kappa = (axis.values for axis in strengths.axes)
for column, value in enumerate(kappa):
    against = strengths[:, column].mean_alpha_dot < 0
    low, high = frequency[~against].max(), frequency[against].min()
    print(f"kappa {value}: {low:.1f} to {high:.1f} Hz")
