"""Memory of impacts of contacts, from which follows what those change that are left out where impacts accumulate."""

from __future__ import annotations

from typing import Any

import numpy as np

from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.layout import abi

#: Impacts that are remembered of each contact, and what precedes the rates of rows: time, and rate of the gap.
REMEMBERED, AT, RATE, HEAD = 2, 0, 1, 2


class ImpactMemory(Record):
    """The latest impacts of each contact, and working memory; empty without contacts.

    Attributes
    ----------
    impacts : Array, shape (REMEMBERED (HEAD + k) k,)
        For each row its impacts, the latest one first: time [s], rate of the gap after it, rates of all k rows.
    modes : Array of int64, shape (k,)
        Modes of the latest impact, kept while rest is tried.
    groups : Array of int64, shape (k,)
        At the latest impact, the part of G that each row belongs to, -1 for rows that do not touch.
    leads : Array of int64, shape (k,)
        The contact of whose series each row takes part, else -1.
    closes : Array of int64, shape (k,)
        1 for gaps that the latest impact does not push, and that end closed with its series.
    rates, rested, rests, first : Array, shapes (k,)
        Rates of rows after the latest impact; where rest is tried, rates and accelerations; those of the first trial.
    pins : Array of int64, shape (k,)
        Modes of friction by reactions at the latest impact.
    spent : Array, shape (2,)
        Work of the impulses of an impact, and of their sizes [J].
    kicked : Array, shape (k,)
        By Poisson's law, what follows from compression: impulses of gaps, and of sliding friction by them. Of friction
        by reactions, what rest lacks of its bound at the end of a series.
    compressed : Array
        Impulses of compression.
    y, w, control : Array, Array of int64
        State and scratch, kept while rest is tried.
    """

    impacts: Array
    modes: Integers
    groups: Integers
    leads: Integers
    closes: Integers
    pins: Integers
    spent: Array
    kicked: Array
    compressed: Array
    rates: Array
    rested: Array
    rests: Array
    first: Array
    y: Array
    w: Array
    control: Integers


def new_impact_memory(k: int, width: int, nw: int, impulses: int) -> Any:
    """Return an empty memory for k rows, states and scratches of `width` and `nw` numbers, and some `impulses`."""
    numbers, control = np.zeros, np.zeros(abi.N_CONTROL if k else 0, dtype=np.int64)
    impacts, groups, leads = numbers(REMEMBERED * (HEAD + k) * k), np.full(k, -1), np.full(k, -1)
    modes, closes, pins = (np.zeros(k, dtype=np.int64) for _ in range(3))
    rates = numbers(k), numbers(k), numbers(k), numbers(k)
    return ImpactMemory(
        *(impacts, modes, groups, leads, closes, pins, numbers(2), numbers(k), numbers(impulses)),
        *(*rates, numbers(width), numbers(nw), control),
    )
