"""Descriptor forms in space: the emitted Jacobian by complex steps on the emitted residual, for every joint and force.

K and C, the derivatives of forces, constraint rows and multipliers by q and v, are parts of that Jacobian.
"""

import cmath
import math
import types

import msgspec
import numpy as np
import pytest
from support.emitted import law_source, mechanism_of
from support.random_space import make
from support.space import STEP, angle_of

from symgen.base.vocabulary.infos import LawInfo
from symgen.describe.forces import FORCES
from symgen.describe.joints import JOINTS
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import generate
from symgen.run.layout.compiled import ModelInfo

#: Ropes follow from their starts, and have references in tests/run/single/test_ropes_in_space.py; points on beams have
#: theirs in tests/verification/test_sliding.py.
JOINT_KINDS = tuple(
    name for name, kind in JOINTS.items() if "spatial" in kind.SPACES and name not in ("rope", "slides-on")
)
FORCE_KINDS = tuple(name for name, kind in FORCES.items() if "spatial" in kind.SPACES and name != "beam")
#: Method -> level of its descriptor.
LEVELS = {
    "baumgarte": "acceleration",
    "ggl": "stabilised",
    "generalized-alpha": "position",
    "index3-augmented-lagrangian": "projected",
    "half-explicit": "explicit",
}
#: Joint kinds by fours, each with some force kinds, so that every kind is in one case at least.
CASES = [
    (JOINT_KINDS[i : i + 4], tuple(FORCE_KINDS[(i // 4 + k) % len(FORCE_KINDS)] for k in range(2)))
    for i in range(0, len(JOINT_KINDS), 4)
]


def arithmetic():
    """The functions of `math` that emitted code calls, for complex numbers next to real ones."""
    names = {n: getattr(cmath, n) for n in ("sqrt", "exp", "log", "sin", "cos", "tan", "tanh", "sinh", "cosh")}
    return types.SimpleNamespace(**names, atan2=angle_of, floor=lambda x: math.floor(complex(x).real))


class Stage:
    """``residual`` and ``tangent`` of a law as plain Python, the former with complex arithmetic."""

    def __init__(self, raw, modules, method):
        stem = choose_method(method, None, True).stem
        self.info = msgspec.convert(modules["model"][1], ModelInfo)
        self.law = msgspec.convert(modules[stem][1], LawInfo)
        source = law_source(modules, stem, "prepare", "form")
        self.real, self.complex = types.ModuleType(stem), types.ModuleType(f"{stem}_complex")
        for module in (self.real, self.complex):
            exec(compile(source, stem, "exec"), module.__dict__)
        self.complex.math = arithmetic()
        model = types.ModuleType("model")
        exec(compile(modules["model"][0], "model", "exec"), model.__dict__)
        self.p = [0.0] * (self.law.parameter_offset + len(self.law.parameters) + self.law.hoisted)
        self.p[: len(self.info.parameters)] = [raw["parameters"][q.name] for q in self.info.parameters]
        for i, (_, default) in enumerate(self.law.parameters):
            self.p[self.law.parameter_offset + i] = default
        model.prepare.py_func(self.p)
        self.real.prepare.py_func(self.p)

    def residual(self, t, y, k):
        r = [0.0] * (self.law.unknowns + 2 * self.info.m)
        self.complex.residual.py_func(t, y, k, self.p, [0.0] * self.law.nw, r)
        return np.array(r[: self.law.unknowns])

    def tangent(self, t, y, k):
        n, width = self.law.unknowns, self.info.nq + self.info.nv
        j = [math.nan] * len(self.law.tangent)
        self.real.tangent.py_func(t, y, k, self.p, [0.0] * self.law.nw, j)
        by = np.zeros((n, n + width))
        for (row, column), value in zip(self.law.tangent, j, strict=True):
            assert by[row, column] == 0.0  # straight code writes a place once
            by[row, column] = value
        return by[:, :n], by[:, n:]


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(
    "case",
    [pytest.param(i, marks=() if i < 2 else pytest.mark.slow) for i in range(len(CASES))],
    ids=["-".join(kinds[:1]) for kinds, _ in CASES],
)
def test_tangent_is_the_derivative_of_the_residual(case):
    rng = np.random.default_rng(case)
    raw, t, q, v = make(rng, *CASES[case], smooth=True)
    modules = generate(mechanism_of(raw), tuple(choose_method(m, None, True) for m in LEVELS)).modules
    for method, level in LEVELS.items():
        stage = Stage(raw, modules, method)
        assert stage.law.level == level
        y, k = [*q, *v, 0.0], rng.uniform(-2.0, 2.0, stage.law.unknowns).tolist()
        for found, vector in zip(stage.tangent(t, y, k), (k, y), strict=True):
            expected = np.zeros(found.shape)
            for c in range(found.shape[1]):
                moved = [complex(x, STEP) if i == c else x for i, x in enumerate(vector)]
                r = stage.residual(t, y if vector is k else moved, moved if vector is k else k)
                expected[:, c] = np.imag(r) / STEP
            if stage.law.level == "explicit":  # M and D are all that such schemes take
                dynamic = slice(stage.info.nq, stage.info.nq + stage.info.nv)
                whole, expected = expected, np.zeros(expected.shape)
                expected[dynamic] = whole[dynamic] if vector is k else 0.0
            scale = np.maximum(1.0, np.abs(expected).max(axis=1, keepdims=True))
            np.testing.assert_allclose(found / scale, expected / scale, rtol=0.0, atol=1e-11, err_msg=method)


def test_every_kind_is_in_a_case():
    assert {kind for kinds, _ in CASES for kind in kinds} == set(JOINT_KINDS)
    assert {kind for _, kinds in CASES for kind in kinds} == set(FORCE_KINDS)
