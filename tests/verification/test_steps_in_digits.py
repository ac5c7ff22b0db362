"""Derivatives of a step beside differences of the same step in 50 digits, by equations that share nothing with symgen.

The reference is `plane_in_digits`. States are those of bodies, and all of them count as independent.
"""

import tomllib
from decimal import Decimal
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from symgen.api import Model
from symgen.describe.files.validate import validate
from verification.plane_in_digits import ZERO, Plane, rk4, slopes, trapezoidal, value

ROOT = Path(__file__).resolve().parents[2]
CATALOGUE, BOUNDED = ROOT / "symgen" / "describe" / "catalogue", ROOT / "benchmarks" / "bounded" / "files"
SCHEMES = {"rk4": rk4, "trapezoidal": trapezoidal}
EXTRA = "extra*(2 + 0.1*extra)"
CART = """
[mechanism]
name = "rubbed"
gravity = [0.0, -9.81]

[bodies.cart]
mass = 1.0
inertia = 0.1
points = { pin = [0.0, 0.1] }
velocity = [0.3, 0.0]

[bodies.pole]
mass = 0.4
inertia = 0.02
points = { pin = [0.0, -0.5] }
position = [-0.05, 0.5975]
angle = 0.1
velocity = [0.3, 0.0]

[joints.rail]
type = "translational"
between = ["ground", "cart"]
at = [[0.0, 0.0], [0.0, 0.0]]
axis = [1.0, 0.0]
friction = { sliding = 2.0, static = 3.0 }
stop = { upper = 0.02, restitution = 0.5 }

[joints.pin]
type = "revolute"
between = ["cart", "pole"]
at = ["pin", "pin"]
friction = { sliding = 0.02 }

[forces.motor]
type = "force"
body = "cart"
at = [0.0, 0.0]
force = [5.0, 0.0]
"""


def exact(numbers):
    """Return binary numbers as decimal ones."""
    return np.array([Decimal(float(x)) for x in np.ravel(numbers)]).reshape(np.shape(numbers))


def described(path, body):
    """Return the table of a file without its drivers, with an input that turns a body, and an output."""
    raw = tomllib.loads(CART if path is None else path.read_text(encoding="utf-8"))
    raw["joints"] = {name: joint for name, joint in raw["joints"].items() if joint["type"] != "driver"}
    raw.setdefault("inputs", {})["extra"] = {"default": 0.7}
    raw.setdefault("forces", {})["driven"] = {"type": "torque", "body": body, "torque": EXTRA}
    raw["outputs"] = {"seen": {"value": f"{body}.y + 0.1*{body}.omega**2"}}
    return raw


def started(raw, scheme, h):
    """Return a run step by step."""
    apart = {"max_violation": 1e6, "max_energy_error": 1e6}
    return Model(validate(raw, "digits")).start(
        method="lagrange", coordinates="absolute", integrator=scheme, step=h, **apart
    )


def apart(found, wanted, floor):
    """Return how far derivatives are from others, column by column over the largest of a column."""
    return float((np.abs(found - wanted).max(axis=0) / np.maximum(np.abs(wanted).max(axis=0), floor)).max())


def largest(raw, run, found, step, y, changes, floor):
    """Return the largest difference of A along changes of the state and of B, and of C."""
    plane, x, n = Plane(raw), np.append(exact(y), Decimal(run.parameters["extra"])), len(y)
    end = step(plane, x)
    assert np.abs((end - exact(run.state)).astype(float)).max() < 1e-11 * max(1.0, np.abs(run.state).max())
    ways = np.block([[changes, np.zeros((n, 1))], [np.zeros((1, changes.shape[1])), 1.0]])
    own = np.column_stack([found.A, found.B[:, found.inputs.index("extra")]]) @ ways
    wanted = slopes(lambda z: step(plane, x + exact(ways) @ z), np.full(ways.shape[1], ZERO)).astype(float)
    t, formula = Decimal(run.t), raw["outputs"]["seen"]["value"]
    outputs = slopes(lambda z: np.array([value(formula, plane.names_at(t, z, {}))]), exact(run.state)).astype(float)
    assert apart(found.C[[found.outputs.index("seen")]].T, outputs.T, 1.0) < 1e-14 * max(1.0, np.abs(outputs).max())
    return apart(own, wanted, floor)


#: File, body that is pushed, step [s], scheme.
STEPS = {
    "cart-pole": ("machines/cart-pole", "pole", 5e-3, "rk4"),
    "four-bar": ("four-bar", "crank", 1e-2, "rk4"),
    "slider-crank": ("slider-crank", "crank", 1e-3, "rk4"),
    "wiper": ("machines/wiper", "arm", 1e-3, "rk4"),
    "klann-leg": ("machines/klann-leg", "leg", 1e-3, "rk4"),
    "jansen-leg": ("machines/jansen-leg", "leg", 1e-3, "rk4"),
    "andrews": ("andrews", "K1", 1e-5, "rk4"),
    "implicit four-bar": ("four-bar", "crank", 1e-2, "trapezoidal"),
    "implicit cart-pole": ("machines/cart-pole", "pole", 5e-3, "trapezoidal"),
}


@pytest.mark.by_turns(8)
@pytest.mark.fast("cart-pole")
@pytest.mark.parametrize("name", STEPS)
def test_derivatives_of_a_step_are_those_of_50_digits(name):
    file, body, h, scheme = STEPS[name]
    raw = described(CATALOGUE / f"{file}.toml", body)
    run = started(raw, scheme, h)
    for _ in range(3):
        run.step(h)
    t, y = Decimal(run.t), np.array(run.state)
    run.step(h)

    def step(plane, x):
        return SCHEMES[scheme](lambda t, y: plane.rate(t, y, {"extra": x[-1]}), t, x[:-1], Decimal(h))

    assert largest(raw, run, run.derivatives(), step, y, np.eye(len(y)), 1e-30) < 1e-12


# -- events ------------------------------------------------------------------------------------------------------------


class Mode(NamedTuple):
    """Coordinates of joints at rest, and signs of rates against which friction acts."""

    held: tuple[str, ...]
    sliding: dict[str, int]


class Case(NamedTuple):
    """A step with an event in it.

    Attributes
    ----------
    path, body : Path or None, str
        File, or the cart, and the body that is pushed.
    h, before : float, int
        Step [s], and the steps before.
    event : str
        The first event of the step, or none; others may fall together with it.
    held : tuple
        What is at rest before it.
    limit, restitution : formula or number
        Of its stop.
    """

    path: Path | None
    body: str
    h: float
    before: int
    event: str
    held: tuple[str, ...] = ()
    limit: str | float = 0.0
    restitution: str | float = 0.0

    @property
    def joint(self):
        """The joint of the event."""
        return self.event.partition(".")[0]

    def size(self, plane, t, y, inputs, mode):
        """Return what is zero at the event."""
        if self.event.endswith("hit"):
            return plane.coordinate(y, self.joint)[0] - plane.number(self.limit)
        if self.event.endswith("leave"):
            return plane.balance(t, y, inputs, *mode)[2][-1]
        return speed(plane, y, self.joint)

    def passed(self, plane, y, mode):
        """Return state and mode behind the event."""
        sliding, restitution = dict(mode.sliding), plane.number(self.restitution)
        match self.event.rpartition(".")[2]:
            case "hit":
                y = plane.struck(y, self.joint, restitution)
                sliding = signs(plane, y, () if restitution else (self.joint,))
                return y, Mode(() if restitution else (self.joint,), sliding)
            case "stick":
                del sliding[self.joint]
                return y, Mode((self.joint,), sliding)
            case "reverse":
                sliding[self.joint] *= -1
                return y, Mode(mode.held, sliding)
        return y, Mode((), sliding)


def speed(plane, y, name):
    """Return the rate of what a joint reports."""
    return plane.coordinate(y, name)[1] @ y[len(y) // 2 :]


def signs(plane, y, held):
    """Return the signs of rates against which friction acts."""
    names = [name for name, joint in plane.raw["joints"].items() if "friction" in joint and name not in held]
    return {name: 1 if speed(plane, y, name) > 0 else -1 for name in names}


def passing(case, plane, x, t, at, mode, scheme):
    """Return a step with an event, which is sought from a time on by secants."""
    h, inputs, y = Decimal(case.h), {"extra": x[-1]}, x[:-1]

    def moved(mode, t, y, h):
        return scheme(lambda t, y: plane.rate(t, y, inputs, *mode), t, y, h)

    if not case.event:
        return moved(mode, t, y, h)

    def off(part):
        return case.size(plane, t + part, moved(mode, t, y, part), inputs, mode)

    one, other = at - t, at - t + Decimal("1e-10")
    size = off(one)
    while one != other:
        last = off(other)
        if abs(last) < Decimal("1e-45") or last == size:
            break
        one, size, other = other, last, other - last * (other - one) / (last - size)
    y, mode = case.passed(plane, moved(mode, t, y, other), mode)
    return moved(mode, t + other, y, h - other)


def allowed(plane, y, held):
    """Return changes of a state that leave rows, and rates at rest, as they are, one a column."""
    n = len(y) // 2

    def rates(x):
        return plane.rows(x, held)[0] @ x[n:]

    rows = plane.rows(y, held)[0].astype(float)
    places = rows[: len(rows) - len(held)]
    both = np.vstack([np.hstack([places, 0.0 * places]), slopes(rates, y).astype(float)])
    _, sizes, ways = np.linalg.svd(both)
    return ways[np.count_nonzero(sizes > 1e-9 * sizes.max()) :].T


PRESS, BUCKET, TOGGLE = BOUNDED / "press.toml", BOUNDED / "bucket.toml", CATALOGUE / "machines" / "toggle-press.toml"
DIE = "-2*link_length*cos(shut)"
PASSED = {
    "cart strikes": Case(None, "pole", 1e-2, 4, "rail.upper.hit", limit=0.02, restitution=0.5),
    "pin turns back": Case(None, "pole", 1e-2, 5, "pin.reverse"),
    "cart turns back": Case(None, "pole", 1e-2, 7, "rail.reverse"),
    "press rests": Case(PRESS, "lower", 1e-2, 10, "", held=("guide",)),
    "press leaves": Case(PRESS, "lower", 1e-2, 31, "guide.lower.leave", held=("guide",)),
    "press strikes": Case(PRESS, "lower", 1e-2, 66, "guide.upper.hit", limit=0.36),
    "bucket falls": Case(BUCKET, "rocker", 5e-3, 6, "cylinder.lower.hit", limit="closed"),
    "bucket leaves": Case(BUCKET, "rocker", 5e-3, 70, "cylinder.lower.leave", held=("cylinder",)),
    "ram strikes": Case(TOGGLE, "upper", 2e-3, 45, "guide.lower.hit", limit=DIE),
}


IMPLICIT = "cart strikes", "pin turns back", "cart turns back", "press rests", "press leaves", "press strikes"


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "scheme"), [(name, "rk4") for name in PASSED] + [(name, "trapezoidal") for name in IMPLICIT]
)
def test_derivatives_of_a_step_with_an_event_are_those_of_50_digits(name, scheme):
    case = PASSED[name]
    raw = described(case.path, case.body)
    run = started(raw, scheme, case.h)
    for _ in range(case.before):
        run.step(case.h)
    t, y, passed = run.t, np.array(run.state), len(run.events)
    run.step(case.h)
    first = list(run.events)[passed:][:1]
    assert [event.name for event in first] == ([case.event] if case.event else [])
    plane, at = Plane(raw), Decimal(first[0].t) if first else None
    mode = Mode(case.held, signs(plane, exact(y), case.held))

    def step(plane, x):
        return passing(case, plane, x, Decimal(t), at, mode, SCHEMES[scheme])

    ways = allowed(plane, exact(y), case.held)
    # what comes to rest at a stop depends on nothing, and its derivatives are rounding
    assert largest(raw, run, run.derivatives(), step, y, ways, 1e-2) < 1e-10
