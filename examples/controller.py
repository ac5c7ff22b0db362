"""A controller in Python that samples a run: a pole on a cart, kept upright at 50 Hz and pushed once.

The file's own controller is off, as its gains are 0; the input `force` is set from outside.
"""

import numpy as np

import symgen

model = symgen.load("cart-pole")
names = ("gain_x", "gain_vx", "gain_lean", "gain_rate")
gains = np.array([model.parameters()[name] for name in names])

run = model.start(parameters=dict.fromkeys(names, 0.0), integrator="rk4", step=1e-3)


def balance(t, run):
    """Return the force on the cart; a gust of 5 N for a tenth of a second comes on top."""
    state = run.q["cart.x"], run.v["cart.vx"], run.q["pole.theta"], run.v["pole.omega"]
    return {"force": -float(gains @ state) + (5.0 if 3.0 <= t < 3.1 else 0.0)}


leans = []
run.every(0.02, balance)
run.every(0.1, lambda t, run: leans.append(run.q["pole.theta"]))
run.run(10.0)

print(f"pole: from {leans[0]:.3f} rad over {max(map(abs, leans[30:40])):.3f} rad after the gust to {leans[-1]:.1e} rad")
print(f"cart: back at {run.q['cart.x']:.1e} m")
