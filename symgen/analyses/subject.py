"""What an analysis is about: a mechanism with its descriptor form, its parameters and a state to begin with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from msgspec.structs import replace as replaced
from numpy.typing import NDArray

from symgen.analyses.algebra import split
from symgen.analyses.yardsticks import Yardsticks
from symgen.compiling.linearised import DescriptorForm, Evaluated, compile_linearised
from symgen.compiling.pipeline import compile_model
from symgen.compiling.side import compile_side
from symgen.describe.evaluate import evaluate, parameter_values, scalars
from symgen.describe.holds import holds_of
from symgen.describe.start import described_start
from symgen.errors import AssemblyError, InputError, nearest
from symgen.lower.windings import winding_order
from symgen.running.inputs import Inputs, put_inputs
from symgen.running.plan import Plan, Purpose
from symgen.running.prepare import assemble, begin, make_plan
from symgen.running.starts import held_of
from symgen.runtime import abi
from symgen.runtime.model_arrays import lengths_of
from symgen.runtime.probe import Ready
from symgen.settings import Settings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.describe.mechanism import Mechanism
    from symgen.runtime.compiled import CompiledModel, ModelInfo

Array = NDArray[np.float64]

#: Beyond this many coordinates of bodies code is looped, and equilibria are searched with sparse matrices.
LARGE = 300
#: A redundant row below this part of what rows are is the rounding of none, as of a loop that is closed anyway.
NO_ROW = 1e-11
#: Jumps of inputs are looked for up to so far behind a time, and are at it as near as this, both parts of it.
BEYOND, HERE = 1e-9, 1e-13
#: What a name of a rate ends in.
RATE = ".rate"


@dataclass(frozen=True)
class Subject(Yardsticks):
    """A mechanism, ready to be analysed.

    Attributes
    ----------
    mechanism : Mechanism
        With its tree where the state is that of joints.
    compiled : CompiledModel
        Names, sizes and sections; its functions close starts.
    form : DescriptorForm
        The descriptor form with its derivatives.
    t : float
        Time [s].
    y : Array
        The state at the start: q, v, and what stands behind.
    p, w : Array
        Parameters and scratch.
    notes : tuple of str
        What was changed to close the mechanism.
    closed : bool
        Whether the start satisfies the constraints.
    by : tuple of str
        Parameters that derivatives are known by beside the inputs.
    inputs : tuple of str
        Those of the file: a mechanism in which formulas stand for them has switches as well.
    """

    mechanism: Mechanism
    compiled: CompiledModel
    form: DescriptorForm
    t: float
    y: Array
    p: Array
    w: Array
    notes: tuple[str, ...] = ()
    closed: bool = True
    by: tuple[str, ...] = ()
    inputs: tuple[str, ...] = ()

    @property
    def varied(self) -> tuple[str, ...]:
        """Inputs, then the parameters that derivatives are known by."""
        return (*self.inputs, *self.by)

    @property
    def coordinates(self) -> str:
        """``absolute``, or ``joint`` where the state is that of a tree."""
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

    def evaluated(
        self, y: Array, a: Array | None = None, lam: Array | None = None, t: float | None = None
    ) -> Evaluated:
        """Evaluate the descriptor form; v' and the multipliers are 0 by default."""
        w = self.w.copy()
        self.compiled.section(w, "multipliers")[:] = 0.0 if lam is None else lam
        rates = np.zeros(self.nv) if a is None else a
        return self.form.at(self.t if t is None else t, y, rates, self.p, w)

    def rows(self, e: Evaluated) -> Array:
        """Return D, with zeros for redundant rows that are nothing but rounding; shape (m, nv)."""
        d = e.by("velocities", "v")
        d[self.redundant & (np.linalg.norm(d * self.spans, axis=1) < NO_ROW * self.gaps)] = 0.0
        return d

    def free(self, e: Evaluated) -> Array:
        """Return directions that rows leave free, orthonormal where lengths of the mechanism and radians are as long.

        In metres a small mechanism turns without moving, and its moments of inertia are none beside its masses.
        """
        spans = self.spans[:, np.newaxis]
        return np.asarray(spans * split(self.rows(e) * spans.T)[0])

    def wound(self, y: Array) -> Subject:
        """Return the same with the angles that count turns as they are at a state less than half a turn away."""
        count, model = self.compiled.info.windings, self.compiled.model
        if not count:
            return self
        there, w = self.w.copy(), self.w.copy()
        for function in (model.geometry, model.measure):
            Ready(function, abi.MEASURE)(self.t, y.copy(), self.p, there)
        w[abi.WINDING : abi.WINDING + count] = there[abi.WINDING : abi.WINDING + count]
        return replace(self, w=w)

    def as_long_as(self, length: float) -> Subject:
        """Return the same as a mechanism of at least such a length [m]."""
        if length <= self.length:
            return self
        w = self.w.copy()
        w[abi.LENGTH] = length
        return replace(self, w=w)

    def turned(self, values: Mapping[str, float]) -> Subject:
        """Return the same with the angles that count turns as coordinates of joints are that are known by name."""
        w = self.w.copy()
        names = {m: f"{joint.name}.{label}" for joint in self.mechanism.joints for label, m in joint.coordinates}
        for i, measure in enumerate(winding_order(self.mechanism, self.compiled.shape)):
            w[abi.WINDING + i] = values.get(names.get(measure, ""), w[abi.WINDING + i])
        return replace(self, w=w)

    def values_of_inputs(self, y: Array, t: float) -> dict[str, float]:
        """Return what the inputs are at a state: numbers, or what formulas of the state are there."""
        places = [q.name for q in self.compiled.info.parameters]
        found = {name: float(self.p[places.index(name)]) for name in self.inputs}
        if formulas := self.mechanism.given:
            said = "what formulas of inputs are"
            side = compile_side(self.mechanism, self.compiled, "given", said, formulas)
            at = side(t, y, self.p, self.w.copy(), np.zeros_like(y))
            found |= {name: found[name] + float(x) for (name, _), x in zip(formulas, at, strict=True)}
        return found

    def position(self, name: str) -> tuple[str, int]:
        """Return where a coordinate stands: ``q`` and its index, or ``functions`` and the place of its value.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        names = [q.name for q in self.compiled.info.coordinates]
        if name in names:
            return "q", names.index(name)
        known = {f for f, (_, orders) in self.form.functions.items() if orders == 3}
        if name in known:
            return "functions", self.form.functions[name][0]
        expected = f"a coordinate of {self.mechanism.name}"
        raise InputError(f"'{name}'", expected, "none of that name", nearest(name, {*names, *known}))

    def unit(self, name: str) -> str:
        """Return the unit of a coordinate."""
        space, at = self.position(name)
        return self.compiled.info.coordinates[at].unit if space == "q" else self.form.units[name]

    def named(self, y: Array) -> dict[str, float]:
        """Return the coordinates by name: the state's own, those of bodies where a tree carries them, and of joints."""
        info, found = self.compiled.info, self.evaluated(y).value("functions")
        result = {q.name: float(x) for q, x in zip(info.coordinates, y, strict=False)}
        shown = {f"{b.name}.{c}" for b in self.mechanism.bodies for c in b.coordinates}
        shown |= {f"{joint.name}.{label}" for joint in self.mechanism.joints for label, _ in joint.coordinates}
        for name, (at, _) in self.form.functions.items():
            if name in shown:
                result[name] = float(found[at])
        return result


def subject_of(mechanism: Mechanism, settings: Settings, by: Sequence[str] = ()) -> Subject:
    """Return a mechanism with its start, ready to be analysed.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        ``parameters``, ``inputs``, ``start``, ``coordinates`` and ``shape`` are looked at.
    by : sequence of str
        Parameters that derivatives are wanted by beside the inputs.

    Raises
    ------
    InputError
        If a setting is wrong.
    """
    given, inputs = given_at_start(mechanism, settings), mechanism.inputs
    mechanism, settings = given.mechanism, given.settings
    if settings.shape == "auto":
        size = mechanism.body_coordinates
        looped = size > LARGE and settings.coordinates == "absolute"
        settings = replace(settings, shape="looped" if looped else "straight")
    found = at_start(mechanism, settings)
    mechanism, compiled, t = found.mechanism, found.compiled, found.t
    p = _at(compiled, found.p.copy(), given, t)
    names = _parameters(mechanism, by)
    form = compile_linearised(_as_given(_varied(mechanism, given), settings.parameters), compiled, (*inputs, *names))
    state = t, found.y.copy(), p, found.w.copy()
    return Subject(mechanism, compiled, form, *state, found.notes, found.closed, names, inputs)


def given_at_start(mechanism: Mechanism, settings: Settings) -> Inputs:
    """Return a mechanism and settings with inputs in their places: known up to the start, which may be one of a run."""
    if isinstance(settings.start, Mapping) or (begin := settings.start.last_state.t) <= 0.0:
        return put_inputs(mechanism, settings)
    # a run from here on begins behind what jumps here; smooth data may end here
    found = put_inputs(mechanism, replace(settings, until=begin), behind=BEYOND)
    return replace(found, settings=replace(found.settings, until=2.0 * begin))  # nothing is run


def _at(compiled: CompiledModel, p: Array, given: Inputs, t: float) -> Array:
    """Return parameters with what inputs that jump are at a time."""
    places = {q.name: i for i, q in enumerate(compiled.info.parameters)}
    for stop in given.stops[1:]:
        if stop.t <= t * (1.0 + HERE):
            p[[places[name] for name in stop.values]] = list(stop.values.values())
    p[[places[name] for name, _ in given.mechanism.given]] = 0.0  # see `_varied`
    compiled.prepare(p)
    return p


def _varied(mechanism: Mechanism, given: Inputs) -> Mechanism:
    """Return a mechanism in which inputs that follow formulas may be other than these by what stands in their slots."""
    if given.driven is None or not mechanism.given:
        return mechanism
    varied = given.driven.varied
    return replaced(mechanism, forces=varied.forces, outputs=varied.outputs)


def _parameters(mechanism: Mechanism, by: Sequence[str]) -> tuple[str, ...]:
    """Return the parameters among names, each once.

    Raises
    ------
    InputError
        If one is no parameter.
    """
    known = [p.name for p in mechanism.parameters]
    for name in by:
        if name not in known:
            expected = f"a parameter of {mechanism.name}"
            raise InputError(f"by '{name}'", expected, "none of that name", nearest(name, known))
    return tuple(name for name in dict.fromkeys(by) if name not in mechanism.inputs)


def _as_given(mechanism: Mechanism, given: Mapping[str, float]) -> Mechanism:
    """Return a mechanism in which parameters that are given numbers follow no formula."""
    if not any(p.formula is not None and p.name in given for p in mechanism.parameters):
        return mechanism
    plain = (replaced(p, formula=None) if p.name in given else p for p in mechanism.parameters)
    return replaced(mechanism, parameters=tuple(plain))


def _extent(mechanism: Mechanism, values: Mapping[str, float], info: ModelInfo, y: Array) -> float:
    """Return the largest coordinate that is a length, or of a point in its body [m]; 0 where all are at one place."""
    places = [e for body in mechanism.bodies for _, point in body.points for e in point]
    places += [e for _, marker in mechanism.seats for e in marker.point]
    sizes = [abs(evaluate(e, values, "points")) for e in places]
    return max(float(np.abs(y[: info.nq] * lengths_of(info)).max(initial=0.0)), *sizes, 0.0)


class AtStart(NamedTuple):
    """Code of a mechanism with its state at the start.

    Attributes
    ----------
    mechanism : Mechanism
        With its tree where the state is that of joints.
    compiled : CompiledModel
        Its code.
    t : float
        Time [s].
    y, p, w : Array
        State, parameters and scratch.
    notes : tuple of str
        What was changed to close the mechanism.
    closed : bool
        Whether the state satisfies the constraints.
    """

    mechanism: Mechanism
    compiled: CompiledModel
    t: float
    y: Array
    p: Array
    w: Array
    notes: tuple[str, ...] = ()
    closed: bool = True


def at_start(mechanism: Mechanism, settings: Settings) -> AtStart:
    """Return a mechanism at its start; as described where nothing closes it, which a static search does on its way.

    Raises
    ------
    AssemblyError
        If nothing closes a mechanism in joint coordinates.
    """
    plan = make_plan(mechanism, settings, Purpose.STATE)
    try:
        run = begin(plan, assemble(plan))
    except AssemblyError:
        if plan.coordinates == "joint":
            raise
        return _as_described(plan)
    start = run.start
    return AtStart(run.mechanism, run.compiled, start.t, start.y, start.p, start.w, start.notes)


def _as_described(plan: Plan) -> AtStart:
    mechanism, compiled = plan.mechanism, compile_model(plan.mechanism, plan.choice)
    info, values = compiled.info, parameter_values(mechanism, plan.parameters)
    numbers = scalars(values)
    q, v = described_start(mechanism, numbers)
    held = held_of(info, plan.holds or holds_of(mechanism), numbers, v)
    y, w = np.zeros(info.ny), compiled.scratch()
    y[: info.nq] = q
    for i, value in held.coordinates.items():
        y[i] = value
    w[abi.LENGTH] = _extent(mechanism, values, info, y) or 1.0
    p = compiled.parameter_array(values, plan.method_parameters)
    compiled.prepare(p)
    return AtStart(mechanism, compiled, 0.0, y, p, w, closed=False)
