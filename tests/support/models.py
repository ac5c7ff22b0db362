"""Fixed descriptions: mechanisms that hold every joint and force kind, and small ones for single questions."""

import math

import numpy as np

#: Every joint kind but the weld and every force kind, all rows independent, everything smooth: SymPy can take it.
EVERYTHING = {
    "mechanism": {"name": "everything", "gravity": ["0.3*k1", -9.81]},
    "parameters": {"k1": 1.7, "k2": -0.6, "m1": {"value": 2.5, "unit": "kg"}},
    "bodies": {
        "arm": {
            "mass": "m1",
            "inertia": "m1*0.3",
            "centre_of_mass": [0.2, "k2/3"],
            "points": {"A": [-0.5, 0.0], "B": [1.0, 0.2]},
        },
        "rod": {"mass": 1.2, "inertia": 0.4, "points": {"B": [-0.7, 0.1], "C": [0.8, 0.0]}},
        "slide": {"mass": "k1", "inertia": 0.2, "centre_of_mass": [0.1, 0.0]},
        "disc": {"mass": 0.9, "inertia": 0.15, "centre_of_mass": [0.05, -0.02]},
        "plate": {"mass": 3.0, "inertia": 1.1, "centre_of_mass": [0.0, 0.3]},
        "wheel": {"mass": 0.7, "inertia": 0.05},
        "skate": {"mass": 1.4, "inertia": 0.3, "centre_of_mass": [-0.2, 0.1]},
        "dot": {"type": "point", "mass": 0.6},
    },
    "joints": {
        "pin": {"type": "revolute", "between": ["ground", "arm"], "at": [[0.1, "k2"], "A"]},
        "knee": {"type": "revolute", "between": ["arm", "rod"], "at": ["B", "B"]},
        "slot": {"type": "pin-in-slot", "between": ["rod", "plate"], "at": ["C", [0.3, 0.1]], "axis": [1.0, 0.4]},
        "rail": {
            "type": "prismatic",
            "between": ["plate", "slide"],
            "at": [[0.2, 0.5], "centre"],
            "axis": ["k1", 1.0],
            "angle": 0.2,
        },
        "push": {"type": "driver", "joint": "rail", "value": "0.3*sin(k1*t) + 0.1*t**2"},
        "roll": {
            "type": "rolling",
            "between": ["disc", "plate"],
            "radius": "0.2*k1",
            "axis": [1.0, 0.1],
            "on": [0.0, 0.9],
            "centre": [0.0, 0.0],
            "offset": 0.4,
        },
        "mesh": {
            "type": "gear",
            "between": ["disc", "wheel"],
            "carrier": "arm",
            "radii": [0.3, "k1/4"],
            "mesh": "external",
            "offset": 0.1,
        },
        "hub": {"type": "revolute", "between": ["wheel", "rod"], "at": ["centre", [0.1, -0.3]]},
        "blade": {"type": "knife-edge", "body": "skate", "at": [0.4, 0.1], "axis": [1.0, -0.3]},
        "link": {"type": "distance", "between": ["dot", "skate"], "at": ["centre", [0.2, 0.2]], "length": "k1/2"},
    },
    "forces": {
        "wind": {
            "type": "force",
            "body": "skate",
            "at": [0.1, 0.3],
            "force": ["2*sin(t)", "k1*skate.vx - 0.2*t"],
            "frame": "body",
        },
        "field": {"type": "force", "body": "dot", "potential": ["0.5*k1*x**2", "cos(y)"]},
        "strut": {
            "type": "spring-damper",
            "between": ["skate", "plate"],
            "at": [[0.0, 0.1], [0.5, 0.5]],
            "stiffness": 40.0,
            "damping": "k1",
            "free_length": 0.7,
            "actuator": "0.3*length*cos(t) - rate**2",
            "potential": "0.2*length**3",
        },
        "twist": {
            "type": "torsional-spring-damper",
            "between": ["arm", "rod"],
            "stiffness": "3*k1",
            "damping": 0.4,
            "free_angle": 0.2,
            "actuator": "0.1*t*angle",
        },
        "motor": {
            "type": "torque",
            "body": "disc",
            "reaction": "plate",
            "torque": "1.5 - 0.2*rate",
            "potential": "0.1*angle**2",
        },
    },
}

#: The same with a force that reads points and joint coordinates.
READING = EVERYTHING | {
    "mechanism": {"name": "reading", "gravity": ["0.3*k1", -9.81]},
    "forces": EVERYTHING["forces"]
    | {
        "guide": {
            "type": "force",
            "body": "disc",
            "at": [0.0, 0.1],
            "force": ["0.2*arm.B.y - 0.3*knee.angle*rod.C.vx", "rail.rate*cos(push.displacement) - slide.x"],
        },
    },
}

#: Rotors between bodies, one to the ground, and two on slides, whose part of M changes with the motion.
GEARED = EVERYTHING | {
    "mechanism": {"name": "geared", "gravity": ["0.3*k1", -9.81]},
    "joints": EVERYTHING["joints"]
    | {
        name: EVERYTHING["joints"][name] | {"rotor_inertia": inertia, "gear_ratio": ratio}
        for name, inertia, ratio in (("pin", "0.02*k1", 3.0), ("knee", 0.001, "10*k2"), ("rail", 0.03, 7.0))
    },
}

#: A weld, and formulas that are not smooth: tables, conditions, minima.
ROUGH = {
    "mechanism": {"name": "rough", "gravity": [0.0, -9.81]},
    "parameters": {"k1": 1.7},
    "tables": {
        "curve": {"x": [-1.0, 0.0, 0.5, 2.0], "y": [0.3, -1.0, 2.0, 0.4]},
        "wave": {"x": [-1.0, -0.2, 0.5, 1.0, 2.0], "y": [0.3, -1.0, 2.0, 0.4, 0.3], "interpolation": "cubic"},
        "round": {"x": [0.0, 0.3, 0.7, 1.0], "y": [1.0, 2.0, 0.5, 1.0], "interpolation": "pchip", "periodic": True},
    },
    "bodies": {
        "a": {"mass": 1.1, "inertia": 0.3, "points": {"P": [0.3, 0.1]}},
        "b": {"mass": 0.8, "inertia": 0.2, "centre_of_mass": [0.1, 0.2]},
        "c": {"mass": 0.5, "inertia": 0.1},
    },
    "joints": {
        "weld": {"type": "rigid", "between": ["a", "b"], "at": ["P", [0.2, -0.4]], "angle": "k1/3"},
        "hinge": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], "centre"]},
        "turn": {"type": "driver", "body": "c", "coordinate": "theta", "value": "k1*t"},
        "gear": {"type": "gear", "between": ["b", "c"], "ratio": 2.0, "mesh": "internal"},
    },
    "forces": {
        "table": {"type": "torque", "body": "b", "torque": "curve(a.theta)*curve(5*rate)"},
        "smooth": {"type": "torque", "body": "a", "torque": "wave(b.theta)*round(k1*rate)"},
        "guarded": {"type": "torque", "body": "c", "torque": "1.0 if c.x <= 0 else sqrt(c.x)"},
        "steps": {
            "type": "force",
            "body": "c",
            "force": ["piecewise(t < 0.5, 1, t < 1, -k1, 0)", "min(c.x, 0.2, max(c.y, -1))"],
        },
        "signs": {
            "type": "torque",
            "body": "a",
            "reaction": "c",
            "torque": "abs(rate)*sign(angle) - (1 if rate > 0.1 or not angle > 0 else 0)",
        },
    },
}


def parallelogram() -> dict:
    """Three parallel links under a bar: one of twelve rows follows from the others where the constraints hold."""
    bodies, joints = {}, {}
    for i in range(3):
        rod = {"mass": 1.0, "inertia": "1/12", "points": {"A": [-0.5, 0.0], "B": [0.5, 0.0]}}
        bodies[f"link{i}"] = rod | {"position": [float(i), 0.5], "angle": "pi/2"}
        joints[f"A{i}"] = {"type": "revolute", "between": ["ground", f"link{i}"], "at": [[float(i), 0.0], "A"]}
        joints[f"B{i}"] = {"type": "revolute", "between": [f"link{i}", "bar"], "at": ["B", f"P{i}"]}
    bodies["link0"]["angular_velocity"] = -1.0
    points = {f"P{i}": [float(i - 1), 0.0] for i in range(3)}
    bodies["bar"] = {"mass": 2.0, "inertia": 1.0, "points": points, "position": [1.0, 1.0]}
    return {
        "mechanism": {"name": "parallelogram", "gravity": [0.0, -9.81]},
        "run": {"until": 0.5, "step": 1e-3},
        "bodies": bodies,
        "joints": joints,
    }


def circles(a, b, p, q, side):
    """Return where circles about a and b with radii p and q meet, on one side."""
    away = b - a
    distance = math.hypot(*away)
    along = (p * p - q * q + distance * distance) / (2.0 * distance)
    across = math.sqrt(p * p - along * along)
    ahead = away / distance
    return a + along * ahead + side * across * np.array([-ahead[1], ahead[0]])
