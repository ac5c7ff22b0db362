"""What events have found of rows with bounds, compiled: which have broken loose, come to rest, or lost their force."""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.modes.bounded_rows import STILL, row_scale
from symgen.run.modes.row_records import Choice


@exact(entry=True)
def forget_found(c: Choice, begins: bool) -> None:
    """Forget which rows events have found, where a run `begins`, or at other events."""
    for i in range(c.rows.count):
        c.found.broken[i] = c.found.stopped[i] = c.found.left[i] = 0
    c.found.begins[0] = 1 if begins else 0


def find_rows(c: Choice, breaks: int, stops: int, leaves: int) -> None:
    """Keep the rows that an event has found, -1 for none: that break loose, come to rest, and lose their force."""
    if breaks >= 0:
        c.found.broken[breaks] = 1
    if stops >= 0:
        c.found.stopped[stops] = 1
    if leaves >= 0:
        c.found.left[leaves] = 1


@exact()
def find_alike(c: Choice, i: int, goes_on: bool) -> None:
    """Let the row after one have found what that one has, neither of them rest where slip goes on."""
    if goes_on:
        c.found.stopped[i] = 0
    c.found.broken[i + 1], c.found.stopped[i + 1] = c.found.broken[i], c.found.stopped[i]


@exact(entry=True)
def allow_depth(c: Choice, depth: float) -> None:
    """Set the largest depth of open gaps below zero, over the mechanism's length."""
    c.found.depth[0] = depth


def keep_breaking(c: Choice, i: int, t: float) -> None:
    """Keep when and where a coordinate breaks loose."""
    c.found.let_go[i], c.found.place[i] = t, c.read.value[i]


def forget_breaking(c: Choice) -> None:
    """Forget which coordinates have broken loose in the run before."""
    for i in range(c.rows.count):
        c.found.let_go[i] = math.nan


@exact(entry=True)
def forget_passed(c: Choice, w: Array) -> int:
    """Forget which coordinates an event has found at rest where the impact at its time has set them in motion."""
    for i in range(c.rows.dry):
        if abs(c.read.speed[i]) > STILL * row_scale(c, w, i, abi.SPEED):
            c.found.broken[i] = c.found.stopped[i] = 0
    return int(c.rows.dry)
