"""Machines that designs are tried on, as raw descriptions, with what elementary mechanics says of them."""

import math
from typing import Any

import numpy as np


def pin(first: str, second: str, at: list[Any]) -> dict[str, Any]:
    """Return a revolute joint."""
    return {"type": "revolute", "between": [first, second], "at": at}


def compressor() -> dict[str, Any]:
    """Return a slider-crank with a counterweight on its crank, driven at 12 rad/s, without gravity."""
    return {
        "mechanism": {"name": "compressor", "gravity": [0.0, 0.0]},
        "run": {"until": 2.0 * math.pi / 12.0},
        "parameters": {"cw": {"value": 0.3, "unit": "kg"}, "m": "0.5 + cw", "xg": "(0.5*0.06 - cw*0.07)/m"},
        "bodies": {
            "crank": {
                "mass": "m",
                "inertia": "0.5*0.12**2/12 + 0.5*(0.06 - xg)**2 + cw*(0.07 + xg)**2",
                "points": {"O": ["-xg", 0.0], "P": ["0.12 - xg", 0.0]},
                "position": ["xg", 0.0],
            },
            "rod": {
                "mass": 0.8,
                "inertia": 0.01,
                "points": {"P": [-0.2, 0.0], "Q": [0.2, 0.0]},
                "position": [0.32, 0.0],
            },
            "piston": {"mass": 0.7, "inertia": 0.001, "position": [0.52, 0.0]},
        },
        "joints": {
            "O": pin("ground", "crank", [[0.0, 0.0], "O"]),
            "P": pin("crank", "rod", ["P", "P"]),
            "Q": pin("rod", "piston", ["Q", "centre"]),
            "guide": {
                "type": "translational",
                "between": ["ground", "piston"],
                "at": [[0.0, 0.0], "centre"],
                "axis": [1.0, 0.0],
            },
            "motor": {"type": "driver", "joint": "O", "coordinate": "angle", "value": "12*t"},
        },
        "outputs": {
            "fx": {"value": "O.Fx", "unit": "N"},
            "fy": {"value": "O.Fy + guide.Fy", "unit": "N"},
            "shaking": {"value": "sqrt((O.Fx)**2 + (O.Fy + guide.Fy)**2)", "unit": "N"},
        },
    }


def best_counterweight() -> float:
    """Return the counterweight of the least mean square of the shaking force.

    The force is the rate of the momentum. Half of the rod goes with the pin: with the crank it turns a moment
    s = 0.5 0.06 + 0.4 0.12 - 0.07 cw. The other half and the piston go along x, where they add 1.1 0.12 at the
    frequency of the crank, and even multiples of it. So (s + 0.132)**2 + s**2 is least, at s = -0.066.
    """
    return (0.5 * 0.06 + 0.4 * 0.12 + 0.5 * 1.1 * 0.12) / 0.07


def press() -> dict[str, Any]:
    """Return a press: a crank lifts the knee of two links, the lower one pushes a ram onto a stiff plate."""
    rod = {"mass": "{m}*{n}", "inertia": "{m}*{n}**3/12"}

    def link(m: float, n: str) -> dict[str, str]:
        return {key: text.format(m=m, n=n) for key, text in rod.items()}

    return {
        "mechanism": {"name": "knee-press", "gravity": [0.0, -9.81]},
        "run": {"until": 1.0},
        "parameters": {
            **{name: {"value": x, "unit": "m"} for name, x in zip("ab", (0.3, 0.3), strict=True)},
            "ex": {"value": 0.35, "unit": "m"},
            "ey": {"value": -0.3, "unit": "m"},
            "r": {"value": 0.08, "unit": "m"},
            "l": {"value": 0.3, "unit": "m"},
            "spring": {"value": 1000.0, "unit": "N/m"},
            "slack": {"value": 0.3, "unit": "m"},
            "bx": "ex",
            "by": "ey + r",
            "d": "sqrt(bx**2 + by**2)",
            "c": "max(-1.0, min(1.0, (a**2 + d**2 - l**2)/(2*a*d)))",
            "kx": "a*(bx*c + by*sqrt(1.0 - c**2))/d",
            "ky": "a*(by*c - bx*sqrt(1.0 - c**2))/d",
            "ry": "ky - sqrt(max(0.0, b**2 - kx**2))",
        },
        "bodies": {
            "crank": {
                "mass": 4.0,
                "inertia": 0.05,
                "points": {"B": ["r", 0.0]},
                "position": ["ex", "ey"],
                "angle": "pi/2",
            },
            "coupler": {
                **link(10, "l"),
                "points": {"B": ["-l/2", 0.0], "K": ["l/2", 0.0]},
                "position": ["(bx + kx)/2", "(by + ky)/2"],
                "angle": "atan2(ky - by, kx - bx)",
            },
            "upper": {
                **link(20, "a"),
                "points": {"U": ["-a/2", 0.0], "K": ["a/2", 0.0]},
                "position": ["kx/2", "ky/2"],
                "angle": "atan2(ky, kx)",
            },
            "lower": {
                **link(20, "b"),
                "points": {"K": ["-b/2", 0.0], "R": ["b/2", 0.0]},
                "position": ["kx/2", "(ky + ry)/2"],
                "angle": "atan2(ry - ky, -kx)",
            },
            "ram": {"mass": 30.0, "inertia": 0.1, "position": [0.0, "ry"]},
        },
        "joints": {
            "E": pin("ground", "crank", [["ex", "ey"], "centre"]),
            "B": pin("crank", "coupler", ["B", "B"]),
            "K1": pin("coupler", "upper", ["K", "K"]),
            "K2": pin("upper", "lower", ["K", "K"]),
            "U": pin("ground", "upper", [[0.0, 0.0], "U"]),
            "R": pin("lower", "ram", ["R", "centre"]),
            "guide": {
                "type": "translational",
                "between": ["ground", "ram"],
                "at": [[0.0, 0.0], "centre"],
                "axis": [0.0, 1.0],
            },
            "motor": {"type": "driver", "joint": "E", "coordinate": "angle", "value": "pi/2 + 2*pi*t"},
        },
        "forces": {
            "load": {
                "type": "force",
                "body": "ram",
                "force": [0.0, "3e5*max(0.0, -0.58 - ram.y) + spring*(0.0 - ram.y - slack)"],
            }
        },
        "outputs": {"mu": {"value": "cos(coupler.theta - upper.theta)", "largest": 0.8}},
    }


#: Bounds and limits of the press.
PRESS_BOX = {
    "a": (0.2, 0.4),
    "b": (0.2, 0.4),
    "ex": (0.15, 0.6),
    "ey": (-0.5, 0.1),
    "r": (0.04, 0.2),
    "l": (0.15, 0.5),
    "spring": (0.0, 6000.0),
    "slack": (0.0, 0.6),
}
PRESS_KEEP = ["min(ram.y) <= -598 mm", "max(ram.y) >= -530 mm", "-0.75 <= mu <= 0.75"]


def four_bar_of_pivots() -> dict[str, Any]:
    """Return a four-bar whose pivots are parameters, its crank turning once a second."""
    ends = {"crank": ("a", "b"), "coupler": ("b", "c"), "rocker": ("d", "c")}
    places = {"a": (0.0, 0.0), "b": (40.0, 200.0), "c": (360.0, 600.0), "d": (400.0, 0.0)}
    bodies = {}
    for name, (near, far) in ends.items():
        length = f"0.5*sqrt(({far}x - {near}x)**2 + ({far}y - {near}y)**2)"
        bodies[name] = {
            "mass": 1.0,
            "inertia": 1e4,
            "points": {"near": [f"-{length}", 0.0], "far": [length, 0.0]},
            "position": [f"({near}x + {far}x)/2", f"({near}y + {far}y)/2"],
            "angle": f"atan2({far}y - {near}y, {far}x - {near}x)",
        }
    return {
        "mechanism": {"name": "four-pivots", "gravity": [0.0, 0.0]},
        "run": {"until": 2.0},
        "parameters": {f"{name}{axis}": x for name, at in places.items() for axis, x in zip("xy", at, strict=True)},
        "bodies": bodies,
        "joints": {
            "A": pin("ground", "crank", [["ax", "ay"], "near"]),
            "B": pin("crank", "coupler", ["far", "near"]),
            "C": pin("coupler", "rocker", ["far", "far"]),
            "D": pin("ground", "rocker", [["dx", "dy"], "near"]),
            "motor": {
                "type": "driver",
                "joint": "A",
                "coordinate": "angle",
                "value": "atan2(by - ay, bx - ax) + 2*pi*t",
            },
        },
    }


def coupler_of_pivots(t: Any) -> dict[str, Any]:
    """Return place and angle of the coupler of (0, 0), (40, 200), (360, 600), (400, 0) over time, by two circles."""
    crank, coupler, rocker = math.hypot(40.0, 200.0), math.hypot(320.0, 400.0), math.hypot(40.0, 600.0)
    angle = math.atan2(200.0, 40.0) + 2.0 * np.pi * np.asarray(t)
    b = crank * np.column_stack([np.cos(angle), np.sin(angle)])
    way = np.array([400.0, 0.0]) - b
    d = np.hypot(*way.T)
    along = (d**2 + coupler**2 - rocker**2) / (2.0 * d)
    aside = np.sqrt(coupler**2 - along**2)
    c = b + (along[:, None] * way + aside[:, None] * np.column_stack([-way[:, 1], way[:, 0]])) / d[:, None]
    turned = np.unwrap(np.arctan2(*(c - b).T[::-1]))
    return {
        "t": np.asarray(t),
        "coupler.x": (b + c)[:, 0] / 2.0,
        "coupler.y": (b + c)[:, 1] / 2.0,
        "coupler.theta": turned,
    }
