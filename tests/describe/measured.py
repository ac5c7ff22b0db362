"""A plain evaluation of bodies, measures and rows in numbers, real or complex, written for the tests alone."""

import cmath
from collections.abc import Mapping

import numpy as np

from symgen.base.vocabulary.expressions import Name, Number
from symgen.base.vocabulary.measures import Angle, Component, Distance, Holonomic, LinkStretch
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import Mechanism


class Posed:
    """A mechanism with numbers for parameters, and poses {body: (x, y, angle)} of the bodies' frames."""

    def __init__(self, mechanism: Mechanism, frames: Mapping[str, tuple] | None = None) -> None:
        self.mechanism = mechanism
        self.values = {p.name: p.value for p in mechanism.parameters}
        self.frames = dict(frames or self.start()) | {"ground": (0.0, 0.0, 0.0)}

    def number(self, expression, t: float = 0.0) -> float:
        return evaluate_formula(expression, self.values | {"t": t})

    def start(self) -> dict[str, tuple]:
        return {b.name: (*map(self.number, b.position), self.number(b.angle)) for b in self.mechanism.bodies}

    def turned(self, body: str, vector) -> np.ndarray:
        x, y = map(self.number, vector)
        c, s = np.cos(self.frames[body][2]), np.sin(self.frames[body][2])
        return np.array([c * x - s * y, s * x + c * y])

    def point(self, marker) -> np.ndarray:
        x, y, _ = self.frames[marker.body]
        return np.array([x, y]) + self.turned(marker.body, marker.point)

    def measure(self, measure):
        match measure:
            case Component(a, b, along):
                return self.turned(along.body, along.vector) @ (self.point(b) - self.point(a))
            case Angle(a, b):
                return self.frames[b][2] - self.frames[a][2]
            case Distance(a, b):
                gap = self.point(b) - self.point(a)
                return cmath.sqrt(gap @ gap) if np.iscomplexobj(gap) else np.sqrt(gap @ gap)
            case LinkStretch(a, b, length):
                gap, size = self.point(b) - self.point(a), self.number(length)
                return (gap @ gap - size**2) / (2 * size)
        return sum(self.number(weight) * self.measure(term) for weight, term in measure.terms)

    def residual(self, row: Holonomic, t: float = 0.0):
        return self.measure(row.measure) - self.number(row.value, t)

    def residuals(self, t: float = 0.0) -> dict[str, float]:
        return {
            f"{joint.name}.{row.label}": self.residual(row, t)
            for joint in self.mechanism.joints
            for row in joint.rows
            if isinstance(row, Holonomic)
        }

    def gradient(self, measure, body: str) -> np.ndarray:
        """Derivative of the measure by the pose of a body's frame, by complex steps."""
        result = []
        for i in range(3):
            step = [1e-30j if j == i else 0.0 for j in range(3)]
            moved = self.frames | {body: tuple(a + b for a, b in zip(self.frames[body], step, strict=True))}
            result.append(np.imag(Posed(self.mechanism, moved).measure(measure)) / 1e-30)
        return np.array(result)


def complex_value(expression, values: Mapping[str, complex]) -> complex:
    """Value of an expression of sums, products and powers, for complex steps."""
    if isinstance(expression, Number):
        return expression.value
    if isinstance(expression, Name):
        return values[expression.name]
    arguments = [complex_value(argument, values) for argument in expression.arguments]
    match expression.function:
        case "add":
            return arguments[0] + arguments[1]
        case "sub":
            return arguments[0] - arguments[1]
        case "mul":
            return arguments[0] * arguments[1]
        case "div":
            return arguments[0] / arguments[1]
        case "neg":
            return -arguments[0]
        case "pow":
            return arguments[0] ** arguments[1]
    raise LookupError(expression.function)
