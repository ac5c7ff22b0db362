"""Why a run has no modes: one table of sentences, for single runs, rows of sweeps, C and FMUs.

A fault is a code of `symgen.run.modes.bounded_rows` with the row, or the rows, at which it is found, and at most two
numbers. Fields of sentences are names of rows and numbers with their formats, which Python and C write alike.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from symgen.base.errors import InputError
from symgen.run.effects.applying import AT_ITS_LIMIT, CONTRADICTED, NOT_IN_PLACE
from symgen.run.modes.bounded_rows import (
    CONTRARY,
    DISAGREED,
    GAINED,
    IMMOVABLE,
    JAMMED,
    NEGATIVE_GAP,
    NO_BOUND_IN_MOTION,
    NO_BOUNDS,
    NO_CONTACT_MODES,
    NO_FORCES,
    NO_NUMBER,
    NO_RESTITUTION,
    NOT_APPLIED,
    NOT_FINITE,
    NOTHING_FOUND,
    REDUNDANT,
    SEVERAL_BY_REACTION,
    SEVERAL_MODES,
    TWO_PIECES,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.run.loops.run_spec import BoundedNames


class Sentence(NamedTuple):
    """What is wrong, what was expected, what was found and what to do.

    Fields: ``kind``, ``kinds``, ``name`` of the row at fault; ``names`` of several rows; ``hits`` of their impacts;
    ``a_kind``, ``all`` of the first row; ``by_reaction``, ``pressed``, what depends on reactions and where; ``gaps``;
    ``drivers``, all of them; ``row`` of the mechanism; ``modes`` and ``others``, what contacts do; ``first`` and
    ``second``, numbers; ``t``, the time [s].
    """

    where: str
    expected: str
    got: str
    hint: str = ""


#: Faults that only runs with these kinds of rows have (`symgen.run.loops.run_spec.Watched.turning`).
OF_KIND = {
    TWO_PIECES: {"corners"},
    NO_CONTACT_MODES: {"contacts"},
    NOTHING_FOUND: {"contacts"},
    SEVERAL_MODES: {"contacts"},
    GAINED: {"contacts", "reactions"},
    SEVERAL_BY_REACTION: {"pressed", "reactions"},
}
#: Sentences by their codes.
SENTENCES = {
    NEGATIVE_GAP: Sentence(
        "{kind} {name}", "a gap of at least 0", "{first:.6g} at t = {t:.6g} s", "a start within all {kinds}"
    ),
    NO_NUMBER: Sentence("{kind} of {name}", "formulas that stay defined", "one that is no number after t = {t:.6g} s"),
    NO_RESTITUTION: Sentence("{kind} {name}", "a restitution from 0 to 1", "{first:g}"),
    NO_BOUND_IN_MOTION: Sentence("{kind} of {name}", "a bound in motion above 0, as that at rest is above 0", "0"),
    NO_BOUNDS: Sentence(
        "{kind} of {name}",
        "bounds of at least 0, at rest at least that in motion",
        "{first:g} at rest and {second:g} in motion",
    ),
    NOT_FINITE: Sentence("{a_kind}", "accelerations that are finite", "others at t = {t:.6g} s"),
    NO_FORCES: Sentence("{a_kind}", "forces at rest that can be found", "none after many changes"),
    JAMMED: Sentence(
        "{by_reaction} of {name}",
        "{by_reaction} that brings about less than all of its own reaction (a jamming number below 1)",
        "{first:.12g} at t = {t:.9g} s",
    ),
    REDUNDANT: Sentence(
        "{by_reaction} of {pressed}",
        "rows that determine all reactions, where {by_reaction} depends on one",
        "{row}, which other rows determine",
    ),
    DISAGREED: Sentence("{by_reaction}", "bounds and reactions that agree", "others at {pressed} after many changes"),
    IMMOVABLE: Sentence(
        "{kind} {name}",
        "an impact that can change the rate of the gap",
        "a rate of {first:.6g} at t = {t:.6g} s that joints{drivers} determine",
    ),
    CONTRARY: Sentence(
        "{gaps}", "a motion in which no gap becomes negative", "none that {names} allow at t = {t:.6g} s"
    ),
    TWO_PIECES: Sentence(
        "{kind} {name}",
        "a gap of which one piece pushes at a corner",
        "two at t = {t:.6g} s",
        "a stop for each piece",
    ),
    NO_CONTACT_MODES: Sentence(
        "contact {name}",
        "a finite force",
        "none at t = {t:.9g} s: its mobility less that of its friction is {first:.6g} (at most 0 jams)",
        "a smaller coefficient of friction",
    ),
    NOTHING_FOUND: Sentence(
        "contact {name}",
        "forces within the bounds of all contacts and friction that depend on each other",
        "none that are found at t = {t:.9g} s among {first:.0f} rows",
        "a smaller coefficient of friction",
    ),
    SEVERAL_MODES: Sentence("contacts", "one motion at t = {t:.9g} s", "several: {modes}, and {others}"),
    SEVERAL_BY_REACTION: Sentence("{by_reaction}", "one motion at t = {t:.9g} s", "several, which differ at {names}"),
    GAINED: Sentence(
        "{kind} {name}",
        "an impact that adds no energy",
        "one that adds {first:.12g} J at t = {t:.9g} s, as Newton's law may with friction or several impacts at once",
    ),
    NOT_APPLIED: Sentence(
        "{hits}: reset", "velocities that the joints and each other allow", "others at t = {t:.6g} s"
    ),
}


#: Sentences on joints that hold for a while: on the event ``event``, with the distance ``first``, at the time ``t``.
HOLDING_SENTENCES = {
    NOT_IN_PLACE: Sentence(
        "event '{event}'",
        "a joint in its place where it catches",
        "one that is off by {first:.3g} of the mechanism's length, or rad, at t = {t:.6g} s",
        "holds_at = 'present' holds it where it is",
    ),
    CONTRADICTED: Sentence(
        "event '{event}'",
        "a condition that the catch leaves true",
        "one that it makes false at t = {t:.6g} s",
        "two conditions: holds = {{ catches = ..., releases = ... }}",
    ),
    AT_ITS_LIMIT: Sentence(
        "event '{event}'",
        "a condition that goes on to change where the joint holds",
        "one that the joint keeps at its limit from t = {t:.6g} s on",
        "two conditions: holds = {{ catches = ..., releases = ... }}",
    ),
}


def refusal_of_catch(code: int, event: str, first: float, t: float) -> InputError:
    """Return the error on a joint that cannot hold, by its code, the event, a number and the time [s]."""
    return InputError(*(text.format(event=event, first=first, t=t) for text in HOLDING_SENTENCES[code]))


def fixed_words(rows: BoundedNames) -> dict[str, str]:
    """Return the fields that are the same at all faults of a run."""
    pressed = rows.pressed
    return {
        "a_kind": rows.kinds[0],
        "all": rows.nouns[0],
        "by_reaction": rows.kinds[pressed[0]] if pressed else "",
        "pressed": ", ".join(rows.names[i] for i in pressed),
        "gaps": rows.nouns[rows.dry] if rows.dry < len(rows.names) else "",
        "drivers": "".join(f" and the driver {name}" for name in rows.drivers),
    }


def modes_in_words(rows: BoundedNames, digits: float, many: str) -> str:
    """Return what contacts do in modes that are the digits of a number to the base of 4; `many` without a number."""
    if not digits >= 0.0:
        return many
    words, number = list[str](), int(digits)
    modes = [number // 4**i % 4 for i in range(len(rows.names))]
    for i in rows.contacts:
        slip = modes[rows.partners[i]] if rows.partners[i] >= 0 else 1
        words.append(f"{rows.names[i]} {'opens' if modes[i] == 0 else _DOES[slip]}")
    return ", ".join(words)


#: What a closed contact does by the mode of its friction.
_DOES = ("slides freely", "sticks", "slides forwards", "slides backwards")


def names_in(which: float, names: Sequence[str]) -> list[str]:
    """Return the names whose powers of 2 are in a sum, each once."""
    return list(dict.fromkeys(name for i, name in enumerate(names) if int(which) >> i & 1))


def hits_of(names: Sequence[str]) -> str:
    """Return the impacts of some rows in words."""
    return f"event{'s' * (len(names) > 1)} " + " and ".join(f"'{name}.hit'" for name in names)


def refusal(
    rows: BoundedNames, every: Sequence[str], code: int, which: float, first: float, second: float, t: float
) -> InputError:
    """Return the error on a state without modes.

    Parameters
    ----------
    rows : BoundedNames
        The rows with bounds of the run.
    every : sequence of str
        Names of all rows of the mechanism.
    code : int
        The fault.
    which : float
        The row; a sum of powers of 2 for several.
    first, second : float
        Numbers.
    t : float
        Time [s].
    """
    sentence, place = SENTENCES[code], int(which) if which >= 0.0 else 0
    own = place if place < len(rows.names) else 0
    names = names_in(which, rows.names) if which >= 0.0 else []
    words = {
        **fixed_words(rows),
        **{"kind": rows.kinds[own], "kinds": rows.nouns[own], "name": rows.names[own]},
        **{"names": ", ".join(names), "hits": hits_of(names)},
        "row": every[place] if place < len(every) else "a row",
        "modes": modes_in_words(rows, first, "one of many contacts"),
        "others": modes_in_words(rows, second, "another one"),
    }
    return InputError(*(text.format(**words, first=first, second=second, t=t) for text in sentence))
