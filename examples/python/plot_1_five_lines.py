"""
Five lines
==========

The paper's bead at 10.7 turns a second draws festoons. The colour tells whether its north pole points up or down.
"""

import festoon as fs

bead = fs.Bead(frequency="10.7 Hz")
run = bead.run(periods=260, trajectory=True)
print(run.regime, f"at a mean radius of {run.lab.mean_r:.4g} +- {run.lab.mean_r_error:.1g} mm")
run.trajectory.plot(colour="n_z")
