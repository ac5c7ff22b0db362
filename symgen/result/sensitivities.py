"""Sensitivities of a run: derivatives of its quantities by chosen numbers, as labelled arrays.

They are derivatives of the run that was made: of its code, its steps and its corrections, evaluated beside the motion.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, enumeration, quote, suggest
from symgen.describe.facts.kinks import discontinuities_of
from symgen.describe.facts.motion_quantities import QuantityNames
from symgen.describe.formulas.reported_columns import TABLES as FORMULAS
from symgen.result.evaluated import Evaluated
from symgen.result.labelled import Labelled
from symgen.result.step_errors import DOUBTFUL, errors_of_steps
from symgen.result.unmoved import unmoved_sentence
from symgen.run.compiling.side import compile_side
from symgen.run.directions.directions import DirectedCourse, run_with_directions
from symgen.run.directions.push_directions import refuse_law_without_directions
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.moving_breaks import with_moving_kinks
from symgen.run.planning.named_directions import named_directions
from symgen.run.planning.prepare import Preparation, Prepared, find_preparation
from symgen.run.planning.start_directions import StartDirections

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.base.vocabulary.expressions import Expr
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.single.outcome import Outcome

Array = NDArray[np.float64]

#: Explicit schemes whose steps are linear in the state, the default first.
SCHEMES = ("dop853", "dopri5", "rk4", "abm4", "abm", "euler", "heun")
#: Tables of a result with sensitivities.
TABLES = ("q", "v", "a", "joint_coordinates", *FORMULAS)
#: Energies, as sums of kinetic and potential energy.
ENERGIES = {"energy.kinetic": (1.0, 0.0), "energy.potential": (0.0, 1.0), "energy.total": (1.0, 1.0)}
#: Directions leave the constraints by less than this part of their size, unless they are doubtful.
CONSISTENT = 1e-6


def prepare_for_directions(mechanism: Mechanism, settings: Settings) -> tuple[Prepared, tuple[str, ...]]:
    """Return a run that can have directions, and notes on what was chosen for that.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        Of the run; what they leave open is chosen.

    Raises
    ------
    InputError
        If the scheme, the shape of the code or the start has no directions; says what works instead.
    """
    notes = list[str]()
    if settings.shape == "auto":
        settings = replace(settings, shape="straight")
    elif settings.shape == "looped":
        raise InputError("sensitivities", "code of the shape 'straight'", "shape 'looped'")
    usual = settings.integrator or mechanism.defaults.integrator
    ready = find_preparation(mechanism, settings)
    name, forms = ready.plan.integrator.name, ready.plan.choice.method.forms
    if name not in SCHEMES and usual in (None, "auto") and "ode" in forms:
        ready = find_preparation(mechanism, replace(settings, integrator=SCHEMES[0]))
        notes.append(f"{SCHEMES[0]} in place of {name}, which has no sensitivities")
        name = SCHEMES[0]
    if name not in SCHEMES:
        works = [n for n in SCHEMES if n in INTEGRATORS.names]
        got, hint = f"'{name}'", f"with the method {ready.plan.choice.method.name}, none has"
        if "ode" in forms:
            hint = f"take {works[0]}"
        raise InputError("sensitivities: integrator", f"an explicit scheme ({', '.join(works)})", got, hint)
    run = _add_derivative_code(ready).run()
    watched = run.spec.events
    refuse_law_without_directions(watched, name)
    if any(x.jumps for x in discontinuities_of(run.plan.mechanism)) or (watched and watched.rows is not None):
        expected, got = "a run without jumps of formulas", "formulas that jump where the state passes zero"
        hint = "write kinks by max, min or abs, and jumps as an event, which resets a state of the file"
        raise InputError("sensitivities", expected, got, hint)
    return run, tuple(notes)


def _add_derivative_code(ready: Preparation) -> Preparation:
    """Return a run with the code for derivatives."""
    plan = ready.plan
    return replace(ready, plan=replace(plan, choice=replace(plan.choice, directed=True)), assembled=None)


class Differentiated:
    """A run with directions.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        Of the run.
    names : mapping of str to str
        What it is differentiated by, as typed, each with its name in the mechanism: parameters, values of the start,
        ``method.NAME``.

    Attributes
    ----------
    run : Prepared
        The run without directions.
    """

    def __init__(self, mechanism: Mechanism, settings: Settings, names: Mapping[str, str]) -> None:
        run, self._notes = prepare_for_directions(mechanism, settings)
        self.directions = named_directions(run, names)
        self._start = StartDirections(run, self.directions)
        self.run = with_moving_kinks(run, self._start)
        self._course: DirectedCourse | None = None

    def integrate(self, progress: Callable[[float], None] | None = None) -> Outcome:
        """Integrate with directions, and return the outcome as of a run without them."""
        run = self.run
        seeds = self._start.seeds()
        self._course = run_with_directions(run.compiled, run.plan.integrator, run.start, run.spec, seeds, progress)
        return self._course.outcome

    @property
    def seconds(self) -> float:
        """Processor time of all loops that `integrate` entered [s]."""
        assert self._course is not None, "the run was made"
        return sum(part.outcome.cpu_seconds for part in self._course.parts)

    @property
    def bodies(self) -> CompiledModel:
        """Code whose coordinates tables have: of bodies."""
        return self._start.compiled

    def sensitivities(self, outcome: Outcome) -> Sensitivities:
        """Return the sensitivities of the run that `integrate` made.

        Parameters
        ----------
        outcome : Outcome
            The outcome as reported.
        """
        assert self._course is not None, "the run was made"
        return Sensitivities(Evaluated(self.run, self._start, self._course), outcome)

    def result(self, result: Result) -> Result:
        """Return a result with its sensitivities, with notes and warnings on them."""
        own = self.sensitivities(result.outcome)
        notes = *result.notes, *self._notes, *self._start.notes
        reason, status = result.reason, result.status
        still = [name for name, moves in zip(own.names, own.moves, strict=True) if not moves]
        warnings = (*result.warnings, *(unmoved_sentence([name], "in this run") for name in still))
        if together := self._warning_on_shared_forces(own):
            warnings = (*warnings, together)
        doubt = own.reason_for_doubt(result)
        if doubt and status == "ok":
            status, reason = "unverified", doubt
        return replace(result, sensitivities=own, notes=notes, warnings=warnings, status=status, reason=reason)

    @staticmethod
    def _warning_on_shared_forces(own: Sensitivities) -> str:
        """Return the warning on forces at rest that joints do not determine, empty without such."""
        rows = own.resting_together
        if not rows:
            return ""
        return (
            f"{enumeration(rows)} rest together: derivatives of their forces there are those of one way to share them"
        )


class Sensitivities:
    """Derivatives of a run by chosen numbers; ``sensitivities["crank.theta"]`` is a table over time, as `of` returns.

    Parameters
    ----------
    evaluated : Evaluated
        Evaluates them.
    outcome : Outcome
        The outcome as reported.

    Attributes
    ----------
    names, units : tuple of str
        What the run is differentiated by, and the units of that.
    """

    def __init__(self, evaluated: Evaluated, outcome: Outcome) -> None:
        self._evaluated, self._outcome = evaluated, outcome
        self.names = tuple(d.name for d in evaluated.start.directions)
        self.units = tuple(d.unit for d in evaluated.start.directions)
        self._tables = dict[str, Array]()

    def __repr__(self) -> str:
        return f"<Sensitivities to {', '.join(self.names)}>"

    def __getstate__(self) -> dict[str, Any]:
        for name in ("q", "v"):
            self.table(name)
        _ = self.violation, self.error, self.moves, self.end
        return {**self.__dict__, "_evaluated": None, "_outcome": None}

    @cached_property
    def violation(self) -> float:
        """How far directions leave the constraints: a row's largest derivative over a coordinate's."""
        return float(self._evaluated.distance_from_constraints().max(initial=0.0))

    @cached_property
    def _errors(self) -> tuple[Array, Array] | None:
        return errors_of_steps(self._evaluated)

    @property
    def error(self) -> float | None:
        """Largest estimated error of a derivative in one step, over its size; None for constant steps."""
        return None if self._errors is None else float(self._errors[0].max(initial=0.0))

    @cached_property
    def end(self) -> dict[str, float] | None:
        """Derivatives of the time of the event that ended the run, by name; None where none did.

        Derivatives of quantities are those at the same time; a quantity at the event changes by its rate times
        these as well.
        """
        times = self._evaluated.directions_of_end()
        return None if times is None else dict(zip(self.names, times.tolist(), strict=True))

    @property
    def resting_together(self) -> tuple[str, ...]:
        """Rows with bounds that share forces at rest at some output, which joints do not determine."""
        return self._evaluated.resting_together()

    @cached_property
    def moves(self) -> tuple[bool, ...]:
        """Whether each number changes the motion at all."""
        return tuple(bool(x) for x in np.any(self._evaluated.course.states != 0.0, axis=(0, 1)))

    def table(self, name: str) -> Array:
        """Return the derivatives of all columns of a table of the result, shape (k, columns, n).

        Parameters
        ----------
        name : str
            ``q``, ``v``, ``a``, ``joint_coordinates``, ``points``, ``elements`` or ``outputs``.

        Raises
        ------
        InputError
            If the table has no sensitivities.
        """
        if name not in TABLES:
            raise InputError("sensitivities", f"a table with sensitivities ({', '.join(TABLES)})", quote(name))
        if name not in self._tables:
            if self._evaluated is None:
                raise InputError("sensitivities", "a result of this process", "one that was pickled or copied")
            self._tables[name] = self._table(name)
        return self._tables[name]

    def _table(self, name: str) -> Array:
        evaluated, outcome = self._evaluated, self._outcome
        compiled, mechanism = outcome.compiled, evaluated.run.plan.mechanism
        info = compiled.info
        if name in ("q", "v"):
            states = evaluated.states()
            return states[:, : info.nq] if name == "q" else states[:, info.nq : info.work]
        if name == "a":
            return evaluated.rates()[:, info.nq : info.work]
        if name == "joint_coordinates":
            return evaluated.function(compiled.model.observe, info.observed)[:, info.m :]
        formulas = [(column.name, column.formula) for column in FORMULAS[name](mechanism)]
        if not formulas:
            return np.zeros((len(outcome.times), 0, len(self.names)))
        return self._formulas(name, formulas)

    def _formulas(self, name: str, formulas: list[tuple[str, Expr]]) -> Array:
        """Return the derivatives of formulas, shape (k, formulas, n)."""
        evaluated, outcome = self._evaluated, self._outcome
        side = compile_side(
            evaluated.run.plan.mechanism, outcome.compiled, name, f"the table {name} of results", formulas
        )
        if "multipliers" in side.reads and outcome.start.redundant_rows:
            row = outcome.start.redundant_rows[0]
            got = f"those of dependent rows ({row}) in {name}"
            raise InputError("sensitivities", "multipliers that the motion determines", got)
        return evaluated.function(side.function, len(formulas))

    def column(self, table: str, place: int, unit: str) -> Labelled:
        """Return the derivatives of one column of a table over time."""
        return self._labelled(self.table(table)[:, place], unit)

    def of_quantity(self, result: Result, name: str) -> Labelled:
        """Return the derivatives of a column, an energy or a formula over time.

        Raises
        ------
        InputError
            If it is none, or has no derivatives.
        """
        if result._places.get(name, ("", 0))[0] in TABLES:
            return self.column(*place_of_column(result, name))
        if self._evaluated is None:
            raise InputError("sensitivities", "a result of this process", "one that was pickled or copied")
        if name in ENERGIES:
            return self._labelled(self._evaluated.energies() @ np.array(ENERGIES[name]), "J")
        names = QuantityNames(self._evaluated.run.plan.mechanism)
        try:
            quantity = names.read("gradient", name)
        except InputError as error:
            # a column without derivatives has a name of its own; anything else is a slip in a formula
            if name in result._places or name.replace(".", "").isidentifier():
                place_of_column(result, name)
            raise InputError("gradient", error.expected, error.got, error.hint) from None
        return self._labelled(self._formulas("gradient", [(name, quantity.formula)])[:, 0], quantity.unit)

    def _labelled(self, values: Array, unit: str) -> Labelled:
        return Labelled(values, self.names, tuple(derivative_unit(unit, own) for own in self.units))

    def saved(self, result: Result) -> tuple[str, ...]:
        """Return the tables that files hold: coordinates, velocities, and outputs if there are any."""
        return ("q", "v", "outputs") if result.columns("outputs") else ("q", "v")

    def to_json(self, result: Result) -> dict[str, Any]:
        """Return names, units, the violation, and the derivatives at the end by quantity and name."""
        final = dict[str, dict[str, float]]()
        for table in self.saved(result) if len(result.t) else ():
            for column, row in zip(getattr(result, table).names, self.table(table)[-1].tolist(), strict=True):
                final[column] = dict(zip(self.names, row, strict=True))
        by = dict(zip(self.names, self.units, strict=True))
        return {"by": by, "violation": self.violation, "error": self.error, "end": self.end, "final": final}

    def reason_for_doubt(self, result: Result) -> str | None:
        """Return why the sensitivities of a run are in doubt, None where they are not."""
        if doubt := doubt_of_motion(result):
            return doubt
        if self._evaluated.course.doubts:
            return self._evaluated.course.doubts[0]
        if self.end is not None and not np.all(np.isfinite([*self.end.values()])):
            return "the event that ended the run is met without speed: its time has no derivative"
        if self.violation > CONSISTENT:
            return f"sensitivities leave the constraints by {self.violation:.1g} of their size"
        return self.doubt_of_steps(result.outcome.simulation.spec)

    def doubt_of_steps(self, spec: RunSpec) -> str | None:
        """Return that steps of a run are too long for derivatives, None where they are not."""
        if self.error is None or self._errors is None or not self.error > DOUBTFUL * max(spec.rtol, spec.atol):
            return None
        errors, times = self._errors
        k = int(errors.argmax())
        where = f"in the one that ends at t = {times[k]:.6g} s the derivative by {self.names[k]}"
        error = f"errs by about {errors[k]:.1g} of its size; take a smaller max_step, or a constant step"
        return f"steps follow the state alone: {where} {error}"


def doubt_of_motion(result: Result) -> str | None:
    """Return why derivatives of any kind are in doubt because of the motion, None where they are not."""
    if result.rank_event_count:
        first = result.rank_events[0].t_in
        return f"the motion passes near a singular position at t = {first:.6g} s, where sensitivities may jump"
    if result.outcome.counters["dense_solves"]:
        return "accelerations were solved with another rank on the way, which sensitivities do not follow"
    return None


def derivative_unit(unit: str, by: str) -> str:
    """Return the unit of a derivative."""
    if not by:
        return unit
    below = f"({by})" if any(sign in by for sign in " */") else by
    return f"{unit or '1'}/{below}" if not any(sign in unit for sign in " /") else f"({unit})/{below}"


def place_of_column(result: Result, name: str) -> tuple[str, int, str]:
    """Return the table, the place and the unit of a column of a result.

    Raises
    ------
    InputError
        If there is no such column, or it has no sensitivities.
    """
    places = {n: at for n, at in result._places.items() if at[0] in TABLES}
    if name not in places:
        raise InputError("gradient", "a quantity with sensitivities", quote(name), suggest(name, places))
    table, place = places[name]
    return table, place, getattr(result, table).units[place]
