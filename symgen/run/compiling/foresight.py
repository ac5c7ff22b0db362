"""What a run needs to find the jumps and kinks of formulas in time by itself, for printers of other languages.

Arguments that are straight lines over time are compiled as their values at 0 and slopes, which depend on parameters.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.vocabulary.expressions import names_in_expression
from symgen.describe.parts.driven_mechanism import Jump
from symgen.run.breaks.foreseen_seams import Foreseen
from symgen.run.breaks.in_time import line_of_formula, slope_and_offset
from symgen.run.compiling.side import Side, compile_side
from symgen.run.loops.seams import seams_with_room
from symgen.run.loops.times_of_jumps import BESIDE_A_SIDE, NEXT_TO, SAME, SEAMS_OF_PASSAGE, SEAMS_OF_WINDOW
from symgen.run.printed.foreseen_run import Foresight
from symgen.run.printed.kept_run import END_TIME

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec

#: Room for the passages of a window: where formulas pass levels again and again, and at most.
_ROOM, _MOST_ROOM = 64, 256


@dataclass(frozen=True)
class Passages:
    """Foreseen passages of formulas, for runs that find their times.

    Attributes
    ----------
    lines : Side
        Values of their formulas.
    jumps : sequence of (Jump, int)
        Each with what its passages are, see `symgen.run.loops.times_of_jumps`.
    step : float
        Distance of the grid of constant steps [s], 0 without.
    shortest : float
        Largest distance of samples [s].
    """

    lines: Side
    jumps: Sequence[tuple[Jump, int]]
    step: float
    shortest: float

    @classmethod
    def of_run(cls, foreseen: Foreseen, compiled: CompiledModel) -> Passages:
        """Return the passages of a run."""
        mechanism, jumps = foreseen.mechanism, foreseen.passing
        formulas = [
            (f"{name} {i}", e)
            for i, (jump, _) in enumerate(jumps)
            for name, e in zip(("value", "slope"), slope_and_offset(jump.argument) or (jump.argument,), strict=False)
        ]
        lines = compile_side(mechanism, compiled, "passages", "Formulas that pass levels in time", formulas)
        step = 0.0 if foreseen.grid is None else foreseen.grid[1]
        return cls(lines, jumps, step, mechanism.defaults.max_step or math.inf)

    @property
    def room(self) -> int:
        """Number of passages that a window has room for."""
        endless = any(jump.period or slope_and_offset(jump.argument) is None for jump, _ in self.jumps)
        return min(sum(len(jump.levels) for jump, _ in self.jumps) + (_ROOM if endless else 1), _MOST_ROOM)

    def foresight(self, spec: RunSpec, shown: Any) -> Any:
        """Return these as `Foresight`, for a run that shows an array of times."""
        straight = [slope_and_offset(jump.argument) is not None for jump, _ in self.jumps]
        widths = [1 + is_straight for is_straight in straight]
        levels = [sorted(jump.levels) for jump, _ in self.jumps]
        integers = (x.astype(np.int64) for x in (np.cumsum([0, *widths])[:-1], np.array(straight)))
        own = (np.array([kind for _, kind in self.jumps], dtype=np.int64), np.cumsum([0, *map(len, levels)]))
        ends = END_TIME if spec.adaptive else -1
        return Foresight(
            *(float(spec.until), self.shortest, 0.0, self.step, SAME, BESIDE_A_SIDE, NEXT_TO, ends, *own),
            *(np.array([x for each in levels for x in each]), np.array([jump.period for jump, _ in self.jumps])),
            *(shown, np.zeros(2), np.zeros(self.room), np.zeros(1)),
            *(np.zeros(self.room, dtype=np.int64), np.zeros(4, dtype=np.int64)),
            *(self.lines.function, *integers, np.zeros(sum(widths))),
        )

    def seams(self, compiled: CompiledModel, adaptive: bool) -> Any:
        """Return room for the seams of a window as `Seams`."""
        most = SEAMS_OF_PASSAGE * self.room + SEAMS_OF_WINDOW
        return seams_with_room(most, adaptive, bool(compiled.info.bounded))


def is_laid_out(foreseen: Foreseen, until: float) -> bool:
    """Return whether the times of all passages are known before a run to `until`, whatever its parameters are."""
    return not any(
        {*names_in_expression(jump.argument)} != {"t"} or jump.period or not _ends_before(jump, until)
        for jump in (*foreseen.kinks, *foreseen.sides, *foreseen.gaps)
    )


def _ends_before(jump: Jump, until: float) -> bool:
    """Return whether a straight line passes all its levels before a time."""
    line = line_of_formula(jump, {})
    return line is not None and all((x - line[0]) / line[1] < until for x in jump.levels if line[1])
