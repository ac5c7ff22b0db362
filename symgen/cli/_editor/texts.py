"""Texts of an editor as they are read one after the other: another number costs neither a parser nor other code."""

from __future__ import annotations

from typing import Any, NamedTuple

from symgen.describe.edits.rereading import ReadText, read_text_after
from symgen.describe.facts.lifted import (
    Lifted,
    lifted_with_numbers,
    name_of_changeable,
    numbers_as_parameters,
    path_in_words,
)
from symgen.describe.files.origins import Source
from symgen.describe.files.places import DocumentOutline
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism


class Draft(NamedTuple):
    """A text, and the mechanism that it describes."""

    read: ReadText
    mechanism: Mechanism

    @property
    def raw(self) -> dict[str, Any]:
        """Its tables."""
        return self.read.raw

    @property
    def outline(self) -> DocumentOutline:
        """Its parts by characters."""
        return self.read.outline


class Texts:
    """The last text that was read, and the last mechanism whose numbers are parameters.

    Parameters
    ----------
    source : Source
        The file, for messages.
    """

    def __init__(self, source: Source) -> None:
        self.source = source
        self._last: Draft | None = None
        self._lifted: tuple[ReadText, Lifted] | None = None

    def read(self, text: str) -> Draft:
        """Return a text as it is read; the last one is read once.

        Raises
        ------
        InputError
            If it describes no mechanism.
        """
        last = self._last
        if last is None or last.read.text != text:
            read = read_text_after(None if last is None else last.read, text, self.source)
            self._last = last = Draft(read, validate(read.raw, self.source))
        return last

    def for_runs(self, draft: Draft) -> Mechanism:
        """Return the mechanism whose code stays what it is while a hand changes numbers of the file."""
        lifted = self._lifted_before(draft)
        if lifted is None:
            lifted = numbers_as_parameters(draft.mechanism)
        self._lifted = draft.read, lifted
        return lifted.mechanism

    def for_starts(self, draft: Draft) -> Mechanism:
        """Return the same where it is at hand, else the mechanism itself: a start is there sooner then."""
        lifted = self._lifted_before(draft)
        return draft.mechanism if lifted is None else lifted.mechanism

    def _lifted_before(self, draft: Draft) -> Lifted | None:
        """Return the last mechanism with the numbers of another text; None where these are no parameters of it."""
        if self._lifted is None:
            return None
        read, lifted = self._lifted
        if read.kind is not draft.read.kind:
            return None
        changed = draft.read.changed_numbers(read)
        named = {name_of_changeable(path_in_words(path), path, value): value for path, value in changed.items()}
        was_zero = any(not value for value in read.changed_numbers(draft.read).values())
        return None if was_zero or "" in named else lifted_with_numbers(lifted, named)
