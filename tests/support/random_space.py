"""Hypothesis-made spatial mechanisms: any joints and forces between rigid bodies, point masses and the ground.

They need not close or move: equations hold at every state, so joints may overlap and contradict each other.
"""

import numpy as np
from hypothesis import strategies as st

from support.random_mechanisms import OF_ANGLE, OF_LENGTH, OF_TIME, POTENTIALS

PARAMETERS = {"k1": 1.7, "k2": -0.6, "big": 12.5}
OF_STATE = (
    "1.5",
    "k1*sin(3*t)",
    "-big*B.x + 2*B.vz - B.e2*B.wy",
    "piecewise(B.z > 0.1, 1.5*B.vx, -0.5*t)",
    "tab(B.x) + abs(B.vx)*sign(B.vy)",
    "B.wz**2/(1 + B.e1**2) - tanh(B.y)",
)
#: Rows of one's own: smooth formulas of positions, and formulas linear in velocities; B stands for a rigid body.
OF_PLACE = (
    "B.y - k1*B.x**2 - 0.3*sin(2*t)",
    "sqrt(1 + B.x**2)*B.ez.x - B.P.z*B.y",
    "B.ex.y*B.ey.z - exp(-0.3*t)",
)
OF_SPEED = (
    "B.ex.x*B.P.vy - B.ex.y*B.P.vx",
    "B.wx - k1*B.z*B.vy + 0.3*cos(t)",
    "(B.P.vz + t*B.ey.vx)/(2 + sin(B.x)) - k2",
)
#: Joint kinds with an angle or a displacement that others may use -> these.
REPORTED = {
    "revolute": ("angle",),
    "cylindrical": ("angle", "displacement"),
    "universal": ("angle1", "angle2"),
    "planar": ("angle", "displacement1", "displacement2"),
    "screw": ("angle", "displacement"),
    "translational": ("displacement",),
    "parallel-axes": ("angle",),
}


class Maker:
    """One random description in the making."""

    def __init__(self, rng: np.random.Generator, smooth: bool = False) -> None:
        self.rng, self.smooth = rng, smooth
        self.rigid, self.points, self.joints = [], [], {}

    def pick(self, options):
        return options[int(self.rng.integers(len(options)))]

    def vector(self):
        return self.rng.uniform(-1.0, 1.0, 3).round(3).tolist()

    def axis(self):
        """A direction, sometimes along an axis of the frame, where terms vanish."""
        if self.rng.random() < 0.3:
            return self.pick(np.eye(3).tolist())
        return self.vector()

    def across(self, axis):
        """A vector well away from an axis."""
        while True:
            v = self.rng.uniform(-1.0, 1.0, 3)
            if np.linalg.norm(np.cross(v, axis)) > 0.3 * np.linalg.norm(axis):
                return v.round(3).tolist()

    def positive(self):
        return self.pick([round(float(self.rng.uniform(0.3, 2.0)), 3), "k1", 1.0])

    def formula(self, options):
        if self.smooth:
            options = [o for o in options if not any(word in o for word in ("abs", "tab", "piecewise"))]
        return self.pick(options).replace("B.", f"{self.pick(self.rigid)}.")

    def body(self, turns=False, ground=True, other=None):
        known = [*self.rigid, *([] if turns else self.points), *(["ground"] if ground else [])]
        return self.pick([b for b in known if b != other])

    def at(self, body):
        if body in self.points:
            return "centre"
        return self.vector() if body == "ground" else self.pick([self.vector(), "centre", "P"])

    def axes(self):
        """Keys of two triads."""
        axis = [self.axis(), self.axis()]
        return axis, [self.across(a) for a in axis]

    def rigid_body(self):
        root = self.rng.uniform(-0.5, 0.5, (3, 3)) + np.eye(3)
        tensor = (root @ root.T + 0.2 * np.eye(3)).round(3)
        i = [tensor[0, 0], tensor[1, 1], tensor[2, 2], tensor[0, 1], tensor[0, 2], tensor[1, 2]]
        keys = {"mass": self.positive(), "inertia": [float(e) for e in (i if self.rng.random() < 0.6 else i[:3])]}
        keys["points"] = {"P": self.vector()}
        return keys | ({"centre_of_mass": self.vector()} if self.rng.random() < 0.5 else {})

    def coordinate(self, unit=None):
        """A reported coordinate of a joint, which is made where there is none."""
        angles = unit != "m"
        kind = self.pick([k for k, labels in REPORTED.items() if any(n.startswith("angle") == angles for n in labels)])
        name = f"held{len(self.joints)}"
        self.joints[name] = self.joint(kind)
        return name, self.pick([n for n in REPORTED[kind] if n.startswith("angle") == angles])

    def joint(self, kind) -> dict:
        keys: dict = {"type": kind}
        if kind == "driver":
            if self.rng.random() < 0.7:
                joint, label = self.coordinate(self.pick(["rad", "m"]))
                return keys | {"joint": joint, "coordinate": label, "value": self.formula(OF_TIME)}
            body = self.body(ground=False)
            keys |= {"body": body, "coordinate": self.pick("xyz"), "value": self.formula(OF_TIME)}
            return keys | {"point": self.at(body)}
        if kind == "rows":
            rows = [{"position": self.formula(OF_PLACE)}, {"velocity": self.formula(OF_SPEED)}]
            return keys | {"rows": self.pick([rows, rows[:1], rows[1:]])}
        if kind == "coupling":
            terms = [".".join(self.coordinate(self.pick(["rad", "m"]))) for _ in range(2)]
            keys |= {"terms": dict(zip(terms, ("k2", 1.3), strict=True)), "value": self.formula(OF_TIME)}
            if self.rng.random() < 0.5:
                powers = self.rng.uniform(-1.0, 1.0, int(self.rng.integers(2, 5))).round(3).tolist()
                keys |= {"of": ".".join(self.coordinate(self.pick(["rad", "m"]))), "polynomial": powers}
            return keys
        if kind == "gear":
            radii = self.rng.random() < 0.5
            pairs = [self.coordinate("rad"), self.coordinate("rad" if radii else self.pick(["rad", "m"]))]
            keys |= {"joints": [p[0] for p in pairs], "coordinates": [p[1] for p in pairs], "offset": "k2/2"}
            keys["mesh"] = self.pick(["external", "internal"])
            return keys | ({"radii": [self.positive(), self.positive()]} if radii else {"ratio": self.positive()})
        if kind == "rack-and-pinion":
            (pinion, turn), (rack, way) = self.coordinate("rad"), self.coordinate("m")
            keys |= {"pinion": pinion, "rack": rack, "coordinates": [turn, way]}
            return keys | {"radius": self.pick([0.4, "k2"]), "offset": 0.1}
        if kind in ("rolling-disc", "rolling-sphere", "knife-edge"):
            body, normal = self.body(turns=True, ground=False), self.axis()
            keys |= {"body": body, "normal": normal, "on": self.vector()}
            if kind != "rolling-sphere":
                keys["axis"] = self.axis()
            if kind == "knife-edge":
                return keys | {"at": self.at(body)}
            return keys | {"radius": self.positive(), "centre": self.at(body), "reference": self.across(normal)}
        turning = dict.fromkeys(("spherical", "distance", "place"), (0, 0))
        turning |= dict.fromkeys(("pin-in-slot", "point-on-plane"), (0, 1))
        first, second = turning.get(kind, (1, 0 if kind == "revolute-spherical" else 1))
        a = self.body(turns=bool(first))
        b = self.body(turns=bool(second), other=a)
        keys["between"] = [a, b]
        if kind == "perpendicular":
            return keys | {"axes": [self.axis(), self.axis()]}
        if kind not in ("orientation", "parallel-axes"):
            keys["at"] = [self.at(a), self.at(b)]
        if kind in ("distance", "revolute-spherical"):
            keys["length"] = self.positive()
        if kind == "screw":
            keys |= {"pitch": self.pick([0.3, "k2"]), "offset": "k2/3"}
        if kind in ("spherical", "distance", "place"):
            return keys
        if kind == "pin-in-slot":
            return keys | {"type": self.pick([kind, "inline"]), "axis": self.axis()}
        if kind == "point-on-plane":
            return keys | {"type": self.pick([kind, "in-plane"]), "normal": self.axis()}
        if kind == "revolute-spherical":
            axis = self.axis()
            return keys | {"axis": axis, "reference": self.across(axis)}
        axis, reference = self.axes()
        name = {"universal": "axes", "planar": "normal"}.get(kind, "axis")
        return keys | {name: axis, "reference": reference}

    def force(self, kind) -> dict:
        keys: dict = {"type": kind}
        three = [self.formula(OF_STATE) for _ in range(3)]
        if kind == "force":
            body = self.body(ground=False)
            keys |= {"body": body, "at": self.at(body)}
            if self.rng.random() < 0.4:
                return keys | {"potential": [self.pick(POTENTIALS).replace("{}", n) for n in "xyz"]}
            return keys | {"force": three, "frame": self.pick(["ground", "body"] if body in self.rigid else ["ground"])}
        if kind == "torque" and self.rng.random() < 0.5:
            body = self.body(turns=True, ground=False)
            keys |= {"body": body, "reaction": self.body(turns=True, other=body), "torque": three}
            return keys | {"frame": self.pick(["ground", "body"])}
        if kind == "bushing":
            a = self.body(turns=True)
            b = self.body(turns=True, other=a)
            axis, reference = self.axes()
            root = self.rng.uniform(-1.0, 1.0, (6, 6)).round(2)
            whole, diagonal = (root + root.T).tolist(), [3.0, "k1", 0.0, 2.0, 1.0, "big"]
            stiffness = self.pick([whole, diagonal])
            damping = self.pick([whole, [0.5, 0.0, "k1", 0.2, 0.1, 0.0]])
            keys |= {"between": [a, b], "at": [self.at(a), self.at(b)], "axis": axis, "reference": reference}
            return keys | {"stiffness": stiffness, "damping": damping}
        word = "length" if kind == "spring-damper" else "angle"
        if self.rng.random() < 0.5:
            keys["potential"] = self.pick(POTENTIALS).replace("{}", word)
        effort = self.formula([*OF_STATE, *(OF_LENGTH if word == "length" else OF_ANGLE)])
        if word == "angle":
            keys["joint"], keys["coordinate"] = self.coordinate("rad")
        if kind == "torque":
            return keys | {"torque": effort}
        keys |= {"stiffness": self.positive(), "damping": self.positive(), "actuator": effort}
        keys["free_length" if word == "length" else "free_angle"] = 0.3
        if word == "length":
            a = self.body()
            b = self.body(other=a)
            keys |= {"between": [a, b], "at": [self.at(a), self.at(b)]}
        return keys


@st.composite
def described(draw, joints: tuple[str, ...], forces: tuple[str, ...] = ()):
    """(raw description, t, q, v): one joint and one force of each kind asked for, and a random state."""
    return make(np.random.default_rng(draw(st.integers(0, 10**9))), joints, forces)


def make(rng, joints, forces=(), smooth=False):
    """As `described`, from a generator of random numbers; if `smooth` with formulas that have no kinks."""
    maker = Maker(rng, smooth)
    maker.rigid = [f"b{i}" for i in range(int(rng.integers(2, 4)))]
    maker.points = [f"p{i}" for i in range(int(rng.integers(0, 2)))]
    bodies = {name: maker.rigid_body() for name in maker.rigid}
    bodies |= {name: {"type": "point", "mass": maker.positive()} for name in maker.points}
    for i, kind in enumerate(joints):
        made = maker.joint(kind)
        maker.joints[f"j{i}"] = made
    given = {f"f{i}": maker.force(kind) for i, kind in enumerate(forces)}
    raw = {
        "mechanism": {
            "name": "random",
            "space": "spatial",
            "gravity": maker.pick([[0.0, 0.0, -9.81], ["k1", "k2", 0.0]]),
        },
        "parameters": PARAMETERS,
        "tables": {"tab": {"x": [-1.0, 0.0, 0.5, 2.0], "y": [0.3, -1.0, 2.0, 0.4]}},
        "bodies": bodies,
        "joints": maker.joints,
        "forces": given,
    }
    return raw, float(rng.uniform(0.0, 2.0)), *random_state(raw, rng)


def random_state(raw, rng):
    """(q, v) with Euler parameters of length 1."""
    q, v = [], []
    for keys in raw["bodies"].values():
        q += rng.uniform(-2.0, 2.0, 3).tolist()
        v += rng.uniform(-2.0, 2.0, 3).tolist()
        if keys.get("type", "rigid") == "rigid":
            e = rng.normal(size=4)
            q += (e / np.linalg.norm(e)).tolist()
            v += rng.uniform(-2.0, 2.0, 3).tolist()
    return q, v
