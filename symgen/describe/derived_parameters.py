"""Parameters that are formulas of parameters: which they are, and in which order they are worked out."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from symgen.errors import InputError
from symgen.vocabulary.expressions import Expr, names

if TYPE_CHECKING:
    from symgen.describe.mechanism import Parameter

#: Parameters that a message about a circle of them lists.
_TOLD = 8


def in_order(formulas: Mapping[str, Expr | None], where: str) -> list[str]:
    """Return names so that each stands behind those that its formula depends on, else in their own order.

    Parameters
    ----------
    formulas : mapping of str to Expr or None
        The formula of each, None for numbers.
    where : str
        File and section, for the message.

    Raises
    ------
    InputError
        If formulas lead back to where they began; says by which way.
    """
    done = dict.fromkeys(name for name, formula in formulas.items() if formula is None)
    for first in formulas:
        way: dict[str, list[str]] = {}  # parameters that are being worked out -> what they still wait for
        name = first
        while name not in done:
            formula = formulas[name]
            assert formula is not None, "numbers are done"
            waiting = way.setdefault(name, list(dict.fromkeys(names(formula)))[::-1])
            while waiting and waiting[-1] in done:
                waiting.pop()
            if not waiting:
                done[name] = None
                del way[name]
                name = next(reversed(way), first)
                continue
            name = waiting[-1]
            if name in way:
                circle = [*list(way)[list(way).index(name) :], name]
                told = " -> ".join(circle if len(circle) <= _TOLD else [*circle[: _TOLD - 1], "...", name])
                raise InputError(f"{where}.{name}", "a formula that does not lead back to its own parameter", told)
    return list(done)


def derived(parameters: Iterable[Parameter], given: Container[str] = ()) -> list[tuple[str, Expr]]:
    """Return name and formula of the parameters that follow from others, each behind those it depends on.

    Parameters
    ----------
    parameters : iterable of Parameter
        Of a mechanism.
    given : container of str
        Those that have numbers in place of their formulas.
    """
    formulas = {p.name: None if p.name in given else p.formula for p in parameters}
    found: Sequence[str] = in_order(formulas, "parameters") if any(formulas.values()) else ()
    return [(name, formula) for name in found if (formula := formulas[name]) is not None]
