"""One kernel per kind of measure: value, row and quadratic velocity term, derived once and used for every occurrence.

For a measure s(q): s' = J v and s'' = J v' + b. The kernel gives s, the entries of J by body, and b. A velocity measure
u(q, v) = J v (nonholonomic rows) gives J and b of u' = J v' + b. The pattern of which slots share a body is part of
the kernel's key, so that a direction fixed in the body of a marker is differentiated together with it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from symgen.formulate.frames import FRAME_SLOTS, Frame, along_motion
from symgen.formulate.translate import Translator
from symgen.ir.graph import Graph


@dataclass(frozen=True)
class Kernel:
    """A derived measure: a small graph whose inputs are slots.

    Inputs are ``("slot", i)``: the frames' slots (`FRAME_SLOTS` each) come first, then the constants (`constants` of
    them: local points, directions, lengths). `row` holds, for each frame, the nodes of its velocity columns.
    """

    graph: Graph
    frames: tuple[Frame, ...]
    constants: int
    value: int
    row: tuple[tuple[int, ...], ...]
    bias: int

    @property
    def outputs(self) -> tuple[int, ...]:
        """All output nodes: value, row entries frame by frame, bias."""
        return (self.value, *(n for part in self.row for n in part), self.bias)


Constants = tuple[Any, ...]
_Build = Callable[[tuple[Frame, ...], Constants], Any]


def _component(f: tuple[Frame, ...], k: Constants) -> Any:
    a, b = f[0].locate((k[0], k[1])), f[1].locate((k[2], k[3]))
    e = f[2].rotate((k[4], k[5]))
    return e[0] * (b[0] - a[0]) + e[1] * (b[1] - a[1])


def _squared(f: tuple[Frame, ...], k: Constants) -> Any:
    a, b = f[0].locate((k[0], k[1])), f[1].locate((k[2], k[3]))
    return (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2


def _distance(f: tuple[Frame, ...], k: Constants) -> Any:
    return sp.sqrt(_squared(f, k))


def _link_stretch(f: tuple[Frame, ...], k: Constants) -> Any:
    return (_squared(f, k) - k[4] ** 2) / (2 * k[4])


def _point_speed(f: tuple[Frame, ...], k: Constants) -> Any:
    a = f[0].locate((k[0], k[1]))
    e = f[1].rotate((k[2], k[3]))
    return e[0] * along_motion(a[0], f[:1]) + e[1] * along_motion(a[1], f[:1])


#: Kind -> (expression of frames and constants, number of frames, number of constants, whether it is a velocity already)
_MEASURES: dict[str, tuple[_Build, int, int, bool]] = {
    "component": (_component, 3, 6, False),
    "distance": (_distance, 2, 4, False),
    "link-stretch": (_link_stretch, 2, 5, False),
    "point-speed": (_point_speed, 2, 4, True),
}


@cache
def derive(kind: str, frames: tuple[tuple[int, str], ...]) -> Kernel:
    """Derive the kernel of a measure.

    Parameters
    ----------
    kind : str
        ``component``, ``distance``, ``link-stretch`` or ``point-speed``.
    frames : tuple of (slot, kind)
        For each frame argument of the measure, which of the kernel's frames it is and what that frame is.
    """
    build, count, constants, is_rate = _MEASURES[kind]
    assert len(frames) == count, "the caller passes one frame for each of the measure's"
    unique = {slot: Frame(f"f{slot}", frame_kind) for slot, frame_kind in frames}
    ordered = tuple(unique[i] for i in sorted(unique))
    k = tuple(sp.Symbol(f"k{i}", real=True) for i in range(constants))
    value = build(tuple(unique[slot] for slot, _ in frames), k)
    rate = value if is_rate else along_motion(value, ordered)
    row = tuple(tuple(sp.diff(rate, v) for v in frame.velocities) for frame in ordered)
    bias = along_motion(rate, ordered)

    graph = Graph()
    symbols: dict[Any, int] = {}
    for i, frame in enumerate(ordered):
        for j, slot in enumerate(FRAME_SLOTS):
            symbols[frame.symbol(slot)] = graph.input("slot", i * len(FRAME_SLOTS) + j)
    for i, symbol in enumerate(k):
        symbols[symbol] = graph.input("slot", len(ordered) * len(FRAME_SLOTS) + i)
    flat = [value, *(e for part in row for e in part), bias]
    nodes = Translator(graph, symbols).all(flat)
    position = 1
    rows = []
    for frame in ordered:
        width = len(frame.velocities)
        rows.append(tuple(nodes[position : position + width]))
        position += width
    return Kernel(graph, ordered, constants, nodes[0], tuple(rows), nodes[-1])
