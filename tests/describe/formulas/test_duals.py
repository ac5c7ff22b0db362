"""Numbers with derivatives: each function of formulas against differences in 40 digits, and formulas that follow."""

import math

import mpmath
import pytest

import symgen
from symgen.base.vocabulary.elementary_functions import ELEMENTARY
from symgen.base.vocabulary.expressions import FUNCTIONS
from symgen.describe.formulas.duals import Dual, Duals, apply_to_duals, as_dual, parameter_duals
from symgen.describe.formulas.evaluate import parameter_values

POINT = {"acosh": 1.7}
EXACT = {
    **{name: getattr(mpmath, name) for name in ELEMENTARY},
    **{"add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b},
    **{"pow": lambda a, b: a**b, "neg": lambda a: -a, "abs": abs, "atan2": mpmath.atan2},
    **{"min": min, "max": max, "both": min, "either": max},
}


@pytest.mark.parametrize("name", sorted(EXACT))
def test_functions(name):
    first, count = POINT.get(name, 0.6), FUNCTIONS[name][0]
    points, rates = (first, 0.45)[:count], (1.5, -0.7)[:count]
    got = apply_to_duals(name, [Dual(x, (rate, 2.0 * rate)) for x, rate in zip(points, rates, strict=True)])
    with mpmath.workdps(40):
        h = mpmath.mpf(10) ** -15
        ends = [
            EXACT[name](*(mpmath.mpf(x) + s * h * rate for x, rate in zip(points, rates, strict=True))) for s in (1, -1)
        ]
        slope = float((ends[0] - ends[1]) / (2 * h))
    assert got.value == FUNCTIONS[name][1](*points)
    assert got.slopes == pytest.approx((slope, 2.0 * slope), rel=1e-12)


def test_what_is_constant_between_jumps():
    a = Dual(0.4, (1.0,))
    for name in ("lt", "le", "gt", "ge", "sign", "not", "and", "or"):
        arguments = [a, as_dual(0.3)][: FUNCTIONS[name][0]]
        assert set(apply_to_duals(name, arguments).slopes) <= {0.0}
    assert apply_to_duals("where", [as_dual(1.0), a, as_dual(2.0)]).slopes == (1.0,)


def test_formulas_of_parameters_follow(tmp_path):
    path = tmp_path / "m.toml"
    path.write_text(
        '[mechanism]\nname = "m"\n[parameters]\na = { value = 2.0 }\nb = { value = "a**2 + 1" }\n'
        'c = { value = "sin(b)*a" }\n[bodies.p]\ntype = "point"\nmass = "c + 2"\n',
        encoding="utf-8",
    )
    mechanism = symgen.load(path).mechanism
    values = parameter_values(mechanism)
    by = parameter_duals(mechanism, values, {}, ["a", "b"])
    # one that is a direction itself is set to a number: it follows no other
    assert by["b"].slopes == (0.0, 1.0)
    assert by["c"].slopes == pytest.approx((math.sin(5.0), 2.0 * math.cos(5.0)))
    alone = parameter_duals(mechanism, values, {}, ["a"])
    assert alone["b"].slopes == (4.0,)
    assert alone["c"].slopes == pytest.approx((math.sin(5.0) + 2.0 * math.cos(5.0) * 4.0,))
    assert Duals(alone).value(mechanism.bodies[0].mass, "mass").slopes == alone["c"].slopes
