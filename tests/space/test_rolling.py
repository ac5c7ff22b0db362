"""Rolling without slip: a closed form, and rows that have a velocity but no position."""

import math

import numpy as np
import pytest
from support.spatial_runs import centre, energy, run, spin, turned

import symgen

RADIUS, CIRCLE, LEAN = 0.3, 1.0, math.pi / 9


def test_steady_rolling_on_a_circle():
    """The centre goes round evenly and the disc keeps its lean: the balance of moments, as the file states it."""
    model, result = run("rolling-disc", rtol=1e-12)
    assert result.status == "ok", result.reason
    rate = math.sqrt(9.81 * math.tan(LEAN) / (RADIUS * math.sin(LEAN) / 4 + 1.5 * CIRCLE))
    angle = rate * result.t
    path = np.column_stack([CIRCLE * np.cos(angle), CIRCLE * np.sin(angle), np.full_like(angle, RADIUS * np.cos(LEAN))])
    np.testing.assert_allclose(centre(result, "disc"), path, atol=1e-10)
    axis = turned(result, "disc").apply([0.0, 0.0, 1.0])
    leaning = np.cos(LEAN) * path / np.linalg.norm(path[:, :2], axis=1, keepdims=True)
    leaning[:, 2] = np.sin(LEAN)
    np.testing.assert_allclose(axis, leaning, atol=1e-10)
    np.testing.assert_allclose(spin(result, "disc")[:, 2], -rate * CIRCLE / RADIUS, atol=1e-9)
    # friction holds the disc on the circle, and the plane carries its weight
    force = np.column_stack([result[f"multiplier.contact.{row}"] for row in ("normal", "slip1", "slip2")])
    np.testing.assert_allclose(force[:, 0], 2.0 * 9.81, rtol=1e-9)
    np.testing.assert_allclose(np.hypot(force[:, 1], force[:, 2]), 2.0 * rate**2 * CIRCLE, rtol=1e-9)
    drift = energy(result, model.mechanism)
    np.testing.assert_allclose(drift, drift[0], rtol=1e-11)


def test_nonholonomic_rows_have_no_position():
    """A disc elsewhere on the plane is where it should be; one above the plane is put on it."""
    model = symgen.load("rolling-disc")
    compiled = model.compile("direct-correction")
    assert [row.name for row in compiled.info.rows if not row.holonomic] == ["contact.slip1", "contact.slip2"]
    start = model.assemble(compiled)
    y, p, w, iw = (a.copy() for a in (start.y, start.p, start.w, np.zeros(32, dtype=np.int64)))
    elsewhere = y.copy()
    elsewhere[:2] += 0.3, -0.2
    expected = elsewhere.copy()
    assert compiled.law_module.accept(0.0, elsewhere, p, w, iw) & 1 == 0
    np.testing.assert_allclose(elsewhere[:7], expected[:7], atol=1e-15)

    above = y.copy()
    above[2] += 1e-3
    assert compiled.law_module.accept(0.0, above, p, w, iw) & 1 == 0
    e0, e1, e2, e3 = above[3:7]
    axis_z = e0**2 - e1**2 - e2**2 + e3**2
    assert above[2] - RADIUS * math.sqrt(1.0 - axis_z**2) == pytest.approx(0.0, abs=1e-12)
    assert above[2] < y[2] + 1e-3
    assert np.abs(above[:2] - y[:2]).max() < 1e-3


@pytest.mark.slow_cases("coordinate-partitioning")
@pytest.mark.parametrize("method", ["lagrange", "coordinate-partitioning"])
def test_rolling_by_other_methods(method):
    _, result = run("rolling-disc", method, rtol=1e-12, until=3.0)
    assert result.status in ("ok", "unverified"), result.reason
    radius = np.linalg.norm(centre(result, "disc")[:, :2], axis=1)
    np.testing.assert_allclose(radius, CIRCLE, atol=1e-9)
