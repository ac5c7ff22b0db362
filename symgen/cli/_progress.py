"""A progress bar on standard error, only on a terminal and only for long work."""

from __future__ import annotations

import math
import sys
import threading
import time
from typing import Any, Self

#: Shorter work shows nothing and does not import the library of the bar.
PATIENCE = 0.7
#: Time between two lines about a long study where standard error is no terminal [s].
BETWEEN_LINES = 20.0
#: What is done before a run begins, as long as nothing has been reached.
BEFORE = "deriving and compiling"


class Bar:
    """Progress bar, called with the work done; draws nothing unless standard error is a terminal.

    Until it is called for the first time it says that code is derived and compiled, and for how long already.

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
        self.lock, self.ended = threading.Lock(), False
        self.timer = threading.Timer(PATIENCE, self._show_beginning)
        self.timer.daemon = True

    def __enter__(self) -> Self:
        if self.shown:
            self.timer.start()
        return self

    def __call__(self, reached: float) -> None:
        if not self.shown or (self.progress is None and time.perf_counter() - self.began < PATIENCE):
            return
        with self.lock:
            self._begin()
        self.progress.update(self.task, completed=reached, total=self.total, description=self.title)

    def __exit__(self, *error: object) -> None:
        self.timer.cancel()
        with self.lock:
            self.ended = True
            if self.progress is not None:
                self.progress.stop()

    def _show_beginning(self) -> None:
        """Say what is done while nothing has been reached."""
        with self.lock:
            if not self.ended:
                self._begin()

    def _begin(self) -> None:
        """Begin to draw, where nothing is drawn yet."""
        if self.progress is not None:
            return
        from rich.console import Console
        from rich.progress import (
            BarColumn,
            Progress,
            TaskProgressColumn,
            TextColumn,
            TimeElapsedColumn,
            TimeRemainingColumn,
        )

        times = (TimeElapsedColumn(), TimeRemainingColumn())
        columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), *times)
        progress = Progress(*columns, console=Console(stderr=True), transient=True)
        self.task = progress.add_task(f"{self.title}: {BEFORE}" if self.title else BEFORE, total=None)
        progress.start()
        self.progress = progress


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
