"""Newton's iteration of implicit schemes: where it ends, and the work of the last multipliers."""

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen

LINE = {"type": "rows", "rows": [{"position": "p.y", "label": "y"}]}
#: A point between a driver and a spring: the driver does the work of the spring, 1/2 k x^2.
DRIVEN = {
    "mechanism": {"name": "driven"},
    "bodies": {"p": {"type": "point", "mass": 1.0, "velocity": [0.1, 0.0]}},
    "joints": {"line": LINE, "stick": {"type": "rows", "rows": [{"position": "p.x - 0.1*t", "label": "x"}]}},
    "forces": {"spring": {"type": "force", "body": "p", "force": ["-100*p.x", 0.0]}},
}
#: A point that a spring of any stiffness k > 1 pulls behind sin(t): x = 1 + k sin(t)/(k - 1).
FOLLOWER = {
    "mechanism": {"name": "follower"},
    "parameters": {"k": 1e10},
    "bodies": {"p": {"type": "point", "mass": 1.0, "position": [1.0, 0.0], "velocity": ["k/(k - 1)", 0.0]}},
    "joints": {"line": LINE},
    "forces": {"spring": {"type": "force", "body": "p", "force": ["-k*(p.x - 1 - sin(t))", 0.0]}},
}
CONSTANT = {"integrator.adaptive": "false"}


@pytest.mark.parametrize(
    ("integrator", "settings"),
    [
        *[("radau5", {}), ("radau5", {"method": "ggl"}), ("sdirk", {}), ("trapezoidal", {"step": 1e-3})],
        *[
            ("newmark", {"step": 1e-3}),
            ("rodas", {}),
            ("hht", {"method": "generalized-alpha"}),
            ("generalized-alpha", {"method": "generalized-alpha"}),
        ],
    ],
)
def test_a_driver_does_the_work_of_the_spring_that_it_pulls(integrator, settings):
    """Accelerations are right in the first iterate, multipliers are not; all rates are linear over time."""
    result = symgen.load(mechanism_of(DRIVEN)).simulate(integrator=integrator, until=2.0, **settings)
    assert result.status == "ok"
    np.testing.assert_allclose(result["p.x"], 0.1 * result.t, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(result.work, 0.0, atol=1e-12)  # 2 J of the driver, -2 J of the spring
    np.testing.assert_allclose(result.energy_error, 0.0, atol=1e-12)


@pytest.mark.parametrize("k", [1e8, 1e10, 1e12])
@pytest.mark.parametrize("step", [1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize("integrator", ["radau5", "sdirk", "trapezoidal", "rodas"])
def test_an_iteration_ends_where_only_rounding_of_a_stiff_force_is_left(integrator, k, step):
    options = {} if integrator == "trapezoidal" else CONSTANT
    settings = {"integrator": integrator, "step": step, "until": 100 * step, "options": options}
    result = symgen.load(mechanism_of(FOLLOWER)).simulate(parameters={"k": k}, **settings)
    assert result.status == "ok" and result.steps == 100
    np.testing.assert_allclose(result["p.x"], 1.0 + k * np.sin(result.t) / (k - 1.0), rtol=0.0, atol=1e-7)


def with_states(rows):
    """Return a model with a state b that decays by its cube, between two that stay at their size, and some rows."""
    rest = {"rate": "0.0*t", "start": "size"}
    description = {
        "mechanism": {"name": f"decay{rows}"},
        "parameters": {"size": 0.0},
        "bodies": {"p": {"type": "point", "mass": 1.0}},
        "states": {"a": rest, "b": {"rate": "-b**3", "start": 10.0}, "c": rest},
    }
    if rows:
        lines = [{"position": f"p.{x}", "label": x} for x in "xy"[:rows]]
        description["joints"] = {"line": {"type": "rows", "rows": lines}}
    return symgen.load(mechanism_of(description))


@pytest.mark.fast("trapezoidal-0", "sdirk-2")
@pytest.mark.parametrize("rows", [0, 1, 2])
@pytest.mark.parametrize("integrator", ["radau5", "sdirk", "trapezoidal"])
def test_large_states_make_no_residual_of_another_one_rounding(integrator, rows):
    """Steps of 1 s are too long for an iteration on b' = -1000: it has to fail, whatever other states are."""
    model, options = with_states(rows), {} if integrator == "trapezoidal" else CONSTANT
    settings = {"integrator": integrator, "until": 2.0, "options": options}
    for step, status in ((1.0, "failed"), (1e-2, "ok")):
        small, *others = (
            model.simulate(parameters={"size": size}, step=step, **settings) for size in (0.0, 1.0, 1e9, 1e15, 1e20)
        )
        assert small.status == status
        for other in others:
            assert other.status == small.status
            np.testing.assert_array_equal(other["b"], small["b"])
