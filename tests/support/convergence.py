"""Errors of runs with constant steps beside a fine run of another method, and the orders that they show."""

import numpy as np

from support.emitted import mechanism_of
from support.models import parallelogram
from symgen.api import load

STEPS = (4e-3, 2e-3, 1e-3)
#: In the plane, in space and rolling, in joint coordinates and as looped code: name, end [s], settings.
MOTIONS = [
    ("four-bar", 2.0, {}),
    ("four-bar", 2.0, {"coordinates": "joint"}),
    ("spatial-slider-crank", 0.5, {}),
    ("spatial-slider-crank", 0.5, {"coordinates": "joint"}),
    ("rolling-disc", 0.5, {}),
    ("four-bar", 2.0, {"shape": "looped"}),
]


def compared(model, until, steps=STEPS, **settings):
    """Results of runs with constant steps, and their errors of q at the end."""
    exact = model.simulate(method="direct-correction", rtol=1e-12, atol=1e-12, until=until, times=[until])
    results = [model.simulate(step=h, until=until, times=[until], **settings) for h in steps]
    for result in results:
        assert result.status == "ok", result.reason
    return results, [np.abs(np.asarray(result.q) - np.asarray(exact.q)).max() for result in results]


def orders(errors):
    """Orders between steps that are halved."""
    return np.log2(np.divide(errors[:-1], errors[1:]))


def redundant(method):
    """A run of a parallelogram with a coupler more than it needs, and its error."""
    (result,), (error,) = compared(load(mechanism_of(parallelogram())), 0.5, (1e-3,), method=method)
    assert result.rank.rank < result.rank.rows
    return result, error
