"""Sensitivities against differences of the same emitted code in 45 digits, with the same steps and an own loop."""

import ast
import inspect
import types

import mpmath as mp
import numpy as np
import pytest
from support.rotation import of_turn

import symgen
from symgen import Settings
from symgen.api import Model
from symgen.derive.methods import METHODS
from symgen.describe.facts.lifted import lift_numbers
from symgen.result.sensitivities import prepare_for_directions
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout import abi

DIGITS = 45
#: By order: distance of the values of a number, the factors of the motions with these values, and their divisor.
DIFFERENCES = {2: ("1e-18", {-1: -1, 1: 1}, 2), 4: ("1e-9", {-2: 1, -1: -8, 1: 8, 2: -1}, 12)}
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
    w[abi.STEP_STATUS] = h
    accept(mp.mpf(0), y, p, w, iw)

    def rate_at(t, at):
        rate = [mp.mpf(0)] * len(y)
        if rhs(t, at, p, w, iw, rate) != 0:
            exact(law.confirm)(t, at, p, w, iw, rate)
        return rate

    step = adams_step(rate_at, y) if run.plan.integrator.name == "abm4" else tableau_step(rate_at, scheme)
    for n in range(steps):
        y[:] = step(n * h, h, y)
        assert not accept((n + 1) * h, y, p, w, iw) & 1
    return y


def ahead(y, h, weights, rates):
    """Return a state moved by weighed rates."""
    return [x + h * sum(a * k for a, k in zip(weights, each, strict=True)) for x, *each in zip(y, *rates, strict=True)]


def tableau_step(rate_at, scheme):
    """Return the step of an explicit Runge-Kutta scheme."""
    count = int(scheme.stages)
    rows = [slice(*scheme.start[s : s + 2]) for s in range(count + 1)]

    def there(s, y, h, rates):
        columns = scheme.column[rows[s]].tolist()
        return ahead(y, h, scheme.value[rows[s]].tolist(), [rates[j] for j in columns]) if columns else list(y)

    def step(t, h, y):
        rates = list[list]()
        for s in range(count):
            rates.append(rate_at(t + mp.mpf(float(scheme.nodes[s])) * h, there(s, y, h, rates)))
        return there(count, y, h, rates)

    return step


def adams_step(rate_at, y):
    """Return the step of Adams, Bashforth and Moulton of order 4, begun by three of Runge and Kutta."""
    past, third, sixth = [rate_at(mp.mpf(0), list(y))], mp.mpf(1) / 3, mp.mpf(1) / 6

    def step(t, h, y):
        if t > 0:
            past.insert(0, rate_at(t, list(y)))  # at the accepted state
        if len(past) < 4:
            rates = [past[0]]
            for part in (mp.mpf(0.5), mp.mpf(0.5), mp.mpf(1)):
                rates.append(rate_at(t + part * h, ahead(y, h, [part], rates[-1:])))
            return ahead(y, h, [sixth, third, third, sixth], rates)
        predicted = ahead(y, h / 24, [55, -59, 37, -9], past[:4])
        return ahead(y, h / 24, [9, 19, -5, 1], [rate_at(t + h, predicted), *past[:3]])

    return step


def largest_difference(name, numbers, method, integrator, steps, step=1e-2, coordinates="absolute", order=2):
    """Return how far sensitivities are from differences in 45 digits, over the largest."""
    adaptive = {} if integrator in ("rk4", "abm4") else {"integrator.adaptive": "false"}
    settings = Settings(
        method=method,
        integrator=integrator,
        step=step,
        until=step * steps,
        times=[step * steps],
        options=adaptive,
        coordinates=coordinates,
        verify=False,
        max_violation=1.0,
        max_energy_error=1e3,
    )
    own = lift_numbers("numbers", symgen.load(name).mechanism, numbers)
    run, _ = prepare_for_directions(own.mechanism, settings)
    assert (run.tree is None) == (coordinates == "absolute")
    directed = Model(own.mechanism).simulate(settings, sensitivities=tuple(own.keys.values()))
    found = directed.sensitivities._evaluated.course.states[-1, : run.compiled.info.work]
    with mp.workdps(DIGITS):
        width, factors, divisor = DIFFERENCES[order]
        expected = np.zeros_like(found)
        for k, key in enumerate(own.keys.values()):
            ends = [(factor, moved(run, {key: way * mp.mpf(width)}, steps)) for way, factor in factors.items()]
            for i in range(len(found)):
                expected[i, k] = float(sum(factor * end[i] for factor, end in ends) / (divisor * mp.mpf(width)))
    assert np.abs(expected).max(axis=0).min() > 1e-9
    return float((np.abs(found - expected).max(axis=0) / np.abs(expected).max(axis=0)).max())


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["lagrange", "direct-correction", "velocity-projection"])
def test_derivatives_are_those_of_the_run_that_was_made(method):
    assert largest_difference("four-bar", MASSES, method, "rk4", 10) < 1e-11


#: Each method with an integrator, as neither knows of the other, and with the next one in another turn.
PAIRS = of_turn(
    (
        (method, integrator)
        for method in METHODS.names
        for integrator in ("rk4", "dop853", "abm4")
        if {"ode", "one-step"}
        & set(METHODS.get(method, "method").forms)
        & set(INTEGRATORS.get(integrator, "integrator").forms)
    ),
    16,
)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("method", "integrator"), PAIRS)
def test_every_method(method, integrator):
    # penalties multiply the rounding of what they hold back
    bound = 1e-7 if "penalty" in method else 1e-11
    assert largest_difference("four-bar", MASSES, method, integrator, 30) < bound


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "numbers", "step", "steps", "coordinates"),
    [
        ("slider-crank", ("rod_mass", "mechanism.gravity[1]"), 2e-3, 100, "absolute"),
        ("andrews", ("bodies.K2.mass", "bodies.K3.inertia"), 5e-5, 40, "joint"),
        ("bricard", ("mechanism.gravity[1]", "bodies.rod3.mass"), 5e-3, 10, "joint"),
        ("rolling-disc", ("mechanism.gravity[2]", "bodies.disc.mass"), 1e-2, 40, "absolute"),
    ],
)
def test_mechanisms_of_the_catalogue(name, numbers, step, steps, coordinates):
    assert largest_difference(name, numbers, "lagrange", "rk4", steps, step, coordinates, order=4) < 1e-10
