"""Masses that are pushed, on a guide or free: the equations of tests that are judged by closed forms."""

from collections.abc import Sequence
from pathlib import Path

import symgen


def pushed_mass(
    name: str,
    force: str,
    x: Sequence[float],
    y: Sequence[float],
    parameter: str,
    mass: float = 2.0,
    speed: float = 0.3,
    until: float = 1.0,
) -> str:
    """Return the file of a mass of which a force along x is a formula that calls the table ``push``.

    Parameters
    ----------
    name, force : str
        Of the mechanism, and the formula.
    x, y : sequence of float
        Points of the table.
    parameter : str
        Name of a parameter that is 1.
    mass, speed, until : float
        Of the mass [kg], its speed at the start [m/s], and the end of runs [s].
    """
    return f"""
[mechanism]
name = "{name}"
[run]
until = {until}
step = 1e-2
[parameters]
{parameter} = 1.0
[tables.push]
x = {list(x)}
y = {list(y)}
[bodies.mass]
mass = {mass}
inertia = 0.1
velocity = [{speed}, 0.0]
[joints.guide]
type = "translational"
between = ["ground", "mass"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
[forces.push]
type = "force"
body = "mass"
force = ["{force}", 0.0]
"""


def pushed_point(folder: Path, force: str, until: float = 10.0, tables: str = "") -> symgen.Model:
    """A point of 1 kg without weight under a force along x over the time, at 0.1 m/s; `f` is a parameter of 50."""
    file = folder / "pushed.toml"
    file.write_text(
        f'[mechanism]\nname = "pushed"\ngravity = [0.0, 0.0]\n[run]\nuntil = {until}\n[parameters]\nf = 50.0\n{tables}'
        '[bodies.a]\ntype = "point"\nmass = 1.0\nposition = [0.0, 0.0]\nvelocity = [0.1, 0.0]\n'
        f'[forces.push]\ntype = "force"\nbody = "a"\nforce = ["{force}", 0.0]\n',
        encoding="utf-8",
    )
    return symgen.load(file)
