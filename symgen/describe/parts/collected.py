"""What happens with an error of a description: the first one ends its reading, or all are collected."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager
from types import TracebackType
from typing import Any, TypeVar

from symgen.base.errors import InputError

T = TypeVar("T")

#: What a message quotes, up to a dot: the name that was looked up.
_QUOTED = re.compile(r"""['"]([^'".]+)""")


class Incomplete(Exception):
    """What is being read needs something that is wrong, which is reported already."""


#: How the sentence of a wrong formula begins, in place of which a number may stand.
FORMULAS = ("a number or an expression", "an expression of")
#: How often a table with wrong formulas is read at most.
MOST_READS = 60


def further_errors(read: Callable[[Any], object], table: object, error: InputError) -> tuple[InputError, ...]:
    """Return what else is wrong in a table: it is read again with a number in place of each formula that is wrong.

    Parameters
    ----------
    read : callable
        What reads the table.
    table : object
        The table, as the file has it.
    error : InputError
        What is wrong first.
    """
    found, filled, reads = list[InputError](), set[str](), 0

    def error_of(changed: Mapping[str, Any]) -> InputError | None:
        nonlocal reads
        reads += 1
        try:
            read(changed)
        except InputError as other:
            return other
        except Incomplete:
            return None
        return None

    while isinstance(table, Mapping) and error.expected.startswith(FORMULAS) and reads < MOST_READS:
        key = next((key for key in table if f".{key}." in f"{error.where}.".replace("[", ".[")), None)
        if key is None or key in filled:  # a number is not what it takes
            break
        whole = _with_numbers(table[key])
        for part in _with_one_number(table[key]):  # the one whose number changes what is wrong
            if reads >= MOST_READS or part == whole:  # then no text is left that could be wrong as well
                continue
            other = error_of(mended := {**table, key: part})
            alike = other is not None and (other.where, other.expected) == (error.where, error.expected)
            if alike and str(other) != str(error):
                break
        else:
            filled.add(key)
            other = error_of(mended := {**table, key: whole})
        if other is None or any(f".{name}." in f"{other.where}.".replace("[", ".[") for name in filled):
            break
        table, error = mended, other
        found += [error, *error.further]
    return tuple(found)


def _with_numbers(value: object) -> object:
    """Return a value with a number in place of each of its texts."""
    if isinstance(value, str):
        return 1.0
    if isinstance(value, list):
        return [_with_numbers(item) for item in value]
    return {key: _with_numbers(item) for key, item in value.items()} if isinstance(value, Mapping) else value


def _with_one_number(value: str | float | list[Any] | Mapping[str, Any]) -> Iterator[object]:
    """Yield a value with a number in place of one of its texts, each in turn."""
    if isinstance(value, str):
        yield 1.0
    elif isinstance(value, list):
        for i, item in enumerate(value):
            yield from ([*value[:i], other, *value[i + 1 :]] for other in _with_one_number(item))
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield from ({**value, key: other} for other in _with_one_number(item))


class Errors:
    """Errors in the parts of a description.

    Parameters
    ----------
    all_of_them : bool, optional
        Collect the errors of all parts, without those that follow from others; else the first one is raised.

    Attributes
    ----------
    found : dict
        What was collected, in order, by its sentence.
    """

    def __init__(self, all_of_them: bool = False) -> None:
        self.found: dict[str, InputError] = {}
        self._all = all_of_them
        self._wrong = set[str]()  # names of bodies, joints, parameters, ... that could not be read

    def part_of_description(self, *names: str) -> AbstractContextManager[None, bool]:
        """Return the context of a part; where errors are collected, reading goes on after it.

        Parameters
        ----------
        *names : str
            Names that are unknown to the rest if the part is wrong.
        """
        return _Apart(self, names) if self._all else _PASSED_ON

    @property
    def all_of_them(self) -> bool:
        """Whether errors are collected."""
        return self._all

    def read_whole(self, read: Callable[[Any], T], table: object) -> T:
        """Return the part that `read` reads from a table; where errors are collected, each wrong formula is one."""
        try:
            return read(table)
        except InputError as error:
            if self._all:
                error.further += further_errors(read, table, error)
            raise

    def leave_if_wrong(self, *names: str) -> None:
        """Leave the part being read if one of `names` stands for something wrong."""
        if not self._wrong.isdisjoint(names):
            raise Incomplete

    def leave_if_any(self) -> None:
        """Leave the description if a part of it is wrong."""
        if self.found:
            raise Incomplete

    def keep_error(self, error: InputError | Incomplete, names: tuple[str, ...]) -> None:
        """Keep an error unless it quotes a name that stands for something wrong; `names` do so from now on."""
        for each in (error, *error.further) if isinstance(error, InputError) else ():
            if self._wrong.isdisjoint(_QUOTED.findall(each.got)):
                self.found.setdefault(str(each), each)
        self._wrong.update(names)


class _Apart(AbstractContextManager[None, bool]):
    """A part of a description: its errors are noted and end here; without `errors` they pass."""

    def __init__(self, errors: Errors | None, names: tuple[str, ...]) -> None:
        self.errors, self.names = errors, names

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> bool:
        if self.errors is None or not isinstance(error, InputError | Incomplete):
            return False
        self.errors.keep_error(error, self.names)
        return True


_PASSED_ON = _Apart(None, ())
