"""A pair of shapes that symgen has not: a disc on an arc, as one module beside those of `describe/contacts/pairs`."""

import math
from collections.abc import Iterator
from pathlib import Path

import msgspec
import numpy as np
import pytest
from support.ending import Ending

from symgen.base.vocabulary.expressions import ZERO, Expr, Number, Reading, call
from symgen.base.vocabulary.measures import GROUND, Angle, Component, Direction, FormulaMeasure
from symgen.describe.contacts.surfaces import PAIRS, Disc, Pair, Touch
from symgen.describe.parts.fields import Point, Scalar
from symgen.describe.parts.scope import Scope
from tests.run.contacts.scenes import G, body, head, loaded

# -- what the module of the pair has -----------------------------------------------------------------------------------


class ArcTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The outer side of an arc about the second axis of its body: its centre, radius and half of its angle."""

    body: str
    arc: tuple[Scalar, Scalar]
    at: Point = (0.0, 0.0)


def read_arc(scope: Scope, key: str, table: ArcTable, disc: Disc) -> Touch:
    """Return gap and slip of a disc on the arc, and on its ends beyond."""
    owner = scope.body(f"{key}.body", table.body)
    centre = scope.marker(f"{key}.at", owner, table.at)
    radius, half = (scope.value(scope.constant(f"{key}.arc", value), f"{key}.arc") for value in table.arc)
    x, y = (
        Reading(f"{scope.name}.{word}", Component(centre, disc.centre, Direction(owner, vector)))
        for word, vector in (("across", (Number(1.0), ZERO)), ("up", (ZERO, Number(1.0))))
    )
    angle = call("atan2", x, y)
    end_x, end_y = Number(radius * math.sin(half)), Number(radius * math.cos(half))
    side = call("where", call("lt", x, ZERO), Number(-1.0), Number(1.0))
    beyond_x, beyond_y = call("sub", x, call("mul", side, end_x)), call("sub", y, end_y)
    past = call("gt", call("abs", angle), Number(half))
    distance = call("where", past, _length(beyond_x, beyond_y), call("sub", _length(x, y), Number(radius)))
    on_arc = call("mul", call("add", Number(radius), disc.radius), angle)
    on_end = call(
        "add", call("mul", side, Number(radius * half)), call("mul", disc.radius, call("atan2", beyond_x, beyond_y))
    )
    slip = call("where", past, on_end, on_arc)
    for of, sign in ((disc.body, "add"), (owner, "sub")):
        if of != GROUND and scope.turns(of):
            slip = call(sign, slip, call("mul", disc.radius, Reading(f"{of}.theta", Angle(GROUND, of))))
    gap = FormulaMeasure(call("sub", distance, disc.radius))
    return Touch(gap, ZERO, FormulaMeasure(slip), None, (disc.outline,))


def _length(x: Expr, y: Expr) -> Expr:
    return call("sqrt", call("add", call("mul", x, x), call("mul", y, y)))


KIND = Pair("arc", ArcTable, read_arc, lambda table: str(table.body))

# -- tests -------------------------------------------------------------------------------------------------------------


@pytest.fixture
def arcs() -> Iterator[None]:
    """Have the pair for a test."""
    PAIRS.register("disc-arc", KIND)
    yield
    PAIRS._loaded.pop("disc-arc")
    PAIRS._modules = None


def dome(surface: str, start: float, friction: float) -> str:
    """Return a disc of 0.1 m at rest on a dome of 0.4 m, off its top by an angle."""
    place = 0.5 * math.sin(start), 0.5 * math.cos(start)
    text = (
        head("dome") + body("disc", 1.0, 0.005, place) + '[contacts.dome]\nbetween = [{ body = "disc", disc = 0.1 }, '
    )
    return text + f'{{ body = "ground", {surface} }}]\nfriction = {friction!r}\n'


@pytest.mark.slow
@pytest.mark.usefixtures("arcs")
def test_on_a_long_arc_a_disc_moves_as_on_a_disc(tmp_path: Path) -> None:
    runs = [
        loaded(dome(surface, 0.15, 0.35), tmp_path).simulate(until=0.75, integrator="dop853", rtol=1e-12, verify=False)
        for surface in ("arc = [0.4, 1.2]", "disc = 0.4")
    ]
    names, times = ([[getattr(event, key) for event in run.events] for run in runs] for key in ("name", "t"))
    assert names[0] == names[1] == ["dome.slip", "dome.lift"]
    np.testing.assert_allclose(times[0], times[1], rtol=0.0, atol=1e-11)
    np.testing.assert_allclose(runs[0].q.values, runs[1].q.values, rtol=0.0, atol=1e-10)


@pytest.mark.slow
@pytest.mark.usefixtures("arcs")
@pytest.mark.parametrize("integrator", ["dop853", "picard"])
def test_past_its_end_a_disc_rolls_about_the_corner(integrator: str, tmp_path: Path) -> None:
    """The angle about the centre, then that about the end, follow from energies and an integration of one's own."""
    from scipy.integrate import solve_ivp

    r, far, start, half, mu = 0.1, 0.5, 0.45, 0.5, 0.6

    def about(length: float) -> object:
        return lambda _, y: [y[1], G * math.sin(y[0]) / (1.5 * length)]

    def ends(_: float, y: np.ndarray) -> float:
        return y[0] - half

    def slips(_: float, y: np.ndarray) -> float:
        return mu * (G * math.cos(y[0]) - r * y[1] ** 2) - G * math.sin(y[0]) / 3.0

    tight = {"rtol": 1e-12, "atol": 1e-14, "method": "DOP853"}
    one = solve_ivp(about(far), (0.0, 2.0), [start, 0.0], events=Ending(ends), **tight)
    two = solve_ivp(about(r), (0.0, 2.0), [half, one.y[1, -1] * far / r], events=Ending(slips), **tight)
    text = dome(f"arc = [0.4, {half}]", start, mu)
    run = loaded(text, tmp_path).simulate(until=0.5, integrator=integrator, rtol=1e-12, verify=False)
    assert run.events[0].name == "dome.slip" and abs(run.events[0].t - one.t[-1] - two.t[-1]) < 1e-9
    across = 0.4 * math.sin(half) + r * math.sin(two.y[0, -1])
    assert abs(run.events[0].q["disc.x"] - across) < 1e-9


@pytest.mark.usefixtures("arcs")
def test_messages_know_the_shape(tmp_path: Path) -> None:
    from symgen.base.errors import InputError

    with pytest.raises(InputError, match=r"expected a shape: disc, arc, line, outline, segment|did you mean 'arc'"):
        loaded(dome("arcs = [0.4, 1.2]", 0.15, 0.35), tmp_path)
