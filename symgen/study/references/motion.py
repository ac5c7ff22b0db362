"""Reference motions of whole families: the independent equations compiled once, for any values of the parameters.

The route of `symgen.study.references.independent` (positions written out, SymPy on the whole constraints,
accelerations by least squares) with two differences that studies over many parameter values need: parameters stay
symbols, and the equations are compiled. They are integrated by Gragg's extrapolated midpoint rule (W. B. Gragg, SIAM
J. Numer. Anal. 2 (1965) 384-403), which shares no code and no coefficients with the integrators under test, or, where
decay is much faster than the motion, by SciPy's Radau; twice with different tolerances, the difference being the
estimated error.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cache, cached_property
from itertools import pairwise
from typing import Any

import numba
import numpy as np
import sympy as sp
from numba import types
from numpy.typing import NDArray

from symgen.base.errors import InputError, SimulationError
from symgen.describe.mechanism import Mechanism
from symgen.result.points import Points
from symgen.study.references.extrapolation import compute_rate, integrate_by_extrapolation
from symgen.study.references.independent import CUTOFF, IndependentEquations, table_curves
from symgen.study.references.numba_code import machine_code
from symgen.study.references.reference import Reference
from symgen.study.references.solvers import (
    OverBudgetError,
    Scheme,
    integrate_by_steps,
    integrate_in_parts,
    is_stiff,
    longest_reference_step,
)
from symgen.study.references.sympy_formulas import ReferenceFormulas

Array = NDArray[np.float64]

#: Tolerances of the two integrations by extrapolation, and of the two by Radau.
FINE, COARSE = 3e-14, 3e-13
#: Looser tolerances where rounding of very stiff forces makes those unattainable: an integration with a tolerance that
#: can be attained takes less than so many times the evaluations of a coarser one.
ROUGH_FINE, ROUGH_COARSE, UNATTAINED = 1e-10, 1e-9, 3.0
STIFF_FINE, STIFF_COARSE = 1e-9, 1e-8
#: Evaluation limit of a reference of few coordinates. The cost of an evaluation grows with their square; dependent rows
#: cost about so many times as much.
BUDGET, FEW, DEPENDENT = 3_000_000, 9, 4
#: Evaluation limit of an integration by Radau, Jacobians included.
STIFF_BUDGET = 400_000

_F8, _A, _I8, _I = types.float64, types.float64[::1], types.int64, types.int64[::1]
#: equations(t, q, v, p, out).
EQUATIONS = types.FunctionType(types.int64(_F8, _A, _A, _A, _A))
_RATE = types.void(EQUATIONS, _I, _I8, _I8, _A, _A, _F8, _A, _A)
_EXTRAPOLATE = types.int64(EQUATIONS, _I, _I8, _I8, _A, _A, _F8, _A, _F8, _F8, _A, _A, _I8, _I)


class CompiledEquations(IndependentEquations):
    """Independent equations with parameters that stay adjustable.

    Parameters
    ----------
    mechanism : Mechanism
        A validated planar mechanism.
    parameters : mapping
        Initial values of all its parameters; `set_parameters` changes them.
    """

    def __init__(self, mechanism: Mechanism, parameters: Mapping[str, float]) -> None:
        self.dependent = False
        self.symbols = [sp.Symbol(f"p{i}", real=True) for i in range(len(mechanism.parameters))]
        super().__init__(mechanism, parameters)
        self.set_parameters(parameters)

    def set_parameters(self, parameters: Mapping[str, float]) -> None:
        """Set the values of the parameters; compiles nothing."""
        self.parameters = parameters
        self.values = np.array([parameters[p.name] for p in self.mechanism.parameters] or [0.0])
        self._set_masses()

    def evaluate(self, t: float, q: Array, v: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Return Phi, D, nu, gamma and f at a state."""
        return self._split_numbers(self._numbers(t, q, v))

    def _numbers(self, t: float, q: Array, v: Array) -> Array:
        count = len(self.mechanism.states)
        flat = np.zeros(3 * self.m + len(self._entries) + self.n + count + self._rotor_index.shape[1])
        rest = np.zeros(self.n + count - len(v))
        self._function(float(t), np.ascontiguousarray(q), np.concatenate([v, rest]), self.values, flat)
        return flat

    def rate(self, t: float, y: Array) -> Array:
        """Return (v, v', z'), as `IndependentEquations.rate` does."""
        rates = np.empty(len(y))
        _compile_for_all(compute_rate, _RATE)(
            self._address,
            self._index,
            self.m,
            self.n,
            self.mass,
            self.values,
            float(t),
            np.ascontiguousarray(y),
            rates,
        )
        return rates

    @property
    def budget(self) -> int:
        """Evaluation limit of an integration by extrapolation."""
        return int(BUDGET * min(1.0, (FEW / self.n) ** 2) / (DEPENDENT if self.dependent else 1))

    @cached_property
    def _address(self) -> Any:
        """The equations as an argument of compiled functions: of a function itself Numba looks it up at every call."""
        return types.CompileResultWAP(self._result)

    @cached_property
    def _index(self) -> Any:
        places = self._row_index, self._column_index, *self._rotor_index
        return np.concatenate([[len(self._entries)], *places]).astype(np.int64)

    def advance(
        self, t: float, y: Array, until: float, rtol: float, scale: Array, state: Array, used: object, most: int
    ) -> Array:
        """Integrate to `until` by extrapolation.

        Parameters
        ----------
        t, y, until : float, Array, float
            Initial time and state, and end time.
        rtol, scale : float, Array
            Tolerance, relative to `scale` or the state, whichever is larger.
        state : Array, shape (1,)
            First step [s], or 0 to choose one; set to the next step.
        used : integer array, shape (1,)
            Evaluations so far; those of this call are added.
        most : int
            Evaluation limit.

        Raises
        ------
        SimulationError
            If the step collapses or the limit is exceeded.
        """
        y = y.copy()
        code = _compile_for_all(integrate_by_extrapolation, _EXTRAPOLATE)(
            *(self._address, self._index, self.m, self.n, self.mass, self.values, t, y, until, rtol, scale, state),
            *(most, used),
        )
        if code == 1:
            raise OverBudgetError(f"the reference takes more than {most:.3g} evaluations")
        if code == 2 or not np.all(np.isfinite(y)):
            raise SimulationError(f"the reference motion cannot be integrated beyond t = {t:.6g} s")
        return y

    # -- formulas ------------------------------------------------------------------------------------------------------

    def _parameter_symbols(self) -> dict[str, Any]:
        return {p.name: symbol for p, symbol in zip(self.mechanism.parameters, self.symbols, strict=True)}

    def _compile(self, formulas: ReferenceFormulas, outputs: list[Any]) -> Callable[..., Any]:
        """Return the outputs as a compiled function (t, q, v, p, out), which counts no turns."""
        if formulas.turns:
            expected, got = "a mechanism whose rows and forces count no turns, for references", "angles with turns"
            raise InputError(self.mechanism.name, expected, got, "symgen run --verify estimates errors")
        text, space = self._function_text(formulas, outputs)
        signature = EQUATIONS.signature
        make = numba.njit(signature, error_model="numpy", nogil=True)
        identity = "\n".join((text, *map(repr, self.mechanism.tables)))
        self._result = machine_code("equations", signature, identity, lambda: make(space["equations"]))
        function: Callable[..., Any] = self._result.entry_point
        return function

    def _function_text(self, formulas: ReferenceFormulas, outputs: list[Any]) -> tuple[str, dict[str, Any]]:
        """Return the text of a function `equations`, and the names with which it has been executed."""
        shared, results = sp.cse(outputs, symbols=sp.numbered_symbols("x"), order="canonical")
        names = [*(f"q{i} = q[{i}]" for i in range(self.n)), *(f"v{i} = v[{i}]" for i in range(self.n))]
        names += [f"{z} = v[{self.n + i}]" for i, z in enumerate(formulas.z)]
        names += [f"p{i} = p[{i}]" for i in range(len(self.symbols))]
        lines = ["def equations(t, q, v, p, out):", *names]
        space: dict[str, Any] = {"math": math}
        for table in self.mechanism.tables:
            space |= {name: numba.njit(error_model="numpy")(f) for name, f in table_curves(table).items()}
        own = {name: name for name in space}
        space["__name__"] = __name__  # where a process that loads the code looks for names
        lines += [f"{symbol} = {sp.pycode(e, user_functions=own)}" for symbol, e in shared]
        lines += [f"out[{i}] = {sp.pycode(e, user_functions=own)}" for i, e in enumerate(results)]
        text = "\n    ".join([*lines, "return 0"])
        exec(text, space)  # SymPy's own printing of a checked mechanism
        return text, space


class InterpretedEquations(CompiledEquations):
    """The same equations where they are evaluated some thousand times at most: compilation would take longer."""

    def _compile(self, formulas: ReferenceFormulas, outputs: list[Any]) -> Callable[..., Any]:
        """Return the outputs as a function (t, q, v, p, out) that sets what is undefined to not a number."""
        function = self._function_text(formulas, outputs)[1]["equations"]

        def evaluate_formulas(t: float, q: Array, v: Array, p: Array, out: Array) -> None:
            try:
                with np.errstate(all="ignore"):
                    function(t, q, v, p, out)
            except (ArithmeticError, ValueError):
                out[:] = np.nan

        return evaluate_formulas


@cache
def _compile_for_all(function: Any, signature: Any) -> Any:
    """Return a function compiled for equations of any mechanism, called by address.

    It is the machine code itself: the choice among signatures, of which there is one, takes longer than a rate.
    """
    make = numba.njit(signature, nogil=True, error_model="numpy", fastmath={"contract"})
    return machine_code(function.__name__, signature, "", lambda: make(function.py_func)).entry_point


# -- a motion ----------------------------------------------------------------------------------------------------------


def motion_with_estimate(equations: CompiledEquations, q: Array, v: Array, times: Array) -> Reference:
    """Return the reference motion from a start consistent within rounding.

    Parameters
    ----------
    equations : CompiledEquations
        With the parameters set.
    q, v : Array, shapes (nq,), (nv,)
        The start.
    times : Array
        Output times [s], increasing from 0.

    Raises
    ------
    SimulationError
        If the motion cannot be integrated within the budget, e.g. into a singularity.
    """
    y = equations.nearest_state(0.0, np.concatenate([q, v, equations.starts]))
    d = equations.evaluate(0.0, y[: equations.n], y[equations.n :])[1] * equations.root
    equations.dependent = bool(np.linalg.matrix_rank(d, CUTOFF * np.linalg.norm(d)) < equations.m) if d.size else False
    stiff = is_stiff(equations, y, float(times[-1]))
    scale = _error_scale(y, equations.n)

    if stiff:
        tolerances = STIFF_FINE, STIFF_COARSE
        schemes = (Scheme("Radau", rtol, every, most=STIFF_BUDGET) for every, rtol in enumerate(tolerances, 1))
        fine, coarse = (integrate_by_steps(equations, y, times, scheme, scale=scale) for scheme in schemes)
    else:
        tolerances, fine, coarse = _two_extrapolations(equations, y, times, scale)
    n = equations.n
    estimated = Points.of_mechanism(equations.mechanism, equations.parameters).largest_distance(
        fine[:, :n], coarse[:, :n]
    )
    scheme = "SciPy's Radau" if stiff else "Gragg's extrapolation of order 16"
    how = (
        f"independently derived equations, {scheme} at {tolerances[0]:g}, projected at every output; "
        f"estimated from a second run at {tolerances[1]:g}"
    )
    return Reference.of_states(equations, how, estimated, times, fine)


def _two_extrapolations(
    equations: CompiledEquations, y: Array, times: Array, scale: Array
) -> tuple[tuple[float, float], Array, Array]:
    """Return the tolerances of two integrations, and their states: the tightest ones that rounding allows."""
    most = equations.budget
    rough, used = _integrate_by_extrapolation(equations, y, times, ROUGH_COARSE, 2, scale, most)
    try:
        coarse, used = _integrate_by_extrapolation(
            equations, y, times, COARSE, 2, scale, min(most, int(UNATTAINED * used))
        )
        fine, _ = _integrate_by_extrapolation(equations, y, times, FINE, 1, scale, min(most, int(UNATTAINED * used)))
    except SimulationError:
        fine, _ = _integrate_by_extrapolation(equations, y, times, ROUGH_FINE, 1, scale, most)
        return (ROUGH_FINE, ROUGH_COARSE), fine, rough
    return (FINE, COARSE), fine, coarse


def _integrate_by_extrapolation(
    equations: CompiledEquations, y: Array, times: Array, rtol: float, every: int, scale: Array, most: int
) -> tuple[Array, int]:
    """Return the states at `times` and the evaluations; every `every`-th output is projected."""
    used, longest = np.zeros(1, dtype=np.int64), longest_reference_step(equations, times)

    def integrate_part(t: float, y: Array, times: Array) -> Array:
        states, step = np.empty((len(times), len(y))), np.zeros(1)  # the step to try next
        for k, following in enumerate(times.tolist()):
            if following > t:
                count = max(1, math.ceil((following - t) / longest))
                for first, last in pairwise(np.linspace(t, following, count + 1).tolist()):
                    y = equations.advance(first, y, last, rtol, scale, step, used, most)
                t = following
            if k % every == 0:
                y = equations.nearest_state(t, y)
            states[k] = y
        return states

    return integrate_in_parts(equations, y, times, integrate_part), int(used[0])


def _error_scale(y: Array, n: int) -> Array:
    """Return the error scale of each component: 1 m or rad, and at least 1 m/s or rad/s."""
    scale = np.maximum(np.abs(y), 1.0)
    scale[n : 2 * n] = np.maximum(scale[n : 2 * n], float(np.abs(y[n : 2 * n]).max(initial=0.0)))
    return scale
