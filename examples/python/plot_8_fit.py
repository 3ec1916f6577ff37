"""
From tracks to parameters
=========================

Films of a bead at five speeds, here simulated, with the noise of a camera. `measure` says how fast the bead circles
and how far out, with errors; `fit` finds the bead's strength and friction from these numbers.
"""

import tempfile
from pathlib import Path

import numpy as np

import festoon as fs

truth = fs.Bead(kappa=1.62, gamma=298)
noise = np.random.default_rng(2020)
folder = Path(tempfile.mkdtemp())
rows = []
for drive in (10.7, 12.0, 14.0, 16.0, 19.9):
    run = truth.replace(frequency=drive).run(periods=300, trajectory=True, fps=240)
    seen = run.trajectory[-1200:].lab
    places = np.stack([seen.x, seen.y], axis=1) + noise.normal(0, 0.1, (1200, 2))
    frames = np.column_stack([np.arange(1200), np.arange(1200) / 240, places])
    head = "frame,t [s],x [mm],y [mm]"
    np.savetxt(folder / "track.csv", frames, delimiter=",", header=head, comments="")
    m = fs.measure(folder / "track.csv", drive=drive)
    rows.append((drive, m.mean_r, m.mean_r_error, m.bead_frequency_hz, m.bead_frequency_hz_error))

m.plot("radius")

# %%
# A table of what was measured, and the fit to it:

names = ["frequency [Hz]"]
for name in ("mean_r", "bead_frequency"):
    unit = "mm" if name == "mean_r" else "Hz"
    names += [f"{name} [{unit}]", f"{name}_error [{unit}]"]
np.savetxt(folder / "points.csv", rows, delimiter=",", header=",".join(names), comments="")
fit = fs.fit(folder / "points.csv", free=["kappa", "gamma"], curve_points=50)
print(fit)
print("correlation:", fit.correlation[0, 1].round(3))
fit.plot("mean_r")
