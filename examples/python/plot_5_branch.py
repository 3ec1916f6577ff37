"""
Bifurcations
============

A branch follows an orbit over a parameter, through parts where it is unstable and no simulation finds it. Every point
where its stability changes is located and named. The open circles are simulations.
"""

import numpy as np

import festoon as fs

bead = fs.Bead()
branch = bead.branch(frequency=(7, 25))
for special in branch.specials:
    print(special)

ax = branch.plot("mean_r")
runs = fs.sweep(bead, frequency=np.linspace(9, 25, 17))
ax.plot(runs.frequency_hz, runs.lab.mean_r, "o", markerfacecolor="none", color="black")

# %%
# How long a disturbance lives: near a bifurcation, very long.

branch.plot("relaxation_time").set_yscale("log")
