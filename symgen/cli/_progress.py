"""A progress bar on standard error, only on a terminal and only for what takes long enough to look at."""

from __future__ import annotations

import sys
import time
from types import TracebackType
from typing import Any

#: Shorter work shows nothing, and does not import what draws the bar.
PATIENCE = 0.7


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
