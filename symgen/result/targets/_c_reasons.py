"""Reasons for the ends of runs in C: the sentences of runs, with formats for their numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from string import Formatter
from typing import TYPE_CHECKING, Any, NamedTuple

from symgen.describe.bounds.advice import JUMPING
from symgen.describe.bounds.bounded_modes import MODE
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.modes.refusals import HOLDING_SENTENCES, OF_KIND, SENTENCES, Sentence, fixed_words
from symgen.run.planning.dead_centre import ENDS
from symgen.run.printed.kept_run import END_CODE, END_TIME
from symgen.run.single.run import STIFF

if TYPE_CHECKING:
    from symgen.run.compiling.printed_run import PrintedRun
    from symgen.run.loops.run_spec import BoundedRows, RunSpec

_AT = " at t = %.6g s"


class Reason(NamedTuple):
    """A reason: the code of an end, a format, and expressions for its numbers."""

    code: int
    format: str
    arguments: str


def reasons_of(run: PrintedRun) -> list[Reason]:
    """Return the reasons for which a run may end before its time."""
    return [Reason(code, c_text(text), numbers) for code, text, numbers in _reasons(run)]


def values_of_ends(run: PrintedRun) -> dict[str, Any]:
    """Return the values of templates for the ends of a run."""
    watched = run.watched
    names = () if watched is None else watched.names
    return {
        "reasons": reasons_of(run),
        "watched": ", ".join(map(c_text, names)),
        "gathers": watched is not None and watched.effects is not None,
        "bounded_words": None if watched is None or watched.bounded is None else _words(watched.bounded, run),
        "holding": watched is not None and watched.holding,
        "own_events": sum(action != MODE for action in (() if watched is None else watched.actions)),
        "codes": {
            **{"place": END_CODE, "event": e.IMPOSSIBLE_EVENT, "which": e.GATHERING, "accumulation": e.ACCUMULATION},
            **{"sine": abi.LAST_SINE, "fall": abi.FALL, "zone": abi.IN_ZONE, "step": abi.STEP},
            "locking": " || ".join(f"code == {code}" for code in ENDS),
            **{"impossible": e.IMPOSSIBLE, "unprepared": abi.UNPREPARED, "gathered": abi.GATHERED},
            **{"no_modes": e.NO_MODES, "failure": e.FAILURE, "rows": e.WHICH},
            **{"first_of_holding": min(HOLDING_SENTENCES), "last_of_holding": max(HOLDING_SENTENCES)},
        },
    }


def _words(rows: BoundedRows, run: PrintedRun) -> dict[str, str]:
    """Return the words of the rows with bounds, and the names of all rows, as texts of C."""
    every = [row.name for row in run.compiled.info.rows]
    lists = {"bounded": rows.names, "kinds": rows.kinds, "all": rows.nouns, "rows": every or [""]}
    return {name: ", ".join(map(c_text, words)) for name, words in lists.items()} | {"count": str(len(rows.names))}


def c_text(text: str) -> str:
    """Return a text as a string of C in ASCII; signs with a meaning, and bytes beyond ASCII, are octal numbers."""
    plain = (chr(x) if 32 <= x < 127 and chr(x) not in '"\\?' else f"\\{x:03o}" for x in text.encode())
    return f'"{"".join(plain)}"'


def _reasons(run: PrintedRun) -> Iterator[tuple[int, str, str]]:
    """Yield codes, formats and their content."""
    spec, words = run.spec, {code: text.replace("%", "%%") for code, text in abi.REASONS.items()}
    jumps = run.watched is not None and run.watched.jumps
    jumping = f"{JUMPING}; {spec.in_place}".replace("%", "%%")
    for code in (abi.NOT_FINITE, abi.CORRECTION, abi.VANISHED, abi.UNPREPARED, abi.JUMPED, abi.TURNED):
        yield code, words[code] + _AT, "t"
    phi, drift = _numbers(abi.PHI_MEASURE, abi.LENGTH), _numbers(abi.DRIFT_MEASURE, abi.SPEED)
    yield abi.POSITION, f"{words[abi.POSITION]} (%.3g > {spec.max_violation:g} x %.3g){_AT}", f"{phi}, t"
    yield abi.VELOCITY, f"{_velocities(spec)} (%.3g > {spec.velocity_limit:g} x %.3g){_AT}", f"{drift}, t"
    energy = f"(double)model->run_gauges[{abi.ENERGY_SCALE}]"
    yield abi.ENERGY, f"{words[abi.ENERGY]} ({spec.max_energy_error:g} of %.3g J){_AT}", f"{energy}, t"
    yield abi.TINY_STEP, f"{words[abi.TINY_STEP]}{_AT}" + (f"; {jumping}" if jumps else ""), "t"
    if spec.adaptive:
        attempts = f"(model->run_control[{abi.STEPS}] + model->run_control[{abi.REJECTED}])"
        rest = "at the present rate the rest would take more than"
        yield (
            abi.NO_PROGRESS,
            f"{words[abi.NO_PROGRESS]}: %d attempts at a step brought it to t = %.6g of %g s, and %s max_attempts = "
            f"{spec.max_attempts:g}; {jumping if jumps else STIFF}",
            f"{attempts}, t, (double)model->run_shown[{END_TIME}], "
            f'{attempts} < {spec.max_attempts!r} ? "{rest}" : "that is all of"',
        )
    if run.watched is not None and run.watched.names:
        yield abi.UNDEFINED, f"the condition of the event '%s' is undefined{_AT}", "event, t"
        reset = "reset: expected velocities that the joints and each other allow, got others"
        yield e.IMPOSSIBLE, f"event '%s': {reset}{_AT}", "event, t"
    if run.watched is not None and run.watched.holding:
        of_event = {"event": "event", "first": f"(double)model->run_events[{e.FIRST_NUMBER}]", "t": "t"}
        for fault, sentence in HOLDING_SENTENCES.items():
            yield (-fault, *_format_and_arguments(sentence, {}, of_event))
    if run.watched is not None and run.watched.bounded is not None:
        yield from _faults(run.watched.bounded, run.watched.turning)


def _faults(rows: BoundedRows, turning: Sequence[str]) -> Iterator[tuple[int, str, str]]:
    """Yield the faults of modes with the sentences of runs; their codes are negative, codes of ends positive."""
    fixed, of_row = (
        fixed_words(rows),
        {"kind": "kinds[at]", "kinds": "all[at]", "name": "bounded[at]", "row": "rows[at]"},
    )
    of_row |= {"names": "names", "hits": "hits", "t": "t"}
    of_row |= {"modes": c_text("modes of contacts"), "others": c_text("other ones")}
    of_row |= {"first": f"(double)model->run_events[{e.FIRST_NUMBER}]"}
    of_row |= {"second": f"(double)model->run_events[{e.SECOND_NUMBER}]"}
    for fault, sentence in SENTENCES.items():
        if fault in OF_KIND and OF_KIND[fault].isdisjoint(turning):
            continue
        yield (-fault, *_format_and_arguments(sentence, fixed, of_row))


def _format_and_arguments(
    sentence: Sentence, fixed: Mapping[str, str], arguments_of: Mapping[str, str]
) -> tuple[str, str]:
    """Return a sentence as a format of C and its arguments, by the fields that are the same in a run and the others."""
    where, expected, got, hint = sentence
    text = f"{where}: expected {expected}, got {got}" + (f"; {hint}" if hint else "")
    format_, arguments = "", list[str]()
    for literal, field, spec, _ in Formatter().parse(text):
        format_ += literal.replace("%", "%%")
        if field and field in fixed:
            format_ += fixed[field].replace("%", "%%")
        elif field:
            format_ += f"%{spec or 's'}"
            arguments.append(arguments_of[field])
    return format_, ", ".join(arguments)


def _numbers(*places: int) -> str:
    return ", ".join(f"(double)w[{place}]" for place in places)


def _velocities(spec: RunSpec) -> str:
    words = abi.REASONS[abi.VELOCITY]
    return words if spec.max_velocity_violation is None else words.replace("max_violation", "the root of max_violation")
