"""Plane mechanisms in decimal numbers of 50 digits: steps whose derivatives are differences.

Nothing here is shared with symgen or with its emitted code: a file's table is read as values, formulas by a reader of
their own, and the equations are Newton's and Euler's of each body at its centre of mass, with the forces of joints as
unknowns. Elementary functions are mpmath's.
"""

import ast
from decimal import Decimal, getcontext
from functools import partial

import mpmath as mp
import numpy as np

DIGITS = 50
getcontext().prec = DIGITS
ZERO, ONE = Decimal(0), Decimal(1)
GROUND = "ground"
_AXES = np.array([[ONE, ZERO], [ZERO, ONE]], dtype=object)
_NAMES = "sin", "cos", "tan", "tanh", "exp", "log", "sqrt", "atan"


def elementary(function, x):
    """Return a function of mpmath of a decimal number."""
    with mp.workdps(DIGITS):
        return Decimal(mp.nstr(function(mp.mpf(str(x))), DIGITS))


FUNCTIONS = {name: partial(elementary, getattr(mp, name)) for name in _NAMES} | {"min": min, "max": max, "abs": abs}
PI = elementary(mp.acos, -1)
_BINARY = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
    ast.Pow: lambda a, b: a**b,
}


def value(formula, names):
    """Return a number of a file: as it is written, or of a formula over names."""
    return _of_tree(ast.parse(formula, mode="eval").body, names) if isinstance(formula, str) else Decimal(str(formula))


def _of_tree(tree, names):
    match tree:
        case ast.Constant():
            return Decimal(str(tree.value))
        case ast.Name():
            return names[tree.id]
        case ast.Attribute():
            return names[ast.unparse(tree)]
        case ast.UnaryOp():
            return -_of_tree(tree.operand, names)
        case ast.BinOp():
            return _BINARY[type(tree.op)](_of_tree(tree.left, names), _of_tree(tree.right, names))
        case ast.IfExp(test=ast.Compare(ops=[ast.Lt()])):
            less = _of_tree(tree.test.left, names) < _of_tree(tree.test.comparators[0], names)
            return _of_tree(tree.body if less else tree.orelse, names)
        case ast.Call():
            function = names.get(tree.func.id) or FUNCTIONS[tree.func.id]
            return function(*(_of_tree(x, names) for x in tree.args))
    raise ValueError(ast.unparse(tree))


def monotone(x, y):
    """Return the cubics of Fritsch and Butland through the points of a table, with three-point ends."""
    h, slope = np.diff(x), np.diff(y) / np.diff(x)

    def inner(k):
        if slope[k - 1] * slope[k] <= 0:
            return ZERO
        a, b = 2 * h[k] + h[k - 1], h[k] + 2 * h[k - 1]
        return (a + b) / (a / slope[k - 1] + b / slope[k])

    def end(h0, h1, d0, d1):
        d = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)
        if d * d0 <= 0:
            return ZERO
        return 3 * d0 if d0 * d1 < 0 and abs(d) > 3 * abs(d0) else d

    ends = end(h[0], h[1], slope[0], slope[1]), end(h[-1], h[-2], slope[-1], slope[-2])
    d = [ends[0], *(inner(k) for k in range(1, len(h))), ends[1]]

    def at(z):
        k = max(i for i in range(len(h)) if i == 0 or x[i] <= z)
        s = (z - x[k]) / h[k]
        rest = s * (1 - s) * ((1 - s) * (d[k] - slope[k]) - s * (d[k + 1] - slope[k])) * h[k]
        return y[k] + slope[k] * (z - x[k]) + rest

    return at


def solved(matrix, right):
    """Solve symmetric equations by elimination; rows that depend on others have no force."""
    n, a = len(right), np.column_stack([matrix, right])
    size, kept = max(abs(x) for x in matrix.ravel()), []
    for k in range(n):
        if abs(a[k, k]) > size * Decimal("1e-30"):
            kept.append(k)
            for i in range(k + 1, n):
                if a[i, k]:
                    a[i, k:] = a[i, k:] - a[k, k:] * (a[i, k] / a[k, k])
    x = np.full(n, ZERO)
    for k in reversed(kept):
        x[k] = (a[k, n] - a[k, k + 1 : n] @ x[k + 1 :]) / a[k, k]
    return x


def turned(e):
    """Return a direction turned left by a right angle."""
    return np.array([-e[1], e[0]])


class Names(dict):
    """Names of formulas; those of points are made where a formula asks for them."""

    def __init__(self, names, place):
        super().__init__(names)
        self.place = place

    def __missing__(self, name):
        """Return a coordinate or a rate of a point, BODY.POINT.x or BODY.POINT.vx."""
        body, point, axis = name.split(".")
        return self.place(body, point)["v" in axis]["xy".index(axis[-1])]

    def __or__(self, more):
        """Return the names with others."""
        return Names(super().__or__(more), self.place)


class Plane:
    """A mechanism of rigid bodies in the plane.

    The state has x, y and theta of each body in the order of the file, at its centre of mass, then their rates.
    """

    def __init__(self, raw):
        self.raw, self.names = raw, {"pi": PI}
        for name, own in raw.get("tables", {}).items():
            self.names[name] = monotone(*(np.array([Decimal(str(x)) for x in own[key]]) for key in "xy"))
        for name, own in raw.get("parameters", {}).items():
            self.names[name] = value(own["value"] if isinstance(own, dict) else own, self.names)
        for name, own in raw.get("inputs", {}).items():
            self.names[name] = value(own.get("default", 0), self.names)
        self.bodies = list(raw["bodies"])
        self.gravity = [self.number(x) for x in raw["mechanism"].get("gravity", (0, 0))]
        inertia = [[own["mass"], own["mass"], own["inertia"]] for own in raw["bodies"].values()]
        self.inertia = np.array([self.number(x) for row in inertia for x in row])

    def number(self, formula):
        """Return a number of the file."""
        return value(formula, self.names)

    def pair(self, numbers):
        """Return two numbers of the file."""
        return np.array([self.number(x) for x in numbers])

    def arm(self, body, point):
        """Return a point from the centre of mass, along the axes of its body."""
        own = self.raw["bodies"].get(body, {})
        if isinstance(point, str) and point == "centre":
            return np.array([ZERO, ZERO])
        place = own["points"][point] if isinstance(point, str) else point
        return self.pair(place) - self.pair(own.get("centre_of_mass", (0, 0)))

    def names_at(self, t, y, inputs):
        """Return the names that formulas know."""
        names = self.names | inputs | {"t": t}
        for k, body in enumerate(self.bodies):
            own = zip(
                ("x", "y", "theta", "vx", "vy", "omega"), [*y[3 * k : 3 * k + 3], *self.rates_of(y, k)], strict=True
            )
            names |= {f"{body}.{x}": number for x, number in own}
        return Names(names, lambda body, point: self.point(y, body, self.arm(body, point))[::2])

    def rates_of(self, y, k):
        """Return the rates of a body."""
        return y[len(y) // 2 + 3 * k : len(y) // 2 + 3 * k + 3]

    # -- points and rows -----------------------------------------------------------------------------------------------

    def point(self, y, body, arm):
        """Return a point's place, its derivatives by all coordinates, its rate, and its acceleration at rest of y."""
        slopes = np.full((2, len(y) // 2), ZERO)
        if body == GROUND:
            return arm, slopes, np.array([ZERO, ZERO]), np.array([ZERO, ZERO])
        k = self.bodies.index(body)
        c, s, omega = *self.turn(y, body), self.rates_of(y, k)[2]
        arm = np.array([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]])
        slopes[:, 3 * k : 3 * k + 2], slopes[:, 3 * k + 2] = _AXES, turned(arm)
        return y[3 * k : 3 * k + 2] + arm, slopes, slopes @ y[len(y) // 2 :], -(omega**2) * arm

    def turn(self, y, body):
        """Return cosine and sine of a body's angle."""
        if body == GROUND:
            return ONE, ZERO
        theta = y[3 * self.bodies.index(body) + 2]
        return FUNCTIONS["cos"](theta), FUNCTIONS["sin"](theta)

    def angle_row(self, y, body):
        """Return the derivatives of a body's angle by all coordinates."""
        row = np.full(len(y) // 2, ZERO)
        if body != GROUND:
            row[3 * self.bodies.index(body) + 2] = ONE
        return row

    def across(self, y, joint):
        """Return the way from the first point of a joint to the second as `point` does."""
        both = [self.point(y, body, self.arm(body, at)) for body, at in zip(joint["between"], joint["at"], strict=True)]
        return [second - first for first, second in zip(*both, strict=True)]

    def along(self, y, joint, direction):
        """Return the way along a direction of the first body: its size, derivatives by coordinates, acceleration."""
        first, (c, s) = joint["between"][0], self.turn(y, joint["between"][0])
        e = np.array([c * direction[0] - s * direction[1], s * direction[0] + c * direction[1]])
        spin = self.angle_row(y, first)
        omega = spin @ y[len(y) // 2 :]
        way, slopes, rate, own = self.across(y, joint)
        bias = e @ own + 2 * omega * (turned(e) @ rate) - omega**2 * (e @ way)
        return e @ way, e @ slopes + (turned(e) @ way) * spin, bias

    def coordinate(self, y, name):
        """Return what a joint reports: its size, derivatives by all coordinates, acceleration at rest of y."""
        joint = self.raw["joints"][name]
        if joint["type"] == "translational":
            axis = self.pair(joint["axis"])
            return self.along(y, joint, axis / (axis @ axis).sqrt())
        first, second = (self.angle_row(y, body) for body in joint["between"])
        return (second - first) @ y[: len(y) // 2], second - first, ZERO

    def rows(self, y, held=()):
        """Return the derivatives of all rows by the coordinates, and the accelerations that rows ask for."""
        slopes, wanted = list(), list()
        for joint in self.raw["joints"].values():
            if joint["type"] == "revolute":
                _, own, _, bias = self.across(y, joint)
                slopes += [*own]
                wanted += [*-bias]
            else:
                assert joint["type"] == "translational", joint
                axis = self.pair(joint["axis"])
                _, own, bias = self.along(y, joint, turned(axis / (axis @ axis).sqrt()))
                slopes += [own, self.angle_row(y, joint["between"][1]) - self.angle_row(y, joint["between"][0])]
                wanted += [-bias, ZERO]
        for name in held:
            _, own, bias = self.coordinate(y, name)
            slopes.append(own)
            wanted.append(-bias)
        return np.array(slopes, dtype=object).reshape(-1, len(y) // 2), np.array(wanted, dtype=object)

    # -- efforts -------------------------------------------------------------------------------------------------------

    def efforts(self, t, y, inputs, sliding):
        """Return the efforts along all coordinates; sliding are the signs of rates against which friction acts."""
        n = len(y) // 2
        names, total = self.names_at(t, y, inputs), np.full(n, ZERO)
        for k in range(len(self.bodies)):
            total[3 * k : 3 * k + 2] += self.inertia[3 * k] * np.array(self.gravity)
        for force in self.raw.get("forces", {}).values():
            total += getattr(self, "_" + force["type"].replace("-", "_"))(y, force, names)
        for name, sign in sliding.items():
            total -= sign * self.number(self.raw["joints"][name]["friction"]["sliding"]) * self.coordinate(y, name)[1]
        return total

    def _torque(self, y, force, names):
        row = self.angle_row(y, force["body"])
        return row * value(force["torque"], names | {"rate": row @ y[len(y) // 2 :]})

    def _force(self, y, force, names):
        _, slopes, _, _ = self.point(y, force["body"], self.arm(force["body"], force.get("at", "centre")))
        return np.array([value(x, names) for x in force["force"]]) @ slopes

    def _spring_damper(self, y, force, names):
        def of(key):
            return value(force.get(key, 0), names)

        if "joint" in force:
            length, slopes, _ = self.coordinate(y, force["joint"])
            push = of("actuator")
        else:
            way, slopes, _, _ = self.across(y, force)
            length, push = (way @ way).sqrt(), ZERO
            slopes = way @ slopes / length
        return slopes * (
            push - of("stiffness") * (length - of("free_length")) - of("damping") * (slopes @ y[-len(slopes) :])
        )

    # -- steps ---------------------------------------------------------------------------------------------------------

    def rate(self, t, y, inputs, held=(), sliding=()):
        """Return the rates of the state, with rows of joints and of coordinates at rest in force."""
        free, rows, forces = self.balance(t, y, inputs, held, sliding)
        return np.concatenate([y[len(y) // 2 :], free + rows.T @ forces / self.inertia])

    def balance(self, t, y, inputs, held=(), sliding=()):
        """Return accelerations without rows, the rows, and their forces, which push coordinates up."""
        free = self.efforts(t, y, inputs, dict(sliding)) / self.inertia
        rows, wanted = self.rows(y, held)
        return free, rows, solved(rows / self.inertia @ rows.T, wanted - rows @ free)

    def struck(self, y, name, restitution):
        """Return the state behind an impact along a coordinate of a joint."""
        n = len(y) // 2
        (rows, _), (_, own, _) = self.rows(y), self.coordinate(y, name)
        rows, v = np.vstack([rows, own]), y[n:]
        change = np.full(len(rows), ZERO)
        change[:-1], change[-1] = -(rows[:-1] @ v), -(1 + restitution) * (own @ v)
        return np.concatenate([y[:n], v + rows.T @ solved(rows / self.inertia @ rows.T, change) / self.inertia])


def rk4(rate, t, y, h):
    """Return a step of the classical scheme."""
    a = rate(t, y)
    b = rate(t + h / 2, y + h / 2 * a)
    c = rate(t + h / 2, y + h / 2 * b)
    return y + h / 6 * (a + 2 * (b + c) + rate(t + h, y + h * c))


def trapezoidal(rate, t, y, h):
    """Return a step of the trapezoidal rule, by iterations until no digit changes."""
    first, z = rate(t, y), y
    while True:
        z, before = y + h / 2 * (first + rate(t + h, z)), z
        if max(abs(z - before)) < Decimal(10) ** (5 - DIGITS) * max(abs(z)):
            return z


def slopes(of, x, width=Decimal("1e-15")):
    """Return the derivatives of a function of an array by differences."""
    columns = []
    for i in range(len(x)):
        ends = [of(x + np.array([sign * width * (i == j) for j in range(len(x))])) for sign in (1, -1)]
        columns.append((ends[0] - ends[1]) / (2 * width))
    return np.column_stack(columns)
