"""References: the motion as accurate as possible, computed without any of the emitted code.

A mechanism of the catalogue with a formula, or an equation in one coordinate, uses that. For every other one SciPy's
DOP853 integrates independently derived equations at a tight tolerance, projected at each output, twice with different
tolerances and segments; the difference of the two is the estimated error. Near a singular position the steps are
constant, and two runs whose steps fall differently have to agree: small violations do not determine the branch. If they
do not agree, a note of the reference names the time. Another of SciPy's solvers can be chosen for every mechanism: then
the schemes, too, are not symgen's.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, SimulationError
from symgen.describe.mechanism import Mechanism
from symgen.result.points import AGREEMENT, Agreement, Points, compare_motions
from symgen.study.references.closed_forms import closed_form
from symgen.study.references.solvers import (
    AUTO,
    MOST_CALLS,
    SOLVERS,
    CollapsedError,
    Scheme,
    check_solver,
    integrate_by_multistep,
    integrate_by_steps,
    longest_reference_step,
)

if TYPE_CHECKING:
    from symgen.study.references.independent import IndependentEquations

Array = NDArray[np.float64]

#: A position counts as near-singular where the smallest singular value of D, rows scaled to length 1, is below this
#: fraction of its largest value of the run: the root of the runtime's threshold, which is one of squares. A fraction,
#: because short links in metres make the value itself small everywhere.
NEAR = 1e-2
#: Steps of the runs, as fractions of the first one's.
PHASES = (1.0, 0.93, 0.81, 1.11, 0.71, 0.62)
#: Two runs that differ by less, as a share of the mechanism's size, are accepted.
GOOD = 1e-9
#: Two runs through singular positions that agree by chance understate their error; it was up to five times the
#: difference with `n-four-bar`, whose exact motion is known.
DOUBT = 5.0


@dataclass(frozen=True)
class Reference:
    """Reference motion.

    Attributes
    ----------
    how, estimated_error : str, float
        Source, in one sentence, and estimated error of its points [m].
    times, q, v : Array, shapes (k,), (k, nq), (k, nv)
        Times [s], coordinates, and velocities as in results.
    note : str
        Meaning of errors, in one sentence, where two runs with different steps part at a singular position; else empty.
    lam : mapping of str to Array, shape (k,)
        Multipliers by the names of rows; empty where they were not computed.
    undetermined : tuple of str
        Joints whose reactions the equations of motion do not determine.
    z : Array, shape (k, number of states of the file), or empty
        States that the file defines.
    """

    how: str
    estimated_error: float
    times: Array
    q: Array
    v: Array
    note: str = ""
    lam: Mapping[str, Array] = field(default_factory=dict)
    undetermined: tuple[str, ...] = ()
    z: Array = field(default_factory=lambda: np.zeros((0, 0)))

    @classmethod
    def of_states(
        cls, equations: IndependentEquations, how: str, estimated: float, times: Array, states: Array, note: str = ""
    ) -> Reference:
        """Return the reference of integrated states: coordinates, their rates and states of the file."""
        velocities, n = np.array([equations.velocities(y) for y in states]), equations.n
        return cls(how, max(estimated, 1e-14), times, states[:, :n], velocities, note, z=states[:, 2 * n :])


def reference_motion(
    mechanism: Mechanism,
    parameters: Mapping[str, float],
    q: Array,
    v: Array,
    times: Array,
    solver: str = AUTO,
    own_start: bool = True,
    z: Array | None = None,
) -> Reference:
    """Return the reference motion of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    parameters : mapping
        Values of all parameters.
    q, v : Array, shapes (nq,), (nv,)
        Consistent start.
    times : Array
        Output times [s], increasing from 0 or later.
    solver : str
        ``auto``, or one of `SOLVERS`.
    own_start : bool
        Whether the start is the mechanism's own: formulas hold for no other.
    z : Array, optional
        Start of the states that the file defines; by default as the file has it.

    Raises
    ------
    InputError
        If the solver does not exist, or the mechanism has beam elements or modal bodies, which have no second
        derivation.
    SimulationError
        If the motion cannot be integrated, e.g. into a singularity.
    """
    if mechanism.has_modal_bodies or any(force.flexures for force in mechanism.forces):
        expected = "a mechanism without beam elements and modal bodies, whose equations are derived a second time"
        raise InputError("reference_by", expected, f"'{mechanism.name}'", f"'{AUTO}' takes two formulations that agree")
    closed = closed_form(mechanism) if check_solver(solver) == AUTO and own_start else None
    from symgen.study.references.independent import IndependentEquations

    equations = IndependentEquations(mechanism, parameters)
    y = equations.nearest_state(0.0, equations.state(q, v, z))
    if closed is None:
        reference = _integrate_twice(equations, y, times, "scipy-dop853" if solver == AUTO else solver)
    else:
        how, estimated, motion, velocities = closed(mechanism, parameters, q, times)
        reference = Reference(how, estimated, times, motion, velocities)
    own = reference.z.reshape(len(times), -1)
    states = [equations.state(*state) for state in zip(reference.q, reference.v, own, strict=True)]
    lam = np.array([equations.multipliers(float(t), y) for t, y in zip(times, states, strict=True)])
    lam = lam.reshape(len(times), equations.m)
    by_name = {name: lam[:, i] for i, name in enumerate(equations.row_names)}
    return replace(reference, lam=by_name, undetermined=equations.undetermined_joints(y))


# -- any mechanism -----------------------------------------------------------------------------------------------------


def _integrate_twice(equations: IndependentEquations, y: Array, times: Array, solver: str) -> Reference:
    """Integrate the independently derived equations twice."""
    name, fine_tolerance, coarse_tolerance, goes_on = SOLVERS[solver]
    if not goes_on:
        fine = integrate_by_multistep(equations, y, times, Scheme(name, fine_tolerance, most=MOST_CALLS))
        coarse = integrate_by_multistep(equations, y, times, Scheme(name, coarse_tolerance, most=MOST_CALLS))
    else:
        watch = SingularWatch(equations, y)
        with suppress(CollapsedError):
            fine = integrate_by_steps(equations, y, times, Scheme(name, fine_tolerance), see=watch.record_step)
            watch.collapsed = False
        if watch.collapsed or watch.smallest < NEAR * watch.largest:
            return pass_through(equations, y, times, watch.usual_step or float(times[-1]) / 1000.0)
        coarse = integrate_by_steps(equations, y, times, Scheme(name, coarse_tolerance, 3, False))
    n = equations.n
    estimated = Points.of_mechanism(equations.mechanism, equations.parameters).largest_distance(
        fine[:, :n], coarse[:, :n]
    )
    how = (
        f"independently derived equations, SciPy {name} at {fine_tolerance:g}, projected at every output; "
        f"estimated from a second run at {coarse_tolerance:g}"
    )
    return Reference.of_states(equations, how, estimated, times, fine)


# -- singular positions ------------------------------------------------------------------------------------------------


def scaled_values(d: Array) -> Array:
    """Return the singular values of the rows scaled to length 1."""
    lengths = np.linalg.norm(d, axis=1)
    return np.asarray(np.linalg.svd(d / np.where(lengths > 0.0, lengths, 1.0)[:, None], compute_uv=False))


class SingularWatch:
    """Steps of a run, and the extremes of the smallest singular value of D with scaled rows.

    Parameters
    ----------
    equations : IndependentEquations
        Integrated equations.
    y : Array, shape (2 n,)
        The start, whose rank counts: permanently dependent rows are no passage.
    """

    def __init__(self, equations: IndependentEquations, y: Array) -> None:
        self.equations, self.sizes, self.collapsed = equations, list[float](), True
        self.rank = int(np.sum(self._values(0.0, y) > 1e-6))
        self.smallest, self.largest = np.inf, 0.0
        self.record_step(0.0, 0.0, y)
        self.sizes.clear()

    def _values(self, t: float, y: Array) -> Array:
        n = self.equations.n
        d = self.equations.evaluate(t, y[:n], y[n:])[1]
        return scaled_values(d) if np.all(np.isfinite(d)) else np.zeros(len(d))

    def record_step(self, size: float, t: float, y: Array) -> None:
        """Record a step and the state at its end."""
        self.sizes.append(size)
        if self.rank:
            value = float(self._values(t, y)[self.rank - 1])
            self.smallest, self.largest = min(self.smallest, value), max(self.largest, value)

    @property
    def usual_step(self) -> float:
        """Step by which half of the time was covered, 0 without steps: collapsed steps are many but cover no time."""
        ordered = np.sort(np.array(self.sizes))
        covered = np.cumsum(ordered)
        return float(ordered[int(np.searchsorted(covered, 0.5 * covered[-1]))]) if self.sizes else 0.0


def pass_through(equations: IndependentEquations, y: Array, times: Array, step: float) -> Reference:
    """Run with constant steps until two runs agree well; return the pair that agrees best as the reference.

    At an isolated singular position accelerations are not determined; an error estimate measures noise there, and steps
    that follow it collapse. A constant step with a projection after each carries a run through. Its accuracy depends on
    where the steps fall.

    Parameters
    ----------
    equations, y, times
        Integrated equations, consistent initial state, and output times [s].
    step : float
        Step of the first run [s].

    Raises
    ------
    SimulationError
        If fewer than two runs reach the end.
    """
    points, motions, failures = (
        Points.of_mechanism(equations.mechanism, equations.parameters),
        list[Array](),
        list[str](),
    )
    longest = min(step, longest_reference_step(equations, times) / max(PHASES))
    if len(times) > 1:  # steps that were longer than from one output to the next would all fall alike
        longest = min(longest, float(np.median(np.diff(times))) / max(PHASES))
    best: tuple[Agreement, Array, int] | None = None
    for i, phase in enumerate(PHASES):
        try:
            motion = integrate_by_steps(equations, y, times, Scheme("DOP853", np.inf, step=phase * longest))
        except SimulationError as error:
            failures.append(str(error))
            continue
        for other in motions:
            apart = compare_motions(points, other[:, : equations.n], motion[:, : equations.n])
            if best is None or apart.apart < best[0].apart:
                best = apart, other, i + 1
        motions.append(motion)
        if best is not None and best[0].apart < GOOD * points.size(motion[:, : equations.n]):
            break
    if best is None:
        raise SimulationError(failures[0])
    apart, states, runs = best
    how = (
        f"independently derived equations, SciPy DOP853 at constant steps near {step:.2g} s, projected after every "
        f"step, through singular positions; estimated from {runs} runs whose steps fall differently"
    )
    note = ""
    if apart.parts is not None:
        note = (
            f"the two reference runs that agree best part by more than {AGREEMENT:g} of the mechanism's size at "
            f"t = {float(times[apart.parts]):.4g} s, behind a singular position: from there on it is not known which "
            "branch the motion takes, and errors are distances to one of them"
        )
    return Reference.of_states(equations, how, DOUBT * apart.apart, times, states, note)
