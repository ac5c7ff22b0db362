"""Linear-quadratic gains for a pole on a cart: linearise upright, solve Riccati's equation, close the loop."""

import numpy as np
from scipy.linalg import solve_continuous_are

import symgen

model = symgen.load("cart-pole")
off = dict.fromkeys(("gain_x", "gain_vx", "gain_lean", "gain_rate"), 0.0)  # the file's own controller

upright = model.linearise(at="start", states=["cart.x", "pole.theta"], parameters={**off, "lean": 0.0})
A, B = upright.A, upright.B
Q, R = np.diag([10.0, 10.0, 1.0, 1.0]), np.eye(1)
K = np.linalg.solve(R, B.T @ solve_continuous_are(A, B, Q, R))
print("states", upright.states)
print("open loop", np.round(upright.eigenvalues().real, 3))
print("gains", np.round(K[0], 4))
print("closed loop", np.round(np.linalg.eigvals(A - B @ K), 3))

run = model.start(parameters=off, integrator="dop853")  # the mechanism itself, from a lean of 0.2 rad
places = [run.state.names.index(name) for name in upright.states]
run.every(0.01, lambda t, run: {"force": -float(K[0] @ run.state[places])})
run.run(8.0)
print(f"after 8 s: pole at {run.q['pole.theta']:.1e} rad, cart at {run.q['cart.x']:.1e} m")
