"""What is worked out of a mechanism once: for each mechanism its own, and nothing is kept of one that is gone."""

import gc
import weakref

import msgspec

from symgen.api import load
from symgen.describe.remembered import compute_once


def test_once_for_each_mechanism_for_as_long_as_it_is_there():
    asked = []

    @compute_once
    def name(mechanism):
        asked.append(mechanism.name)
        return mechanism.name

    first = load("pendulum").mechanism
    again = msgspec.structs.replace(first)  # equal, but another one
    assert [name(first), name(first), name(again), name(first)] == ["pendulum"] * 4
    assert len(asked) == 2
    gone = weakref.ref(again)
    del again
    gc.collect()
    assert gone() is None
    for _ in range(50):  # one of these may stand where the other stood
        other = msgspec.structs.replace(first, name="other")
        assert name(other) == "other"
        del other
