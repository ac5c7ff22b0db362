"""A progress bar on standard error, only on a terminal and only for what takes long enough to look at."""

from __future__ import annotations

import math
import sys
import time
from types import TracebackType
from typing import Any

#: Shorter work shows nothing, and does not import what draws the bar.
PATIENCE = 0.7
#: Where standard error is no terminal, so long passes between two lines about a long study [s].
BETWEEN_LINES = 20.0


class Bar:
    """Callable with how far the work is; draws nothing unless standard error is a terminal.

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

    def __enter__(self) -> Bar:
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

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self.progress is not None:
            self.progress.stop()


class Lines:
    """Progress of a long study: a bar on a terminal, elsewhere a line on standard error from time to time."""

    def __init__(self) -> None:
        self.bar = Bar("", 1.0)
        self.last = time.perf_counter()

    def __enter__(self) -> Lines:
        return self

    def __call__(self, what: str, done: int, total: int, share: float, seconds_left: float | None) -> None:
        self.say(f"{what}: {done} of {total}", share, None if done == total else seconds_left)

    def say(self, text: str, share: float, seconds_left: float | None) -> None:
        """Show what is being done, how much of the work is behind it, and about how long the rest takes."""
        self.bar.title = text  # the bar says by itself how much is done, and how long the rest takes
        self.bar(share)
        if not self.bar.shown and time.perf_counter() - self.last > BETWEEN_LINES:
            self.last = time.perf_counter()
            left = "" if seconds_left is None else f", about {_duration(seconds_left)} left"
            print(f"symgen: {math.floor(100.0 * share)} %, {text}{left}", file=sys.stderr, flush=True)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.bar.__exit__(kind, error, trace)


def _duration(seconds: float) -> str:
    """Return a duration in the unit that suits it."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 1.5 * size:
            return f"{seconds / size:.1f} {unit}"
    return f"{seconds:.0f} s"
