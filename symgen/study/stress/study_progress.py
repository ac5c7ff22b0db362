"""Progress of a stress study over all of its parts: references, runs and searches."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace

from symgen.study.runner import Cell, Status

#: Expected work in microseconds, by quick studies of `four-bar` and `pendulum`: of a reference, a run, and a step of
#: either; runs that a search for the largest step takes. Other mechanisms have another unit, which a study finds.
REFERENCE, RUN, STEP, SEARCH = 1e5, 5e3, 0.5, 12.0
#: What the first cells with some code take longer: references, runs over the right-hand side, schemes of methods.
FIRST_REFERENCE, FIRST_RUN, FIRST_SCHEME = 1.5e6, 2e5, 4e5
#: Integrators of which a step takes so many explicit ones.
STEPS_OF = {"radau5": 10.0}

#: Called with the current activity and the progress.
Progress = Callable[[str, Status], None]


def expected_work(kind: str, steps: float, integrator: str = "") -> float:
    """Return how long a cell takes, in the unit of a study.

    Parameters
    ----------
    kind : {"reference", "run", "search"}
        What it computes.
    steps : float
        Steps of a run by the case.
    integrator : str
        Of a run, or of a search.
    """
    each = STEP * steps * STEPS_OF.get(integrator, 1.0)
    return REFERENCE + each if kind == "reference" else RUN + each * (SEARCH if kind == "search" else 1.0)


def with_first_cells(cells: Iterable[tuple[Cell, float]]) -> list[Cell]:
    """Return cells, the first of each group with what its code takes: compiling is most of a quick study.

    Parameters
    ----------
    cells : iterable of (Cell, float)
        Cells, and what the first one of its group takes longer.
    """
    known, found = set[str](), list[Cell]()
    for cell, longer in cells:
        found.append(cell if cell.group in known else replace(cell, cost=cell.cost + longer))
        known.add(cell.group)
    return found


@dataclass
class Whole:
    """Cells and work of a study, all parts together.

    Parameters
    ----------
    total, work : int, float
        Cells, and their expected work.
    progress : callable
        Called with the current activity and the progress of the whole study.
    """

    total: int
    work: float
    progress: Progress
    _done: int = 0
    _worked: float = 0.0
    _began: float = field(default_factory=lambda: time.monotonic())
    _ready: float = 0.0

    @classmethod
    def of_study(cls, cells: Iterable[Cell], progress: Progress) -> Whole:
        """Return the progress of some cells, before the first one."""
        costs = {cell.key: cell.cost for cell in cells}
        return cls(len(costs), sum(costs.values()), progress)

    def begin_part(self, what: str, cells: Iterable[Cell]) -> Callable[[Status], None]:
        """Return what shows the progress of the next part as one of the whole study."""
        costs = {cell.key: cell.cost for cell in cells}
        done, worked, own = self._done, self._worked, sum(costs.values())
        self._done, self._worked = done + len(costs), worked + own

        begun = False

        def show_part(status: Status) -> None:
            nonlocal begun
            reached = worked + status.share * own
            if not begun:  # what a journal had
                begun, self._ready = True, self._ready + status.share * own
            gained, left = reached - self._ready, None
            if gained > 0.0:
                left = (self.work - reached) * (time.monotonic() - self._began) / gained
            share = reached / self.work if self.work else 1.0
            self.progress(what, Status(done + status.done, self.total, share, left))

        return show_part
