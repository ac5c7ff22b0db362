"""Residuals and Jacobians of descriptor forms in both shapes at one state, in a process that compiles nothing.

``python -m support.both_forms`` writes JSON: case -> quantity -> largest difference over its scale.
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace

import numpy as np

from support.both_shapes import DEEP, models
from symgen.api import Model
from symgen.compiling.pipeline import choose_method, compile_model
from symgen.ir.program import STATUS

#: Methods whose constraints differ; all mechanisms see the first.
METHODS = ("ggl", "lagrange", "baumgarte", "adaptive-baumgarte", "penalty", "generalized-alpha")
PROJECTED = "index3-augmented-lagrangian"


def evaluate(model: Model, method: str, shape: str) -> dict[str, np.ndarray]:
    """Return residual, power and Jacobian at a state off the constraints, with any unknowns."""
    compiled = compile_model(model.mechanism, replace(choose_method(method, None, True), shape=shape))
    info, law = compiled.info, compiled.law
    values = model.parameters()
    q, v = model.initial_state(values)
    y = np.zeros(info.ny)
    y[: info.nq] = q
    y[info.nq : -1] = [0.0 if x is None else x for x in v]
    rng = np.random.default_rng(3)
    y[:-1] += 0.2 * rng.standard_normal(info.ny - 1)
    k = rng.standard_normal(law.unknowns)
    p, w = compiled.parameter_array(values, {}), compiled.scratch()
    compiled.model.prepare(p)
    compiled.law_module.prepare(p)
    w[STATUS.index("step")] = 1e-3
    more = 2 * info.m if law.level == "projected" else 0
    residual, slopes = np.full(law.unknowns + more, 7.0), np.full(len(law.tangent), np.nan)
    compiled.law_module.residual(0.3, y, k, p, w, residual)
    compiled.law_module.tangent(0.3, y, k, p, w, slopes)
    jacobian = np.zeros((law.unknowns, law.unknowns + info.nq + info.nv))
    rows, columns = np.array(law.tangent).T
    np.add.at(jacobian, (rows, columns), slopes)
    return {"residual": residual, "power": w[[STATUS.index("power")]], "jacobian": jacobian}


def differences(model: Model, method: str) -> dict[str, float]:
    """Return the largest difference between the shapes in each quantity, over its size or 1."""
    straight, looped = (evaluate(model, method, shape) for shape in ("straight", "looped"))
    return {
        key: float(np.max(np.abs(straight[key] - looped[key])) / np.max(np.abs(straight[key]), initial=1.0))
        for key in straight
    }


if __name__ == "__main__":
    wanted = {word for word in sys.argv[1:] if not word.startswith("-")}
    left_out = {word[1:] for word in sys.argv[1:]} - wanted
    results = {}
    for label, model in models().items():
        if label in left_out:
            continue
        for method in (*METHODS, PROJECTED):
            if wanted & {label, method} if wanted else label in DEEP or method == METHODS[0]:
                results[f"{label} {method}"] = differences(model, method)
    json.dump(results, sys.stdout)
