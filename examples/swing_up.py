"""A pole on a cart learns to swing up and to stay there, by a random search over eight weights of a policy.

Each row of the environment has weights of its own, so that one step tries all policies of a generation.
"""

import numpy as np

import symgen.gym

ROWS, BEST, FORCE = 256, 16, 20.0
task = {
    "model": "cart-pole",
    "observe": ["cart.x", "cart.vx", "sin(pole.theta)", "cos(pole.theta)", "pole.omega"],
    "act": {"force": (-FORCE, FORCE)},
    "reward": "cos(pole.theta) - 0.1*cart.x**2 - 0.01*pole.omega**2",
    "reset": {"pole.theta": (3.1, 3.2), "cart.x": 0.0},
    "parameters": dict.fromkeys(("gain_x", "gain_vx", "gain_lean", "gain_rate"), 0.0),
    "dt": 0.04,
    "step": 0.01,
    "until": 8.0,
}


def force(seen, w):
    """Return the force on each cart: linear in the state near the top, elsewhere along the missing energy."""
    x, vx, sine, cosine, omega = seen.T
    balance = w[0] * x + w[1] * vx + 5.0 * w[2] * sine + 2.0 * w[3] * omega
    missing = omega**2 / 3.0 + 9.81 * (cosine - 1.0)
    swing = w[4] * missing * omega * cosine + w[5] * x + w[6] * vx
    return np.clip(np.where(cosine > 0.9 + 0.1 * np.tanh(w[7]), balance, swing), -FORCE, FORCE)


def rewards(env, weights):
    """Return the sum of rewards of an episode for each row."""
    seen, _ = env.reset(seed=1)
    total, over = np.zeros(ROWS), False
    while not over:
        seen, reward, _, truncated, _ = env.step(force(seen, weights)[:, np.newaxis])
        total, over = total + reward, truncated.all()
    return total


env = symgen.gym.make_vec(num_envs=ROWS, **task)
generator = np.random.default_rng(3)
mean, spread = np.zeros(8), np.full(8, 5.0)
for generation in range(10):
    weights = mean[:, np.newaxis] + spread[:, np.newaxis] * generator.normal(size=(8, ROWS))
    total = rewards(env, weights)
    best = weights[:, np.argsort(total)[-BEST:]]
    mean, spread = best.mean(1), best.std(1) + 0.02
    print(f"generation {generation + 1}: best sum of rewards {total.max():.1f}, mean {total.mean():.1f}")
env.close()

one = symgen.gym.make(**task)
seen, _ = one.reset(seed=7)
over = False
while not over:
    seen, _, _, over, _ = one.step(force(seen[np.newaxis], mean))
print(f"a new start: the pole ends at a height of {seen[3]:.3f} of its length, at {seen[4]:.3f} rad/s")
