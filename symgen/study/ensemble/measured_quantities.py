"""Points, force elements, drivers, formulas of ``[outputs]`` and reactions of the runs of an ensemble.

Loops write the states and other inputs of formulas as further columns of each run. After the loops, one compiled loop
(`symgen.run.rows.row_measures`) calls the side module of single runs for all of them. The loops of all targets are the
same with and without such quantities.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.vocabulary.expressions import readings_in
from symgen.base.vocabulary.measures import GROUND, Integral
from symgen.describe.facts.carriers import bodies_of_reactions, seats_on_carriers
from symgen.describe.formulas.reported_columns import TABLES
from symgen.result.reactions import Acting, Seat
from symgen.result.signals import Signal
from symgen.run.compiling.side import compile_side
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.loops.seams import preparing_functions, seams_of_loop

if TYPE_CHECKING:
    from symgen.base.vocabulary.expressions import Expr
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.loops.run_spec import Seam

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: What the function is called in its module.
NAME, PURPOSE = "measured", "what is kept of the runs of sweeps"


def first_integral(mechanism: Mechanism, chosen: Sequence[Signal]) -> str | None:
    """Return the first of some quantities that reads an integral, None where none does."""
    names = {q.name for q in chosen if q.source == e.SIDE}
    for output in mechanism.outputs:
        if output.name in names and any(isinstance(r.source, Integral) for r in readings_in(output.value)):
            return output.name
    return None


def _tables_by_source(acting: Acting, entries: Array, multipliers: Array) -> dict[int, Array]:
    """Return the tables of reactions by source."""
    table = acting.reactions(entries, multipliers)
    further = {e.BODY_REACTION: acting.in_body_axes(table), e.MAGNITUDE: acting.magnitudes(table)}
    return {source: labelled.values for source, labelled in ({e.REACTION: table} | further).items()}


def store_modules(folder: str, modules: Mapping[str, tuple[str, Mapping[str, Any]]]) -> Path:
    """Put modules that have travelled into the cache of this machine, where that has others or none; return the folder.

    Parameters
    ----------
    folder : str
        Its name there.
    modules : mapping of str to (str, mapping)
        Source and metadata of each module by its stem.
    """
    from symgen.compile.store.entries import Entries

    entries = Entries()
    with entries.lock_folder(folder):
        for stem, (source, metadata) in modules.items():
            path = entries.path(folder, stem)
            if entries.get(folder, stem) is None or path.read_text(encoding="utf-8") != source:
                entries.put(folder, stem, source, metadata)
    return path.parent


@dataclass(frozen=True)
class JointPlace:
    """Where a joint acts: its first body, and which formulas are its point there and that body's centre of mass."""

    body: str
    point: tuple[int, ...]
    centre: tuple[int, ...]


@dataclass(frozen=True)
class MeasuredOutputs:
    """Outputs at which quantities of runs are measured.

    Attributes
    ----------
    times : Array, shape (1, times) or (runs, times)
        Output times, of all runs or of each [s].
    seams : tuple of tuple of Seam
        As in `symgen.study.ensemble.chunks.Rows`.
    adaptive : bool
        Whether steps vary.
    step : float
        Constant step [s].
    """

    times: Array
    seams: tuple[tuple[Seam, ...], ...]
    adaptive: bool
    step: float


@dataclass(frozen=True)
class Measures:
    """Code for quantities that no loop computes; it travels as source.

    Attributes
    ----------
    folder, stem, source, metadata
        Of the side module.
    length : int
        Numbers that its function writes.
    reads : tuple of Signal
        Columns of the loops that it reads.
    places : tuple of int
        Where each of these goes, see `symgen.run.rows.row_measures.Left`.
    joints : mapping of str to Place
        Where reactions act; empty where none are kept.
    """

    folder: str
    stem: str
    source: str
    metadata: Mapping[str, Any]
    length: int
    reads: tuple[Signal, ...]
    places: tuple[int, ...]
    joints: Mapping[str, JointPlace]

    @property
    def described(self) -> list[Any]:
        """Description of the computation, as JSON can express it."""
        joints = {name: (p.body, p.point, p.centre) for name, p in self.joints.items()}
        return [self.folder, self.stem, self.source, [q.name for q in self.reads], self.places, joints]

    @cached_property
    def function(self) -> Any:
        """The compiled function of the formulas, its module put into the cache of this machine where it has none."""
        from symgen.compile.store.loaded_modules import load_module

        folder = store_modules(self.folder, {self.stem: (self.source, self.metadata)})
        return getattr(load_module(folder / f"{self.stem}.py"), NAME)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "function"}

    def evaluate_quantities(
        self,
        compiled: CompiledModel,
        quantities: Sequence[Signal],
        outputs: MeasuredOutputs,
        selected: Integers,
        columns: Array,
        ps: Array,
        ws: Array,
    ) -> Array:
        """Return quantities of selected runs, shape (selected, quantities, times).

        Parameters
        ----------
        compiled : CompiledModel
            Code of the runs.
        quantities : sequence of Signal
            Those that no loop leaves.
        outputs : MeasuredOutputs
            When they are measured.
        selected : Array of int
            Runs.
        columns : Array, shape (runs, columns, times)
            Columns that loops wrote; the last ones are `reads`.
        ps, ws : Array, shapes (runs, np), (runs, nw)
            Parameters at the start, and scratch, which is overwritten.
        """
        from symgen.run.layout.records import Span
        from symgen.run.rows.row_measures import Left, measure_rows
        from symgen.run.rows.rows import observe_nothing_of_coordinates

        info, runs, n_times = compiled.info, len(ps), outputs.times.shape[1]
        y, rates, places = np.zeros(info.ny), np.zeros(info.ny), np.array(self.places, dtype=np.int64)
        first = columns.shape[1] - len(self.reads)
        left = Left(outputs.times, selected, columns, first, places, ps, ws, y, rates, np.zeros(ps.shape[1]))
        seams = seams_of_loop(compiled, outputs.adaptive, outputs.seams or ((),))
        span = Span._make((outputs.step, *(0.0 for _ in Span._fields[1:])))
        changing = seams, span, *preparing_functions(compiled)
        numbers, (at, size) = np.zeros((runs, n_times, self.length)), info.sections["jacobian"]
        entries = np.zeros((runs if self.joints else 0, n_times, size))
        function = self.function if self.length else observe_nothing_of_coordinates
        measure_rows((left, changing, function, compiled.model.geometry), numbers, at, entries)
        sides = [q for q in quantities if q.source == e.SIDE]
        column = {q.name: i for i, q in enumerate(sides)}
        tables: dict[int, Array] = {}
        if self.joints:
            tables = self._reaction_tables(info, selected, columns[:, first:], numbers, entries)
        values = np.empty((len(selected), len(quantities), n_times))
        for i, q in enumerate(quantities):
            if q.source == e.SIDE:
                values[:, i] = numbers[selected, :, column[q.name]]
            else:
                values[:, i] = tables[q.source][:, q.column].reshape(len(selected), n_times)
        return values

    def _reaction_tables(
        self, info: ModelInfo, selected: Integers, columns: Array, numbers: Array, entries: Array
    ) -> dict[int, Array]:
        """Return the tables of reactions by source, shape (selected x times, columns)."""

        def flatten_selected(array: Array) -> Array:  # (runs, times, n): outputs of one run after those of another
            return np.ascontiguousarray(array[selected]).reshape(len(selected) * array.shape[1], array.shape[2])

        states = flatten_selected(np.swapaxes(columns[:, : info.ny], 1, 2))
        multipliers = [i for i, q in enumerate(self.reads) if q.source == e.MULTIPLIER]
        formulas = flatten_selected(numbers)
        seats = {}
        for name, place in self.joints.items():
            point = formulas[:, list(place.point)] if place.point else np.zeros((len(states), 3))
            centre = formulas[:, list(place.centre)] if place.centre else 0.0
            seats[name] = Seat(place.body, point - centre)
        return _tables_by_source(
            Acting(info, seats, states),
            flatten_selected(entries),
            flatten_selected(np.swapaxes(columns[:, multipliers], 1, 2)),
        )


def make_measures(mechanism: Mechanism, compiled: CompiledModel, chosen: Sequence[Signal]) -> Measures | None:
    """Return how the quantities that no loop leaves are worked out beside a compiled model, None where there are none.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism of the runs.
    compiled : CompiledModel
        Its code for a processor.
    chosen : sequence of Signal
        All that is kept.

    Raises
    ------
    InputError
        If numbers that meet in a formula overflow.
    """
    if all(q.source < e.SIDE for q in chosen):
        return None
    info = compiled.info
    definitions = {c.name: c.formula for columns in TABLES.values() for c in columns(mechanism)}
    formulas = [(q.name, definitions[q.name]) for q in chosen if q.source == e.SIDE]
    joints = _places_of_reactions(mechanism, formulas) if any(q.source > e.SIDE for q in chosen) else {}
    side = compile_side(mechanism, compiled, NAME, PURPOSE, formulas)
    reads = [(Signal("", f"y{i}", "", e.STATE, i), e.OF_Y, i) for i in range(info.ny)]
    if "ydot" in side.reads:
        reads += [(Signal("", f"v'{i}", "", e.ACCELERATION, i), e.OF_RATES, info.nq + i) for i in range(info.nv)]
    if "multipliers" in side.reads or joints:
        at, _ = info.sections["multipliers"]
        reads += [(Signal("", f"lambda{i}", "", e.MULTIPLIER, i), e.OF_W, at + i) for i in range(info.m)]
    if "winding" in side.reads:
        n, at = abi.N_STATUS, abi.WINDING
        reads += [(Signal("", f"angle{i}", "", e.STATUS, n + i), e.OF_W, at + i) for i in range(info.windings)]
    if "modes" in side.reads:
        (at, size), behind = info.sections["modes"], abi.N_STATUS + info.windings
        reads += [(Signal("", f"mode{i}", "", e.STATUS, behind + i), e.OF_W, at + i) for i in range(size)]
    return Measures(
        folder=side.path.parent.name,
        stem=side.path.stem,
        source=side.path.read_text(encoding="utf-8"),
        metadata={"reads": sorted(side.reads)},
        length=len(formulas),
        reads=tuple(quantity for quantity, _, _ in reads),
        places=tuple(number for _, array, at in reads for number in (array, at)),
        joints=joints,
    )


def _places_of_reactions(mechanism: Mechanism, formulas: list[tuple[str, Expr]]) -> dict[str, JointPlace]:
    """Return where reactions act, after adding what that depends on to the formulas."""
    places, seats = dict[str, JointPlace](), seats_on_carriers(mechanism)

    def add_formulas(label: str, expressions: Sequence[Expr]) -> tuple[int, ...]:
        first = len(formulas)
        formulas.extend((f"{label} {axis}", x) for axis, x in zip("xyz", expressions, strict=False))
        return tuple(range(first, len(formulas)))

    for name, body in bodies_of_reactions(mechanism).items():
        point: tuple[int, ...] = ()
        centre: tuple[int, ...] = ()
        if (seat := seats.get(name)) is not None:
            point = add_formulas(f"point of {name}", seat[0])
            if body != GROUND:
                centre = add_formulas(f"centre of {body}", seat[1])
        places[name] = JointPlace(body, point, centre)
    return places
