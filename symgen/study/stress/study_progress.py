"""Progress of a stress study over all of its parts: references, runs and searches."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from symgen.study.runner import Cell, Status

#: Called with the current activity and the progress.
Progress = Callable[[str, Status], None]


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
    _began: float = field(default_factory=time.monotonic)
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
