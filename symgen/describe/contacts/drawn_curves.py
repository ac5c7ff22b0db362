"""Curves of drawings: ellipses, Bezier curves and the path data of SVG."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from symgen.describe.contacts.arcs_along import Stretch, bulged

#: Numbers that each letter of path data takes.
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_NUMBER = re.compile(r"[\s,]*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)")
_FLAG, _LETTER = re.compile(r"[\s,]*([01])"), re.compile(r"[\s,]*([A-Za-z])")


class BadDrawing(Exception):
    """A drawing is none, or none of one chain.

    Parameters
    ----------
    expected, got : str
        For the message.
    """

    def __init__(self, expected: str, got: str) -> None:
        super().__init__(expected, got)
        self.expected, self.got = expected, got


def ellipse(centre: complex, axis: complex, ratio: float, begin: float, end: float) -> Iterator[Stretch]:
    """Yield an ellipse from a parameter to another one, by quarters; a circle exactly, by halves.

    Parameters
    ----------
    centre, axis : complex
        Its centre, and the half axis at the parameter 0.
    ratio : float
        The other half axis over this one, below 0 where parameters go clockwise.
    begin, end : float
        Parameters [rad].
    """
    circle = abs(abs(ratio) - 1.0) < 1e-12
    count = max(1, math.ceil(abs(end - begin) / (math.pi if circle else 0.5 * math.pi) - 1e-9))
    step = (end - begin) / count

    def point(s: float) -> complex:
        return centre + axis * complex(math.cos(s), ratio * math.sin(s))

    def quarter(first: float) -> Stretch:
        def at(x: float) -> tuple[complex, complex]:
            s = first + step * x
            rate = step * axis * complex(-math.sin(s), ratio * math.cos(s))
            return point(s), rate / abs(rate)

        return Stretch(at)

    for i in range(count):
        first = begin + step * i
        if circle:
            yield bulged(point(first), point(first + step), math.tan(0.25 * step) * math.copysign(1.0, ratio))
        else:
            yield quarter(first)


def bezier(*points: complex) -> Stretch:
    """Return the curve of Bezier of its control points."""
    distinct = [b for b in points if b != points[0]]
    before = [b for b in points if b != points[-1]]
    if not distinct:
        raise BadDrawing("curves with a length", "one whose points are all at one place")
    ends = {0.0: distinct[0] - points[0], 1.0: points[-1] - before[-1]}

    def at(x: float) -> tuple[complex, complex]:
        level, rate = list(points), 0j
        while len(level) > 1:
            rate = level[-1] - level[0] if len(level) == 2 else rate
            level = [a + x * (b - a) for a, b in pairwise(level)]
        rate = ends.get(x, rate)
        return level[0], rate / abs(rate) if rate else ends[0.0] / abs(ends[0.0])

    return Stretch(at)


def read_path(data: str) -> tuple[list[Stretch], bool]:
    """Return the stretches of SVG path data, its y axis downwards, and whether it is closed.

    Source: W3C: Scalable Vector Graphics (SVG) 2, section 9.3, and for arcs appendix B.2.4.

    Raises
    ------
    BadDrawing
        If it is no path data, or draws several chains.
    """
    stretches, place, start, closed = list[Stretch](), 0j, 0j, False
    control, kind_before = 0j, ""
    for letter, numbers in _commands(data):
        kind = letter.upper()
        base = place if letter.islower() else 0j
        x = (
            [complex(numbers[i], numbers[i + 1]) + base for i in range(0, len(numbers) - 1, 2)]
            if kind not in "A"
            else []
        )
        if closed or (kind == "M" and stretches):
            raise BadDrawing("path data of one chain", f"a second one, from its letter '{letter}' on")
        mirrored = 2.0 * place - control
        if kind == "M":
            place = start = x[0]
        elif kind == "Z":
            closed = True
            if abs(place - start) > 0.0:
                stretches.append(bulged(place, start, 0.0))
        elif kind in "LHV":
            if kind != "L":
                across, up = (numbers[0], None) if kind == "H" else (None, numbers[0])
                end = complex(
                    place.real if across is None else across + base.real, place.imag if up is None else up + base.imag
                )
            else:
                end = x[0]
            if end != place:
                stretches.append(bulged(place, end, 0.0))
            place = end
        elif kind == "A":
            end = complex(numbers[5], numbers[6]) + base
            stretches += _arc_between(place, end, numbers)
            place = end
        else:
            controls = x
            if kind in "ST":
                smooth = kind_before in ("CS" if kind == "S" else "QT")
                controls = [mirrored if smooth and kind_before else place, *x]
            stretches.append(bezier(place, *controls))
            control, place = controls[-2], controls[-1]
        kind_before = kind
    if not stretches:
        raise BadDrawing("path data such as 'M 0 0 L 10 0'", "none that draws anything")
    return stretches, closed


def _commands(data: str) -> Iterator[tuple[str, list[float]]]:
    """Yield letters of path data, each as often as it has numbers for, and their numbers."""
    at, letter, first = 0, "", True
    while data[at:].strip(" \t\r\n,"):
        if found := _LETTER.match(data, at):
            letter, at = found[1], found.end()
            if letter.upper() not in _TAKES or (first and letter.upper() != "M"):
                raise BadDrawing("path data with the letters MLHVCSQTAZ, which begins with M", f"the letter '{letter}'")
        elif letter.upper() in ("", "Z"):
            raise BadDrawing("path data that begins with M", f"'{data[at : at + 20].strip()}'")
        elif letter in "Mm":
            letter = "L" if letter == "M" else "l"  # further pairs draw lines
        first, numbers = False, list[float]()
        for i in range(_TAKES[letter.upper()]):
            pattern = _FLAG if letter in "Aa" and i in (3, 4) else _NUMBER
            if (found := pattern.match(data, at)) is None:
                got = data[at : at + 20].strip() or "the end"
                raise BadDrawing(f"{_TAKES[letter.upper()]} numbers after '{letter}' of path data", f"'{got}'")
            numbers.append(float(found[1]))
            at = found.end()
        if not all(map(math.isfinite, numbers)):
            raise BadDrawing("finite numbers in path data", f"one that is none after '{letter}'")
        yield letter, numbers


def _arc_between(start: complex, end: complex, numbers: Sequence[float]) -> Iterator[Stretch]:
    """Yield the arc of an ellipse between two points, as path data has it."""
    across, up, large, positive = abs(numbers[0]), abs(numbers[1]), numbers[3] != 0.0, numbers[4] != 0.0
    if start == end:
        return
    if across == 0.0 or up == 0.0:
        yield bulged(start, end, 0.0)
        return
    turned = cmath.exp(1j * math.radians(numbers[2]))
    half = 0.5 * (start - end) / turned
    half = complex(half.real / across, half.imag / up)  # on a circle of radius 1
    size = max(1.0, abs(half))
    away = math.sqrt(max(0.0, size * size / abs(half) ** 2 - 1.0)) * (1.0 if large == positive else -1.0)
    middle = 1j * half * away  # of the circle, seen from the middle of its chord
    begin, finish = cmath.phase(half - middle), cmath.phase(-half - middle)
    if positive and finish < begin:
        finish += 2.0 * math.pi
    if not positive and finish > begin:
        finish -= 2.0 * math.pi
    centre = 0.5 * (start + end) + turned * complex(across * middle.real, up * middle.imag)
    yield from ellipse(centre, turned * across * size, up / across, begin, finish)
