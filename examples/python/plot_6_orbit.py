"""
An orbit and its multipliers
============================

Seen from the magnet a pattern of festoons is a closed curve, a periodic orbit. Newton's method finds it, and its
Floquet multipliers tell how disturbances grow or die away in a period: all of them inside the unit circle, so the
orbit is stable.
"""

import matplotlib.pyplot as plt
import numpy as np

import festoon as fs

orbit = fs.Bead(frequency="10.7 Hz").orbit()
print(orbit)
orbit.plot()

# %%
# The multipliers in the complex plane:

figure, ax = plt.subplots(figsize=(4.6, 4.6), layout="constrained")
circle = np.exp(1j * np.linspace(0, 2 * np.pi, 200))
ax.plot(circle.real, circle.imag, color="gray")
ax.plot(orbit.multipliers.real, orbit.multipliers.imag, "o")
ax.set(title="Floquet multipliers", xlabel="real part", ylabel="imaginary part", aspect="equal")
ax.set_xticks([-1, -0.5, 0, 0.5, 1])
ax.grid(True, color="#e4e4e4")

# %%
# The drive at which the pattern closes after exactly 15 festoons, as in the paper's Fig. 9:

closed = fs.Bead(model__dynamics="farago2020").orbit(festoons=15)
print(f"{closed.frequency_hz:.4f} Hz, {closed.festoons:.6f} festoons")
closed.plot(frame="lab", end=40, arrows=False)
