"""Emitted code under an integrator of SciPy: generate a package, import its module, integrate it by LSODA.

The package needs NumPy and Numba alone. Its `System` has the equations with their parameters and a consistent start.
"""

import sys

import numpy as np
from scipy.integrate import solve_ivp

import symgen

model = symgen.load("slider-crank")
model.generate("emitted", ["lagrange"])
sys.path.insert(0, "emitted")

from simulate import System  # noqa: E402  # it is written above

system = System("lagrange")
solution = solve_ivp(system.rate, (0.0, 1.0), system.y, method="LSODA", rtol=1e-10, atol=1e-12)

own = model.simulate(method="lagrange", integrator="dop853", rtol=1e-10, atol=1e-12, until=1.0)
print(f"SciPy  {solution.nfev} evaluations, crank at {solution.y[2, -1]:.9f} rad")
print(f"symgen {own.evaluations} evaluations, crank at {own['crank.theta'][-1]:.9f} rad")
assert np.allclose(solution.y[2, -1], own["crank.theta"][-1], atol=1e-6)
