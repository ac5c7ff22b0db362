"""The report of one machine: drawing, motion, largest loads, curves, frequencies at rest, and how far to trust it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import numpy as np

from symgen.analyses.kinds import AnalysisTable
from symgen.analyses.kinds.modes import mode_lines as shown_modes
from symgen.analyses.reached_limits import ReachedLimit
from symgen.base.errors import SymgenError, enumeration, fit_lines, plural
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.drawing.drawing import Drawing
from symgen.result.extremes import without_doubles
from symgen.result.labelled import Labelled, columns_at
from symgen.result.summary import summary_lines
from symgen.study.machine_class import machine_class, version_list
from symgen.study.report.curves import LOADS, RATE, curves_of_run, in_degrees
from symgen.study.report.dead_points import outside_passages, passages
from symgen.study.report.document import DocumentTable, Letterhead, Picture, ReportDocument, Section, TableCell
from symgen.study.report.key_numbers import MOST_NUMBERS, KeyNumber
from symgen.study.report.letterhead import origin_of_file
from symgen.study.report.picture import MOST_BODIES
from symgen.study.report.verdict import judge_run
from symgen.study.report.words import engineering_number

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result

#: Positions of the motion that have pictures; six parts of a run of whole turns are not all alike.
POSITIONS = 7
#: Rows of a table at most.
MOST_ROWS = 60
#: The head of a report without one.
PLAIN = Letterhead()


def machine_report(
    model: Model,
    result: Result,
    command: str = "",
    over: str = "t",
    page: str = "",
    letterhead: Letterhead = PLAIN,
) -> ReportDocument:
    """Return the report of a machine.

    Parameters
    ----------
    model : Model
        The machine.
    result : Result
        Its run, which has outputs.
    command : str, optional
        The command that makes the report again.
    over : str
        Column along the horizontal axis of curves, such as ``crank.theta``.
    page : str, optional
        Name of the file beside the report that plays the motion.
    letterhead : Letterhead, optional
        Number and mark of the report, who signs it, and the size of its paper.

    Raises
    ------
    InputError
        If there is no such column, or matplotlib is missing.
    """
    along = in_degrees(result.along(over))
    facts = [
        *summary_lines(result),
        *((f"parameter {name}", value_with_unit(model, name, value)) for name, value in result.parameters.items()),
        ("versions", version_list()),
        ("machine", machine_class()),
    ]
    _, limits, numbers, verdict = judge_run(model.mechanism, result)
    sections = [
        *_first_section(model, result, numbers),
        *_remarks_section(model.mechanism, result),
        *_limits_section(limits, result.status == "failed"),
        *_motion_section(model, result),
        *_events_section(result),
        *_loads_section(result, along),
        Section("Curves", _text_on_curves(result), pictures=(*curves_of_run(result, along),)),
        *_frequencies_section(model, result),
    ]
    title = model.mechanism.title or model.name
    lead = _lead_sentence(result)
    origin = origin_of_file(model.mechanism, letterhead.number)
    return ReportDocument(
        title, (lead,), tuple(facts), command, tuple(sections), quote(page), verdict, origin, letterhead
    )


def value_with_unit(model: Model, name: str, value: float, noted: bool = True) -> str:
    """Return a parameter's value with its unit, as in the file, and with its note if that is wanted."""
    parameter = next((p for p in model.mechanism.parameters if p.name == name), None)
    number, unit = (value, "") if parameter is None else parameter.as_written(value)
    note = "" if parameter is None or not parameter.note or not noted else f", {parameter.note}"
    return f"{number:g} {unit}".removesuffix(" 1").strip() + note


def _lead_sentence(result: Result) -> str:
    span = f"from {result.t[0]:g} to {result.t[-1]:g} s" if len(result.t) else "without outputs"
    return f"{result.mechanism}, simulated {span} with {result.method} and {result.integrator}."


def _remarks_section(mechanism: Mechanism, result: Result) -> Iterator[Section]:
    """Yield the section of what is known of the model, and of what the run warns of, if anything is."""
    if said := (*mechanism.remarks, *result.warnings):
        yield Section("Remarks", tuple(f"{sentence}." for sentence in said))


def _loads_section(result: Result, along: Labelled) -> Iterator[Section]:
    """Yield the section of the largest loads; a failed run has none, as its last loads tell of the failure alone."""
    if result.status == "failed":
        return
    count, spans = int(np.sum(outside_passages(result))), passages(result) if result.rank_events else []
    left = ", ".join(f"{begin:.4g} to {end:.4g} s" for begin, end in spans)
    without = f" without those from {left}, near a singular position" if spans else ""
    text = f"Largest absolute values over {plural(count, 'output')}{without}; a peak between two outputs can be higher."
    yield Section("Largest loads", (text,), tables=(*_load_tables(result, along),))


def _first_section(model: Model, result: Result, numbers: Sequence[KeyNumber]) -> Iterator[Section]:
    """Yield the section with the picture of the motion beside the numbers that are asked for first.

    Of a failed run these are the position that it came to.
    """
    if not len(result.t):
        return
    rows = tuple((n.what, n.value, n.where) for n in numbers)
    table = DocumentTable("", ("", "largest", "when and where"), rows)
    if result.status == "failed":
        table = _position_at_the_end(model.mechanism, result)
    pictures = []
    if len(model.mechanism.bodies) <= MOST_BODIES:
        moving = Drawing.of_motion(model.mechanism, result.q.values, dict(result.parameters))
        pictures.append(sketch_picture("motion", "The start, later positions and paths", moving))
    yield Section("At a glance", tables=(table,) if table.rows else (), pictures=tuple(pictures), beside=True)


def _position_at_the_end(mechanism: Mechanism, result: Result) -> DocumentTable:
    """Return how far a failed run came: time and coordinates of joints there and at the start, the ground's first."""
    joints = result.whole(("joint_coordinates",))
    grounded = {joint.name for joint in mechanism.joints if GROUND in joint.bodies}
    chosen = [i for i, name in enumerate(joints.names) if not name.endswith(RATE)]
    chosen.sort(key=lambda i: joints.names[i].partition(".")[0] not in grounded)
    first, last = ([engineering_number(float(joints.values[k, i]), joints.units[i]) for i in chosen] for k in (0, -1))
    rows = [("time", f"{result.t[-1]:.4g} s", f"{result.t[0]:g} s, until {result.until:g} s")]
    rows += [(joints.names[i], there, start) for i, there, start in zip(chosen, last, first, strict=True)]
    return DocumentTable("", ("", "came to", "from"), tuple(rows[:MOST_NUMBERS]))


def _motion_section(model: Model, result: Result) -> Iterator[Section]:
    """Yield the section of pictures of the mechanism."""
    if len(model.mechanism.bodies) > MOST_BODIES or not len(result.t):
        return
    q, values = result.q.values, dict(result.parameters)
    pictures = [
        sketch_picture("start", f"{model.name} at its start", Drawing.of_mechanism(model.mechanism, q[0], values)),
    ]
    for k in np.unique(np.linspace(0, len(q) - 1, POSITIONS).round().astype(int))[1:].tolist():
        still = Drawing.of_mechanism(model.mechanism, q[k], values, ghosts=[q[0].tolist()], labels=False)
        pictures.append(sketch_picture(f"at-{k}", f"t = {result.t[k]:.4g} s", still))
    yield Section("Motion", pictures=tuple(pictures), strip=True)


def _limits_section(found: Sequence[ReachedLimit], failed: bool) -> Iterator[Section]:
    """Yield the section of the file's limits, if it has any; a failed run keeps none and exceeds none."""
    if not found:
        return
    if failed:
        names = enumeration([*dict.fromkeys(each.name for each in found)])
        yield Section("Limits", (f"The limits of {names} are not judged, as the run failed.",))
        return
    headings = ("quantity", "limit", "reached", "at t [s]", "")
    rows = tuple(
        (
            each.name,
            limit_in_words(each),
            engineering_number(each.reached, each.unit),
            "" if each.t is None else f"{each.t:.4g}",
            TableCell("kept", "good") if each.is_met else TableCell("exceeded", "bad"),
        )
        for each in found
    )
    yield Section("Limits", tables=(DocumentTable("", headings, rows),))


def limit_in_words(each: ReachedLimit) -> str:
    """Return a limit: at most 3 kN m."""
    return f"{'at most' if each.side == 'largest' else 'at least'} {engineering_number(each.limit, each.unit)}"


def _events_section(result: Result) -> Iterator[Section]:
    """Yield the section of what happened when, if anything did: each name with its times."""
    times = dict[str, list[float]]()
    for event in result.events:
        times.setdefault(event.name, []).append(event.t)
    if not times:
        return
    rows = tuple(
        (name, str(len(each)), f"{each[0]:.4g}", f"{each[-1]:.4g}" if len(each) > 1 else "")
        for name, each in times.items()
    )
    table = DocumentTable(
        "", ("event", "times", "first at t [s]", "last at t [s]"), rows[: fit_lines(len(rows), MOST_ROWS)]
    )
    yield Section("Events", tables=(table,))


def sketch_picture(name: str, caption: str, still: Drawing) -> Picture:
    """Return a drawing of a mechanism as a picture."""
    return Picture(name, caption, caption, still.svg.encode(), "svg", pixels=still.png)


def _load_tables(result: Result, along: Labelled) -> Iterator[DocumentTable]:
    """Yield a table for each unit of loads: the largest value of each, when and where."""
    every = result.whole(("elements", "magnitudes"))
    every = columns_at(every, without_doubles(every.names))
    where, counted = along.names[0] != "t", outside_passages(result)
    headings = ("quantity", "largest", "at t [s]", *([f"at {along.names[0]} [{along.units[0]}]"] if where else []))
    for unit, title in LOADS.items():
        rows = []
        for i, name in enumerate(every.names):
            values = every.values[:, i]
            if every.units[i] != unit or not np.nan_to_num(values[counted]).any():
                continue
            k = int(np.nanargmax(np.where(counted, np.abs(values), np.nan)))
            place = (f"{along.values[k, 0]:.4g}",) if where else ()
            rows.append((abs(values[k]), (name, engineering_number(values[k], unit), f"{result.t[k]:.4g}", *place)))
        rows.sort(key=lambda row: -row[0])
        if rows:
            first = fit_lines(len(rows), MOST_ROWS)
            notes = (f"{len(rows) - first} smaller ones are left out.",) if len(rows) > first else ()
            yield DocumentTable(title, headings, tuple(row for _, row in rows[:first]), notes=notes)


def _text_on_curves(result: Result) -> tuple[str, ...]:
    """Return why a failed run has no curves of loads."""
    return ("Loads are not shown, as they tell of the failure alone.",) if result.status == "failed" else ()


def _frequencies_section(model: Model, result: Result) -> Iterator[Section]:
    """Yield the section of frequencies about the equilibrium that the start of the file leads to.

    A machine whose drivers prescribe all of its motion has none.
    """
    title, text, tables = "Frequencies at rest", list[str](), list[DocumentTable]()
    try:
        modes: Any = model.modes(parameters=dict(result.parameters), at="equilibrium")
    except SymgenError as error:
        yield Section(title, (f"There are none: {error}.",))
        return
    if not modes.degrees_of_freedom:
        return
    for item in shown_modes(modes):
        if isinstance(item, AnalysisTable):
            rows = tuple(tuple(map(str, row)) for row in item.rows)
            tables.append(DocumentTable("Modes", tuple(item.headings), rows))
        else:
            text.append(f"{str(item)[:1].upper()}{str(item)[1:]}.")
    yield Section(title, tuple(text), tables=tuple(tables))
