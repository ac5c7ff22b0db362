"""Machines that lock, with the time and what would have to jump there; the sentence on their end, in parts."""

import math


def link(length, **keys):
    ends = {"a": [-0.5 * length, 0.0], "b": [0.5 * length, 0.0]}
    return {"mass": 1.0, "inertia": 0.1, "points": ends, **keys}


def pin(first, second, *at):
    return {"type": "revolute", "between": [first, second], "at": list(at)}


#: The rod is in line with the way of the slider's pin to the crank's, across the guide: 0.3 sin(t) = 0.2.
SLIDER = {
    "mechanism": {"name": "slider-lock"},
    "bodies": {
        "crank": {"mass": 1.0, "inertia": 0.01, "points": {"tip": [0.3, 0.0]}},
        "rod": link(0.2, position=[0.4, 0.0]),
        "slider": {"mass": 1.0, "inertia": 0.01, "position": [0.5, 0.0]},
    },
    "joints": {
        "shaft": pin("ground", "crank", [0.0, 0.0], [0.0, 0.0]),
        "motor": {"type": "driver", "joint": "shaft", "value": "t"},
        "P": pin("crank", "rod", "tip", "a"),
        "Q": pin("rod", "slider", "b", "centre"),
        "guide": {"type": "translational", "between": ["ground", "slider"], "at": [[0, 0], "centre"], "axis": [1, 0]},
    },
}
#: Coupler and rocker lie on each other: the distance of their ends is 0.2, and 1 + 1.21 - 2.2 cos(angle) = 0.04.
FOUR_BAR = {
    "mechanism": {"name": "four-bar-lock", "gravity": [0.0, -9.81]},
    "bodies": {
        "crank": link(1.0, position=[0.0, 0.5], angle="pi/2"),
        "coupler": link(0.8, position=[0.4, 0.98]),
        "rocker": link(1.0, position=[0.95, 0.48], angle=1.88),
    },
    "joints": {
        "A": pin("ground", "crank", [0.0, 0.0], "a"),
        "B": pin("crank", "coupler", "b", "a"),
        "C": pin("coupler", "rocker", "b", "b"),
        "D": pin("ground", "rocker", [1.1, 0.0], "a"),
        "motor": {"type": "driver", "joint": "A", "value": "pi/2 - 3*t"},
    },
}
LOCKED = {
    "slider-lock": (SLIDER, math.asin(2.0 / 3.0), {"rod.theta", "slider.x"}),
    "four-bar-lock": (FOUR_BAR, (math.pi / 2.0 - math.acos(2.17 / 2.2)) / 3.0, {"rocker.theta", "coupler.theta"}),
}


def parts(sentence):
    """Time, driver, and names of what would have to jump."""
    head, _, rest = sentence.removeprefix("dead centre at t = ").partition(" s: ")
    driver, _, free = rest.removesuffix(" would have to jump").partition(" can go no further; ")
    return float(head), driver, set(free.split(", "))
