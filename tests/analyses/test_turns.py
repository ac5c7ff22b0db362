"""Analyses of angles that count turns: both shapes of code remember the same angle, in orders of their own."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from analyses import rods
from symgen.analyses.subject import subject_of
from symgen.settings import Settings

#: Of the spring on the second hinge [N m/rad].
STIFFNESS = 3.0


def hinged():
    """Two discs on hinges of their own along z, of which the second is held by a torsion spring; no gravity.

    The first one's angle is reported and used by nothing.
    """
    disc = {"mass": 1.0, "inertia": [0.1, 0.1, 0.2]}
    hinge = {"axis": [0.0, 0.0, 1.0]}
    return rods.model(
        {"first": disc, "second": disc},
        {
            "A": rods.pin("ground", "first", rods.GROUND3, "centre", **hinge),
            "B": rods.pin("ground", "second", rods.GROUND3, "centre", **hinge),
        },
        "spatial",
        gravity=[0.0, 0.0, 0.0],
        forces={"spring": {"type": "torsional-spring-damper", "joint": "B", "stiffness": STIFFNESS}},
    )


@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize("turned", [0.4, 5.0, -7.5])
def test_what_a_wound_spring_exerts(shape, turned):
    """The balance at the start is what the spring exerts, k times an angle beyond half a turn."""
    model = hinged()
    subject = subject_of(model.mechanism, Settings(shape=shape, start={"B.angle": turned}))
    found = subject.form.at(0.0, subject.y, np.zeros(12), subject.p, subject.w)
    assert abs(turned) < math.pi or subject.compiled.info.windings == 2
    assert_allclose(found.value("balance")[-1], STIFFNESS * turned, rtol=1e-12)
