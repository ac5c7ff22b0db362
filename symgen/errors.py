"""Every error symgen raises on purpose, with the exit code the command line gives it."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class SymgenError(Exception):
    """Base of all errors whose text is one sentence written for the person at the keyboard."""

    exit_code = 1


class InputError(SymgenError):
    """The description of a mechanism, an option or a command is wrong.

    Parameters
    ----------
    where : str
        File and key, or option, that is wrong, e.g. ``"crane.toml: bodies.boom.mass"``.
    expected : str
        What would have been valid.
    got : str
        What was found.
    hint : str, optional
        Nearest valid spelling or what to do next.
    """

    exit_code = 2

    def __init__(self, where: str, expected: str, got: str, hint: str = "") -> None:
        self.where, self.expected, self.got, self.hint = where, expected, got, hint
        super().__init__(f"{where}: expected {expected}, got {got}" + (f"; {hint}" if hint else ""))


class AssemblyError(SymgenError):
    """The mechanism cannot be closed from the given start; says which joint stays open and by how much."""

    exit_code = 2


class SimulationError(SymgenError):
    """A run could not be started or its result cannot be used."""


def nearest(word: str, known: Iterable[str]) -> str:
    """Return the hint ``did you mean 'x'?`` for the closest known word, or the list of known words."""
    names = sorted(known)
    close = difflib.get_close_matches(word, names, n=1, cutoff=0.6)
    if close:
        return f"did you mean '{close[0]}'?"
    return "known: " + ", ".join(names) if names else ""
