"""Rows in words: their vectors, evaluated with rotation matrices of SciPy, are zero where the derived rows are."""

import math
import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import symgen
from symgen.describe.catalogue import all_names
from symgen.describe.formulas.evaluate import evaluate_formula, parameter_values
from symgen.describe.mechanism import Mechanism
from symgen.result.reading.row_words import row_words

RANDOM = np.random.default_rng(55)


class Place:
    """Bodies of a mechanism anywhere, with points and axes by the names of the text."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.values = {"t": 0.3, "pi": math.pi, **parameter_values(mechanism)}
        self.states = dict[str, float]()
        self.frames = {"ground": (np.zeros(3), np.eye(3))}
        self.points = dict[str, np.ndarray]()
        for body in mechanism.bodies:
            centre, turned = RANDOM.normal(size=3), np.eye(3)
            if mechanism.space == "planar":
                centre[2], angle = 0.0, 0.0 if body.is_point else RANDOM.normal()
                turned = Rotation.from_euler("z", angle).as_matrix()
                self.states[f"{body.name}.theta"] = angle
            elif not body.is_point:
                x, y, z, w = Rotation.random(random_state=int(RANDOM.integers(1 << 30))).as_quat()
                turned = Rotation.from_quat([x, y, z, w]).as_matrix()
                self.states |= {f"{body.name}.e{i}": e for i, e in enumerate((w, x, y, z))}
            self.states |= {f"{body.name}.{c}": value for c, value in zip("xyz", centre, strict=True)}
            middle = self._number(body.centre_of_mass)
            self.frames[body.name] = centre - turned @ middle, turned
            for point, place in (*body.points, ("centre", body.centre_of_mass)):
                self.points[f"{body.name}.{point}"] = self._of(body.name, self._number(place))

    def _number(self, entries: tuple) -> np.ndarray:
        numbers = [evaluate_formula(e, self.values) for e in entries]
        return np.array([*numbers, *[0.0] * (3 - len(numbers))])

    def _of(self, body: str, point: np.ndarray) -> np.ndarray:
        origin, turned = self.frames[body]
        return origin + turned @ point

    def _vector(self, text: str) -> np.ndarray:
        _, _, entries = text.partition(" ")
        numbers = [float(eval(e, {"__builtins__": {}}, self.values)) for e in entries.strip("[]").split(", ")]
        return np.array([*numbers, *[0.0] * (3 - len(numbers))])

    def r(self, text: str) -> np.ndarray:
        return self._of(text.partition(" ")[0], self._vector(text)) if " [" in text else self.points[text]

    def u(self, text: str) -> np.ndarray:
        return self.frames[text.partition(" ")[0]][1] @ self._vector(text)

    def side(self, text: str) -> float:
        """Evaluate one side of an equation."""
        text = re.sub(r"\b([ru])\(([^()]*?)\)", r"\1('\2')", text)
        text = re.sub(r"\be_([xyz])\((\w+)\)", r"e('\1', '\2')", text)
        text = re.sub(r"\btheta\((\w+)\)", r"theta('\1')", text)
        text = re.sub(r"\|([^|]*)\|", r"norm(\1)", text).replace(" . ", " @ ").replace("^", "**")
        text = re.sub(r"(?<=[\w.]) sqrt", " * sqrt", text)
        functions = {
            **{"r": self.r, "u": self.u, "e": lambda k, body: self.frames[body][1][:, "xyz".index(k)]},
            **{"theta": lambda body: self.states[f"{body}.theta"], "norm": np.linalg.norm},
            **{name: getattr(math, name) for name in ("sqrt", "sin", "cos", "exp")},
        }
        return float(eval(text, {"__builtins__": {}}, self.values | functions))

    def phi(self, text: str) -> float:
        """Evaluate a derived row."""
        names = {**self.values, **self.states}
        text = re.sub(r"[A-Za-z_]\w*\.\w+", lambda m: f"({float(names[m[0]])!r})", text)
        functions = {name: getattr(math, name) for name in ("sqrt", "sin", "cos", "exp")}
        return float(eval(text, {"__builtins__": {}}, self.values | functions))


MECHANISMS = "spatial-slider-crank stewart-platform front-suspension bricard rolling-disc slider-crank driven-four-bar"


@pytest.mark.slow_cases("stewart-platform", "front-suspension", "bricard")
@pytest.mark.parametrize("name", [*MECHANISMS.split(), "pendulum", "heavy-top"])
def test_vectors_are_zero_where_rows_are(name: str) -> None:
    model = symgen.load(name)
    rows = [row for row in model.inspect().facts["rows"] if row["vectors"] and row["phi"] is not None]
    assert rows
    place = Place(model.mechanism)
    for row in rows:
        left, right = map(place.side, row["vectors"].split(" = "))
        phi = place.phi(row["phi"])
        if row["vectors"].startswith("|"):
            assert phi == pytest.approx((left**2 - right**2) / (2 * right), rel=1e-5, abs=1e-5)
        else:
            assert abs(phi) == pytest.approx(abs(left - right), rel=1e-5, abs=1e-5), row["vectors"]


def test_every_row_of_the_catalogue_has_words() -> None:
    for name in all_names():
        mechanism = symgen.load(name).mechanism
        words = row_words(mechanism)
        assert set(words) >= {f"{joint.name}.{row.label}" for joint in mechanism.joints for row in joint.rows}
        assert all(held.words and "None" not in held.words for held in words.values())


def test_kinds_of_rows_read_as_sentences() -> None:
    file = symgen.MechanismBuilder("kinds").body("a", mass=1.0, inertia=1.0, points={"tip": [0.5, 0.0]})
    file = file.body("b", mass=1.0, inertia=1.0)
    file = file.joint("pin", "revolute", between=["ground", "a"], at=[[0.0, 0.0], "tip"])
    file = file.joint("rod", "distance", between=["a", "b"], at=["centre", "centre"], length=2.0)
    file = file.joint("level", "orientation", between=["a", "b"])
    file = file.joint("motor", "driver", joint="pin", value="2*t")
    file = file.joint("blade", "knife-edge", body="b", axis=[1.0, 0.0])
    assert {name: held.words for name, held in row_words(file.build()).items()} == {
        "pin.x": "ground [0, 0] and a.tip coincide in x",
        "pin.y": "ground [0, 0] and a.tip coincide in y",
        "rod.distance": "a.centre and b.centre keep the distance 2",
        "level.angle": "a and b do not turn against each other",
        "motor.driver": "the angle of a follows 2.0*t",
        "blade.normal": "b.centre does not move along e_y of b",
    }
