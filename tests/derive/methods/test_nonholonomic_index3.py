"""ALI3-P on rows without Phi: the steady turn of a rolling disc in closed form, of order 2, and a knife edge."""

import math

import numpy as np
import pytest
from support.convergence import orders

from symgen.api import load
from symgen.describe import MechanismBuilder

RADIUS, CIRCLE, LEAN = 0.3, 1.0, math.pi / 9
RATE = math.sqrt(9.81 * math.tan(LEAN) / (RADIUS * math.sin(LEAN) / 4 + 1.5 * CIRCLE))
KEYS = {"method": "index3-augmented-lagrangian", "max_violation": 1e-9}


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("keys1", "keys0", "keys2")
@pytest.mark.parametrize("keys", [{}, {"shape": "looped"}, {"coordinates": "joint"}])
def test_steady_turn_of_a_rolling_disc(keys):
    """The centre goes round evenly; friction turns it with m rate^2 R."""
    errors, until = [], 0.5
    for h in (4e-3, 2e-3, 1e-3):
        result = load("rolling-disc").simulate(step=h, until=until, times=[until], **KEYS, **keys)
        assert result.status == "ok", result.reason
        assert result.position_violation_max < 1e-12 and result.velocity_violation_max < 1e-12
        centre = CIRCLE * np.array([math.cos(RATE * until), math.sin(RATE * until), RADIUS * math.cos(LEAN)])
        errors.append(max(abs(result[f"disc.{axis}"][-1] - x) for axis, x in zip("xyz", centre, strict=True)))
        slip = math.hypot(*(result[f"multiplier.contact.slip{i}"][-1] for i in (1, 2)))
        assert slip == pytest.approx(2.0 * RATE**2 * CIRCLE, rel=1e-3)
    np.testing.assert_allclose(orders(errors), 2.0, atol=0.1)


def test_a_knife_edge_on_a_slope_goes_along_a_cycloid():
    """From rest with spin w: x = g sin^2(w t) / (2 w^2), y = g (w t - sin(2 w t) / 2) / (2 w^2)."""
    w, g, until = 2.0, 3.0, 1.0
    builder = MechanismBuilder("sleigh", gravity=(g, 0.0))
    builder.body(
        "sleigh", mass=1.3, inertia=0.2, position=(0.0, 0.0), angle=0.0, angular_velocity=w, velocity=(0.0, 0.0)
    )
    builder.joint("blade", "knife-edge", body="sleigh", at=(0.0, 0.0), axis=(1.0, 0.0))
    result = load(builder.build()).simulate(step=1e-3, until=until, times=[until], **KEYS)
    assert result.status == "ok", result.reason
    x = g * math.sin(w * until) ** 2 / (2.0 * w**2)
    y = g * (w * until - math.sin(2.0 * w * until) / 2.0) / (2.0 * w**2)
    assert result["sleigh.x"][-1] == pytest.approx(x, abs=2e-6)
    assert result["sleigh.y"][-1] == pytest.approx(y, abs=2e-6)
