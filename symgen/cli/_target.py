"""The option that says what code is emitted for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import click

from symgen.ir.program import TARGETS

F = TypeVar("F", bound=Callable[..., Any])


def target_option(text: str) -> Callable[[F], F]:
    """Return the option ``--target``; `text` is its help."""
    return click.option("--target", type=click.Choice(TARGETS), default="cpu", show_default=True, help=text)
