"""Values at which eigenvalues pass the imaginary axis, against those of two oscillators that are known in formulas."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from analyses.rods import of_text

FILE = """
[mechanism]
name = "two-ways"
[parameters]
p = 0.0
a0 = 1.0
a1 = 0.0
b0 = 1.0
b1 = 0.0
b2 = 0.0
c0 = 1.0
c1 = 0.0
d0 = 1.0
d1 = 0.0
[bodies.mass]
type = "point"
mass = 1.0
[forces.pull]
type = "force"
body = "mass"
force = ["-(a0 + a1*p)*mass.x - (b0 + b1*p + b2*p*p)*mass.vx", "-(c0 + c1*p)*mass.y - (d0 + d1*p)*mass.vy"]
"""
LETTERS = "a0", "a1", "b0", "b1", "c0", "c1", "d0", "d1"


@pytest.fixture(scope="module")
def model():
    return of_text(FILE)


def known(x0, x1, y0, y1):
    """Return where s^2 + (y0 + y1 p) s + x0 + x1 p has roots on the axis: values, imaginary parts, and rising."""
    found = []
    if y1 != 0.0 and (x := x0 - x1 * y0 / y1) > 0.0:
        found.append((-y0 / y1, np.sqrt(x), y1 < 0.0))
    if x1 != 0.0 and y0 - y1 * x0 / x1 != 0.0:
        found.append((-x0 / x1, 0.0, (x1 < 0.0) == (y0 - y1 * x0 / x1 > 0.0)))
    return found


@pytest.mark.by_turns(3)
@pytest.mark.fast("numbers0-9", "numbers5-2", "numbers6-4")
@pytest.mark.parametrize(
    ("numbers", "count"),
    [
        # a pair meets, parts on the real line, and one of it goes over
        ((3.6, 0.4, 0.5, 0.0, 1.2, -0.7, 0.6, 0.0), 9),
        # two real ones meet on the right and go over together: one value
        ((1.1, 0.2, -2.2, 2.0, 9.0, 0.0, 0.5, 0.0), 4),
        # one oscillator's pair goes to the right while a real one of the other goes to the left
        ((2.0, 0.0, 0.55, -1.0, 1.0, 2.0, 0.9, 0.1), 6),
        # beside a mass that nothing holds in one way
        ((0.0, 0.0, 0.0, 0.0, 1.0, 0.65, 0.7, 0.0), 20),
        # beside an oscillator that nothing damps
        ((7.0, 0.0, 0.0, 0.0, 1.0, 0.65, 0.7, 0.0), 20),
        # one pair goes to the right and another one, of nearly the same frequency, to the left: as many at both ends
        ((4.0, 0.0, -0.3, 1.0, 4.1, 0.0, -0.2, -1.0), 2),
        ((4.0, 0.0, -0.3, 1.0, 4.1, 0.0, -0.2, -1.0), 4),
        ((2.2, 0.8, 0.4, -0.6, 1.9, 0.8, 0.3, 0.55), 3),
    ],
)
def test_crossings_are_where_roots_are_on_the_axis(model, numbers, count):
    values = np.linspace(-3.0, 3.0, count)
    parameters = dict(zip(LETTERS, numbers, strict=True))
    found = model.locus(("p", values), at="start", parameters=parameters).crossings
    expected = sorted(c for c in (*known(*numbers[:4]), *known(*numbers[4:])) if abs(c[0]) < 3.0)
    assert [c.rising for c in found] == [c[2] for c in expected]
    assert_allclose([c.value for c in found], [c[0] for c in expected], rtol=0.0, atol=1e-7)
    assert_allclose([c.eigenvalue.imag for c in found], [c[1] for c in expected], rtol=0.0, atol=1e-6)


@pytest.mark.slow_cases("0")
@pytest.mark.parametrize("seed", range(2))
def test_as_many_pass_as_stand_on_the_other_side_behind(model, seed):
    rng = np.random.default_rng(seed)
    numbers = rng.uniform(-1.5, 1.5, 8) + np.array([2.0, 0.0, 0.5, 0.0, 2.0, 0.0, 0.5, 0.0])
    values = np.linspace(-3.0, 3.0, 7)
    found = model.locus(("p", values), at="start", parameters=dict(zip(LETTERS, numbers, strict=True)))
    right = [
        sum(np.count_nonzero(np.roots([1.0, d + p * e, a + p * b]).real > 0.0) for a, b, d, e in np.split(numbers, 2))
        for p in values
    ]
    for k, change in enumerate(np.diff(right)):
        inside = [c for c in found.crossings if values[k] < c.value <= values[k + 1]]
        assert sum((1 if c.rising else -1) * (2 if c.eigenvalue.imag > 1e-6 else 1) for c in inside) == change


@pytest.mark.by_turns(3)
@pytest.mark.fast("damped-3")
@pytest.mark.parametrize("count", [2, 3, 5])
@pytest.mark.parametrize("beside", [{"c0": 9.0, "d0": 0.0}, {"c0": 0.0, "d0": 1.0}], ids=["sprung", "damped"])
def test_a_branch_that_passes_and_comes_back_between_two_values_is_seen(model, count, beside):
    """A mass whose damper is p^2 - 1/4: beside one that nothing damps, and one that nothing holds."""
    parameters = {"b0": -0.25, "b2": 1.0, **beside}
    found = model.locus(("p", np.linspace(-2.0, 2.2, count)), at="start", parameters=parameters).crossings
    assert_allclose([c.value for c in found], [-0.5, 0.5], rtol=0.0, atol=1e-7)
    assert [c.rising for c in found] == [True, False]
