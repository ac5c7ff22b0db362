"""Print tables whole, also into a file or a pipe, where Rich would take a width of 80 characters."""

from __future__ import annotations

import sys

from rich.console import Console
from rich.table import Table


def show(table: Table) -> None:
    """Print a table as wide as the terminal, or as wide as it needs where there is none."""
    Console(width=None if sys.stdout.isatty() else 170).print(table)
