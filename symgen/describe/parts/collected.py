"""What happens with an error of a description: the first one ends its reading, or all are collected."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from types import TracebackType
from typing import Any

from symgen.base.errors import InputError

#: What a message quotes, up to a dot: the name that was looked up.
_QUOTED = re.compile(r"""['"]([^'".]+)""")


class Incomplete(Exception):
    """What is being read needs something that is wrong, which is reported already."""


#: How the sentence of a wrong formula begins, in place of which a number may stand.
FORMULA = "a number or an expression"


def errors_in_other_keys(read: Callable[[Any], object], table: object, error: InputError) -> tuple[InputError, ...]:
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
    found, mended = list[InputError](), set[str]()
    while isinstance(table, Mapping) and error.expected.startswith(FORMULA):
        key = next((key for key in table if f".{key}." in f"{error.where}.".replace("[", ".[")), None)
        if key is None or key in mended:
            break
        mended.add(key)
        table = {**table, key: _with_numbers(table[key])}
        try:
            read(table)
        except InputError as other:
            if any(f".{key}." in f"{other.where}.".replace("[", ".[") for key in mended):
                break
            error = other
            found += [error, *error.further]
        except Incomplete:
            break
        else:
            break
    return tuple(found)


def _with_numbers(value: object) -> object:
    """Return a value with a number in place of each of its texts."""
    if isinstance(value, str):
        return 1.0
    if isinstance(value, list):
        return [_with_numbers(item) for item in value]
    return {key: _with_numbers(item) for key, item in value.items()} if isinstance(value, Mapping) else value


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
