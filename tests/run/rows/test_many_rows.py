"""Rows of a large sweep with resets: the times of their events are those of single runs.

They have equal bits, except where a velocity of the start varies: it is closed in another order.
"""

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.describe.catalogue import raw

G, E = 9.81, 0.8


def bouncing_ball():
    """A ball that bounces and counts its impacts in a state of its own."""
    return symgen.load(
        mechanism_of(
            {
                "mechanism": {"name": "ball", "gravity": [0.0, -G]},
                "run": {"until": 2.0, "step": 1e-2},
                "parameters": {"height": 1.0},
                "bodies": {"ball": {"type": "point", "mass": 1.3, "position": [0.0, "height"]}},
                "states": {"hits": {"rate": "0", "start": 0.0}},
                "events": {"impact": {"when": "ball.y < 0", "reset": {"ball.vy": f"-{E}*ball.vy", "hits": "hits + 1"}}},
            }
        )
    )


def struck_four_bar():
    """A four-bar whose crank loses a part of its speed at an angle."""
    description = raw("four-bar")
    description["events"] = {"stroke": {"when": "crank.theta > 1.1", "reset": {"crank.omega": "-0.5*crank.omega"}}}
    return symgen.load(mechanism_of(description))


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("model", "event", "varied", "values", "most", "settings"),
    [
        (bouncing_ball, "impact", "height", (0.5, 1.5), 0.0, {"integrator": "rk4", "step": 1e-2, "until": 2.0}),
        (
            struck_four_bar,
            "stroke",
            "crank.omega",
            (1.0, 3.0),
            1e-12,
            {"integrator": "rk4", "step": 1e-3, "until": 1.0},
        ),
        (struck_four_bar, "stroke", "crank.omega", (1.0, 3.0), 1e-12, {"integrator": "dop853", "until": 1.0}),
    ],
    ids=["ball", "four-bar", "four-bar-dop853"],
)
def test_events_of_rows_have_the_times_of_single_runs(model, event, varied, values, most, settings):
    model, numbers = model(), np.linspace(*values, 200)
    rows = symgen.sweep(model, {varied: numbers}, quantities=("q", "v", "event"), **settings)
    assert set(rows.status) == {"ok"}
    where = "parameters" if varied == "height" else "start"
    for i in range(0, 200, 40):
        one = model.simulate(**{where: {varied: float(numbers[i])}}, **settings)
        times = [x.t for x in one.events if x.name == event]
        assert rows[f"event.{event}.count"][i] == len(times) > 0
        found = rows[f"event.{event}.first"][i], rows[f"event.{event}.last"][i]
        np.testing.assert_allclose(found, (times[0], times[-1]), rtol=most, atol=0.0)
    if varied == "height":  # closed form of the first impacts
        np.testing.assert_allclose(rows["event.impact.first"], np.sqrt(2.0 * numbers / G), rtol=0.0, atol=1e-9)
