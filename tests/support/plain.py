"""Textbook kinematics and statics of a raw description, written with sin and cos of the bodies' angles.

Nothing of symgen's markers, measures or derivation is used: each joint and force is evaluated from the keys of its
table as its documentation defines it. The arithmetic is generic: `ops` is any module with sin, cos, sqrt and exp
(`math`, `cmath`, `mpmath`, `sympy`), so the same definitions serve complex steps, high-precision differences and SymPy.
"""

import cmath
import math
from collections.abc import Mapping
from types import SimpleNamespace

from support.curves import curve

GROUND = "ground"
#: What formulas may call: these from `ops`, and plain ones.
_FUNCTIONS = ("sin", "cos", "tan", "sqrt", "exp", "log", "tanh", "atan", "atan2")
PLAIN_FUNCTIONS = {
    "pi": math.pi,
    "abs": abs,
    "min": min,
    "max": max,
    "sign": lambda x: float(bool(x > 0) - bool(x < 0)),
}
STEP = 1e-30
#: Joint kinds by their other names.
ALIASES = {
    "prismatic": "translational",
    "point-on-line": "pin-in-slot",
    "inline": "pin-in-slot",
    "in-plane": "point-on-plane",
}


def piecewise(*arguments):
    for condition, value in zip(arguments[:-1:2], arguments[1::2], strict=True):
        if condition:
            return value
    return arguments[-1]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def minus(a, b):
    return a[0] - b[0], a[1] - b[1]


def left(a):
    return -a[1], a[0]


def numbered(keys):
    """(label, row) of each row of a joint of type ``rows``."""
    return [(f"row{i}", row) for i, row in enumerate(keys["rows"], 1)]


class Plain:
    """A raw description with numbers for its parameters.

    Phi, the velocity conditions, loads and energies are functions of (t, q, v) in the order of the file.
    """

    def __init__(self, raw: Mapping, ops=math, values: Mapping[str, float] | None = None) -> None:
        self.raw, self.ops, self.values = raw, ops, {}
        self.known = {n: getattr(ops, n) for n in _FUNCTIONS if hasattr(ops, n)} | PLAIN_FUNCTIONS
        self.known |= {"piecewise": piecewise}
        for name, table in raw.get("tables", {}).items():
            self.known[name] = curve(**table)
        for name, entry in raw.get("parameters", {}).items():
            given = (values or {}).get(name, entry["value"] if isinstance(entry, Mapping) else entry)
            self.values[name] = self.number(given)
        self.bodies = raw["bodies"]
        self.first, size = {}, 0
        for name in self.bodies:
            self.first[name] = size
            size += 3 if self.turns(name) else 2
        self.size = size

    def using(self, ops) -> "Plain":
        """The same description in another arithmetic."""
        return Plain(self.raw, ops, self.values)

    # -- formulas ------------------------------------------------------------------------------------------------------

    def number(self, value, **names):
        """Value of a number or of a formula; Python's own grammar and evaluation."""
        if not isinstance(value, str):
            return value
        return eval(value, {"__builtins__": {}}, self.known | self.values | names)  # a test's own text

    def pair(self, values):
        return self.number(values[0]), self.number(values[1])

    def of_state(self, value, t, q, v, **names):
        """Value of a formula of time and state; `q` and `v` may be longer than the state."""
        bodies = {}
        for name, i in self.first.items():
            parts = {"x": q[i], "y": q[i + 1], "vx": v[i], "vy": v[i + 1]}
            if self.turns(name):
                parts |= {"theta": q[i + 2], "omega": v[i + 2]}
                for point in self.bodies[name].get("points", {}):
                    (x, y), (vx, vy) = self.point(name, point, q), self.velocity(name, point, q, v)
                    parts[point] = SimpleNamespace(x=x, y=y, vx=vx, vy=vy)
            bodies[name] = SimpleNamespace(**parts)
        return self.number(value, t=t, **bodies, **names)

    # -- bodies and points ---------------------------------------------------------------------------------------------

    def turns(self, body) -> bool:
        return body == GROUND or self.bodies[body].get("type", "rigid") == "rigid"

    def angle(self, body, q):
        return q[self.first[body] + 2] if body != GROUND and self.turns(body) else 0.0

    def turned(self, body, vector, q):
        """A vector given in the frame of `body`, in ground axes."""
        if body == GROUND or not self.turns(body):
            return vector
        c, s = self.ops.cos(self.angle(body, q)), self.ops.sin(self.angle(body, q))
        return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]

    def axis(self, body, vector, q):
        """Unit vector along an axis given in the frame of `body`, in ground axes."""
        x, y = self.pair(vector)
        length = self.ops.sqrt(x * x + y * y)
        return self.turned(body, (x / length, y / length), q)

    def centre(self, body, q):
        return (0.0, 0.0) if body == GROUND else (q[self.first[body]], q[self.first[body] + 1])

    def arm(self, body, point, q):
        """From the centre of mass (ground: the origin) to a point, in ground axes."""
        if body == GROUND:
            return self.pair(point)
        keys = self.bodies[body]
        com = self.pair(keys.get("centre_of_mass", (0.0, 0.0)))
        if point == "centre":
            return 0.0, 0.0
        local = self.pair(keys["points"][point] if isinstance(point, str) else point)
        return self.turned(body, minus(local, com), q)

    def point(self, body, point, q):
        c, r = self.centre(body, q), self.arm(body, point, q)
        return c[0] + r[0], c[1] + r[1]

    def velocity(self, body, point, q, v):
        """Velocity of a point: that of the centre of mass plus omega times the arm turned left."""
        if body == GROUND:
            return 0.0, 0.0
        i, r = self.first[body], self.arm(body, point, q)
        w = v[i + 2] if self.turns(body) else 0.0
        return v[i] - w * r[1], v[i + 1] + w * r[0]

    def spin(self, body, v):
        return v[self.first[body] + 2] if body != GROUND and self.turns(body) else 0.0

    # -- joints --------------------------------------------------------------------------------------------------------

    def phi(self, t, q) -> dict:
        """Holonomic residuals by row name."""
        return {
            f"{name}.{label}": value
            for name, keys in self.raw.get("joints", {}).items()
            for label, value in self.joint_rows(keys, t, q)
        }

    def joint_rows(self, keys, t, q):
        """(label, residual) of one joint, signed so that the force on the first body is -D^T lambda."""
        kind = ALIASES.get(keys["type"], keys["type"])
        if kind == "driver":
            return [("driver", self.driven(keys, q) - self.number(keys["value"], t=t))]
        if kind == "coupling":
            return [("coupling", self.coupled(keys, q) - self.number(keys["value"], t=t))]
        if kind == "rows":
            rest = [0.0] * self.size
            return [(n, self.of_state(row["position"], t, q, rest)) for n, row in numbered(keys) if "position" in row]
        if kind in ("knife-edge", "place"):
            return []
        a, b = keys["between"]
        if kind == "orientation":
            return [("angle", self.angle(b, q) - self.angle(a, q) - self.number(keys["angle"]))]
        if kind == "gear":
            return [("mesh", self.mesh(keys, a, b, q))]
        if kind == "rolling":
            ahead, above = self.on_line(keys, q)
            radius, turn = self.number(keys["radius"]), self.angle(a, q) - self.angle(b, q)
            offset = self.number(keys.get("offset", 0.0))
            return [("normal", radius - above), ("roll", offset - (ahead + radius * turn))]
        gap = minus(self.point(b, keys["at"][1], q), self.point(a, keys["at"][0], q))
        if kind == "distance":
            length = self.number(keys["length"])
            return [("distance", (dot(gap, gap) - length**2) / (2 * length))]
        if kind == "pin-in-slot":
            return [("normal", dot(left(self.axis(b, keys["axis"], q)), gap))]
        held = ("angle", self.angle(b, q) - self.angle(a, q) - self.number(keys.get("angle", 0.0)))
        if kind == "translational":
            return [("normal", dot(left(self.axis(a, keys["axis"], q)), gap)), held]
        return [("x", gap[0]), ("y", gap[1]), *([held] if kind == "rigid" else [])]

    def mesh(self, keys, a, b, q):
        carrier = keys.get("carrier", GROUND)
        first, second = self.pair(keys["radii"]) if "radii" in keys else (1.0, self.number(keys["ratio"]))
        sense = -1.0 if keys.get("mesh") == "internal" else 1.0
        turn_a, turn_b = (self.angle(wheel, q) - self.angle(carrier, q) for wheel in (a, b))
        return self.number(keys.get("offset", 0.0)) - (first * turn_a + sense * second * turn_b)

    def on_line(self, keys, q):
        """Where a disc's centre is along its line and above it."""
        disc, base = keys["between"]
        along = self.axis(base, keys["axis"], q)
        r = minus(self.point(disc, keys.get("centre", "centre"), q), self.point(base, keys["on"], q))
        return dot(along, r), dot(left(along), r)

    def driven(self, keys, q):
        """The coordinate that a driver prescribes."""
        if "body" in keys:
            if keys["coordinate"] == "theta":
                return self.angle(keys["body"], q)
            return self.point(keys["body"], keys.get("point", "centre"), q)["xy".index(keys["coordinate"])]
        found = self.joint_coordinates(self.raw["joints"][keys["joint"]], q)
        return found[keys["coordinate"]] if "coordinate" in keys else next(iter(found.values()))

    def coupled(self, keys, q):
        """A weighted sum of joint coordinates, less a polynomial of another one."""

        def coordinate(name):
            joint, _, label = name.partition(".")
            return self.joint_coordinates(self.raw["joints"][joint], q)[label]

        total = sum(self.number(factor) * coordinate(name) for name, factor in keys["terms"].items())
        if "of" in keys:
            total -= sum(self.number(c) * coordinate(keys["of"]) ** k for k, c in enumerate(keys["polynomial"]))
        return total

    def joint_coordinates(self, keys, q) -> dict:
        """What a joint reports."""
        kind = ALIASES.get(keys["type"], keys["type"])
        if kind == "rolling":
            return {"displacement": self.on_line(keys, q)[0]}
        if kind not in ("revolute", "translational", "pin-in-slot", "place"):
            return {}
        a, b = keys["between"]
        found = {}
        gap = minus(self.point(b, keys["at"][1], q), self.point(a, keys["at"][0], q))
        if kind == "place":
            return {label: dot(self.axis(a, along, q), gap) for label, along in (("x", (1.0, 0.0)), ("y", (0.0, 1.0)))}
        if kind == "translational":
            found["displacement"] = dot(self.axis(a, keys["axis"], q), gap)
        if kind == "pin-in-slot":
            found["displacement"] = -dot(self.axis(b, keys["axis"], q), gap)
        if kind != "translational" and self.turns(a) and self.turns(b):
            found["angle"] = self.angle(b, q) - self.angle(a, q)
        return found

    def slips(self, t, q, v) -> dict:
        """Residuals of nonholonomic conditions by row name: the velocity to the right of the blade, and formulas."""
        result = {}
        for name, keys in self.raw.get("joints", {}).items():
            if keys["type"] == "knife-edge":
                across = left(self.axis(keys["body"], keys["axis"], q))
                result[f"{name}.normal"] = -dot(across, self.velocity(keys["body"], keys.get("at", "centre"), q, v))
            elif keys["type"] == "rows":
                rows = {n: row["velocity"] for n, row in numbered(keys) if "velocity" in row}
                result |= {f"{name}.{n}": self.of_state(row, t, q, v) for n, row in rows.items()}
        return result

    # -- forces and energies -------------------------------------------------------------------------------------------

    def slope(self, text, **names):
        """Derivative of a potential by its own variable, by a complex step."""
        (name, value), plain = next(iter(names.items())), self.using(cmath)
        return complex(plain.number(text, **{name: value + STEP * 1j})).imag / STEP

    def loads(self, t, q, v):
        """(body, force, torque, point, conservative) of every applied load, reactions on the other body included."""
        for keys in self.raw.get("forces", {}).values():
            yield from getattr(self, f"_{keys['type'].replace('-', '_')}")(keys, t, q, v)

    def _force(self, keys, t, q, v):
        body, at = keys["body"], keys.get("at", "centre")
        if "potential" in keys:
            x, y = self.point(body, at, q)
            pull = -self.slope(keys["potential"][0], x=x), -self.slope(keys["potential"][1], y=y)
            yield body, pull, 0.0, at, True
            return
        pull = tuple(self.of_state(e, t, q, v) for e in keys["force"])
        yield body, self.turned(body, pull, q) if keys.get("frame") == "body" else pull, 0.0, at, False

    def _turning(self, first, second, keys, t, q, v, actuator):
        turn, rate = self.angle(second, q) - self.angle(first, q), self.spin(second, v) - self.spin(first, v)
        k, c = self.number(keys.get("stiffness", 0.0)), self.number(keys.get("damping", 0.0))
        kept = -k * (turn - self.number(keys.get("free_angle", 0.0)))
        kept -= self.slope(keys["potential"], angle=turn) if "potential" in keys else 0.0
        lost = self.of_state(keys.get(actuator, 0.0), t, q, v, angle=turn, rate=rate) - c * rate
        for torque, conservative in ((kept, True), (lost, False)):
            yield second, (0.0, 0.0), torque, "centre", conservative
            yield first, (0.0, 0.0), -torque, "centre", conservative

    def _torque(self, keys, t, q, v):
        return self._turning(keys.get("reaction", GROUND), keys["body"], keys, t, q, v, "torque")

    def _torsional_spring_damper(self, keys, t, q, v):
        return self._turning(*keys["between"], keys, t, q, v, "actuator")

    def _spring_damper(self, keys, t, q, v):
        (a, b), (end_a, end_b) = keys["between"], keys["at"]
        gap = minus(self.point(b, end_b, q), self.point(a, end_a, q))
        length = self.ops.sqrt(dot(gap, gap))
        unit = gap[0] / length, gap[1] / length
        rate = dot(unit, minus(self.velocity(b, end_b, q, v), self.velocity(a, end_a, q, v)))
        k, c = self.number(keys.get("stiffness", 0.0)), self.number(keys.get("damping", 0.0))
        kept = -k * (length - self.number(keys.get("free_length", 0.0)))
        kept -= self.slope(keys["potential"], length=length) if "potential" in keys else 0.0
        lost = self.of_state(keys.get("actuator", 0.0), t, q, v, length=length, rate=rate) - c * rate
        for push, conservative in ((kept, True), (lost, False)):
            yield b, (push * unit[0], push * unit[1]), 0.0, end_b, conservative
            yield a, (-push * unit[0], -push * unit[1]), 0.0, end_a, conservative

    def potential(self, q):
        """Potential energy of springs, of given potentials and of gravity."""
        gravity = self.pair(self.raw["mechanism"].get("gravity", (0.0, 0.0)))
        total = 0.0
        for body in self.bodies:
            total -= self.number(self.bodies[body]["mass"]) * dot(gravity, self.centre(body, q))
        for keys in self.raw.get("forces", {}).values():
            kind = keys["type"]
            if kind == "force":
                if "potential" in keys:
                    x, y = self.point(keys["body"], keys.get("at", "centre"), q)
                    total += self.number(keys["potential"][0], x=x) + self.number(keys["potential"][1], y=y)
                continue
            if kind == "spring-damper":
                (a, b), (end_a, end_b) = keys["between"], keys["at"]
                gap = minus(self.point(b, end_b, q), self.point(a, end_a, q))
                word, s, free = "length", self.ops.sqrt(dot(gap, gap)), keys.get("free_length", 0.0)
            else:
                a, b = keys["between"] if "between" in keys else (keys.get("reaction", GROUND), keys["body"])
                word, s, free = "angle", self.angle(b, q) - self.angle(a, q), keys.get("free_angle", 0.0)
            total += self.number(keys.get("stiffness", 0.0)) * (s - self.number(free)) ** 2 / 2
            total += self.number(keys["potential"], **{word: s}) if "potential" in keys else 0.0
        return total
