"""A sweep on all cores: how high a pendulum swings, over its speed at the start; v^2 / (2 g) by its energy."""

import numpy as np

import symgen

speeds = np.linspace(1.0, 4.0, 64)
found = symgen.sweep(
    "pendulum", {"bob.vy": speeds}, integrator="dop853", until=2.0, output_step=0.005, quantities=["bob.y"]
)
print(f"{found.counts['ok']} of {speeds.size} runs ended ok")

heights = found["bob.y"].max(axis=-1)
difference = abs(heights - speeds**2 / (2 * 9.81))
print(f"from {heights.min():.3f} m to {heights.max():.3f} m, at most {difference.max():.1e} m from the formula")
found.save("heights.csv")
