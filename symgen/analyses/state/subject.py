"""Subject of an analysis: a mechanism with its descriptor form, its parameters and an initial state."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace as replaced
from numpy.typing import NDArray

from symgen.analyses.state.algebra import null_space_split
from symgen.analyses.state.moving_drivers import note_on_forces_of_time
from symgen.analyses.state.one_sided import RowModes, mode_in_words, rows_as_joints, rows_in_force_at
from symgen.analyses.state.sticking import Stuck, rows_that_stick, with_rows_along, with_turns
from symgen.base.errors import InputError, suggest
from symgen.base.settings import Settings
from symgen.derive.lower.windings import winding_order
from symgen.describe.bounds.bounded_modes import one_sided_rows, without_bounds
from symgen.describe.facts.digest import digest
from symgen.describe.formulas.evaluate import evaluate_formula, parameter_values
from symgen.describe.parts.holding_joints import has_modes_of_joints, in_modes
from symgen.run.compiling.linearised import DescriptorForm, LinearisedState, compile_linearised
from symgen.run.compiling.pipeline import straight_alone
from symgen.run.compiling.side import compile_side
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.planning.inputs import Inputs, put_inputs
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.describe.bounded import BoundedRow
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
from symgen.analyses.state.yardsticks import Yardsticks
from symgen.describe.bounds.checks import refuse_driven_surfaces

Array = NDArray[np.float64]

#: Beyond this many coordinates of bodies code is looped, and equilibria are searched with sparse matrices.
LARGE = 300
#: A row below this part of what rows are is the rounding of none, as of a loop that is closed anyway, or of links that
#: lie in one line.
NO_ROW = 1e-11
#: Jumps of inputs are looked for up to so far after a time, and are at it as near as this, both parts of it.
BEYOND, HERE = 1e-9, 1e-13
#: Suffix of the names of rates.
RATE = ".rate"


@dataclass(frozen=True)
class Subject(Yardsticks):
    """A mechanism, ready to be analysed.

    Attributes
    ----------
    mechanism : Mechanism
        With its tree where the state consists of joint coordinates.
    compiled : CompiledModel
        Names, sizes and sections; its functions close starts.
    form : DescriptorForm
        The descriptor form with its derivatives.
    t : float
        Time [s].
    y : Array
        The state at the start: q, v, and what follows them.
    p, w : Array
        Parameters and scratch.
    closed : bool
        Whether the start satisfies the constraints.
    by : tuple of str
        Parameters that the form is differentiated by besides the inputs.
    inputs : tuple of str
        Inputs of the file: a mechanism in which formulas stand for them has switches as well.
    shut, opened : tuple of BoundedRow
        One-sided rows that are in force at the start, which are rows of `mechanism`, and those that are off.
    stuck : tuple of Stuck
        Rows along those in force, of contacts that are at rest there.
    held : tuple of str
        A sentence on the rows with bounds that hold the state at rest, if any do.
    whence : str
        Where the modes of the one-sided rows are from.
    """

    mechanism: Mechanism
    compiled: CompiledModel
    form: DescriptorForm
    t: float
    y: Array
    p: Array
    w: Array
    closed: bool = True
    by: tuple[str, ...] = ()
    inputs: tuple[str, ...] = ()
    shut: tuple[BoundedRow, ...] = ()
    opened: tuple[BoundedRow, ...] = ()
    stuck: tuple[Stuck, ...] = ()
    held: tuple[str, ...] = ()
    whence: str = "as at the start"

    @property
    def mode(self) -> tuple[str, ...]:
        """A sentence on the one-sided rows in force; none where there are no such rows."""
        return mode_in_words((*self.shut, *(each.row for each in self.stuck)), self.opened, self.whence)

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences that every analysis at a state has: remarks on the model, rows in force, and forces of time."""
        return (*self.mechanism.remarks, *self.mode, *self.held, *note_on_forces_of_time(self.mechanism, self.t))

    @property
    def varied(self) -> tuple[str, ...]:
        """Inputs, then the parameters that the form is differentiated by."""
        return (*self.inputs, *self.by)

    @property
    def places(self) -> list[int]:
        """Places of `varied` among all parameters."""
        names = [q.name for q in self.compiled.info.parameters]
        return [names.index(name) for name in self.varied]

    @property
    def coordinates(self) -> str:
        """``absolute``, or ``joint`` where the state belongs to a tree."""
        return "absolute" if self.mechanism.topology is None else "joint"

    @property
    def nq(self) -> int:
        """Number of coordinates."""
        return self.compiled.info.nq

    @property
    def nv(self) -> int:
        """Number of velocities."""
        return self.compiled.info.nv

    @property
    def m(self) -> int:
        """Number of constraint rows."""
        return self.compiled.info.m

    @property
    def states(self) -> int:
        """Number of states of the file's own."""
        return len(self.compiled.info.states)

    def extents(self, y: Array) -> Array:
        """Return the scales of changes of the file's own states: their values, 1 where these are 0."""
        values = np.abs(y[self.compiled.info.own_states])
        return np.where(values > 0.0, values, 1.0)

    @property
    def spun(self) -> set[int]:
        """Coordinates that are Euler parameters."""
        return {first + k for first, _ in self.compiled.info.spins for k in range(4)}

    @property
    def holonomic(self) -> NDArray[np.bool_]:
        """Which rows restrict positions."""
        return np.array([row.holonomic for row in self.compiled.info.rows], dtype=np.bool_)

    @property
    def redundant(self) -> NDArray[np.bool_]:
        """Which rows depend on others at the start and near it."""
        return np.asarray(self.compiled.section(self.w, "mask") > 0.0)

    @property
    def state_names(self) -> tuple[str, ...]:
        """Names of q and v."""
        info = self.compiled.info
        return (*(q.name for q in info.coordinates), *(v.name for v in info.velocities))

    def evaluate(
        self, y: Array, a: Array | None = None, lam: Array | None = None, t: float | None = None
    ) -> LinearisedState:
        """Evaluate the descriptor form; v' and the multipliers are 0 by default."""
        w = self.w.copy()
        self.compiled.section(w, "multipliers")[:] = 0.0 if lam is None else lam
        rates = np.zeros(self.nv) if a is None else a
        return self.form.at(self.t if t is None else t, y, rates, self.p, w)

    def motion(self, y: Array) -> Array:
        """Return N at a state, over lengths of the mechanism and radians; shape (nq, nv)."""
        return self.evaluate(y).by("motion", "v") * self.spans

    def rows(self, e: LinearisedState) -> Array:
        """Return D, with zeros for rows that are nothing but rounding; shape (m, nv)."""
        d = e.by("velocities", "v")
        d[np.linalg.norm(d * self.spans, axis=1) < NO_ROW * self.gaps] = 0.0
        return d

    def acting(self, e: LinearisedState) -> Array:
        """Return what acts along each velocity, shape (nv,): sums of sizes, which do not cancel where forces balance.

        Of the weight it is the most that it can be along a coordinate, by Schwarz' inequality.
        """
        sizes, mass = np.zeros(self.nv), np.abs(np.diag(e.by("balance", "a")))
        for (_, i), force in zip(self.form.elements, e.value("elements"), strict=True):
            sizes[i] += abs(force)
        values = {q.name: float(x) for q, x in zip(self.compiled.info.parameters, self.p, strict=False)}
        pull = math.hypot(*(evaluate_formula(g, values, "gravity") for g in self.mechanism.gravity))
        whole = sum(abs(evaluate_formula(body.mass, values, "mass")) for body in self.mechanism.bodies)
        return np.asarray(sizes + pull * np.sqrt(whole * mass))

    def lost_rank(self, d: Array) -> int:
        """Return by how much the rank of D is below its rank at positions nearby: above 0 at a singular position."""
        return int(self.m - np.count_nonzero(self.redundant) - (self.nv - self.split_freedom(d)[0].shape[1]))

    def sentence_if_singular(self, d: Array) -> tuple[str, ...]:
        """Return a sentence about a singular position, none elsewhere; none where the start did not close."""
        lost, near = self.lost_rank(d), self.m - int(np.count_nonzero(self.redundant))
        if lost <= 0 or not self.closed:
            return ()
        return (
            f"the position is singular: its constraint rows have rank {near - lost}, those of positions nearby {near}; "
            "degrees of freedom counted here are not those of the motion",
        )

    def split_freedom(self, d: Array, loads: Array | None = None) -> tuple[Array, Array]:
        """Return a basis of what rows leave free and their pseudo-inverse, lengths of the mechanism and radians alike.

        In metres a small mechanism turns without moving, and its moments of inertia are none beside its masses.
        """
        spans = self.spans[:, np.newaxis]
        basis, inverse, _ = null_space_split(d * spans.T, loads)
        return spans * basis, spans * inverse

    def wind_angles(self, y: Array) -> Subject:
        """Return the same with the angles that count turns as they are at a state less than half a turn away."""
        count, model = self.compiled.info.windings, self.compiled.model
        if not count:
            return self
        there, w = self.w.copy(), self.w.copy()
        for function in (model.geometry, model.measure):
            Ready(function, abi.MEASURE)(self.t, y.copy(), self.p, there)
        w[abi.WINDING : abi.WINDING + count] = there[abi.WINDING : abi.WINDING + count]
        return replace(self, w=w)

    def with_least_length(self, length: float) -> Subject:
        """Return the same as a mechanism of at least such a length [m]."""
        w = self.w.copy()
        w[abi.LENGTH] = max(self.length, length)
        return replace(self, w=w)

    def turn_to_joint_angles(self, values: Mapping[str, float]) -> Subject:
        """Return the same with the angles that count turns as coordinates of joints are that are known by name."""
        w = self.w.copy()
        names = {m: f"{joint.name}.{label}" for joint in self.mechanism.joints for label, m in joint.coordinates}
        for i, measure in enumerate(winding_order(self.mechanism, self.compiled.shape)):
            w[abi.WINDING + i] = values.get(names.get(measure, ""), w[abi.WINDING + i])
        return replace(self, w=w)

    def values_of_inputs(self, y: Array, t: float) -> dict[str, float]:
        """Return the values of inputs at a state: numbers, or what formulas of the state are there."""
        values = {name: float(self.p[i]) for name, i in zip(self.inputs, self.places, strict=False)}
        if formulas := self.mechanism.input_formulas:
            side = compile_side(self.mechanism, self.compiled, "given", "what formulas of inputs are", formulas)
            at = side(t, y, self.p, self.w.copy(), np.zeros_like(y))
            values |= {name: values[name] + float(x) for (name, _), x in zip(formulas, at, strict=True)}
        return values

    def position(self, name: str) -> tuple[str, int]:
        """Return the place of a coordinate: ``q`` and its index, or ``functions`` and the place of its value.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        names = [q.name for q in self.compiled.info.coordinates]
        if name in names:
            return "q", names.index(name)
        functions = {f: at for f, (at, orders) in self.form.functions.items() if orders == 3}
        if name in functions:
            return "functions", functions[name]
        expected = f"a coordinate of {self.mechanism.name}"
        raise InputError(f"'{name}'", expected, "none of that name", suggest(name, {*names, *functions}))

    def unit(self, name: str) -> str:
        """Return the unit of a coordinate."""
        space, at = self.position(name)
        return self.compiled.info.coordinates[at].unit if space == "q" else self.form.units[name]

    def coordinates_by_name(self, y: Array) -> dict[str, float]:
        """Return the coordinates by name: of the state, of bodies where a tree carries them, and of joints."""
        values = self.evaluate(y).value("functions")
        shown = {f"{b.name}.{c}" for b in self.mechanism.bodies for c in b.coordinates}
        shown |= {f"{joint.name}.{label}" for joint in self.mechanism.joints for label, _ in joint.coordinates}
        own = {q.name: float(x) for q, x in zip(self.compiled.info.coordinates, y, strict=False)}
        return own | {name: float(values[at]) for name, (at, _) in self.form.functions.items() if name in shown}


def make_subject(
    mechanism: Mechanism, settings: Settings, by: Sequence[str] = (), modes: RowModes | None = None
) -> Subject:
    """Make a mechanism with its start ready to be analysed; of rows with bounds, one-sided ones are as at the start.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        ``parameters``, ``inputs``, ``start``, ``coordinates`` and ``shape`` count.
    by : sequence of str
        Parameters that the form is differentiated by besides the inputs.
    modes : RowModes, optional
        Rows in force at a start that is taken to be at rest; those of the start by default.

    Raises
    ------
    InputError
        If a setting is wrong, or a name of `by` is no parameter.
    """
    refuse_driven_surfaces("analysis", mechanism)
    settings = _without_bounded_state(mechanism, settings)
    mechanism, settings = _in_modes_at_start(mechanism, settings)
    along, pushing = [row for row in mechanism.bounded if row.signed], one_sided_rows(mechanism)
    mechanism = with_turns(without_bounds(mechanism), pushing)
    placed, inputs = put_inputs_at_start(mechanism, settings), mechanism.inputs
    settings = placed.settings
    if settings.shape == "auto":
        large = mechanism.body_coordinates > LARGE and not straight_alone(mechanism)
        looped = large and settings.coordinates == "absolute"
        settings = replace(settings, shape="looped" if looped else "straight")
    run = prepare(with_turns(placed.mechanism, along), settings, Purpose.DESCRIBED)
    if modes is None:
        shut = rows_in_force_at(run.mechanism, run.compiled, run.start, pushing)
    else:
        shut = tuple(row for row in pushing if row.row in modes.shut)
        along = [row for row in along if row.row not in modes.loose]
    stuck = rows_that_stick(run.mechanism, run.compiled, run.start, along, shut, moving=modes is None)
    if shut or along:
        placed = replace(placed, mechanism=with_rows_along(rows_as_joints(placed.mechanism, shut), stuck))
        run = prepare(placed.mechanism, settings, Purpose.DESCRIBED)
    mechanism, compiled, start, closed = run.mechanism, run.compiled, run.start, run.assembled.closed
    names = [q.name for q in mechanism.parameters]
    for name in by:
        if name not in names:
            expected = f"a parameter of {mechanism.name}"
            raise InputError(f"by '{name}'", expected, "none of that name", suggest(name, names))
    by = tuple(name for name in dict.fromkeys(by) if name not in mechanism.inputs)
    varied = mechanism
    if placed.driven is not None and mechanism.input_formulas:  # the content of an input's slot is added to its formula
        whole = placed.driven.varied
        varied = replaced(mechanism, forces=whole.forces, states=whole.states, outputs=whole.outputs)
    if any(q.formula is not None and q.name in settings.parameters for q in varied.parameters):
        plain = (replaced(q, formula=None) if q.name in settings.parameters else q for q in varied.parameters)
        varied = replaced(varied, parameters=tuple(plain))
    form = compile_linearised(varied, compiled, (*inputs, *by))
    p, places = start.p.copy(), {q.name: i for i, q in enumerate(compiled.info.parameters)}
    for seam in placed.seams[1:]:
        if seam.t <= start.t * (1.0 + HERE):
            p[[places[name] for name in seam.values]] = list(seam.values.values())
    p[[places[name] for name, _ in placed.mechanism.input_formulas]] = 0.0
    compiled.prepare(p)
    subject = Subject(mechanism, compiled, form, start.t, start.y.copy(), p, start.w.copy(), closed, by, inputs)
    subject = replace(subject, shut=shut, opened=tuple(row for row in pushing if row not in shut), stuck=stuck)
    return subject if modes is None else replace(subject, whence="in the rest that was found")


def _without_bounded_state(mechanism: Mechanism, settings: Settings) -> Settings:
    """Have the state of a run of a mechanism with bounded rows start one without them."""
    if not mechanism.has_modes or isinstance(settings.start, Mapping):
        return settings
    last = settings.start.last_state
    if last.digest != digest(mechanism):
        return settings  # of another mechanism, which is refused
    return replace(settings, start=replace(last, digest="", windings=(), rank=0, made=None, arrays=None))


def _in_modes_at_start(mechanism: Mechanism, settings: Settings) -> tuple[Mechanism, Settings]:
    """Return a mechanism whose joints hold for good, or not at all, as at the start, and settings for it."""
    if not has_modes_of_joints(mechanism):
        return mechanism, settings
    last = None if isinstance(settings.start, Mapping) else settings.start.last_state
    states = dict[str, float]() if last is None else dict(last.states or {})
    values = parameter_values(mechanism, {k: x for k, x in settings.parameters.items() if not isinstance(x, str)})
    held = in_modes(mechanism, values, states)
    if last is not None:
        own = {x.name for x in held.states}
        kept = {name: x for name, x in states.items() if name in own}
        settings = replace(settings, start=replace(last, states=kept or None))
    return held, settings


def put_inputs_at_start(mechanism: Mechanism, settings: Settings) -> Inputs:
    """Put inputs into their places up to the start, which may be the end of a run."""
    if isinstance(settings.start, Mapping) or (begin := settings.start.last_state.t) <= 0.0:
        return put_inputs(mechanism, settings)
    # a run from here on begins after what jumps here; smooth data may end here
    inputs = put_inputs(mechanism, replace(settings, until=begin), beyond=BEYOND)
    return replace(inputs, settings=replace(inputs.settings, until=2.0 * begin))  # nothing is run
