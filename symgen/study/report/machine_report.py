"""The report of one machine: drawing, motion, largest loads, curves, frequencies at rest, and how far to trust it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import date
from functools import partial
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import numpy as np

from symgen.analyses.kinds import AnalysisTable
from symgen.analyses.kinds.modes import mode_lines as shown_modes
from symgen.analyses.reached_limits import ReachedLimit, reached_limits
from symgen.base.errors import SymgenError, fit_lines, plural
from symgen.describe.drawing.drawing import Drawing
from symgen.result.extremes import without_doubles
from symgen.result.labelled import Labelled, columns_at
from symgen.result.plots import figure_over_column
from symgen.result.summary import summary_lines
from symgen.study.machine_class import machine_class, version_list
from symgen.study.report.document import DocumentTable, Picture, ReportDocument, Section, TableCell
from symgen.study.report.key_numbers import key_numbers
from symgen.study.report.picture import MOST_BODIES, picture_of_figure
from symgen.study.report.verdict import verdict_on_run
from symgen.study.report.words import engineering_number

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.result.result import Result

#: Positions of the motion that have pictures; six parts of a run of whole turns are not all alike.
POSITIONS = 7
#: Rows of a table at most.
MOST_ROWS = 60
#: Units of loads, in the order of the tables.
LOADS = {"N m": "Torques and moments", "N": "Forces", "W": "Powers"}
#: What a rate of change of a joint is called by.
_RATE = ".rate"


def machine_report(model: Model, result: Result, command: str = "", over: str = "t", page: str = "") -> ReportDocument:
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

    Raises
    ------
    InputError
        If there is no such column, or matplotlib is missing.
    """
    along = result.along(over)
    facts = [
        *_origin_of_file(model),
        *summary_lines(result),
        *((f"parameter {name}", _value_with_unit(model, name, value)) for name, value in result.parameters.items()),
        ("versions", version_list()),
        ("machine", machine_class()),
    ]
    limits = reached_limits(model.mechanism, result) if len(result.t) else ()
    sections = [
        *_first_section(model, result),
        *_limits_section(limits),
        *_motion_section(model, result),
        *_events_section(result),
        *_loads_section(result, along),
        Section("Curves", pictures=(*_curve_pictures(result, along),)),
        _frequencies_section(model, result),
    ]
    title = model.mechanism.title or model.name
    lead, verdict = _lead_sentence(result), verdict_on_run(result, limits)
    return ReportDocument(title, (lead,), tuple(facts), command, tuple(sections), quote(page), verdict)


def _origin_of_file(model: Model) -> Iterator[tuple[str, str]]:
    """Yield who answers for the file, its revision, and the day of the report."""
    own = {"author": model.mechanism.author, "revision": model.mechanism.revision}
    yield from ((label, text) for label, text in own.items() if text)
    yield "date", date.today().isoformat()


def _value_with_unit(model: Model, name: str, value: float) -> str:
    """Return a parameter's value with its unit, as in the file."""
    parameter = next((p for p in model.mechanism.parameters if p.name == name), None)
    number, unit = (value, "") if parameter is None else parameter.as_written(value)
    note = "" if parameter is None or not parameter.note else f", {parameter.note}"
    return f"{number:g} {unit}".removesuffix(" 1").strip() + note


def _lead_sentence(result: Result) -> str:
    span = f"from {result.t[0]:g} to {result.t[-1]:g} s" if len(result.t) else "without outputs"
    return f"{result.mechanism}, simulated {span} with {result.method} and {result.integrator}."


def _loads_section(result: Result, along: Labelled) -> Iterator[Section]:
    """Yield the section of the largest loads; a failed run has none, as its last loads tell of the failure alone."""
    if result.status == "failed":
        return
    text = f"Largest absolute values over {plural(len(result.t), 'output')}; a peak between two outputs can be higher."
    yield Section("Largest loads", (text,), tables=(*_load_tables(result, along),))


def _first_section(model: Model, result: Result) -> Iterator[Section]:
    """Yield the section with the picture of the motion beside the numbers that are asked for first."""
    if not len(result.t):
        return
    numbers = () if result.status == "failed" else key_numbers(model.mechanism, result)
    table = DocumentTable("", ("", "largest", "when and where"), tuple((n.what, n.value, n.where) for n in numbers))
    pictures = []
    if len(model.mechanism.bodies) <= MOST_BODIES:
        moving = Drawing.of_motion(model.mechanism, result.q.values, dict(result.parameters))
        pictures.append(_sketch_picture("motion", "The start, later positions and paths", moving))
    yield Section("At a glance", tables=(table,) if numbers else (), pictures=tuple(pictures), beside=True)


def _motion_section(model: Model, result: Result) -> Iterator[Section]:
    """Yield the section of pictures of the mechanism."""
    if len(model.mechanism.bodies) > MOST_BODIES or not len(result.t):
        return
    q, values = result.q.values, dict(result.parameters)
    pictures = [
        _sketch_picture("start", f"{model.name} at its start", Drawing.of_mechanism(model.mechanism, q[0], values)),
    ]
    for k in np.unique(np.linspace(0, len(q) - 1, POSITIONS).round().astype(int))[1:].tolist():
        still = Drawing.of_mechanism(model.mechanism, q[k], values, ghosts=[q[0].tolist()], labels=False)
        pictures.append(_sketch_picture(f"at-{k}", f"t = {result.t[k]:.4g} s", still))
    yield Section("Motion", pictures=tuple(pictures))


def _limits_section(found: Sequence[ReachedLimit]) -> Iterator[Section]:
    """Yield the section of the file's limits, if it has any."""
    if not found:
        return
    headings = ("quantity", "limit", "reached", "at t [s]", "")
    rows = tuple(
        (
            each.name,
            f"{'at most' if each.side == 'largest' else 'at least'} {engineering_number(each.limit, each.unit)}",
            engineering_number(each.reached, each.unit),
            "" if each.t is None else f"{each.t:.4g}",
            TableCell("kept", "good") if each.is_met else TableCell("exceeded", "bad"),
        )
        for each in found
    )
    yield Section("Limits", tables=(DocumentTable("", headings, rows),))


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


def _sketch_picture(name: str, caption: str, still: Drawing) -> Picture:
    return Picture(name, caption, caption, still.svg.encode(), "svg", pixels=still.png)


def _load_tables(result: Result, along: Labelled) -> Iterator[DocumentTable]:
    """Yield a table for each unit of loads: the largest value of each, when and where."""
    every = result.whole(("elements", "magnitudes"))
    every = columns_at(every, without_doubles(every.names))
    where = along.names[0] != "t"
    headings = ("quantity", "largest", "at t [s]", *([f"at {along.names[0]} [{along.units[0]}]"] if where else []))
    for unit, title in LOADS.items():
        rows = []
        for i, name in enumerate(every.names):
            values = every.values[:, i]
            if every.units[i] != unit or not np.nan_to_num(values).any():
                continue
            k = int(np.nanargmax(np.abs(values)))
            place = (f"{along.values[k, 0]:.4g}",) if where else ()
            rows.append((abs(values[k]), (name, engineering_number(values[k], unit), f"{result.t[k]:.4g}", *place)))
        rows.sort(key=lambda row: -row[0])
        if rows:
            first = fit_lines(len(rows), MOST_ROWS)
            notes = (f"{len(rows) - first} smaller ones are left out.",) if len(rows) > first else ()
            yield DocumentTable(title, headings, tuple(row for _, row in rows[:first]), notes=notes)


def _curve_pictures(result: Result, along: Labelled) -> Iterator[Picture]:
    """Yield pictures of loads, of joints and of energies, over time or over a column."""
    loads, joints = result.whole(("elements", "magnitudes")), result.whole(("joint_coordinates", "outputs"))
    loads = columns_at(loads, [i for i in without_doubles(loads.names) if loads.units[i] in LOADS])
    joints = columns_at(joints, [i for i, name in enumerate(joints.names) if not name.endswith(_RATE)])
    errors = result.overview()
    errors = columns_at(errors, [i for i, name in enumerate(errors.names) if name not in result.q.names])
    parts = [
        ("loads", "Efforts, forces and powers", loads),
        ("joints", "Coordinates of joints, and outputs", joints),
        ("energy", "Energies, and errors beyond rounding", errors),
    ]
    for name, caption, table in parts:
        if table.names and len(result.t) > 1:
            title = f"{caption} over {along.names[0]}"
            yield picture_of_figure(name, caption, title, partial(figure_over_column, along, table, title))


def _frequencies_section(model: Model, result: Result) -> Section:
    """Return the section of frequencies about the equilibrium that the start of the file leads to."""
    title, text, tables = "Frequencies at rest", list[str](), list[DocumentTable]()
    try:
        modes: Any = model.modes(parameters=dict(result.parameters), at="equilibrium")
    except SymgenError as error:
        return Section(title, (f"There are none: {error}.",))
    for item in shown_modes(modes):
        if isinstance(item, AnalysisTable):
            rows = tuple(tuple(map(str, row)) for row in item.rows)
            tables.append(DocumentTable("Modes", tuple(item.headings), rows))
        else:
            text.append(f"{str(item)[:1].upper()}{str(item)[1:]}.")
    return Section(title, tuple(text), tables=tuple(tables))
