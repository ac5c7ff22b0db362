"""Random chains and loops with dry friction and stops, and derivatives by differences in Richardson's table."""

import random
from pathlib import Path

import numpy as np

import symgen

MACHINES = Path(symgen.__file__).parent / "describe" / "catalogue" / "machines"


def richardson(function, x, width, levels=4):
    """Return a derivative by central differences, extrapolated, and its error as neighbours in the table show it."""
    table, best = [], (np.inf, np.nan)
    for i in range(levels):
        row = [(function(x + width) - function(x - width)) / (2.0 * width)]
        for k in range(1, i + 1):
            row.append(row[k - 1] + (row[k - 1] - table[i - 1][k - 1]) / (4.0**k - 1.0))
        if i:
            best = min(best, (max(abs(row[i] - table[-1][-1]), abs(row[i] - row[i - 1])), row[i]))
        table.append(row)
        width /= 2.0
    return best[1], best[0]


def chain(seed):
    """Return the text of a chain of one to three rods, and the names of its parameters."""
    own = random.Random(seed)
    count, x, y = own.choice([1, 2, 2, 3]), "", ""
    lines = ["[mechanism]", f'name = "chain{seed}"', 'gravity = [0.0, "-g"]']
    lines += ["[parameters]", "g = 9.81", f"e = {own.uniform(0.2, 0.8):.3f}", f"up = {own.uniform(0.5, 1.2):.3f}"]
    lines.append(f"ratio = {own.uniform(1.0, 1.6):.3f}")
    for i in range(count):
        lines += [f"l{i} = {own.uniform(0.4, 1.0):.3f}", f"m{i} = {own.uniform(0.5, 3.0):.3f}"]
        lines.append(f"T{i} = {own.uniform(0.3, 2.0):.3f}")
    for i in range(count):
        angle = f"{own.uniform(-0.6, 0.5):.4f}"
        lines += [f"[bodies.b{i}]", f'mass = "m{i}"', f'inertia = "m{i}*l{i}**2/12"', f"angle = {angle}"]
        lines.append(f'points = {{ a = ["-l{i}/2", 0.0], b = ["l{i}/2", 0.0] }}')
        lines.append(f'position = ["{x}l{i}/2*cos({angle})", "{y}l{i}/2*sin({angle})"]')
        lines.append(f"angular_velocity = {own.uniform(-3.0, 3.0):.3f}")
        x, y = f"{x}l{i}*cos({angle}) + ", f"{y}l{i}*sin({angle}) + "
    for i in range(count):
        before, at = ("ground", "[0.0, 0.0]") if i == 0 else (f"b{i - 1}", '"b"')
        lines += [f"[joints.j{i}]", 'type = "revolute"', f'between = ["{before}", "b{i}"]', f'at = [{at}, "a"]']
        if own.random() < 0.8:
            lines.append(f'friction = {{ sliding = "T{i}", static = "ratio*T{i}", viscous = 0.02 }}')
        if own.random() < 0.6:
            lines.append('stop = { lower = -1.3, upper = "up", restitution = "e" }')
    return "\n".join(lines), ("g", *(f"{name}{i}" for i in range(count) for name in "lmT"))


def loop(seed):
    """Return the text of a four-bar with friction of each pin, a stop, and the names of its parameters."""
    own = random.Random(1000 + seed)
    text = (MACHINES / "dry-four-bar.toml").read_text().partition("[outputs]")[0]
    numbers = "".join(f"T{pin} = {own.uniform(0.5, 4.0):.3f}\n" for pin in "ABCD")
    numbers += f"ratio = {own.uniform(1.0, 1.5):.3f}\ne = 0.5\nlow = {own.uniform(-1.0, -0.2):.3f}\n"
    text = text.replace("torque = {", f"{numbers}torque = {{")
    parts = text.split('friction = { sliding = "torque" }')
    text = parts[0]
    for pin, rest in zip("ABCD", parts[1:], strict=True):
        text += f'friction = {{ sliding = "T{pin}", static = "ratio*T{pin}" }}' if own.random() < 0.75 else ""
        text += '\nstop = { lower = "low", restitution = "e" }' if pin == "A" else ""
        text += rest
    return text, ("TA", "TB", "TC", "TD", "e", "low", "crank_mass", "coupler_mass")
