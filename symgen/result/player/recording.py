"""Data of a page: positions and columns over time, thinned out to fit, and packed."""

from __future__ import annotations

import base64
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.digits import clean, scale_of
from symgen.base.locales import local_text
from symgen.describe.drawing.scene import Array
from symgen.result.labelled import largest_magnitudes

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

#: Fewest and most frames of a page, and most samples of a further group, which is plotted and not played.
FEWEST, MOST, SAMPLES = 60, 1500, 300
#: Columns of one plot at most, and those of one unit that pages plot of one table.
LONGEST_KEY, MOST_OF_UNIT = 14, 112


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
    places : tuple of int
        Which coordinates of the recording they are; empty for other columns, which a page holds by themselves.
    further : bool
        Whether a page has them only where there is room.
    section : str
        Heading above them in a list of groups.
    scale : float
        Least scale of their numbers: what is nothing beside it is rounding.
    """

    title: str
    unit: str
    names: tuple[str, ...]
    values: Array
    logarithmic: bool = False
    places: tuple[int, ...] = ()
    further: bool = False
    section: str = "bodies"
    scale: float = 0.0


@dataclass(frozen=True)
class RecordedEvent:
    """An event of a run.

    Attributes
    ----------
    begin, end : float
        Its time span [s].
    kind, text : str
        Its kind, and a description.
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
        Settings and outcome of the run.
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
    moments : tuple of RecordedEvent
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
    moments: tuple[RecordedEvent, ...] = ()


def groups_by_unit(title: str, names: Sequence[str]) -> Iterator[tuple[str, slice]]:
    """Yield titles and columns of the groups for columns of one unit; titles of several name their first and last."""
    for i in range(0, min(len(names), MOST_OF_UNIT), LONGEST_KEY):
        some = slice(i, i + LONGEST_KEY)
        first, last = names[some][0].rpartition("."), names[some][-1].rpartition(".")
        yield title if len(names) <= LONGEST_KEY else f"{title}, {first[0]} to {last[0]}", some


def position_groups(mechanism: Mechanism, q: Array) -> list[PlottedGroup]:
    """Return positions and angles of bodies over time."""
    groups = []
    names = [(f"{b.name}.{c}", c) for b in mechanism.bodies for c in b.coordinates]
    for meaning, unit, axes in (("position", "m", ("x", "y", "z")), ("angle", "rad", ("theta",))):
        columns = [i for i, (_, c) in enumerate(names) if c in axes]
        for title, some in groups_by_unit(meaning, [names[i][0] for i in columns]):
            chosen = columns[some]
            own = tuple(names[i][0] for i in chosen)
            scale = scale_of(largest_magnitudes(q[:, columns]), unit)
            groups.append(PlottedGroup(title, unit, own, q[:, chosen], places=tuple(chosen), scale=scale))
    return groups


def is_coarse(recording: Recording, room: int, further: int = 0) -> bool:
    """Whether the coordinates of a page have 16 bits, between the smallest and the largest value, instead of 32.

    They do if `FEWEST` frames would otherwise take too many characters.

    Parameters
    ----------
    recording : Recording
        The motion.
    room : int
        Characters that all columns may take.
    further : int
        Columns of 16 bits beside those of the recording.
    """
    return FEWEST * _characters_of_frame(recording, False, further) > room


def _characters_of_frame(recording: Recording, coarse: bool, further: int) -> float:
    """Return the characters of a frame."""
    wide = sum(
        (4 if exact and not coarse else 2) * int(part.shape[1]) for part, exact in _columns_with_width(recording)
    )
    return (wide + 2 * further) * 4 / 3


def drop_further(recording: Recording) -> Recording:
    """Return a recording without its optional groups."""
    return replace(recording, groups=tuple(group for group in recording.groups if not group.further))


def fit_further(recording: Recording, frames: int, room: int) -> tuple[Recording, list[str]]:
    """Return a recording with the further groups that fit, and the titles of the others.

    Parameters
    ----------
    recording : Recording
        The motion.
    frames : int
        Number of outputs in the page.
    room : int
        Characters that further groups may take.
    """
    groups, missing = list[PlottedGroup](), list[str]()
    for group in recording.groups:
        taken = min(frames, SAMPLES) * 8 / 3 * group.values.shape[1] if group.further else 0.0
        if taken <= room:
            room -= int(taken)
            groups.append(group)
        else:
            missing.append(group.title)
    return replace(recording, groups=tuple(groups)), missing


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
    a_frame = _characters_of_frame(recording, coarse, further)
    count = int(min(max(room / max(a_frame, 1.0), FEWEST), MOST, len(recording.t)))
    return np.unique(np.linspace(0, len(recording.t) - 1, count).round().astype(int))


def _columns_with_width(recording: Recording) -> Iterator[tuple[Array, bool]]:
    """Yield all columns, with whether they keep 32 bits."""
    k = len(recording.t)
    yield recording.t.reshape(k, 1), True
    yield recording.q, True
    for group in recording.groups:
        if not group.places:
            yield group.values, False
    for further in (recording.reactions, recording.pulls):
        if further is not None:
            yield further.reshape(k, -1), False


def pack_recording(recording: Recording, keep: Array, coarse: bool = False) -> dict[str, Any]:
    """Return the part of a recording that a page reads; arrays are columns one after the other in base 64."""
    data: dict[str, Any] = {
        "t": encode_floats(recording.t[keep, None]),
        "q": encode_shorts(recording.q[keep]) if coarse else encode_floats(recording.q[keep]),
        "count": len(keep),
        "facts": [[label, local_text(text)] for label, text in recording.facts],
        "status": recording.status,
        "groups": [
            {
                "title": group.title,
                "unit": group.unit,
                "names": list(group.names),
                "log": group.logarithmic,
                "section": group.section,
                "scale": float(f"{group.scale:.7g}"),
                **({"places": list(group.places)} if group.places else _columns_to_plot(group, keep)),
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
            data[name] = {"names": list(owners), **encode_shorts(values[keep].reshape(len(keep), -1))}
    return data


def _columns_to_plot(group: PlottedGroup, keep: Array) -> dict[str, Any]:
    """Return the columns of a group; of a further one every so many frames, and the last."""
    every = -(-len(keep) // SAMPLES) if group.further else 1
    values = group.values[keep[np.minimum(np.arange(0, len(keep) + every - 1, every), len(keep) - 1)]]
    if group.logarithmic:
        values = np.log10(np.maximum(np.abs(values), 1e-17))
    else:
        values = clean(values, max(group.scale, scale_of(largest_magnitudes(group.values), group.unit)))
    return {"every": every, **encode_shorts(values)}


def encode_floats(values: Array) -> str:
    """Return columns as 32-bit numbers in base 64."""
    return base64.b64encode(np.ascontiguousarray(values.T, dtype="<f4").tobytes()).decode()


def encode_shorts(values: Array) -> dict[str, Any]:
    """Return columns as 16-bit numbers in base 64, each between its smallest and largest value."""
    whole = len(values) > 0 and bool(np.isfinite(values).all())
    low, high = (values.min(axis=0), values.max(axis=0)) if whole else _finite_ends(values)
    span = np.where(high > low, high - low, 1.0)
    if whole:
        scaled = np.round((values - low) / span * 65534.0)
    else:
        scaled = np.where(np.isfinite(values), np.round((np.nan_to_num(values) - low) / span * 65534.0), 65535.0)
    data = base64.b64encode(np.ascontiguousarray(scaled.T, dtype="<u2").tobytes()).decode()
    return {"low": _round_values(low), "span": _round_values(span), "data": data}


def _finite_ends(values: Array) -> tuple[Array, Array]:
    """Return the smallest and the largest finite value of each column, 0 where it has none."""
    if not len(values):
        return np.zeros(values.shape[1]), np.zeros(values.shape[1])
    finite = np.where(np.isfinite(values), values, np.nan)
    with np.errstate(all="ignore"):
        return np.nan_to_num(np.nanmin(finite, axis=0)), np.nan_to_num(np.nanmax(finite, axis=0))


def _round_values(values: Sequence[float] | Array) -> list[float]:
    return [float(f"{x:.7g}") for x in values]
