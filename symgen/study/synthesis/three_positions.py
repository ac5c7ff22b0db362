"""Three positions of a body: linkages whose fixed pins are the centres of circles through three places of moving ones.

Any two points of the body may be pins. Each has three places, one a position, and the centre of the circle through
them is its pin on the ground. These are formulas of the searched machine, so that each candidate passes the positions
wherever it closes, and the search, which varies the two points, follows exact derivatives.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.ranges import Ranges
from symgen.analyses.search.sampled_motions import Aim, Limit, Motions, NoMotion, Taken
from symgen.analyses.search.search import Candidate, Search, screen
from symgen.base.settings import Settings
from symgen.describe.formulas.evaluate import parameter_values
from symgen.study.design.motions import motions_of
from symgen.study.design.problem import QuantityReader
from symgen.study.synthesis.linkages import COSINE, Linkage, pins_of_values, variable_linkage, verify_linkage
from symgen.study.synthesis.tasks import SynthesisTask

Array = NDArray[np.float64]

#: The numbers that vary: two points of the body where it is in the first position.
VARIED = ("ax", "ay", "bx", "by")
#: Bars are at least so long, in parts of the size of the task.
SHORTEST = 0.05
#: Positions are reached to this part of the size of the task; another branch is far away.
REACHED = 1e-6
_OTHER_BRANCH = "the third position is on another branch"


class PositionSearch:
    """Linkages that pass three positions.

    Parameters
    ----------
    task : SynthesisTask
        The positions.
    room : float
        Pins are within so many sizes about the middle of the task.
    transmission : float
        The smallest transmission angle that counts [rad].

    Attributes
    ----------
    search : Search
        The search among them.
    """

    def __init__(self, task: SynthesisTask, room: float, transmission: float) -> None:
        self.task, self.size = task, task.size
        low, high = task.room(room)
        parameters = _parameters(task, 0.5 * (low + high))
        self.mechanism = variable_linkage(parameters, "turn*t")
        reader = QuantityReader(self.mechanism)
        aim = Aim(Taken("peak", COSINE), reader.place("synthesize", COSINE), "", "largest")
        pose = [reader.place("synthesize", f"coupler.{name}") for name in ("x", "y", "theta")]
        limits = [Limit(aim.taken, aim.quantity, "", "largest", math.cos(transmission), 1.0, "transmission")]
        for name, side, bound in (
            *((f"{pin}{axis}", "smallest", low[i]) for pin in "pq" for i, axis in enumerate("xy")),
            *((f"{pin}{axis}", "largest", high[i]) for pin in "pq" for i, axis in enumerate("xy")),
            *((f"{bar}_length", "smallest", SHORTEST * self.size) for bar in ("crank", "coupler", "rocker")),
        ):
            word = "max" if side == "smallest" else "min"  # the same at all times: one of them counts
            limits.append(Limit(Taken(word, name), reader.parameter(name), "m", side, float(bound), self.size, name))
        motions = motions_of(self.mechanism, Settings(until=1.0), VARIED, 1.0, reader.quantities)
        start = 0.5 * (low + high)
        ranges = Ranges(VARIED, np.tile(low, 2), np.tile(high, 2), np.tile(start, 2))
        self.search = Search(ranges, _PassingMotions(self, motions, pose), aim, limits, 1.0)

    def values(self, x: Array) -> dict[str, float]:
        """Return all parameters for the numbers that vary.

        Raises
        ------
        InputError
            If a formula is undefined, as where three places are on a line.
        """
        return parameter_values(self.mechanism, dict(zip(VARIED, x.tolist(), strict=True)))

    def find(self, starts: int, seed: int) -> Iterator[Linkage]:
        """Yield verified linkages: the ends of searches, and where these began, which are others."""
        search = self.search
        screened = screen(search, starts, seed)
        begun = [found for u in screened.starts if (found := search.check(u)) is not None]
        for each in [*(search.improve(first) for first in begun), *begun]:
            if each.is_within and (linkage := self._verify(each)) is not None:
                yield linkage

    def _verify(self, found: Candidate) -> Linkage | None:
        values, task = self.values(self.search.ranges.values(found.u)), self.task
        times = np.array([0.0, values["second"] / values["turn"], 1.0])
        made = verify_linkage(pins_of_values(values), values["turn"], times, task.places, task.angles)
        if made is None or max(made.deviation / self.size, made.turned_off) > REACHED:
            return None
        return made


class _PassingMotions:
    """Motions that end in the third position, on the branch of the first one."""

    def __init__(self, owner: PositionSearch, motions: Motions, pose: list[int]) -> None:
        self._owner, self._motions, self._pose = owner, motions, pose

    def at(self, x: Array, times: Array) -> tuple[Array, Array]:
        """Return quantities and derivatives; see `Motions`."""
        values, slopes = self._motions.at(x, times)
        if not self._arrives(values):
            raise NoMotion(_OTHER_BRANCH)
        return values, slopes

    def screen(self, xs: Array, times: Array) -> list[Array | str]:
        """Return the quantities for rows of values; see `Motions`."""
        found = self._motions.screen(xs, times)
        return [x if isinstance(x, str) or self._arrives(x) else _OTHER_BRANCH for x in found]

    def _arrives(self, values: Array) -> bool:
        """Return whether a motion ends in the third position."""
        task = self._owner.task
        angles = np.zeros(3) if task.angles is None else task.angles
        x, y, turned = values[-1, self._pose]
        off = np.hypot(x - task.places[2, 0], y - task.places[2, 1]) / self._owner.size
        return bool(max(off, abs(np.exp(1j * (turned - angles[2] + angles[0])) - 1.0)) <= REACHED)


def _parameters(task: SynthesisTask, middle: Array) -> dict[str, float | str]:
    """Return the parameters of a linkage through three positions."""
    angles = np.zeros(3) if task.angles is None else task.angles - task.angles[0]
    found: dict[str, float | str] = dict(zip(("tx", "ty"), task.places[0].tolist(), strict=True))
    found |= {"ax": float(middle[0]), "ay": float(middle[1]), "bx": float(middle[0]) + 0.3 * task.size}
    found["by"] = float(middle[1])
    for k in (1, 2):
        numbers = (*task.places[k], math.cos(angles[k]), math.sin(angles[k]))
        found |= dict(zip((f"x{k}", f"y{k}", f"c{k}", f"s{k}"), map(float, numbers), strict=True))
    for p, centre in (("a", "p"), ("b", "q")):
        for k in (1, 2):  # the way from the first place to another one
            found[f"{p}x{k}"] = f"x{k} + c{k}*({p}x - tx) - s{k}*({p}y - ty) - {p}x"
            found[f"{p}y{k}"] = f"y{k} + s{k}*({p}x - tx) + c{k}*({p}y - ty) - {p}y"
        # where the perpendicular bisectors of both ways meet
        found[f"{p}n"] = f"2*({p}x1*{p}y2 - {p}y1*{p}x2)"
        ways = {k: f"({p}x{k}**2 + {p}y{k}**2)" for k in (1, 2)}
        found[f"{centre}x"] = f"{p}x + ({p}y2*{ways[1]} - {p}y1*{ways[2]})/{p}n"
        found[f"{centre}y"] = f"{p}y + ({p}x1*{ways[2]} - {p}x2*{ways[1]})/{p}n"
    # an arc is twice the angle under which a point of the circle that is not on it sees it: in the order of the places
    found["second"] = "2*atan2(ax1*ay2 - ay1*ax2, ax2*(ax2 - ax1) + ay2*(ay2 - ay1))"
    found["turn"] = "second + 2*atan2(ax1*ay2 - ay1*ax2, ax1*ax2 + ay1*ay2)"
    return found
