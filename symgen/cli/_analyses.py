"""What the commands of analyses share: options of where and of what, and tables."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar, cast

import click

from symgen.cli._options import setting_options, words
from symgen.errors import InputError, quoted

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

F = TypeVar("F", bound=Callable[..., Any])


def place_options(function: F) -> F:
    """Give a command the options that say about which state an analysis is.

    They arrive as one value, the arguments ``place`` of `symgen.api.Model.modes` and its like.
    """

    @wraps(function)
    def command(*, at: str, states: str | None, cyclic: str | None, **further: Any) -> Any:
        place = {"at": at, "states": words("--states", states), "cyclic": words("--cyclic", cyclic)}
        return function(place=place, **further)

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
        command = option(command)
    return cast("F", command)


def motion_options(start: str) -> Callable[[F], F]:
    """Return a decorator that gives a command the settings of a motion that drivers prescribe.

    Parameters
    ----------
    start : str
        What the help says of ``--start``.
    """
    return setting_options("parameters", "inputs", "start", "strict", "shape", text={"start": start})


def table_options(shown: str, drawn: str) -> Callable[[F], F]:
    """Return a decorator that gives a command the options of what is done with tables over time.

    Parameters
    ----------
    shown, drawn : str
        What the help says of ``--quantity`` and ``--plot``.
    """
    options = (
        click.option(*("--quantity", "quantities"), multiple=True, metavar="NAME", help=shown),
        click.option("--save", metavar="FILE", help="Write tables to FILE: .csv, with units, or .parquet."),
        click.option("--plot", metavar="FILE", help=f"Draw {drawn} over time into FILE: .png, .svg or .pdf."),
    )

    def decorate(function: F) -> F:
        for option in reversed(options):
            function = option(function)
        return function

    return decorate


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
