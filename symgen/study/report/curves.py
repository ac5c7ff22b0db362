"""Curves of a report: a picture of each kind of quantity, in the units of its first page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from symgen.result.extremes import without_doubles
from symgen.result.labelled import Labelled, columns_at, largest_magnitudes
from symgen.result.plots import axis_label, draw_lines, panels_of_table
from symgen.study.report.dead_points import outside_passages
from symgen.study.report.document import Picture
from symgen.study.report.picture import draw_picture
from symgen.study.report.words import engineering_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from symgen.result.result import Result

#: Units of loads, in the order of the tables.
LOADS = {"N m": "Torques and moments", "N": "Forces", "W": "Powers"}
#: What a rate of change of a joint is called by.
RATE = ".rate"
#: Height of a picture [inch].
_HEIGHT = 2.5


def in_degrees(table: Labelled) -> Labelled:
    """Return a table whose angles are in degrees, as on the first page."""
    shown = [engineering_unit(unit, 1.0) if unit.startswith("rad") else (1.0, unit) for unit in table.units]
    return Labelled(table.values / [size for size, _ in shown], table.names, tuple(unit for _, unit in shown))


def loads_of_run(result: Result) -> Labelled:
    """Return what drivers and force elements exert, reactions, and outputs of these units, without passages."""
    table = result.whole(("elements", "magnitudes", "outputs"))
    table = replace(table, values=np.where(outside_passages(result)[:, np.newaxis], table.values, np.nan))
    return columns_at(table, [i for i in without_doubles(table.names) if table.units[i] in LOADS])


def motion_of_run(result: Result) -> Labelled:
    """Return coordinates of joints, and outputs that are no loads."""
    table = result.whole(("joint_coordinates", "outputs"))
    named = [i for i, name in enumerate(table.names) if not name.endswith(RATE)]
    return columns_at(table, [i for i in named if table.units[i] not in LOADS])


def curves_of_run(result: Result, along: Labelled) -> Iterator[Picture]:
    """Yield pictures of loads, of joints and outputs, and of energies, over time or over a column.

    A failed run has no loads, which tell of the failure alone.
    """
    motion, balance = motion_of_run(result), result.overview()
    balance = columns_at(balance, [i for i, name in enumerate(balance.names) if name not in result.q.names])
    if result.status == "failed":
        motion = columns_at(motion, [i for i, unit in enumerate(motion.units) if unit != "J"])
    else:
        yield from curve_pictures("loads", along, loads_of_run(result))
    yield from curve_pictures("joints", along, motion)
    yield from curve_pictures("energy", along, balance)


def curve_pictures(file: str, along: Labelled, table: Labelled, called: str = "") -> Iterator[Picture]:
    """Yield a picture of each kind of quantity in a table; two fit beside each other.

    Parameters
    ----------
    file : str
        Name of the first picture; the names of others end with a number.
    along : Labelled, shape (k, 1) or (k, n)
        What curves are drawn over: one column for all, or one for each.
    table : Labelled, shape (k, n)
        The curves.
    called : str, optional
        What all of them are, where their names are those of machines.
    """
    if len(table.values) < 2:
        return
    for k, (meaning, unit, logarithmic, columns) in enumerate(panels_of_table(in_degrees(table))):
        name = called or (columns.names[0] if len(columns.names) == 1 else meaning or "further quantities")
        capital = name == meaning or not (called or name in columns.names)
        caption = f"{name[:1].upper() + name[1:] if capital else name} over {along.names[0]}"
        size, shown = 1.0, unit
        if not logarithmic:
            size, shown = engineering_unit(unit, max(largest_magnitudes(columns.values), default=0.0))
        scaled = replace(columns, values=columns.values / size)
        draw = partial(_draw_panel, along=along, columns=scaled, label=axis_label(name, shown), logarithmic=logarithmic)
        yield draw_picture(file if k == 0 else f"{file}-{k + 1}", caption, caption, draw, _HEIGHT)


def _draw_panel(figure: Figure, along: Labelled, columns: Labelled, label: str, logarithmic: bool) -> None:
    ax = figure.subplots()
    ax.margins(x=0.01)
    draw_lines(ax, along.values if along.values.shape[1] > 1 else along.values[:, 0], columns, logarithmic)
    ax.set_ylabel(label)
    ax.set_xlabel(axis_label(along.names[0], along.units[0]))
