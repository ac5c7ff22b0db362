"""Names of velocities and their rates, and of all that a modal body has."""

from __future__ import annotations

from symgen.describe.modal_body import ACCELERATION, COORDINATE, MOST_MODES, SPEED, names_of_modes

#: Velocity -> name of its rate.
ACCELERATIONS = {
    "vx": "ax",
    "vy": "ay",
    "vz": "az",
    "omega": "alpha",
    "wx": "alphax",
    "wy": "alphay",
    "wz": "alphaz",
    **dict(zip(names_of_modes(SPEED, MOST_MODES), names_of_modes(ACCELERATION, MOST_MODES), strict=True)),
}


def is_speed(name: str) -> bool:
    """Whether a coordinate or velocity of a body, such as ``rod.vx``, is a velocity."""
    return name.rpartition(".")[2] in ACCELERATIONS


def names_of_modal_body(dimension: int, count: int) -> tuple[str, ...]:
    """Return the names of coordinates, velocities and accelerations that a modal body has."""
    moving, turning = tuple("xyz"[:dimension]), ("theta",) if dimension == 2 else ("e0", "e1", "e2", "e3")
    speeds = tuple(f"v{x}" for x in moving) + (("omega",) if dimension == 2 else ("wx", "wy", "wz"))
    speeds += names_of_modes(SPEED, count)
    return (*moving, *turning, *names_of_modes(COORDINATE, count), *speeds, *(ACCELERATIONS[speed] for speed in speeds))
