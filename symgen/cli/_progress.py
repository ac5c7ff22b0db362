"""A progress bar on standard error, only on a terminal and only for long work."""

from __future__ import annotations

import math
import sys
import time
from typing import Any, Self

#: Shorter work shows nothing and does not import the library of the bar.
PATIENCE = 0.7
#: Time between two lines about a long study where standard error is no terminal [s].
BETWEEN_LINES = 20.0


class Bar:
    """Progress bar, called with the work done; draws nothing unless standard error is a terminal.

    Parameters
    ----------
    title : str
        What is being done.
    total : float
        Value at which it is done.
    """

    def __init__(self, title: str, total: float) -> None:
        self.title, self.total = title, total
        self.began = time.perf_counter()
        self.shown = sys.stderr.isatty()
        self.progress: Any = None
        self.task: Any = None

    def __enter__(self) -> Self:
        return self

    def __call__(self, reached: float) -> None:
        if not self.shown or (self.progress is None and time.perf_counter() - self.began < PATIENCE):
            return
        if self.progress is None:
            from rich.console import Console
            from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

            columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
            self.progress = Progress(*columns, console=Console(stderr=True), transient=True)
            self.progress.start()
            self.task = self.progress.add_task(self.title, total=self.total)
        self.progress.update(self.task, completed=reached, description=self.title)

    def __exit__(self, *error: object) -> None:
        if self.progress is not None:
            self.progress.stop()


class Lines(Bar):
    """Progress of a long study: a bar on a terminal, elsewhere a line on standard error from time to time."""

    def __init__(self) -> None:
        super().__init__("", 1.0)
        self.last = self.began

    def show_task(self, text: str, share: float) -> None:
        """Show the current task, the part of the work done, and an estimate of the time left."""
        self.title = text
        self(share)
        now = time.perf_counter()
        if not self.shown and now - self.last > BETWEEN_LINES:
            self.last = now
            left = (
                f", about {_duration_in_words((now - self.began) * (1.0 - share) / share)} left"
                if 0.02 < share < 1.0
                else ""
            )
            print(f"symgen: {math.floor(100.0 * share)} %, {text}{left}", file=sys.stderr, flush=True)


def _duration_in_words(seconds: float) -> str:
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 1.5 * size:
            return f"{seconds / size:.1f} {unit}"
    return f"{seconds:.0f} s"
