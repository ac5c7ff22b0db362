"""Derivatives of dynamics in C: of the functions by their arguments, and of a step of the classical scheme."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from symgen.derive.emit.libraries import ARGUMENTS
from symgen.derive.lower.function_programs import StateFunctions
from symgen.result.targets._state_functions import OF_ALL, OF_ROWS, ModuleFunction
from symgen.run.planning.state_model import StateModel

#: Functions that rows are solved in.
_SOLVED = ("forward_dynamics", "inverse_dynamics")
#: A step of the classical scheme from (q, v) under efforts, with its derivatives if asked for, on the stack alone.
_STEP = """
#define NY (@U@_NQ + @U@_NV)
#define NC (NY + @U@_NV + @U@_NP)

/* f = (q', v') at y = (q, v), and S with f' = S x for columns x = (y, effort, p) if S is not NULL. */
static int slopes(const real *y, const real *effort, const real *p, real *f, real *s) {
    static const int width = NC;
    const real *q = y, *v = y + @U@_NQ;
    real part[(NY + 1) * (NC + 1)];
    int failed = @p@_rates(q, v, p, f);
    failed |= @p@_forward_dynamics(q, v, effort, p, f + @U@_NQ);
    if (failed || !s) return failed;
    for (int i = 0; i < NY * NC; i++) s[i] = 0;
#define PUT(call, rows, first, columns, at) \\
    failed |= call; \\
    for (int i = 0; i < rows; i++) \\
        for (int j = 0; j < columns; j++) s[(first + i) * width + at + j] = part[i * columns + j];
    PUT(@p@_rates_by_q(q, v, p, part), @U@_NQ, 0, @U@_NQ, 0)
    PUT(@p@_rates_by_v(q, v, p, part), @U@_NQ, 0, @U@_NV, @U@_NQ)
    PUT(@p@_forward_dynamics_by_q(q, v, effort, p, part), @U@_NV, @U@_NQ, @U@_NQ, 0)
    PUT(@p@_forward_dynamics_by_v(q, v, effort, p, part), @U@_NV, @U@_NQ, @U@_NV, @U@_NQ)
    PUT(@p@_forward_dynamics_by_effort(q, v, effort, p, part), @U@_NV, @U@_NQ, @U@_NV, NY)
    PUT(@p@_forward_dynamics_by_p(q, v, effort, p, part), @U@_NV, @U@_NQ, @U@_NP, NY + @U@_NV)
#undef PUT
    return failed;
}

int @p@_step(const real *q, const real *v, const real *effort, const real *p, real h, real *next, real *derivatives) {
    static const real at[4] = {0, 0.5, 0.5, 1}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    real y[NY], numbers[@U@_NP], stage[NY], f[NY] = {0}, s[NY * NC], d[NY * NC], moved[NY * NC];
    for (int i = 0; i < NY; i++) y[i] = next[i] = i < @U@_NQ ? q[i] : v[i - @U@_NQ];
    for (int i = 0; i < @U@_NP; i++) numbers[i] = p[i];
    for (int i = 0; i < NY * NC; i++) d[i] = 0;
    if (derivatives)
        for (int i = 0; i < NY * NC; i++) derivatives[i] = i / NC == i % NC;
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < NY; i++) stage[i] = y[i] + at[k] * h * f[i];
        numbers[@U@_NP - 1] = p[@U@_NP - 1] + at[k] * h;
        if (derivatives)
            for (int i = 0; i < NY * NC; i++) moved[i] = (i / NC == i % NC) + at[k] * h * d[i];
        if (slopes(stage, effort, numbers, f, derivatives ? s : 0)) return 1;
        for (int i = 0; i < NY; i++) next[i] += weight[k] * h * f[i];
        if (!derivatives) continue;
        for (int i = 0; i < NY; i++)
            for (int j = 0; j < NC; j++) {
                real sum = j < NY ? 0 : s[i * NC + j];
                for (int m = 0; m < NY; m++) sum += s[i * NC + m] * moved[m * NC + j];
                d[i * NC + j] = sum;
            }
        for (int i = 0; i < NY * NC; i++) derivatives[i] += weight[k] * h * d[i];
    }
    return 0;
}
"""
#: The declaration of the step.
DECLARED = """/* A step h of the classical Runge-Kutta scheme from (q, v) with constant efforts: next is (q, v)
   after it. Unless derivatives is NULL, it is the matrix of next by (q, v, effort, p), with the time in p. */
int @p@_step(const @p@_real *q, const @p@_real *v, const @p@_real *effort, const @p@_real *p, @p@_real h,
    @p@_real *next, @p@_real *derivatives);"""


def derivatives(model: StateModel) -> Iterator[ModuleFunction]:
    """Yield the derivatives of all functions of a mechanism but frames by each of their arguments."""
    for name, (vectors, _) in (OF_ALL | (OF_ROWS if model.rows else {})).items():
        solved = model.rows and name in _SOLVED
        quantity, rows = (f"{name} of rows", model.kept) if solved else (name, ())
        for space in (*vectors, "p"):
            values = partial(StateFunctions.derivative, name=quantity, space=space, kept=rows)
            purpose = f"{name} differentiated by {ARGUMENTS[space]}"
            yield ModuleFunction(
                f"{name}_by_{ARGUMENTS[space]}", f"{name}_by_{space}", purpose, vectors, values, tuple(rows)
            )


def step_source(prefix: str) -> str:
    """Return the step in C."""
    return _named(_STEP, prefix)


def step_declaration(prefix: str) -> str:
    """Return its declaration."""
    return _named(DECLARED, prefix)


def _named(text: str, prefix: str) -> str:
    return text.replace("@p@", prefix).replace("@U@", prefix.upper())
