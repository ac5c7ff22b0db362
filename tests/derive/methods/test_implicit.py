"""Descriptor forms: the emitted Jacobian by complex steps on the emitted residual, and what implicit runs cannot do."""

import cmath
import math
import types
from functools import cache
from pathlib import Path

import msgspec
import numpy as np
import pytest
from support.emitted import law_source, listed, mechanism_of
from support.models import EVERYTHING

from benchmarks import stiff
from symgen.api import load
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.base.vocabulary.infos import LawInfo
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import generate
from symgen.run.layout.compiled import ModelInfo
from symgen.run.planning.prepare import make_plan

#: Every joint kind, the weld among them, and every force kind.
ALL_KINDS = listed(EVERYTHING) | {
    "bodies": EVERYTHING["bodies"] | {"tail": {"mass": 0.4, "inertia": 0.03, "points": {"P": [0.1, 0.2]}}},
    "joints": EVERYTHING["joints"]
    | {"weld": {"type": "rigid", "between": ["arm", "tail"], "at": [[0.3, -0.1], "P"], "angle": "k1/3"}},
}
#: Method -> level of its descriptor.
LEVELS = {
    "lagrange": "acceleration",
    "baumgarte": "acceleration",
    "adaptive-baumgarte": "acceleration",
    "penalty": "acceleration",
    "compliant-constraints": "acceleration",
    "ggl": "stabilised",
    "generalized-alpha": "position",
    "index3-augmented-lagrangian": "projected",
    "rattle": "explicit",
    "discrete-gradient": "explicit",
}
STEP = 1e-30


@cache
def generated():
    return generate(mechanism_of(ALL_KINDS), tuple(choose_method(m, None, True) for m in LEVELS))


class Stage:
    """``residual`` and ``tangent`` of a law as plain Python, with complex arithmetic where asked for."""

    def __init__(self, method):
        stem = choose_method(method, None, True).stem
        modules = generated().modules
        self.info = msgspec.convert(modules["model"][1], ModelInfo)
        self.law = msgspec.convert(modules[stem][1], LawInfo)
        source = law_source(modules, stem, "prepare", "form")
        self.module = types.ModuleType(stem)
        exec(compile(source, stem, "exec"), self.module.__dict__)
        self.complex = types.ModuleType(f"{stem}_complex")
        exec(compile(source, stem, "exec"), self.complex.__dict__)
        self.complex.math = cmath

    def parameters(self):
        p = [0.0] * (self.law.parameter_offset + len(self.law.parameters) + self.law.hoisted)
        for i, name in enumerate(self.info.parameters):
            p[i] = {"k1": 1.7, "k2": -0.6, "m1": 2.5}[name.name]
        for i, (_, default) in enumerate(self.law.parameters):
            p[self.law.parameter_offset + i] = default
        model = types.ModuleType("model")
        exec(compile(generated().modules["model"][0], "model", "exec"), model.__dict__)
        model.prepare.py_func(p)
        self.module.prepare.py_func(p)
        return p

    def scratch(self):
        w = [0.0] * self.law.nw
        w[0:20] = [0.01] * 20  # the step, which adaptive gains are taken from, is among the status
        offset, size = self.info.sections["row_weight"]
        w[offset : offset + size] = [1.0] * size
        return w

    def residual(self, t, y, k, p):
        r = [0.0] * (self.law.unknowns + 2 * self.info.m)
        self.complex.residual.py_func(t, y, k, p, self.scratch(), r)
        return np.array(r[: self.law.unknowns])

    def tangent(self, t, y, k, p):
        n, width = self.law.unknowns, self.info.nq + self.info.nv
        j = [math.nan] * len(self.law.tangent)
        self.module.tangent.py_func(t, y, k, p, self.scratch(), j)
        by = np.zeros((n, n + width))
        for (row, column), value in zip(self.law.tangent, j, strict=True):
            assert by[row, column] == 0.0  # straight code writes a place once
            by[row, column] = value
        return by[:, :n], by[:, n:]


@pytest.mark.by_turns(3)
@pytest.mark.fast("ggl", "generalized-alpha", "index3-augmented-lagrangian", "rattle", "discrete-gradient")
@pytest.mark.parametrize("method", LEVELS)
def test_tangent_is_the_derivative_of_the_residual(method):
    stage = Stage(method)
    assert stage.law.level == LEVELS[method]
    p, n, width = stage.parameters(), stage.law.unknowns, stage.info.nq + stage.info.nv
    rng = np.random.default_rng(len(method))
    for t in (0.0, 0.83):
        y = [*rng.uniform(-1.0, 1.0, width).tolist(), 0.0]
        k = rng.uniform(-2.0, 2.0, n).tolist()
        by_k, by_y = stage.tangent(t, y, k, p)
        for found, vector, size in ((by_k, k, n), (by_y, y, width)):
            expected = np.zeros((n, size))
            for c in range(size):
                moved = [complex(x, STEP if i == c else 0.0) for i, x in enumerate(vector)]
                r = stage.residual(t, y if vector is k else moved, moved if vector is k else k, p)
                expected[:, c] = np.imag(r) / STEP
            if stage.law.level == "explicit":  # M and D are all that such schemes take
                dynamic = slice(stage.info.nq, stage.info.nq + stage.info.nv)
                whole, expected = expected, np.zeros(expected.shape)
                expected[dynamic] = whole[dynamic] if vector is k else 0.0
            scale = np.maximum(1.0, np.abs(expected).max(axis=1, keepdims=True))
            np.testing.assert_allclose(found / scale, expected / scale, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize(
    ("method", "integrator"),
    [
        ("generalized-alpha", "trapezoidal"),  # undamped on index 3 without projections
        ("generalized-alpha", "newmark"),
        ("generalized-alpha", "rk4"),
        ("ggl", "trapezoidal"),
        ("ggl", "dop853"),
        ("index3-augmented-lagrangian", "generalized-alpha"),
        ("coordinate-partitioning", "radau5"),
        ("augmented-lagrangian", "sdirk"),
        ("augmented-hamiltonian", "abm"),
        ("lagrange", "generalized-alpha"),
    ],
)
def test_unsuitable_pairs_are_refused_with_those_that_fit(method, integrator):
    from benchmarks.pairs import allowed_pairs

    with pytest.raises(InputError) as refusal:
        make_plan(load("four-bar").mechanism, Settings(method=method, integrator=integrator))
    sentence = str(refusal.value)
    assert f"integrator '{integrator}'" in sentence and method in sentence
    fitting = [i for m, i in allowed_pairs() if m == method]
    named = sentence.partition("these do: ")[2]
    assert set(named.rstrip(".").split(", ")) == set(fitting)


@pytest.mark.parametrize("rho", [1.0, -0.1])
def test_generalized_alpha_without_damping_is_refused(rho):
    settings = Settings(method="generalized-alpha", options={"integrator.rho": rho})
    with pytest.raises(InputError, match=r"option integrator\.rho.*0\.999"):
        make_plan(load("four-bar").mechanism, settings)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "integrator", "tolerance"),
    [
        ("direct-correction", "radau5", 1e-11),
        ("baumgarte", "radau5", 1e-11),
        ("ggl", "radau5", 1e-11),
        ("direct-correction", "sdirk", 1e-6),
    ],
)
def test_steps_far_above_the_explicit_limit_of_a_stiff_case(method, integrator, tolerance):
    limit = stiff.explicit_limit()
    assert 1e-5 < limit < 1e-4  # of the order of the damper's decay, 5.5e4 1/s
    found = stiff.row(method, integrator, stiff.FACTOR * limit)
    assert found.status == "ok" and found.error <= tolerance, found


@pytest.mark.slow
def test_the_reference_of_the_stiff_case_has_two_routes():
    assert stiff.reference()[1] <= 1e-11


def test_an_adaptive_implicit_run_passes_the_transient():
    """Newton's iteration goes down to rounding, which the spring amplifies, and tolerances are kept."""
    result = stiff.model().simulate(
        method="direct-correction",
        integrator="radau5",
        rtol=1e-9,
        atol=1e-11,
        until=float(stiff.TIMES[-1]),
        times=stiff.TIMES,
    )
    assert result.status == "ok" and result.steps < 1000
    exact, _ = stiff.reference()
    assert stiff.points().largest_distance(np.asarray(result.q), exact) <= 1e-7


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_the_work_takes_part_in_the_error_estimate(rtol):
    """Where all coordinates are driven the constraints fix the motion, and the work is all that is integrated."""
    keys = {"method": "ggl", "integrator": "radau5", "until": 5.0}
    result = load("driven-four-bar").simulate(rtol=rtol, atol=rtol * 1e-2, **keys)
    assert result.status == "ok", result.reason
    assert result.energy_drift_max <= 10.0 * rtol * result.outcome.energy_scale


@pytest.mark.slow
def test_velocities_of_generalized_alpha_are_an_error_of_order_two_and_judged_as_one():
    model, keys = load("four-bar"), {"method": "generalized-alpha", "until": 3.0}
    runs = [model.simulate(step=step, **keys) for step in (2e-3, 1e-3, 5e-4)]
    assert all(r.status == "ok" for r in runs)
    errors = [r.velocity_violation_max for r in runs]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05) == errors[1] / errors[2]
    # the same over a longer time: an error of the discretisation, not drift
    assert model.simulate(step=1e-3, **keys | {"until": 12.0}).velocity_violation_max <= 1.5 * errors[1]
    told = [(r.warnings[-1], e) for r, e in zip(runs, errors, strict=True) if r.warnings]
    assert told and all(f"off their constraints by up to {e:.3g}" in warning for warning, e in told)
    assert bool(runs[0].warnings), "the coarsest step is off by more than other methods may be"
    assert all(r.position_violation_max < 1e-13 for r in runs)
    fine = model.simulate(step=1e-4, **keys | {"until": 0.5})
    assert fine.status == "ok" and not fine.warnings
    coarse = load("slider-crank").simulate(method="generalized-alpha", step=1e-2, until=1.0)
    assert coarse.status == "failed" and "exceeds the root of max_violation" in coarse.reason
    with pytest.raises(InputError, match="max_violation"):
        model.simulate(max_violation=-1.0, **keys)


def test_other_methods_have_no_such_licence():
    spec = make_plan(load("four-bar").mechanism, Settings(method="lagrange")).spec
    assert spec.velocity_limit == spec.max_violation == 1e-6
    assert make_plan(
        load("four-bar").mechanism, Settings(method="generalized-alpha")
    ).spec.velocity_limit == pytest.approx(1e-3)


@pytest.mark.by_turns(6)
@pytest.mark.slow
def test_scipy_agrees_on_the_stiff_case():
    """Radau of SciPy on independently derived equations, its Jacobian by differences: nothing is shared."""
    from symgen.study.references.reference import reference_motion

    model = stiff.model()
    start = model.assemble(model.compile())
    nq = model.compile().info.nq
    state = start.y[:nq], start.y[nq:-1]
    found = reference_motion(model.mechanism, model.parameters(), *state, stiff.TIMES[:3], solver="scipy-radau")
    assert stiff.points().largest_distance(found.q, stiff.reference()[0][:3]) <= 1e-9


@pytest.mark.slow
def test_tables_have_slopes_in_implicit_schemes():
    keys = {"method": "direct-correction", "until": 0.2, "output_step": 0.05}
    model = load(Path(__file__).parents[3] / "examples" / "gear-pair.toml")
    implicit = model.simulate(integrator="radau5", rtol=1e-10, atol=1e-11, **keys)
    explicit = model.simulate(integrator="rk4", step=1e-4, **keys)
    assert implicit.status == explicit.status == "ok"
    np.testing.assert_allclose(np.asarray(implicit.q), np.asarray(explicit.q), atol=1e-8)


@pytest.mark.parametrize("method", ["direct-correction", "ggl"])
def test_a_smaller_step_does_not_end_newtons_iteration_of_the_stiffest_spring(method):
    ends = []
    for step in (2e-3, 2.5e-4):
        values = {"stiffness": 1e10, "damping": 2e6}
        options = {"integrator.adaptive": "false"}
        run = stiff.model().simulate(
            method=method, integrator="radau5", step=step, until=0.05, parameters=values, options=options, verify=False
        )
        assert run.status == "ok", run.reason
        ends.append(np.asarray(run.q)[-1])
    assert np.abs(ends[0] - ends[1]).max() < 1e-7
