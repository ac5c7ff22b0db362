"""What the commands of analyses share: options of where and of what, and tables."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from symgen.cli._options import setting_options, words
from symgen.errors import InputError, quoted

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

F = TypeVar("F", bound=Callable[..., Any])


def place_options(function: F) -> F:
    """Give a command the options that say about which state an analysis is."""
    for option in (
        click.option(
            "--cyclic", metavar="NAME,NAME", help="With --at steady: coordinates that turn on. [default: found]"
        ),
        click.option("--states", metavar="NAME,NAME", help="Quantities that are the states. [default: found]"),
        click.option(
            "--at",
            default="equilibrium",
            show_default=True,
            metavar="PLACE",
            help="About what: equilibrium, start, steady, or a time of a run [s].",
        ),
        setting_options("parameters", "start", "coordinates", "shape"),
    ):
        function = option(function)
    return function


def names(option: str, text: str | None) -> tuple[str, ...]:
    """Return the names of a comma-separated list."""
    return words(option, text)


def axis(option: str, text: str) -> tuple[str, NDArray[np.float64]]:
    """Return name and values of a word such as ``crank.theta=lin(0,6.28,25)``.

    Raises
    ------
    InputError
        If it has another form.
    """
    from symgen.ensemble.axes import parse

    name, equals, values = text.partition("=")
    if not equals or not name.strip() or not values.strip():
        raise InputError(option, "NAME=VALUES, such as crank.theta=lin(0,6.28,25)", quoted(text))
    return name.strip(), parse(values.strip(), f"{option} {name.strip()}")
