"""Sizes and ranks of the spatial entries at their starts, by emitted functions run as plain Python."""

import numpy as np
import pytest
from support.emitted import Emitted

from symgen.describe.files.load import load_mechanism
from symgen.describe.formulas.evaluate import scalar_values
from symgen.describe.formulas.start import described_start

#: Entry -> bodies, coordinates, velocities, rows, rank.
SIZES = {
    "bricard": (5, 35, 30, 30, 29),
    "chain:4": (4, 28, 24, 18, 18),
    "flyball-governor": (4, 28, 24, 20, 20),
    "free-rigid-body": (1, 7, 6, 0, 0),
    "front-suspension": (7, 49, 42, 39, 39),
    "heavy-top": (1, 7, 6, 3, 3),
    "rolling-disc": (1, 7, 6, 3, 3),
    "spatial-slider-crank": (3, 21, 18, 17, 17),
    "spherical-double-pendulum": (2, 14, 12, 6, 6),
    "stewart-platform": (13, 91, 78, 78, 78),
}


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("stewart-platform", "front-suspension", "bricard")
@pytest.mark.parametrize("name", SIZES)
def test_sizes_and_ranks(name):
    mechanism = load_mechanism(name)
    assert mechanism.name.startswith(name.partition(":")[0])
    emitted = Emitted(mechanism)
    values = {p.name: p.value for p in mechanism.parameters}
    q = np.array(described_start(mechanism, scalar_values(values))[0])
    found = emitted.at(0.0, q, np.zeros(emitted.info.nv), emitted.parameters(values), law=False)
    values = np.linalg.svd(found.d, compute_uv=False) if len(found.d) else np.zeros(0)
    rank = int(np.sum(values > 1e-9))
    sizes = (len(mechanism.bodies), emitted.info.nq, emitted.info.nv, emitted.info.m, rank)
    assert sizes == SIZES[name]
    assert np.abs(found.phi).max(initial=0.0) < 2e-15, "the description closes all joints"
    assert values[rank - 1] > 0.01 if rank else True
