"""Contacts whose forces are not unique, as those that share a direction, and motions that were not sought."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symgen.run.loops.run_spec import BoundedNames
from symgen.run.modes.bounded_rows import AT_REST, CONSTANT, HELD, SIGN

#: What is said where motions were not sought among so many rows.
NOT_SOUGHT = "other motions were not sought among {} rows of contacts and friction"


def sharing_contacts(rows: BoundedNames, modes: NDArray[np.float64]) -> set[str]:
    """Return the contacts whose forces are not unique, with those that carry them.

    Parameters
    ----------
    rows : BoundedNames
        Rows with bounds.
    modes : Array, shape (rows, MODE_NUMBERS)
        Their modes.
    """
    found = set[str]()
    for i, numbers in enumerate(modes):
        of_contact = i in rows.contacts or rows.partners[i] >= 0
        if of_contact and numbers[HELD] == numbers[SIGN] == 0.0 and numbers[CONSTANT] != 0.0:
            found.add(rows.names[i])
            if numbers[CONSTANT] != AT_REST:
                found.add(rows.names[int(numbers[CONSTANT]) - 1])
    return found


def sentence_on_motions(unsought: int) -> list[str]:
    """Return a note on motions that were not sought, among so many rows; none among 0."""
    return [NOT_SOUGHT.format(unsought)] if unsought > 0 else []


def sentence_on_sharing(names: set[str]) -> list[str]:
    """Return a note on contacts whose forces are not unique, if any."""
    if not names:
        return []
    contacts = ", ".join(sorted(names))
    return [f"forces of contacts are not unique at {contacts}: each has a part in proportion to its bound"]
