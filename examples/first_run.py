"""A first run: simulate a four-bar linkage, read the result by names, plot it and save it."""

import numpy as np

import symgen

result = symgen.load("four-bar").simulate(until=5.0, output_step=0.01)

print(f"status {result.status}, {result.steps} steps")
print(f"crank turned by {np.ptp(result['crank.theta']):.3f} rad")
print(f"largest force in pin B: {result.magnitudes['B.F'].max():.1f} N")
print(f"energy: largest error {abs(result.energy_error).max():.1e} J")
print(f"violation: largest {result.position_violation_max:.1e} m")

result.plot("first-run.pdf", ["B.F", "crank.omega"], over="crank.theta")
result.save("first-run.csv")
