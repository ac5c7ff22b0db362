"""The line of an unloaded beam: straight, an arc, or straight segments that are joined rigidly."""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass

from symgen.base.vocabulary.expressions import (
    ZERO,
    Expr,
    call,
    difference,
    literal_of,
    product,
    scalar_product_of,
    sum_of_terms,
)
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.beams.beam_sections import BeamSection
from symgen.describe.mechanism import Vec
from symgen.describe.parts.fields import value_in_words
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import triad_from_directions

#: Maximum number of elements of a beam: `check` takes some seconds, and four times that of twice as many.
MOST_ELEMENTS = 250
#: Weights of few nodes: trapezoid, Simpson, 3/8, Boole; and those at the ends of many nodes.
_FEW = {1: (0.5,), 2: (1 / 3, 4 / 3), 3: (3 / 8, 9 / 8), 4: (14 / 45, 64 / 45, 24 / 45)}
_MANY = (3 / 8, 7 / 6, 23 / 24)


def node_weights(elements: int) -> list[float]:
    """Return the weights of the nodes of a segment in lengths of its elements, all above 0."""
    ends = _FEW.get(elements, _MANY)
    return [(*ends, 1.0)[min(k, elements - k, len(ends))] for k in range(elements + 1)]


@dataclass(frozen=True)
class CrossSection:
    """A cross section of the unloaded beam.

    Attributes
    ----------
    place, axes, angle : Vec, tuple of Vec, Expr
        Its place, its axes, and in the plane its angle.
    sides : pair of Vec
        Directions along its x axis and on the side of y: shorter formulas than the axes, which follow from them.
    part, share : float, Expr
        The part of the beam's length before it, and the length of beam whose mass it has.
    """

    place: Vec
    axes: tuple[Vec, ...]
    angle: Expr
    sides: tuple[Vec, Vec]
    part: float
    share: Expr


@dataclass(frozen=True)
class Segment:
    """A straight line or an arc from `start` in the plane of two axes, and the number of its elements.

    `between` leads from its start to its end, `side` is on the side of the second axis in space, `axes` begin with the
    direction of `between`, `bend` is the angle [rad] by which the line turns towards the second one.
    """

    start: Vec
    between: Vec
    side: Vec
    axes: tuple[Vec, ...]
    bend: Expr
    elements: int

    @property
    def chord(self) -> Expr:
        """The distance of its ends."""
        return call("sqrt", scalar_product_of(self.between, self.between))

    @property
    def length(self) -> Expr:
        """The length of the line."""
        if self.bend == ZERO:
            return self.chord
        half = product(literal_of(0.5), self.bend)
        return product(self.chord, call("div", half, call("sin", half)))

    @property
    def step(self) -> Expr:
        """The length of an element."""
        return call("div", self.length, literal_of(self.elements))

    @property
    def curvature(self) -> Expr:
        """The curvature towards the second axis."""
        return ZERO if self.bend == ZERO else call("div", self.bend, self.length)

    def section_pose(self, k: int) -> tuple[Vec, tuple[Vec, ...], Expr, tuple[Vec, Vec]]:
        """Return place, axes, angle and sides of the cross section after `k` elements."""
        part, (first, second) = literal_of(k / self.elements), self.axes[:2]
        reach: Expr = product(part, self.chord)
        across: Expr = ZERO
        turn: Expr = ZERO
        if self.bend != ZERO:
            half = product(literal_of(0.5), self.bend)
            along = product(part, half)
            far = product(self.chord, call("div", call("sin", along), call("sin", half)))
            lean, turn = difference(along, half), difference(product(literal_of(2.0), along), half)
            reach, across = product(far, call("cos", lean)), product(far, call("sin", lean))
        place = tuple(
            sum_of_terms(s, product(reach, a), product(across, b))
            for s, a, b in zip(self.start, first, second, strict=True)
        )
        cosine, sine = call("cos", turn), call("sin", turn)
        x = tuple(sum_of_terms(product(cosine, a), product(sine, b)) for a, b in zip(first, second, strict=True))
        y = tuple(difference(product(cosine, b), product(sine, a)) for a, b in zip(first, second, strict=True))
        sides = (self.between, self.side) if self.bend == ZERO else (x, y)
        return place, (x, y, *self.axes[2:]), sum_of_terms(call("atan2", first[1], first[0]), turn), sides


def beam_segments(scope: Scope, beam: BeamSection) -> list[Segment]:
    """Return the segments of a beam's line from its start to its end.

    Raises
    ------
    InputError
        If points, arc, axis of the section or number of elements are wrong.
    """
    points, bend = _beam_vertices(scope, beam), ZERO if beam.arc is None else scope.constant("arc", beam.arc)
    if not abs(scope.value(bend, "arc")) < 6.28:
        raise scope.error("arc", "less than a turn [rad]", value_in_words(beam.arc))
    sides, lines, lengths = (
        _section_sides(scope, beam, len(points) - 1),
        list[tuple[Vec, Vec, Vec, tuple[Vec, ...]]](),
        [],
    )
    for (_, start), (key, point), side in zip(points, points[1:], sides, strict=False):
        between = tuple(map(difference, point, start))
        chord = call("sqrt", scalar_product_of(between, between))
        lengths.append(scope.value(chord, key))
        if not lengths[-1] > 0.0:
            raise scope.error(key, f"another point than {'start' if key == 'end' else 'the one before'}", "the same")
        along = tuple(e if e == ZERO else call("div", e, chord) for e in between)
        axes = (
            triad_from_directions(scope, "y_axis", along, side)
            if scope.spatial
            else (along, (call("neg", along[1]), along[0]))
        )
        lines.append((start, between, side, axes))
    counts = _elements_of_segments(scope, beam.elements, lengths)
    return [Segment(*line, bend, count) for line, count in zip(lines, counts, strict=True)]


def cross_sections(scope: Scope, line: list[Segment]) -> list[list[CrossSection]]:
    """Return the cross sections at each node of a line: two at a vertex, the end and the start of segments."""
    lengths = [scope.value(segment.length, "elements") for segment in line]
    nodes, before, whole = list[list[CrossSection]]([[]]), 0.0, math.fsum(lengths)
    for segment, length in zip(line, lengths, strict=True):
        step = segment.step
        for k, weight in enumerate(node_weights(segment.elements)):
            if k > 0:
                nodes.append([])
            part = (before + length * k / segment.elements) / whole
            nodes[-1].append(CrossSection(*segment.section_pose(k), part, product(literal_of(weight), step)))
        before += length
    return nodes


def _beam_vertices(scope: Scope, beam: BeamSection) -> list[tuple[str, Vec]]:
    """Return the vertices of a beam's line, its ends among them, each with its key."""
    ends = {"start": beam.start, "end": beam.end}
    if beam.line is None:
        for key, point in ends.items():
            if point is None:
                raise scope.error(key, "a point, as a beam without the key line has a start and an end", "no such key")
        return [(key, scope.vector(key, point)) for key, point in ends.items() if point is not None]
    for key, value in {**ends, "arc": beam.arc}.items():
        if value is not None:
            raise scope.error(key, "no such key beside the key line", value_in_words(value))
    return [(f"line[{i}]", scope.vector(f"line[{i}]", point)) for i, point in enumerate(beam.line)]


def _section_sides(scope: Scope, beam: BeamSection, count: int) -> list[Vec]:
    """Return a direction on the side of y of each segment's section; none in the plane."""
    if not scope.spatial:
        if beam.y_axis is not None:
            raise scope.error("y_axis", "no such key in the plane", value_in_words(beam.y_axis))
        return [()] * count
    written = (0.0, 1.0, 0.0) if beam.y_axis is None else beam.y_axis
    listed = [e for e in written if isinstance(e, tuple)]
    plain = [tuple(e for e in written if not isinstance(e, tuple))] * count
    if (listed and len(listed) != count) or len(listed) not in (0, len(written)):
        expected = "one direction" if count == 1 else f"one direction, or {count}, one for each segment"
        raise scope.error("y_axis", expected, value_in_words(written))
    return [scope.direction("y_axis", GROUND, side).vector for side in listed or plain]


def _elements_of_segments(scope: Scope, elements: int | tuple[int, ...], lengths: list[float]) -> list[int]:
    """Return the number of elements of each segment; where it is free, the longest element is as short as possible."""
    least = len(lengths)
    counts = list(elements) if isinstance(elements, tuple) else [1] * least
    whole = sum(counts) if isinstance(elements, tuple) else elements
    if not least <= whole <= MOST_ELEMENTS or len(counts) != least or min(counts) < 1:
        listed = f", or {least} numbers above 0, one for each segment" if least > 1 else ""
        raise scope.error(
            "elements", f"a number of elements, {least} to {MOST_ELEMENTS}{listed}", value_in_words(elements)
        )
    steps = [(-length / count, i) for i, (length, count) in enumerate(zip(lengths, counts, strict=True))]
    heapq.heapify(steps)
    for _ in range(whole - sum(counts)):
        i = steps[0][1]
        counts[i] += 1
        heapq.heapreplace(steps, (-lengths[i] / counts[i], i))
    return counts
