"""Hypothesis-made mechanisms: any joints and forces between rigid bodies, point masses and the ground.

They need not close or move: equations hold at every state, so joints may overlap and contradict each other.
"""

import math

import numpy as np
from hypothesis import strategies as st

PARAMETERS = {"k1": 1.7, "k2": -0.6, "big": 12.5}
#: Formulas of time with two derivatives.
OF_TIME = ("0.4", "0.3 + 0.8*t", "k1*sin(2*t) - 0.2*t**2", "exp(-0.3*t)*cos(k2*t)", "sqrt(1 + t**2)/(2 + t)")
#: Formulas of state; B stands for a body, {} for the element's own words.
OF_STATE = (
    "1.5",
    "k1*sin(3*t)",
    "-big*B.x + 2*B.vy",
    "piecewise(B.y > 0.1, 1.5*B.vx, -0.5*t)",
    "max(B.x, 0.2)*min(t, k1)",
    "tab(B.x) + abs(B.vx)*sign(B.vy)",
    "B.vx**2/(1 + B.y**2) - tanh(B.x)",
    "1.0 if B.x <= 0 and not t > 1 else sqrt(1 + B.x**2)",
)
OF_LENGTH = ("0.7*length - rate**2", "k1*sin(length)*rate", "tab(length)")
OF_ANGLE = ("k1*cos(angle)", "-0.2*rate*abs(rate)", "angle*rate + t")
#: Rows of one's own: smooth formulas of positions, and formulas linear in velocities; R stands for a rigid body.
OF_PLACE = (
    "B.y - k1*B.x**2 - 0.3*sin(2*t)",
    "sqrt(1 + B.x**2)*cos(R.theta) - R.P.x*B.y",
    "R.Q.y*R.theta - exp(-0.3*t)",
)
OF_SPEED = (
    "cos(R.theta)*R.P.vy - sin(R.theta)*R.P.vx",
    "B.vx - k1*B.y*R.omega + 0.3*cos(t)",
    "(R.Q.vx + t*B.vy)/(2 + sin(B.x)) - k2",
)
POTENTIALS = ("k1*{}**2/3 + cos({})", "exp(0.3*{})", "big*{}**3 - {}")

numbers = st.floats(-2.0, 2.0).map(lambda x: round(x, 3))
positive = st.floats(0.2, 3.0).map(lambda x: round(x, 3))
values = st.one_of(numbers, st.sampled_from(["k1", "k2/2", "0.0", "1.0"]))
above_zero = st.one_of(positive, st.sampled_from(["k1", "big/4", 1.0]))
pairs = st.tuples(values, values)
coefficients = st.lists(values, min_size=2, max_size=4)
axes = st.one_of(
    st.sampled_from([(1.0, 0.0), (0.0, -1.0), ("k1", "k2")]),
    st.floats(-math.pi, math.pi).map(lambda a: (round(math.cos(a), 3), round(math.sin(a), 3))),
)


class Bodies:
    """Which bodies there are, and how to pick from them."""

    def __init__(self, draw, rigid: list[str], points: list[str]) -> None:
        self.draw, self.rigid, self.points = draw, rigid, points

    def pick(self, *, turns: bool = False, ground: bool = True, other_than: tuple[str, ...] = ()) -> str:
        known = [*self.rigid, *([] if turns else self.points), *(["ground"] if ground else [])]
        return self.draw(st.sampled_from([b for b in known if b not in other_than]))

    def two(self, turns_a: bool = False, turns_b: bool = False) -> list[str]:
        a = self.pick(turns=turns_a)
        b = self.pick(turns=turns_b, other_than=(a,))
        return [a, b]

    def at(self, body: str):
        if body in self.points:
            return "centre"
        return self.draw(pairs if body == "ground" else st.one_of(pairs, st.sampled_from(["centre", "P", "Q"])))

    def formula(self, choices: tuple[str, ...]) -> str:
        text = self.draw(st.sampled_from(choices)).replace("R.", f"{self.pick(turns=True, ground=False)}.")
        return text.replace("B", self.pick(ground=False))

    def coordinate(self, joints: dict, kind: str, label: str) -> str:
        """A reported coordinate of a joint of some kind, which is made."""
        name = f"held{len(joints)}"
        joints[name] = _joint(self, kind, joints)
        if kind == "revolute":
            joints[name]["between"] = self.two(True, True)
            joints[name]["at"] = [self.at(body) for body in joints[name]["between"]]
        return f"{name}.{label}"


def _joint(b: Bodies, kind: str, joints: dict) -> dict:
    draw = b.draw
    keys: dict = {"type": kind}
    if kind == "knife-edge":
        body = b.pick(turns=True, ground=False)
        return keys | {"body": body, "axis": draw(axes), "at": b.at(body)}
    if kind == "gear":
        pair = b.two(True, True)
        keys |= {"between": pair, "offset": draw(values), "mesh": draw(st.sampled_from(["external", "internal"]))}
        if draw(st.booleans()):
            keys["carrier"] = b.pick(turns=True, other_than=tuple(pair)) if "ground" in pair else "ground"
        elif "ground" in pair:
            keys["carrier"] = b.pick(turns=True, other_than=tuple(pair))
        ratio = {"ratio": draw(above_zero)} if draw(st.booleans()) else {"radii": [draw(above_zero), draw(above_zero)]}
        return keys | ratio
    if kind == "rows":
        rows = [{"position": b.formula(OF_PLACE)}, {"velocity": b.formula(OF_SPEED)}]
        return keys | {"rows": draw(st.sampled_from([rows, rows[:1], rows[1:]]))}
    if kind == "coupling":
        pairs_ = ("revolute", "angle"), ("translational", "displacement")
        keys |= {
            "terms": {b.coordinate(joints, *pair): draw(above_zero) for pair in pairs_},
            "value": b.formula(OF_TIME),
        }
        if draw(st.booleans()):
            keys |= {"of": b.coordinate(joints, "pin-in-slot", "displacement"), "polynomial": draw(coefficients)}
        return keys
    if kind == "driver":
        driven = [n for n, j in joints.items() if j["type"] in ("translational", "pin-in-slot", "rolling")]
        if driven and draw(st.booleans()):
            return keys | {"joint": driven[-1], "coordinate": "displacement", "value": b.formula(OF_TIME)}
        body = b.pick(ground=False)
        coordinate = draw(st.sampled_from(["x", "y"] if body in b.points else ["x", "y", "theta"]))
        keys |= {"body": body, "coordinate": coordinate, "value": b.formula(OF_TIME)}
        return keys if coordinate == "theta" else keys | {"point": b.at(body)}
    both = dict.fromkeys(("rigid", "translational", "rolling", "orientation"), (1, 1))
    turning = (both | {"pin-in-slot": (0, 1)}).get(kind, (0, 0))
    pair = b.two(*map(bool, turning))
    keys["between"] = pair
    if kind == "rolling":
        keys |= {"radius": draw(above_zero), "axis": draw(axes), "offset": draw(values)}
        return keys | {"centre": b.at(pair[0]) if pair[0] != "ground" else [0.5, 0.2], "on": b.at(pair[1])}
    if kind != "orientation":
        keys["at"] = [b.at(body) for body in pair]
    if kind in ("translational", "pin-in-slot"):
        keys["axis"] = draw(axes)
    if kind == "pin-in-slot":
        keys["type"] = draw(st.sampled_from(["pin-in-slot", "inline"]))
    if kind in ("rigid", "translational", "orientation"):
        keys["angle"] = draw(values)
    if kind == "distance":
        keys["length"] = draw(above_zero)
    return keys


def _force(b: Bodies, kind: str) -> dict:
    draw = b.draw
    keys: dict = {"type": kind}
    if kind == "force":
        body = b.pick(ground=False)
        keys |= {"body": body, "at": b.at(body)}
        if draw(st.booleans()):
            chosen = draw(st.tuples(st.sampled_from(POTENTIALS), st.sampled_from(POTENTIALS)))
            return keys | {"potential": [chosen[0].replace("{}", "x"), chosen[1].replace("{}", "y")]}
        frame = "ground" if body in b.points else draw(st.sampled_from(["ground", "body"]))
        return keys | {"force": [b.formula(OF_STATE), b.formula(OF_STATE)], "frame": frame}
    word, own = ("length", OF_LENGTH) if kind == "spring-damper" else ("angle", OF_ANGLE)
    if draw(st.booleans()):
        keys["potential"] = draw(st.sampled_from(POTENTIALS)).replace("{}", word)
    effort = b.formula(draw(st.sampled_from([OF_STATE, own])))
    if kind == "torque":
        body = b.pick(turns=True, ground=False)
        return keys | {"body": body, "reaction": b.pick(turns=True, other_than=(body,)), "torque": effort}
    pair = b.two(kind != "spring-damper", kind != "spring-damper")
    keys |= {"between": pair, "stiffness": draw(above_zero), "damping": draw(above_zero), "actuator": effort}
    keys["free_length" if kind == "spring-damper" else "free_angle"] = draw(values)
    return keys | ({"at": [b.at(body) for body in pair]} if kind == "spring-damper" else {})


@st.composite
def descriptions(draw, joints: tuple[str, ...], forces: tuple[str, ...], most: int = 4) -> dict:
    """Raw descriptions that hold one joint and one force of each kind asked for, up to `most` bodies."""
    count = draw(st.integers(2, most))
    rigid = [f"b{i}" for i in range(count)]
    points = [f"p{i}" for i in range(draw(st.integers(0, 1)))]
    bodies: dict = {}
    for name in rigid:
        bodies[name] = {"mass": draw(above_zero), "inertia": draw(above_zero)}
        bodies[name] |= {"points": {"P": draw(pairs), "Q": draw(pairs)}}
        if draw(st.booleans()):
            bodies[name]["centre_of_mass"] = draw(pairs)
    for name in points:
        bodies[name] = {"type": "point", "mass": draw(above_zero)}
    b, made = Bodies(draw, rigid, points), {}
    for i, kind in enumerate(joints):
        made[f"j{i}"] = _joint(b, kind, made)
    return {
        "mechanism": {"name": "random", "gravity": draw(st.sampled_from([(0.0, 0.0), (0.0, -9.81), ("k1", "k2")]))},
        "parameters": PARAMETERS,
        "tables": {"tab": {"x": [-1.0, 0.0, 0.5, 2.0], "y": [0.3, -1.0, 2.0, 0.4]}},
        "bodies": bodies,
        "joints": made,
        "forces": {f"f{i}": _force(b, kind) for i, kind in enumerate(forces)},
    }


@st.composite
def states(draw, size: int = 15) -> tuple[float, list[float], list[float]]:
    """(t, q, v) for up to five bodies, away from the few positions where markers could meet."""
    rng = np.random.default_rng(draw(st.integers(0, 10**6)))
    return float(rng.uniform(0.0, 2.0)), rng.uniform(-3.0, 3.0, size).tolist(), rng.uniform(-2.0, 2.0, size).tolist()
