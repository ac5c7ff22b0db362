"""Sensitivities against differences of the same emitted code in 45 digits, with the same steps and an own loop."""

import ast
import inspect
import types

import mpmath as mp
import numpy as np
import pytest

import symgen
from symgen import Settings
from symgen.layout import abi
from symgen.methods import METHODS
from symgen.result.sensitivities import prepared

DIGITS, WIDTH = 45, "1e-18"
MASSES = ("crank_mass", "rocker_mass")
#: Elementary functions of emitted code in 45 digits.
NAMES = ("sin", "cos", "tan", "sqrt", "exp", "log", "asin", "acos", "atan", "atan2", "floor", "tanh", "sinh", "cosh")
MATH = types.SimpleNamespace(
    **{name: getattr(mp, name) for name in NAMES},
    fabs=abs,
    inf=mp.inf,
    pi=mp.pi,
    isfinite=mp.isfinite,
    copysign=lambda a, b: abs(a) if b >= 0 else -abs(a),
)


class Divisions(ast.NodeTransformer):
    """Writes divisions as calls: by 0 they are as in NumPy."""

    def visit_BinOp(self, node):
        """Replace a quotient."""
        self.generic_visit(node)
        if isinstance(node.op, ast.Div):
            return ast.Call(ast.Name("quotient", ast.Load()), [node.left, node.right], [])
        return node

    def visit_AugAssign(self, node):
        """Replace the quotient of a variable."""
        self.generic_visit(node)
        if isinstance(node.op, ast.Div):
            before = ast.parse(ast.unparse(node.target), mode="eval").body
            return ast.Assign([node.target], ast.Call(ast.Name("quotient", ast.Load()), [before, node.value], []))
        return node


def quotient(a, b):
    """Return a / b."""
    if b == 0:
        return mp.nan if a == 0 else mp.inf * mp.sign(a)
    return mp.mpf(a) / b


def exact(function, known=None):
    """Return an emitted function as plain Python over numbers of 45 digits, with its callees."""
    known = {} if known is None else known
    if function not in known:
        plain = function.py_func
        own = dict(plain.__globals__) | {"math": MATH, "quotient": quotient}
        tree = ast.parse(inspect.getsource(plain))
        tree.body[0].decorator_list.clear()
        exec(compile(ast.fix_missing_locations(Divisions().visit(tree)), plain.__name__, "exec"), own)
        known[function] = own[plain.__name__]
        for name in plain.__code__.co_names:
            if hasattr(own.get(name), "py_func"):
                own[name] = exact(own[name], known)
    return known[function]


def moved(run, changes, steps):
    """Return the state after a number of steps with other parameters."""
    law, model, start = run.compiled.law_module, run.compiled.model, run.start
    setup = run.plan.integrator.setup(run.compiled, run.spec, start.w)
    scheme, h = setup.scheme, mp.mpf(setup.step)
    y, p, w = ([mp.mpf(x) if np.isfinite(x) else mp.inf for x in a.tolist()] for a in (start.y, start.p, start.w))
    iw = [0] * abi.N_COUNTERS
    places = {q.name: i for i, q in enumerate(run.compiled.info.parameters)}
    for name, change in changes.items():
        p[places[name]] += change
    for module in (model, law):
        exact(module.prepare)(p)
    exact(model.masses)(p, w)
    rhs, accept = exact(law.rhs), exact(law.accept)
    rows = [slice(*scheme.start[s : s + 2]) for s in range(int(scheme.stages) + 1)]
    w[abi.STEP_STATUS] = h
    accept(mp.mpf(0), y, p, w, iw)
    for n in range(steps):
        rates = []

        def there(s, rates=rates):
            own = list(y)
            for j, a in zip(scheme.column[rows[s]].tolist(), scheme.value[rows[s]].tolist(), strict=True):
                own = [x + h * a * k for x, k in zip(own, rates[j], strict=True)]
            return own

        for s in range(int(scheme.stages)):
            rate, t = [mp.mpf(0)] * len(y), n * h + mp.mpf(float(scheme.nodes[s])) * h
            at = there(s)
            if rhs(t, at, p, w, iw, rate) != 0:
                exact(law.confirm)(t, at, p, w, iw, rate)
            rates.append(rate)
        y[:] = there(int(scheme.stages))
        assert not accept((n + 1) * h, y, p, w, iw) & 1
    return y


def largest_difference(method, integrator, steps):
    """Return how far sensitivities are from differences in 45 digits, over the largest."""
    adaptive = {} if integrator == "rk4" else {"integrator.adaptive": "false"}
    settings = Settings(
        method=method,
        integrator=integrator,
        step=1e-2,
        until=1e-2 * steps,
        times=[1e-2 * steps],
        options=adaptive,
        verify=False,
        max_violation=1.0,
        max_energy_error=1e3,
    )
    model = symgen.load("four-bar")
    run, _ = prepared(model.mechanism, settings)
    directed = model.simulate(settings, sensitivities=MASSES)
    found = np.concatenate([directed.sensitivities.table(name)[-1] for name in ("q", "v")])
    with mp.workdps(DIGITS):
        width = mp.mpf(WIDTH)
        expected = np.zeros_like(found)
        for k, name in enumerate(MASSES):
            ends = [moved(run, {name: way * width}, steps) for way in (-1, 1)]
            slopes = [(b - a) / (2 * width) for a, b in zip(*ends, strict=True)]
            expected[:, k] = [float(x) for x in slopes[: len(found)]]
    assert np.abs(expected).max() > 1e-4
    return float((np.abs(found - expected).max(axis=0) / np.abs(expected).max(axis=0)).max())


@pytest.mark.parametrize("method", ["lagrange", "direct-correction", "velocity-projection"])
def test_derivatives_are_those_of_the_run_that_was_made(method):
    assert largest_difference(method, "rk4", 10) < 1e-11


ODE = [name for name in METHODS.names if {"ode", "one-step"} & set(METHODS.get(name, "method").forms)]


@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["rk4", "dop853"])
@pytest.mark.parametrize("method", ODE)
def test_every_method(method, integrator):
    # penalties multiply the rounding of what they hold back
    bound = 1e-7 if "penalty" in method else 1e-11
    assert largest_difference(method, integrator, 30) < bound
