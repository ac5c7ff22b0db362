"""What happens with an error of a description: the first one ends its reading, or all are collected."""

from __future__ import annotations

import re
from contextlib import AbstractContextManager
from types import TracebackType

from symgen.base.errors import InputError

#: What a message quotes, up to a dot: the name that was looked up.
_QUOTED = re.compile(r"""['"]([^'".]+)""")


class Incomplete(Exception):
    """What is being read needs something that is wrong, which is reported already."""


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
        if isinstance(error, InputError) and self._wrong.isdisjoint(_QUOTED.findall(error.got)):
            self.found.setdefault(str(error), error)
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
