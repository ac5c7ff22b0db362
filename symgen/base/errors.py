"""Errors raised by symgen, their exit codes on the command line, and helpers for their messages.

Whatever a message repeats of a file or an argument goes through `quote`, so that it is short and printable.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from symgen.base.escapes import printable

if TYPE_CHECKING:
    from symgen.base.vocabulary.quantities import Counted

#: Characters at most of a part of a message, such as what was found, of the place it begins with, whose names come from
#: files, and of a text that it repeats in quotes.
LONGEST_PART, LONGEST_PLACE, LONGEST_QUOTE = 1000, 240, 60
#: Known names that a hint lists at most, that it compares a word with at most, and the length of such a word.
MOST_LISTED, MOST_COMPARED, LONGEST_COMPARED = 60, 2000, 64
#: Share of letters that two spellings of one word have in common.
CLOSE = 0.6
#: Characters of what was expected above which a likely spelling is said first.
LONGEST_FIRST = 60


class SymgenError(Exception):
    """Base of all errors; the text is one printable sentence for the user."""

    exit_code = 1

    def __str__(self) -> str:
        return printable(super().__str__())


def sentence_of_parts(expected: str, got: str, hint: str) -> str:
    """Return what was expected, what was found and the hint in one sentence: a likely spelling before a long list."""
    if hint.startswith("did you mean") and len(expected) > LONGEST_FIRST:
        return f"got {got}; {hint} (expected {expected})"
    return f"expected {expected}, got {got}" + (f"; {hint}" if hint else "")


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
        Nearest valid spelling or a remedy.
    key : str, optional
        The key in the table `where` that is wrong, where the sentence names it among what was found.

    Attributes
    ----------
    file : path or None
        The mechanism file, where the error is about its text.
    further : tuple of InputError
        What else is wrong in the same table.
    """

    exit_code = 2
    file: Path | None = None
    further: tuple[InputError, ...] = ()

    def __init__(self, where: str, expected: str, got: str, hint: str = "", key: str = "") -> None:
        self.key = key
        self.where = where if len(where) <= LONGEST_PLACE else f"{where[:160]}...{where[-60:]}"
        self.expected, self.got, self.hint = (
            text if len(text) <= LONGEST_PART else f"{text[:LONGEST_PART]}..." for text in (expected, got, hint)
        )
        super().__init__(f"{self.where}: {sentence_of_parts(self.expected, self.got, self.hint)}")

    def __reduce__(self) -> tuple[type, tuple[str, str, str, str, str]]:
        return type(self), (self.where, self.expected, self.got, self.hint, self.key)


class AssemblyError(SymgenError):
    """The mechanism cannot be closed from the given start; says which joint stays open and by how much.

    Parameters
    ----------
    message : str
        The sentence.
    joints : tuple of str
        Joints that stay open, empty for other causes.
    q : tuple of float
        Coordinates of all bodies where closing stopped, for a picture; empty if unknown.
    """

    exit_code = 2

    def __init__(self, message: str, joints: tuple[str, ...] = (), q: tuple[float, ...] = ()) -> None:
        self.joints, self.q = joints, q
        super().__init__(message)

    def __reduce__(self) -> tuple[type, tuple[str, tuple[str, ...], tuple[float, ...]]]:
        return type(self), (str(self), self.joints, self.q)

    def with_coordinates(self, q: Iterable[float]) -> AssemblyError:
        """Return the same error with the coordinates where closing stopped."""
        return type(self)(str(self), self.joints, tuple(q))


class SimulationError(SymgenError):
    """A run could not be started or its result cannot be used."""


class AnalysisError(SymgenError):
    """An analysis has no answer: no equilibrium was found, eigenvalues did not converge."""


class StepError(SimulationError):
    """A step of a stepped run failed; the run stays at the last accepted state.

    Parameters
    ----------
    reason : str
        The reason, as in results.
    time : float
        Where the failed step was to end, or began if it came to nothing [s].
    """

    def __init__(self, reason: str, time: float) -> None:
        self.reason, self.time = reason, time
        super().__init__(reason)

    def __reduce__(self) -> tuple[type, tuple[str, float]]:
        return type(self), (self.reason, self.time)


@contextmanager
def refuse_overflow(where: str, hint: str = "") -> Iterator[None]:
    """Refuse numbers of formulas that overflow where they meet; `where` and `hint` as of `InputError`."""
    try:
        yield
    except OverflowError:
        expected = "numbers whose products, sums and quotients are finite"
        raise InputError(where, expected, "some that overflow", hint) from None


def quote(text: object, longest: int = LONGEST_QUOTE) -> str:
    """Return `text` in quotes, shortened and without control characters, fit for a one-line message."""
    if isinstance(text, str):
        shown = repr(text[:longest])  # a text may be as long as a file
        return shown if len(text) <= longest and len(shown) <= longest else f"{shown[: longest - 4]}...{shown[0]}"
    try:
        shown = "'" + printable(str(text)) + "'"
    except Exception:  # the `str` of a foreign object may raise anything
        return f"an object of type '{type(text).__name__}'"
    return shown if len(shown) <= longest else shown[: longest - 4] + "...'"


def fit_lines(count: int, most: int) -> int:
    """Return how many of `count` lines to show: `most`, or all where only one would be left out."""
    return count if count <= most + 1 else most


def enumeration(words: Sequence[str], last: str = "and") -> str:
    """Return words as an enumeration: a, b and c."""
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} {last} {words[-1]}"


def plural(n: int, one: str, many: str = "") -> str:
    """Return a count with its noun: 1 run, 3 runs."""
    return f"{n} {one if n == 1 else many or one + 's'}"


def sizes_in_words(sized: Counted) -> str:
    """Return sizes with their nouns: 3 coordinates, 3 velocities, 1 constraint row."""
    velocities = plural(sized.nv, "velocity", "velocities")
    return f"{plural(sized.nq, 'coordinate')}, {velocities}, {plural(sized.m, 'constraint row')}"


def suggest(word: str, candidates: Iterable[str]) -> str:
    """Return the hint ``did you mean 'x'?`` for the closest known word, or the list of known words."""
    names = sorted(set(candidates))
    if len(word) <= LONGEST_COMPARED:
        alike = [name for name in names if 2 * min(len(name), len(word)) >= CLOSE * (len(name) + len(word))]
        if len(alike) > MOST_COMPARED:
            alike.sort(key=lambda name: sum(a != b for a, b in zip(name, word, strict=False)))
        same = [name for name in alike if name.casefold() == word.casefold()]
        close = same or difflib.get_close_matches(word, alike[:MOST_COMPARED], n=1, cutoff=CLOSE)
        if close:
            return f"did you mean '{close[0]}'?"
    first = fit_lines(len(names), MOST_LISTED)
    more = f" and {len(names) - first} more" if len(names) > first else ""
    return "known: " + ", ".join(names[:first]) + more if names else ""
