"""An optimisation: the stiffness of a spring that carries an arm, so that its motor needs the least torque.

A spring whose length is 0 when it exerts nothing, from a point above the pin to a point of the arm, carries the weight
in every position if its stiffness is m g l / (a b), with a and b the distances of its ends from the pin.
"""

import numpy as np
from scipy.optimize import minimize_scalar

import symgen

MASS, LENGTH, ABOVE, ALONG = 4.0, 0.6, 0.2, 0.3
POINTS = {"pin": (-LENGTH, 0.0), "hook": (ALONG - LENGTH, 0.0)}

builder = symgen.MechanismBuilder("carried-arm", gravity=(0.0, -9.81)).parameter("stiffness", 100.0, unit="N/m")
builder.body("arm", mass=MASS, inertia=0.12, points=POINTS, position=(LENGTH, 0.0))
builder.joint("pin", "revolute", between=("ground", "arm"), at=((0.0, 0.0), "pin"))
builder.joint("motor", "driver", joint="pin", coordinate="angle", value="0.8*sin(pi*t/50)")  # slowly: inertia is small
builder.force(
    "spring",
    "spring-damper",
    between=("ground", "arm"),
    at=((0.0, ABOVE), "hook"),
    stiffness="stiffness",
    free_length=0.0,
)
arm = symgen.load(builder.build())
times = np.linspace(0.0, 100.0, 41)


def torque(stiffness):
    """Return the effective torque of the motor [N m]."""
    found = arm.inverse(times=times, parameters={"stiffness": stiffness})
    return float(np.sqrt(np.mean(found.efforts["motor"] ** 2)))


best = minimize_scalar(torque, bounds=(100.0, 1000.0), method="bounded", options={"xatol": 1e-3})
formula = MASS * 9.81 * LENGTH / (ABOVE * ALONG)
print(f"without a spring {torque(0.0):.1f} N m; with the best one {best.fun:.3f} N m")
print(f"stiffness {best.x:.2f} N/m after {best.nfev} evaluations; by the formula {formula:.2f} N/m")
