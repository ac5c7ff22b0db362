"""Numbers that change nothing of what a run reports, in words: of sweeps, of fits and of derivatives alike."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.errors import enumeration


def unmoved_sentence(names: Sequence[str], among: str) -> str:
    """Return the sentence on numbers that change nothing.

    Parameters
    ----------
    names : sequence of str
        A number, or numbers that change together.
    among : str
        Of what they change nothing, such as ``"that was measured"``.
    """
    return f"{enumeration(names)} {'changes' if len(names) == 1 else 'change'} nothing {among}"
