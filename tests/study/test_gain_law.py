"""The family `gain`: gains in units of the rate of the motion, the least violation and the slopes beside it."""

from types import SimpleNamespace

import pytest

from symgen import load
from symgen.study.stress.bench import Base, NotApplicable
from symgen.study.stress.families import levels_of_family
from symgen.study.stress.findings import fitted_slope, gain_law


def test_slopes_are_those_of_powers():
    assert fitted_slope([(x, 3.0 * x**-1.5) for x in (0.1, 0.3, 1.0, 2.0)]) == pytest.approx(-1.5)
    assert fitted_slope([(1.0, 1.0), (2.0, 4.0)]) is None


def test_findings_have_the_least_point_and_both_slopes():
    gains = [0.01 * 2.0**k for k in range(13)]
    rows = [
        SimpleNamespace(family="gain", model="m", values=(x,), position_violation_max=1e-9 * max(x**-1.0, x**2.0))
        for x in gains
    ]
    others = [SimpleNamespace(family="step", model="m", values=(1.0,), position_violation_max=1e-20)]
    (sentence,) = gain_law(SimpleNamespace(rows=rows + others))
    assert "on m with rk4: least |Phi| 1.6e-09 m at 0.64 r" in sentence
    assert sentence.endswith("slopes of log |Phi| -1 below and 2 above.")


def test_gains_are_in_units_of_the_rate_that_the_rule_of_the_motion_takes():
    base = Base.of_mechanism("four-bar")
    level = levels_of_family("gain", base, True)[3]
    options = {"method.rule": "motion"}
    result = load("four-bar").simulate(
        method="baumgarte", integrator="rk4", step=1e-2, until=base.nominal_values, options=options, verify=False
    )
    (note,) = (n for n in result.notes if "rule=motion" in n)
    rate = float(note.partition("alpha = beta = ")[2].partition(" ")[0])
    assert level.options["method.alpha"] == pytest.approx(level.values[0] * rate, rel=1e-3)


def test_a_mechanism_at_rest_has_no_gains_of_motion(tmp_path):
    text = '[mechanism]\nname = "still"\ngravity = [0.0, 0.0]\n\n[bodies.a]\nmass = 1.0\ninertia = 1.0\n'
    text += 'points = { A = [-1.0, 0.0] }\nposition = [1.0, 0.0]\n\n[joints.O]\ntype = "revolute"\n'
    (tmp_path / "still.toml").write_text(text + 'between = ["ground", "a"]\nat = [[0.0, 0.0], "A"]\n', encoding="utf-8")
    with pytest.raises(NotApplicable, match="nothing moves"):
        levels_of_family("gain", Base.of_mechanism(tmp_path / "still.toml"), True)
