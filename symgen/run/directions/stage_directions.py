"""Directions of one step of a Runge-Kutta scheme, from its stages.

The beginning of a step and its length have directions, too. Explicit stages k are rates at Y = y + h A k, whose
directions follow one after the other. Implicit stages satisfy F(t + c h, Y, k) = 0, so that

    (dF/dk + h A dF/dY) dk = -(dF/dY (dy + A k dh) + dF/dt (dt + c dh) + dF/dp dp),

with the emitted derivatives at converged stages. The state at the end has the directions dy + h b dk + b k dh; the
emitted ``accept`` corrects state and directions. Where an event ends a step, the scheme itself is differentiated by the
length of the step: the rate of the motion would leave the error of the scheme.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.compile.store.emitted import with_directions
from symgen.run.directions.directed_model import form_for_derivatives
from symgen.run.directions.moments import Directions, Moment, Moments
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.layout.scheme_records import Stages, TableauRecord
from symgen.run.loops.newton import Pattern

if TYPE_CHECKING:
    from symgen.run.layout.records import State

Array = NDArray[np.float64]

#: Newton iterations at most, and the relative correction of stages below which they count as those of the step.
_ITERATIONS, _SAME = 10, 1e-11


class DifferentiatedStep(NamedTuple):
    """A step to be differentiated.

    Attributes
    ----------
    before : Moment
        The state at its beginning.
    h : float
        Its length [s].
    by : Directions
        Directions at its beginning.
    longer : Array, shape (k,)
        Directions of its length.
    """

    before: Moment
    h: float
    by: Directions
    longer: Array

    def at(self, c: float, y: Array) -> Moment:
        """Return the state of a stage."""
        return self.before._replace(t=self.before.t + c * self.h, y=y)

    def time(self, c: float) -> Array:
        """Return the directions of the time of a stage."""
        return self.by.t + c * self.longer


class StageDirections(ABC):
    """Directions through steps.

    Parameters
    ----------
    moments : Moments
        The code, with directions of parameters.
    """

    def __init__(self, moments: Moments) -> None:
        self.moments, self.law = moments, moments.compiled.law_module

    @abstractmethod
    def directions_after_step(self, step: DifferentiatedStep, state: State) -> Array:
        """Return the directions of the state after a step, shape (ny, k).

        Parameters
        ----------
        step : DifferentiatedStep
            The step.
        state : State
            Of the run after it: in its working memory, stages of the step or some near them.
        """

    @cached_property
    def _accept(self) -> Any:
        return self.moments.model.function(self.law.accept, timed=True).caller(abi.ACCEPT.signature.arguments)

    def _correct_directions(self, step: DifferentiatedStep, end: Array, y: Array) -> Array:
        """Return the directions of a state after its correction."""
        columns, model = list[Array](), self.moments.model
        now, by = step.at(1.0, end), Directions(y, step.time(1.0), step.by.modes)
        for _, own, p, w in self.moments.chunks_of_states(now, by):
            self._accept(now.t, own, p, w, np.zeros(abi.N_COUNTERS, dtype=np.int64))
            columns.append(model.directions_after(own, "y").copy())
        return np.concatenate(columns, axis=1)[:, : y.shape[1]]


class ExplicitStages(StageDirections):
    """Directions through steps of an explicit scheme.

    Parameters
    ----------
    moments : Moments
        The code.
    scheme : Tableau
        The scheme's record.
    """

    def __init__(self, moments: Moments, scheme: TableauRecord) -> None:
        super().__init__(moments)
        self._c, self._a = scheme.nodes, np.zeros((scheme.stages + 1, scheme.stages))
        for s in range(scheme.stages + 1):
            entries = slice(scheme.start[s], scheme.start[s + 1])
            self._a[s, scheme.column[entries]] = scheme.value[entries]

    @cached_property
    def _rates(self) -> tuple[Any, Any]:
        rhs = form_for_derivatives(self.law, "rhs")
        functions = (self.moments.model.function(f, timed=True) for f in (rhs, getattr(self.law, "confirm", rhs)))
        rates, confirm = (f.caller(abi.RHS.signature.arguments) for f in functions)
        return rates, confirm

    def directions_after_step(self, step: DifferentiatedStep, state: State) -> Array:
        """Return the directions of the state after a step, shape (ny, k)."""
        stages, columns, count = list[Array](), list[Array](), len(self._a) - 1
        end = step.before.y[: self.moments.model.sizes["y"]]
        y = step.by.y
        for s in range(count + 1):
            sums = sum((a * k for a, k in zip(self._a[s], stages, strict=False)), np.zeros_like(end))
            slopes = sum((a * k for a, k in zip(self._a[s], columns, strict=False)), np.zeros_like(step.by.y))
            end = step.before.y[: len(sums)] + step.h * sums
            y = step.by.y + step.h * slopes + np.outer(sums, step.longer)
            if s < count:
                rate, slope = self._rate(step, float(self._c[s]), end, y)
                stages.append(rate)
                columns.append(slope)
        return self._correct_directions(step, end, y)

    def _rate(self, step: DifferentiatedStep, c: float, y: Array, by: Array) -> tuple[Array, Array]:
        """Return the rate at a stage and its directions."""
        model, (rates, confirm), columns = self.moments.model, self._rates, list[Array]()
        now, counters = step.at(c, y), np.zeros(abi.N_COUNTERS, dtype=np.int64)
        ydot = np.zeros(len(y) * (1 + model.lanes))
        for _, own, p, w in self.moments.chunks_of_states(now, Directions(by, step.time(c), step.by.modes)):
            ydot[:] = 0.0
            if rates(now.t, own, p, w, counters, ydot) != 0:
                confirm(now.t, own, p, w, counters, ydot)
            columns.append(model.directions_after(ydot, "ydot").copy())
        return ydot[: len(y)].copy(), np.concatenate(columns, axis=1)[:, : by.shape[1]]


class ImplicitStages(StageDirections):
    """Directions through steps of an implicit scheme on the descriptor form.

    Parameters
    ----------
    moments : Moments
        The code.
    scheme : Stages
        The scheme's record.
    """

    def __init__(self, moments: Moments, scheme: Stages) -> None:
        super().__init__(moments)
        info, self._n, self._s = moments.compiled.info, moments.compiled.law.unknowns, int(scheme.stages)
        self._a, self._b, self._c = scheme.a.reshape(self._s, self._s), scheme.b, scheme.c
        first, states = info.nq + info.nv, len(info.states)
        # unknowns that are rates of elements of the state, and these elements
        self._rates = np.r_[0:first, self._n - states : self._n]
        self._elements = np.r_[0:first, first + 1 : first + 1 + states]
        self._residual, self._tangent = (Ready(getattr(self.law, name), abi.STAGE) for name in ("residual", "tangent"))

    @cached_property
    def _directed(self) -> Any:
        """The residual with directions; directions of time follow the scratch."""
        model = self.moments.model
        places = {**model.sizes, "k": self._n, "r": self._n, "t": model.sizes["w"] * (1 + model.lanes)}
        function = with_directions(self.law.residual, model.lanes, tuple(sorted(places.items())))
        return function.caller(abi.STAGE.signature.arguments)

    def directions_after_step(self, step: DifferentiatedStep, state: State) -> Array:
        """Return the directions of the state after a step, shape (ny, k)."""
        pattern, n, s, y = Pattern.of(self.moments.compiled, step.before.w), self._n, self._s, step.by.y
        k, matrix = self._converge_stages(step, pattern, state.room[2 * len(state.y) :][: s * n].reshape(s, n).copy())
        rest = np.zeros((s, n, y.shape[1]))
        for i in range(s):
            rate = np.zeros(len(y))
            rate[self._elements] = self._a[i] @ k[:, self._rates]
            rest[i] = self._slopes_by_state(step, i, k, y + np.outer(rate, step.longer))
        rest[:, pattern.left_out] = 0.0
        by_stages = _solve_stages(matrix, -rest.reshape(s * n, -1)).reshape(s, n, -1)
        after, end = y.copy(), step.before.y.copy()
        total = self._b @ k[:, self._rates]
        after[self._elements] += step.h * np.einsum("i,ijk->jk", self._b, by_stages[:, self._rates])
        after[self._elements] += np.outer(total, step.longer)
        end[self._elements] += step.h * total
        return self._correct_directions(step, end, after)

    def _converge_stages(self, step: DifferentiatedStep, pattern: Pattern, k: Array) -> tuple[Array, Array]:
        """Return the stages from some near them, and Newton's matrix there."""
        for _ in range(_ITERATIONS):
            matrix, right = self._equations(step, pattern, k)
            change = _solve_stages(matrix, right).reshape(k.shape)
            k = k - change
            if np.abs(change).max() <= _SAME * max(1.0, np.abs(k).max()):
                return k, self._equations(step, pattern, k)[0]
        raise InputError("derivatives", "stages of the step that converge", f"others at t = {step.before.t:.6g} s")

    def _stage(self, step: DifferentiatedStep, i: int, k: Array) -> Moment:
        y = step.before.y.copy()
        y[self._elements] += step.h * self._a[i] @ k[:, self._rates]
        return step.at(float(self._c[i]), y)

    def _equations(self, step: DifferentiatedStep, pattern: Pattern, k: Array) -> tuple[Array, Array]:
        """Return Newton's matrix of all stages and their residuals, flat."""
        n, s, out = self._n, self._s, pattern.left_out
        matrix, right, slopes = np.zeros((s, n, s, n)), np.zeros((s, n)), np.zeros(pattern.size)
        for i in range(s):
            now, whole = self._stage(step, i, k), np.zeros((n, 2 * n))
            w = now.w.copy()
            self._tangent(now.t, now.y, k[i].copy(), now.p, w, slopes)
            np.add.at(whole, (pattern.rows, pattern.columns), slopes)
            matrix[i, :, i] += whole[:, :n]
            for j in range(s):
                matrix[i, :, j] += step.h * self._a[i, j] * whole[:, n:]
            self._residual(now.t, now.y, k[i].copy(), now.p, w, right[i])
            matrix[i, out] = 0.0
            matrix[i, out, i, out] = 1.0
            right[i, out] = k[i, out]
        return matrix.reshape(s * n, s * n), right.ravel()

    def _slopes_by_state(self, step: DifferentiatedStep, i: int, k: Array, y: Array) -> Array:
        """Return the directions of the residual of a stage whose unknowns have none, shape (n, k)."""
        lanes, n, columns, now = self.moments.model.lanes, self._n, list[Array](), self._stage(step, i, k)
        unknowns, out = np.zeros(n * (1 + lanes)), np.zeros(n * (1 + lanes))
        unknowns[:n] = k[i]
        by = Directions(y, step.time(float(self._c[i])), step.by.modes)
        for _, own, p, w in self.moments.chunks_of_states(now, by):
            self._directed(now.t, own, unknowns, p, w, out)
            columns.append(out[n:].reshape(n, lanes).copy())
        return np.concatenate(columns, axis=1)[:, : y.shape[1]]


def _solve_stages(matrix: Array, right: Array) -> Array:
    """Return the solution; of dependent rows the shortest."""
    try:
        solution = np.linalg.solve(matrix, right)
    except np.linalg.LinAlgError:
        solution = np.linalg.lstsq(matrix, right, rcond=None)[0]
    return np.asarray(solution, dtype=np.float64)
