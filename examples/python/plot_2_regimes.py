"""
Four regimes
============

The faster the magnet turns, the less the bead can follow: it rests over a pole, swings about it, rolls against the
magnet in a few large festoons, then in many small ones. A plot draws into any Axes.
"""

import matplotlib.pyplot as plt

import festoon as fs

figure, axes = plt.subplots(2, 2, figsize=(9.5, 8.6), layout="constrained")
for ax, frequency in zip(axes.flat, ("3 Hz", "8.5 Hz", "10.7 Hz", "19.9 Hz")):
    run = fs.Bead(frequency=frequency).run(periods=400, trajectory=True)
    run.trajectory.plot(ax=ax, arrows=False)
    ax.set_title(f"{run.regime}, {frequency}", fontsize=11, pad=19)
    ax.get_legend().remove()
