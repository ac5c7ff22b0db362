"""One report of several variants of a machine: verdicts, numbers and limits side by side, curves over each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.errors import fit_lines, plural
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.drawing.drawing import Drawing
from symgen.result.labelled import Labelled, columns_at
from symgen.result.summary import status_in_words
from symgen.study.machine_class import machine_class, version_list
from symgen.study.report.curves import LOADS, curve_pictures, in_degrees, loads_of_run, motion_of_run
from symgen.study.report.document import DocumentTable, Letterhead, Picture, ReportDocument, Section, TableCell
from symgen.study.report.key_numbers import key_numbers
from symgen.study.report.letterhead import origin_of_file
from symgen.study.report.machine_report import PLAIN, limit_in_words, sketch_picture, value_with_unit
from symgen.study.report.picture import MOST_BODIES
from symgen.study.report.verdict import JudgedRun, judge_run
from symgen.study.report.words import NONE, engineering_number

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.result.labelled import Array
    from symgen.result.result import Result

#: Variants of one report at most, and quantities whose curves it has.
MOST_VARIANTS, MOST_QUANTITIES = 8, 12
#: Columns that differ by less, beside their range, are the same.
_SAME = 1e-9
#: Moods from the best to the worst, and what a variant with one is.
_MOODS = {"good": "as asked", "doubtful": "doubtful", "bad": "not as asked"}


def variants_report(
    model: Model,
    results: Sequence[Result],
    varied: str,
    command: str = "",
    over: str = "t",
    letterhead: Letterhead = PLAIN,
) -> ReportDocument:
    """Return one report of runs of a machine that differ in a parameter.

    Parameters
    ----------
    model : Model
        The machine.
    results : sequence of Result
        Its runs, at least two.
    varied : str
        The parameter in which they differ.
    command, over, letterhead
        As of `machine_report`.

    Raises
    ------
    InputError
        If there is no such column, or matplotlib is missing.
    """
    runs = {value_with_unit(model, varied, r.parameters[varied], False): judge_run(model.mechanism, r) for r in results}
    first = results[0]
    kept = {name: value for name, value in first.parameters.items() if name != varied}
    facts = [
        ("mechanism", first.mechanism),
        ("method", f"{first.method}, {first.integrator}, until {first.until:g} s"),
        *((f"status, {label}", status_in_words(run.result)) for label, run in runs.items()),
        *((f"parameter {name}", value_with_unit(model, name, value)) for name, value in kept.items()),
        ("versions", version_list()),
        ("machine", machine_class()),
    ]
    sections = [
        Section("Verdicts", tables=(_verdicts(varied, runs),)),
        *_numbers_section(model, varied, runs),
        *_limits_section(runs),
        *_motion_section(model, varied, runs),
        *_curves_section(model, over, runs),
    ]
    lead = f"{first.mechanism} with {plural(len(runs), 'value')} of {varied}: {', '.join(runs)}."
    title, origin = model.mechanism.title or model.name, origin_of_file(model.mechanism, letterhead.number)
    verdict = _verdict_on_variants(varied, runs)
    return ReportDocument(
        title, (lead,), tuple(facts), command, tuple(sections), verdict=verdict, origin=origin, letterhead=letterhead
    )


def _verdict_on_variants(varied: str, runs: dict[str, JudgedRun]) -> TableCell:
    """Return how many variants do what was asked, and which do not, in the mood of the worst."""
    moods = [*_MOODS]
    worst = max((run.verdict.mood for run in runs.values()), key=moods.index)
    good = [label for label, run in runs.items() if run.verdict.mood == "good"]
    others = [f"{varied} = {label} is {_MOODS[run.verdict.mood]}" for label, run in runs.items() if label not in good]
    count = f"{len(good)} of {plural(len(runs), 'variant')} {'does' if len(good) == 1 else 'do'} what was asked"
    return TableCell("; ".join((count, *others)) + ".", worst)


def _verdicts(varied: str, runs: dict[str, JudgedRun]) -> DocumentTable:
    rows = tuple(
        (label, TableCell(_MOODS[run.verdict.mood], run.verdict.mood), run.verdict.text) for label, run in runs.items()
    )
    return DocumentTable("", (varied, "verdict", "why"), rows, words=3)


def _numbers_section(model: Model, varied: str, runs: dict[str, JudgedRun]) -> Iterator[Section]:
    """Yield the section of the first numbers, a column for each variant; what is first of one is said of all."""
    names = dict.fromkeys(number.what for run in runs.values() for number in run.numbers)
    every = [key_numbers(model.mechanism, run.result, True) if run.numbers else () for run in runs.values()]
    numbers = [{number.what: number.value for number in each} for each in every]
    rows = tuple((name, *(each.get(name, NONE) for each in numbers)) for name in names)
    if rows:
        headings = ("largest", *(f"{varied} = {label}" for label in runs))
        yield Section("Numbers side by side", tables=(DocumentTable("", headings, rows),))


def _limits_section(runs: dict[str, JudgedRun]) -> Iterator[Section]:
    """Yield the section of the file's limits: what each variant reaches, if it is judged."""
    limits = {(each.name, limit_in_words(each)) for run in runs.values() for each in run.limits}
    rows: tuple[tuple[str | TableCell, ...], ...] = tuple(
        (name, limit, *(_reached(run, name, limit) for run in runs.values())) for name, limit in sorted(limits)
    )
    if rows:
        yield Section("Limits", tables=(DocumentTable("", ("quantity", "limit", *runs), rows),))


def _reached(run: JudgedRun, name: str, limit: str) -> TableCell:
    found = next((each for each in run.limits if (each.name, limit_in_words(each)) == (name, limit)), None)
    if found is None or run.result.status == "failed":
        return TableCell("not judged", "faint")
    reached = engineering_number(found.reached, found.unit)
    return TableCell(reached, "good") if found.is_met else TableCell(f"{reached}, exceeded", "bad")


def _motion_section(model: Model, varied: str, runs: dict[str, JudgedRun]) -> Iterator[Section]:
    """Yield the section of pictures of the motions."""
    if len(model.mechanism.bodies) > MOST_BODIES:
        return
    pictures = [
        sketch_picture(
            f"motion-{k}",
            f"{varied} = {label}",
            Drawing.of_motion(model.mechanism, run.result.q.values, dict(run.result.parameters)),
        )
        for k, (label, run) in enumerate(runs.items())
        if len(run.result.t)
    ]
    yield Section("Motion", pictures=tuple(pictures), strip=len(pictures) > 2)


def _curves_section(model: Model, over: str, runs: dict[str, JudgedRun]) -> Iterator[Section]:
    """Yield the section of curves: of each quantity one picture, with a line for each variant."""
    tables = {label: _shown_columns(model, run.result) for label, run in runs.items() if len(run.result.t) > 1}
    if not tables:
        return
    names = [*dict.fromkeys(name for table in tables.values() for name in table.names)]
    chosen = names[: fit_lines(len(names), MOST_QUANTITIES)]
    left = len(names) - len(chosen)
    text = (f"{plural(left, 'quantity is', 'quantities are')} left out.",) if left else ()
    along = [in_degrees(runs[label].result.along(over)) for label in tables]
    x = Labelled(
        _beside([one.values[:, 0] for one in along]), tuple(one.names[0] for one in along), along[0].units * len(along)
    )
    pictures = list[Picture]()
    for k, name in enumerate(chosen):
        unit = next(table.unit(name) for table in tables.values() if name in table)
        values = _beside([table[name] if name in table else np.zeros(0) for table in tables.values()], len(x.values))
        pictures += curve_pictures(f"curves-{k}", x, Labelled(values, tuple(tables), (unit,) * len(tables)), name)
    yield Section("Curves", text, pictures=tuple(pictures))


def _beside(columns: Sequence[Array], rows: int = 0) -> Array:
    """Return columns of different lengths beside each other; what is missing is no number."""
    rows = max(rows, *map(len, columns))
    return np.array([np.pad(column, (0, rows - len(column)), constant_values=np.nan) for column in columns]).T


def _shown_columns(model: Model, result: Result) -> Labelled:
    """Return outputs of the file, efforts of drivers, else of force elements, and coordinates of joints at the ground.

    Of columns that are the same the first one is returned, and of a failed run no loads.
    """
    grounded = {joint.name for joint in model.mechanism.joints if GROUND in joint.bodies and joint.kind != "driver"}
    loads, motion = loads_of_run(result), motion_of_run(result)
    outputs = result.whole(("outputs",)).names
    drivers = [i for i, name in enumerate(loads.names) if name.endswith(".effort")]
    efforts = drivers or [i for i, name in enumerate(loads.names) if name in result.whole(("elements",)).names]
    moving = [i for i, name in enumerate(motion.names) if name.rpartition(".")[0] in grounded]
    own = [columns_at(part, [i for i, name in enumerate(part.names) if name in outputs]) for part in (loads, motion)]
    parts = [*own, columns_at(loads, efforts), columns_at(motion, moving)]
    whole = Labelled(
        np.hstack([part.values for part in parts]),
        tuple(name for part in parts for name in part.names),
        tuple(unit for part in parts for unit in part.units),
    )
    failed = result.status == "failed"
    kept = list[int]()
    for i, (name, unit) in enumerate(zip(whole.names, whole.units, strict=True)):
        column = whole.values[:, i]
        rivals = [whole.values[:, j] for j in kept if whole.units[j] == unit]
        told = any(
            np.allclose(column, rival, _SAME, _SAME * np.ptp(np.nan_to_num(column)), equal_nan=True) for rival in rivals
        )
        if not (told or name in whole.names[:i] or (failed and unit in LOADS)):
            kept.append(i)
    return columns_at(whole, kept)
