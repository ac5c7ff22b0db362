"""Residuals and Jacobians of descriptor forms in both shapes at one state, in a process that compiles nothing.

``python -m support.both_forms`` writes JSON: case -> quantity -> largest difference over its scale.
"""

from dataclasses import replace

import numpy as np

from support.both_shapes import off_constraints, report
from symgen.api import Model
from symgen.base.ir.program import STATUS
from symgen.derive.lower.recorded_law import BEHIND
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model

#: Methods whose constraints differ; all mechanisms see the first.
METHODS = (
    *("ggl", "lagrange", "baumgarte", "adaptive-baumgarte", "penalty", "compliant-constraints", "generalized-alpha"),
)
PROJECTED, EXPLICIT = "index3-augmented-lagrangian", "rattle"


def evaluate(model: Model, method: str, shape: str) -> dict[str, np.ndarray]:
    """Return residual, power and Jacobian at a state off the constraints, with any unknowns."""
    compiled = compile_model(model.mechanism, replace(choose_method(method, None, True), shape=shape))
    info, law = compiled.info, compiled.law
    values = model.parameters()
    y, rng = off_constraints(model, info, values)
    k = rng.standard_normal(law.unknowns)
    p, w = compiled.parameter_array(values, {}), compiled.scratch()
    compiled.model.prepare(p)
    compiled.law_module.prepare(p)
    w[STATUS.index("step")] = 1e-3
    more = BEHIND.get(law.level, 0) * info.m
    residual, slopes = np.full(law.unknowns + more, 7.0), np.full(len(law.tangent), np.nan)
    compiled.law_module.residual(0.3, y, k, p, w, residual)
    compiled.law_module.tangent(0.3, y, k, p, w, slopes)
    jacobian = np.zeros((law.unknowns, law.unknowns + info.nq + info.nv))
    rows, columns = np.array(law.tangent).T
    np.add.at(jacobian, (rows, columns), slopes)
    return {"residual": residual, "power": w[[STATUS.index("power")]], "jacobian": jacobian}


if __name__ == "__main__":
    report(
        evaluate, {method: method for method in (*METHODS, PROJECTED, EXPLICIT)}, lambda method: method == METHODS[0]
    )
