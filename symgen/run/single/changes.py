"""External control of a run: acceptance of its first state without a step, and changes of parameters during it.

There are two kinds of parameters. Inputs appear only in functions of state: other values need only `prepare` and a new
begin of the scheme. All others may change masses and joints: the state is accepted again.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.compile.loopcode.entry import bind_arguments
from symgen.compile.loopcode.exact import plain_form
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.model_arrays import triplets_of_entries
from symgen.run.layout.scales import mean_mass
from symgen.run.starts.assembler import layout_of_starts

if TYPE_CHECKING:
    from symgen.run.single.simulation import Simulation

Array = NDArray[np.float64]

#: Results of `watch` at accepted states: they are already present if a run begins anew.
_WATCHED = [abi.PASSAGES, abi.IN_ZONE, abi.LAST_RANK, abi.MASKED, abi.OUTPUTS]


def begin_stepping(simulation: Simulation) -> int:
    """Accept the first state and prepare the scheme, without a step; return `DONE` or the reason for a refusal."""
    control = simulation.state.control
    control[abi.STOP] = 1
    try:
        code = simulation.go_until(simulation.spec.until, math.inf)
    finally:
        control[abi.STOP] = 0
    return abi.DONE if code == abi.STOPPED else code


def begin_anew(simulation: Simulation) -> int:
    """Discard the rates that the scheme keeps, because they have just changed.

    The state is accepted again. Results so far stay: the largest violations, passages, and the next step of an
    adaptive run. The energy that the change adds counts as work.
    """
    state, place = simulation.state, simulation.compiled.info.work
    w, gauges, watched = state.w, state.gauges.copy(), state.control[_WATCHED]
    work = float(state.y[place])
    state.control[abi.BEGUN] = 0
    state.y[place] = 0.0  # the balance begins with no work
    state.iw[abi.BALANCED] = 0
    before = float(w[abi.KINETIC] + w[abi.POTENTIAL])
    code = begin_with_step(simulation)
    state.y[place] = work + float(w[abi.KINETIC] + w[abi.POTENTIAL]) - before
    state.iw[abi.BALANCED] = 0  # the work has changed
    state.gauges[:], state.control[_WATCHED] = gauges, watched
    return code


def begin_with_step(simulation: Simulation) -> int:
    """Begin as `begin` does; an adaptive run that has taken steps keeps its next step."""
    state, span = simulation.state, simulation.span
    if state.control[abi.STEPS] > 0 and simulation.spec.adaptive:
        simulation.span = span._replace(step=float(state.clock[abi.NEXT]))
    try:
        return begin_stepping(simulation)
    finally:
        simulation.span = span


class Changes:
    """Changes of parameters during a run.

    Parameters
    ----------
    simulation : Simulation
        The run.
    """

    def __init__(self, simulation: Simulation) -> None:
        self.simulation = simulation

    def keep_first(self) -> None:
        """Keep the parameters with which the run begins."""
        state = self.simulation.state
        self._first_p, self._first_seam = state.p.copy(), int(state.control[abi.PASSED])

    def earlier_parameters(self, times: Array) -> tuple[tuple[float, Array], ...]:
        """Return the parameters of earlier parts of the run, each with the last time at which it holds.

        Parameters
        ----------
        times : Array
            Of outputs; parts without outputs and events are left out.
        """
        simulation = self.simulation
        happened = () if simulation.events is None else (event.t for event in simulation.events.happened)
        marks, pieces, count = np.sort([*times, *happened]), list[tuple[float, Array]](), 0
        p, places = self._first_p.copy(), self.inputs
        for seam in simulation.spec.seams[self._first_seam : simulation.state.control[abi.PASSED]]:
            near = abi.RESOLVED_TIME * seam.t if simulation.spec.adaptive else simulation.same(seam.t)
            before, count = count, int(np.searchsorted(marks, seam.t + near, side="right"))
            if seam.values and count > before:
                pieces.append((seam.t + near, p.copy()))
                simulation.compiled.prepare(pieces[-1][1])
            elif not seam.values:
                count = before
            for name, value in seam.values.items():
                p[places[name]] = value
        return tuple(pieces)

    def give_values(self, values: Mapping[str, float]) -> bool:
        """Set inputs to other values from the present state on; the scheme begins anew.

        Parameters
        ----------
        values : mapping of str to float
            Finite values by names of inputs.

        Returns
        -------
        bool
            Whether any value has changed; otherwise nothing is done.

        Raises
        ------
        InputError
            If a formula is not finite with these values; nothing is changed then.
        """
        state, places = self.simulation.state, self.inputs
        p, before = state.p, None
        for name, value in values.items():
            place = places[name]
            if p[place] != value:
                before = p.copy() if before is None else before
                p[place] = value
        if before is None:
            return False
        try:
            with np.errstate(all="ignore"):
                self.prepare()
            if not np.isfinite(p).all():
                raise InputError("inputs", "values for which every formula is finite", "others")
        except BaseException:
            p[:] = before
            raise
        if state.control[abi.BEGUN] == 1:
            state.control[abi.BEGUN] = abi.AFRESH
        return True

    def are_defined(self) -> bool:
        """Prepare parameters that have changed at a seam; return whether all are defined."""
        try:
            self.prepare()
        except InputError:  # looped code names the formula; a run ends with one reason in both shapes
            return False
        return bool(np.isfinite(self.simulation.state.p).all())

    def set(self, p: Array) -> None:
        """Continue with other parameters from the present state.

        The energy that the change adds counts as work done on the mechanism. Masses may change as well; positions and
        velocities stay, so changes of the constraints that they violate are refused.

        Parameters
        ----------
        p : Array
            Parameters of the model and the method, not yet prepared; others stay unchanged.

        Raises
        ------
        InputError
            If a number is not finite, a mass is not positive, or the present state violates the constraints by more
            than the run tolerates; nothing is changed then.
        """
        simulation, state = self.simulation, self.simulation.state
        front = simulation.snapshot.front
        before, passages = front.copy(), state.passages.copy() if state.control[abi.PASSAGES] > 0 else None
        try:
            with np.errstate(all="ignore"):
                self._check(p)
            code = begin_anew(simulation)
            if code != abi.DONE:
                raise InputError("set", "parameters with which the run can go on", abi.REASONS[code])
        except BaseException:
            front[:] = before
            if passages is not None:
                state.passages[:] = passages
            raise

    def _check(self, p: Array) -> None:
        """Store parameters and masses, and check that the present state allows them."""
        compiled, state = self.simulation.compiled, self.simulation.state
        w, info = state.w, compiled.info
        t, sections = float(state.clock[abi.TIME]), [compiled.section(w, name) for name in ("jacobian", "nu")]
        masses, geometry = self._functions
        geometry(t)
        before = [section.copy() for section in sections]
        state.p[: len(p)] = p
        self.prepare()
        try:
            masses()
            geometry(t)
        except (ArithmeticError, ValueError):  # plain Python raises
            w[abi.PHI] = math.nan
        mass = compiled.section(w, "mass")
        for j in np.flatnonzero(~(mass > 0.0)):
            if j not in info.massless:
                body = info.velocities[j].name.rpartition(".")[0]
                raise InputError("set", f"a mass and an inertia of {body} above 0", f"{mass[j]:g}")
        if not (math.isfinite(w[abi.PHI]) and np.isfinite(state.p).all()):
            raise InputError("set", "parameters for which the equations are defined", "numbers that are not finite")
        w[abi.MEAN_MASS] = plain_form(mean_mass)(layout_of_starts(compiled), w)
        spec, width, nq = self.simulation.spec, self.simulation.sizes.width, info.nq
        reach = state.metric[:nq] * (state.y[:nq] - state.metric[width : width + nq])
        length = max(float(w[abi.LENGTH]), float(np.abs(reach).max(initial=0.0)))
        self._refuse("position", float(w[abi.PHI_MEASURE]), spec.max_violation * length)
        if any(not np.array_equal(*pair) for pair in zip(before, sections, strict=True)):
            self._refuse("velocity", self._drift(*sections), spec.velocity_limit * float(w[abi.SPEED]))

    @staticmethod
    def _refuse(what: str, size: float, most: float) -> None:
        if not size <= most:
            raise InputError(
                "set",
                f"parameters that leave the {what} of every joint as it is",
                f"a violation of {size:.3g} (at most {most:.3g})",
                "start anew for another geometry",
            )

    def _drift(self, jacobian: Array, nu: Array) -> float:
        """Return the norm of D v - nu of the present velocities, angular rows multiplied by the length."""
        info, state = self.simulation.compiled.info, self.simulation.state
        rows, columns, values = triplets_of_entries(info, jacobian)
        v = state.y[info.nq : info.nq + info.nv]
        lengths = np.where([row.unit == "rad" for row in info.rows], state.w[abi.LENGTH], 1.0)
        return float(np.linalg.norm(lengths * (np.bincount(rows, values * v[columns], info.m) - nu)))

    def prepare(self) -> None:
        """Evaluate the numbers that depend on parameters alone; undefined ones become NaN."""
        try:
            for function in self._preparing:
                function()
        except (ArithmeticError, ValueError):  # plain Python raises
            self.simulation.state.p[-1] = math.nan

    @cached_property
    def inputs(self) -> dict[str, int]:
        """Indices of the inputs among the parameters."""
        info = self.simulation.compiled.info
        return {q.name: i for i, q in enumerate(info.parameters) if q.name in info.inputs}

    @cached_property
    def _preparing(self) -> tuple[Callable[..., Any], ...]:
        """``prepare`` of model and law, on the parameters of the run."""
        modules = self.simulation.compiled.model, self.simulation.compiled.law_module
        return tuple(bind_arguments(module.prepare, e.PREPARE, self.simulation.state.p) for module in modules)

    @cached_property
    def _functions(self) -> tuple[Callable[..., Any], Callable[..., Any]]:
        """``masses`` and ``geometry`` on the arrays of the run; the latter takes the time."""
        (y, p, w), model = self.simulation.state[:3], self.simulation.compiled.model
        return bind_arguments(model.masses, abi.MOVE, p, w), bind_arguments(model.geometry, abi.MEASURE, 0.0, y, p, w)
