"""
The magnet's field
==================

The field at the height of the bead's centre, as the bead feels it. `Bead.field` takes arrays of any shape.
"""

import matplotlib.pyplot as plt
import numpy as np

import festoon as fs

bead = fs.Bead(magnet__b0="3 mT")
bead.plot_field()

# %%
# Along the magnet at several heights. The two maxima, between which the bead swings, merge far away.

figure, ax = plt.subplots(figsize=(6, 4), layout="constrained")
x = np.linspace(-0.05, 0.05, 201)
for height in ("15 mm", "25 mm", "40 mm"):
    B, _ = bead.field(x, 0.0, height=height, units="si")
    ax.plot(1e3 * x, 1e3 * np.linalg.norm(B, axis=-1), label=height)
ax.set(title="Field along the magnet", xlabel="X (mm)", ylabel="|B| (mT)")
ax.grid(True, color="#e4e4e4")
ax.set_ylim(0, 23)
ax.legend(title="height over the magnet", loc="upper center", ncol=3)
