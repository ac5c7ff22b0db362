"""What a page plays: positions and columns over time, thinned out until they fit, and packed."""

from __future__ import annotations

import base64
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.drawing.scene import Array

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

#: Fewest and most frames of a page.
FEWEST, MOST = 60, 1500
#: Columns of one plot at most.
LONGEST_KEY = 14


@dataclass(frozen=True)
class PlottedGroup:
    """Columns of one unit that are plotted together, shape (k, n).

    Attributes
    ----------
    title, unit : str
        What they are.
    names : tuple of str
        Of the columns.
    values : Array, shape (k, n)
        One row an output.
    logarithmic : bool
        Whether they are plotted so.
    """

    title: str
    unit: str
    names: tuple[str, ...]
    values: Array
    logarithmic: bool = False


@dataclass(frozen=True)
class Moment:
    """Something that happened.

    Attributes
    ----------
    begin, end : float
        From when to when [s].
    kind, text : str
        Of which kind, and in words.
    """

    begin: float
    end: float
    kind: str
    text: str


@dataclass(frozen=True)
class Recording:
    """A motion as a page plays it.

    Attributes
    ----------
    mechanism : Mechanism
        What moves.
    values : mapping
        Its parameters.
    t : Array, shape (k,)
        Outputs [s].
    q : Array, shape (k, nq)
        Coordinates of all bodies.
    facts : tuple of (str, str)
        What was run, and how it went.
    status : str
        Of the run.
    groups : tuple of PlottedGroup
        What can be plotted.
    reactions : Array, shape (k, n, d)
        Force of each joint of `pushed` on its first body, ground axes [N].
    pushed : tuple of str
        Joints.
    pulls : Array, shape (k, n)
        Force of each force element of `pulling` that pushes its ends apart [N].
    pulling : tuple of str
        Force elements.
    moments : tuple of Moment
        Rank events and others.
    """

    mechanism: Mechanism
    values: dict[str, float]
    t: Array
    q: Array
    facts: tuple[tuple[str, str], ...] = ()
    status: str = "ok"
    groups: tuple[PlottedGroup, ...] = ()
    reactions: Array | None = None
    pushed: tuple[str, ...] = ()
    pulls: Array | None = None
    pulling: tuple[str, ...] = ()
    moments: tuple[Moment, ...] = ()


def position_groups(mechanism: Mechanism, q: Array) -> list[PlottedGroup]:
    """Return positions and angles of the first bodies over time."""
    groups = []
    names = [(f"{b.name}.{c}", c) for b in mechanism.bodies for c in b.coordinates]
    for title, unit, wanted in (("position", "m", ("x", "y", "z")), ("angle", "rad", ("theta",))):
        chosen = [i for i, (_, c) in enumerate(names) if c in wanted][:LONGEST_KEY]
        if chosen:
            groups.append(PlottedGroup(title, unit, tuple(names[i][0] for i in chosen), q[:, chosen]))
    return groups


def fitted(recording: Recording, room: int, further: int = 0) -> tuple[Recording, bool]:
    """Return the part of a recording that a page holds, and whether its coordinates have 16 bits.

    Where `FEWEST` frames are too many characters, coordinates have 16 bits instead of 32 between the smallest and the
    largest value, and where that is not enough, forces are left out.

    Parameters
    ----------
    recording : Recording
        The motion.
    room : int
        Characters that all columns may take.
    further : int
        Columns of 16 bits beside those of the recording.
    """
    for candidate, coarse in ((recording, False), (recording, True)):
        if FEWEST * _characters(candidate, coarse, further) <= room:
            return candidate, coarse
    return replace(recording, reactions=None, pushed=(), pulls=None, pulling=()), True


def _characters(recording: Recording, coarse: bool, further: int) -> float:
    """Return the characters of a frame."""
    wide = sum((4 if exact and not coarse else 2) * int(part.shape[1]) for part, exact in _parts(recording))
    return (wide + 2 * further) * 4 / 3


def frames_within(recording: Recording, room: int, coarse: bool = False, further: int = 0) -> Array:
    """Return the indices of outputs that a page holds, evenly spread, as many as fit into a number of characters.

    Parameters
    ----------
    recording : Recording
        The motion.
    room : int
        Characters that all columns may take; at least `FEWEST` frames are taken in any case.
    coarse : bool
        Whether coordinates have 16 bits.
    further : int
        Columns of 16 bits beside those of the recording.
    """
    a_frame = _characters(recording, coarse, further)
    count = int(min(max(room / max(a_frame, 1.0), FEWEST), MOST, len(recording.t)))
    return np.unique(np.linspace(0, len(recording.t) - 1, count).round().astype(int))


def _parts(recording: Recording) -> Iterator[tuple[Array, bool]]:
    """Yield all columns, with whether they keep 32 bits."""
    k = len(recording.t)
    yield recording.t.reshape(k, 1), True
    yield recording.q, True
    for group in recording.groups:
        yield group.values, False
    for further in (recording.reactions, recording.pulls):
        if further is not None:
            yield further.reshape(k, -1), False


def packed(recording: Recording, keep: Array, coarse: bool = False) -> dict[str, Any]:
    """Return the part of a recording that a page reads; arrays are columns behind each other in base 64."""
    data: dict[str, Any] = {
        "t": floats(recording.t[keep, None]),
        "q": shorts(recording.q[keep]) if coarse else floats(recording.q[keep]),
        "count": len(keep),
        "facts": [list(fact) for fact in recording.facts],
        "status": recording.status,
        "groups": [
            {
                "title": group.title,
                "unit": group.unit,
                "names": list(group.names),
                "log": group.logarithmic,
                **shorts(
                    np.log10(np.maximum(np.abs(group.values[keep]), 1e-17)) if group.logarithmic else group.values[keep]
                ),
            }
            for group in recording.groups
        ],
        "moments": [[m.begin, m.end, m.kind, m.text] for m in recording.moments],
    }
    for name, values, owners in (
        ("reactions", recording.reactions, recording.pushed),
        ("pulls", recording.pulls, recording.pulling),
    ):
        if values is not None and len(owners):
            data[name] = {"names": list(owners), **shorts(values[keep].reshape(len(keep), -1))}
    return data


def floats(values: Array) -> str:
    """Return columns as 32-bit numbers in base 64."""
    return base64.b64encode(np.ascontiguousarray(values.T, dtype="<f4").tobytes()).decode()


def shorts(values: Array) -> dict[str, Any]:
    """Return columns as 16-bit numbers in base 64, each between its smallest and largest value."""
    finite = np.where(np.isfinite(values), values, np.nan)
    with np.errstate(all="ignore"):
        low = np.nan_to_num(np.nanmin(finite, axis=0)) if len(values) else np.zeros(values.shape[1])
        high = np.nan_to_num(np.nanmax(finite, axis=0)) if len(values) else np.zeros(values.shape[1])
    span = np.where(high > low, high - low, 1.0)
    scaled = np.where(np.isfinite(values), np.round((np.nan_to_num(values) - low) / span * 65534.0), 65535.0)
    data = base64.b64encode(np.ascontiguousarray(scaled.T, dtype="<u2").tobytes()).decode()
    return {"low": _digits(low), "span": _digits(span), "data": data}


def _digits(values: Sequence[float] | Array) -> list[float]:
    return [float(f"{x:.7g}") for x in values]
