"""Find linkages for a task: read it, search, and put the best ones first."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.base.files import write_whole
from symgen.study.synthesis.coupler_paths import PathSearch
from symgen.study.synthesis.linkages import Linkage
from symgen.study.synthesis.tasks import SynthesisTask, read_task
from symgen.study.synthesis.three_positions import PositionSearch

#: Linkages are others where a pin is so far away, in parts of the size of the task.
APART = 0.05
#: Deviations below this part of the size count as none.
NONE = 1e-9
#: Most starts, and the least transmission angle that is asked for unless another one is given [rad].
MOST_STARTS, TRANSMISSION = 100, math.radians(30.0)


@dataclass(frozen=True, repr=False)
class Synthesis:
    """Linkages that were found for a task.

    Attributes
    ----------
    linkages : tuple of Linkage
        The best first: for positions, which all pass, by transmission angle; for a path by deviation.
    reason : str or None
        Why there is none; None where there are some.
    """

    linkages: tuple[Linkage, ...]
    reason: str | None = field(default=None)

    @property
    def ok(self) -> bool:
        """Whether there is a linkage."""
        return self.reason is None

    def save(self, path: str | PathLike[str], place: int = 1) -> Path:
        """Write the file of a linkage.

        Parameters
        ----------
        path : str or PathLike
            A file that ends in ``.toml``.
        place : int
            Which one, from 1, the best, on.

        Raises
        ------
        InputError
            If there is no such linkage, the file does not end so, or cannot be written.
        """
        file = arguments.toml_file("save", arguments.path_argument("save", path))
        if not 1 <= arguments.whole_number("save: place", place, 1, MOST_STARTS**2) <= len(self.linkages):
            raise InputError("save: place", f"one of {len(self.linkages)} linkages", str(place))
        return write_whole(file, self.linkages[place - 1].text)

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen synthesize --json``."""
        return {"linkages": [each.to_json() for each in self.linkages], "reason": self.reason}

    def __repr__(self) -> str:
        return f"<Synthesis: {len(self.linkages)} linkages>"


def synthesize(
    task: str | PathLike[str] | Mapping[str, object],
    starts: int = 6,
    room: float = 1.5,
    transmission: float = TRANSMISSION,
    seed: int = 0,
) -> Synthesis:
    """Find four-bar linkages that pass three positions of a body, or whose coupler point passes a path.

    Each one has moved through the task in a run of its own file: on one circuit and branch, without a dead centre.

    Parameters
    ----------
    task : str, path or mapping
        Columns ``x``, ``y`` and, for three positions, ``angle``; a CSV file or arrays by headings. Headings may have
        units, such as ``x [mm]``; without units they are in SI. Points of a path are passed in their order, at any
        times; one that ends where it begins needs a crank that turns round.
    starts : int
        Searches.
    room : float
        Pins are within so many sizes of the task about its middle.
    transmission : float
        The smallest angle between coupler and rocker that counts [rad].
    seed : int
        Of the candidates; the same one gives the same answer.

    Returns
    -------
    Synthesis
        Without linkages where none was found, with the reason.

    Raises
    ------
    InputError
        If an argument is wrong.
    """
    read = read_task(task)
    count = arguments.whole_number("synthesize: starts", starts, 1, MOST_STARTS)
    chance = arguments.whole_number("synthesize: seed", seed, 0, 2**63 - 1)
    wide = arguments.number("synthesize: room", room)
    least = arguments.number("synthesize: transmission", transmission)
    if not 0.6 <= wide <= 100.0:
        raise InputError("synthesize: room", "0.6 to 100 sizes of the task", f"{wide:g}")
    if not 0.0 <= least < 0.5 * math.pi:
        got = f"{math.degrees(least):g} degrees"
        raise InputError("synthesize: transmission", "an angle from 0 to below 90 degrees", got)
    kind = PathSearch if read.angles is None else PositionSearch
    found = [each for each in kind(read, wide, least).find(count, chance) if each.transmission >= least - 1e-6]
    chosen = list[Linkage]()
    for each in sorted(found, key=lambda linkage: _rank(linkage, read)):
        if all(_distance(each, other) > APART * read.size for other in chosen):
            chosen.append(each)
    return Synthesis(tuple(chosen), None if chosen else _reason(wide, least))


def _rank(linkage: Linkage, task: SynthesisTask) -> tuple[float, float]:
    """Return what is less for a better linkage: how far it misses a path, then how badly forces pass."""
    missed = linkage.deviation / task.size
    return (missed if task.angles is None and missed > NONE else 0.0), -linkage.transmission


def _distance(one: Linkage, other: Linkage) -> float:
    return float(np.abs(np.array(one.pins) - np.array(other.pins)).max())


def _reason(room: float, transmission: float) -> str:
    return (
        f"no linkage was found with pins within {room:g} sizes of the task and transmission angles from "
        f"{math.degrees(transmission):g} degrees on: give more room, a smaller angle or more starts"
    )
