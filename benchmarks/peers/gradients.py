"""CasADi on IDAS's slider-crank: a quantity of the whole run and its derivatives, by CVODES with sensitivities.

    python -m benchmarks.peers.gradients [--json FILE]

The mechanism in one coordinate, the angle of its crank, by hand: this is the shortest right-hand side that it has. G is
the integral of its kinetic energy over 10 s, a quadrature of CVODES; its derivatives by stiffness and damping of the
spring are forward sensitivities. Multistep formulas and iterations are those that CVODES has; right-hand sides are
compiled by gcc where there is one. Errors are the largest relative ones of the three numbers, whose references are by a
model without tools in 30 digits; seconds are medians of 15 calls.
"""

from __future__ import annotations

import argparse
import json
import shutil
import statistics
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

#: G [J s], dG/dk, dG/dc.
VALUES = 3.3366067994828, 0.33344810612844, -0.36375403397095
STIFFNESS, DAMPING, FREE_LENGTH, FORCE, DURATION = 1.0, 1.0, 1.0, 1.0, 10.0
TOLERANCES = tuple(10.0**-k for k in range(6, 14))
REPEATS = 15
ADAMS = {"linear_multistep_method": "adams"}
METHODS: dict[str, dict[str, Any]] = {
    "Adams, functional": ADAMS | {"nonlinear_solver_iteration": "functional"},
    "Adams, Newton": ADAMS,
    "BDF, Newton": {},
}


def equations(ca: Any) -> dict[str, Any]:
    """Return the problem as CasADi takes it."""
    angle, speed = ca.SX.sym("angle"), ca.SX.sym("speed")
    k, c = ca.SX.sym("k"), ca.SX.sym("c")
    tip = 0.5 * ca.vertcat(ca.cos(angle), ca.sin(angle))
    along = ca.vertcat(ca.sqrt(1.0 - tip[1] ** 2), -tip[1])
    slider = tip + along
    slope = ca.jacobian(ca.vertcat(angle, slider[0], ca.atan2(along[1], along[0])), angle)
    inertia = slope[0] ** 2 + slope[1] ** 2 + 2.0 * slope[2] ** 2
    length = ca.norm_2(0.5 * tip - (slider - 0.5 * along))
    stretch = ca.jacobian(length, angle)
    pull = k * (length - FREE_LENGTH) + c * stretch * speed
    push = FORCE * ca.jacobian((slider + along)[0], angle)
    change = ca.jacobian(inertia, angle)
    rate = (push - pull * stretch - 0.5 * change * speed**2) / inertia
    energy = 0.5 * inertia * speed**2
    return {"x": ca.vertcat(angle, speed), "p": ca.vertcat(k, c), "ode": ca.vertcat(speed, rate), "quad": energy}


def timed(call: Callable[[], Any]) -> tuple[Any, float]:
    """Return the result of a call, and the median of its wall times [s]."""
    result, seconds = call(), list[float]()
    for _ in range(REPEATS):
        began = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - began)
    return result, statistics.median(seconds)


def error_of(values: Any) -> float:
    """Return the largest relative error of G and its derivatives."""
    return float(np.abs(np.asarray(values, dtype=float).ravel() / VALUES - 1.0).max())


def rows() -> list[dict[str, Any]]:
    """Return errors and times of CVODES by tolerance."""
    import casadi as ca

    problem, measured = equations(ca), list[dict[str, Any]]()
    start, numbers = [0.5 * np.pi, 0.0], [STIFFNESS, DAMPING]
    compiler = shutil.which("gcc")
    jit = {"jit": True, "compiler": "shell", "jit_options": {"flags": ["-O3", "-march=native"], "compiler": compiler}}
    for label, method in METHODS.items():
        for tolerance in TOLERANCES:
            options = method | {"reltol": tolerance, "abstol": tolerance, "quad_err_con": True}
            options |= {"max_num_steps": 100_000, "disable_internal_warnings": True} | (jit if compiler else {})
            solver = ca.integrator("solver", "cvodes", problem, 0.0, DURATION, options)
            x, p = ca.MX.sym("x", 2), ca.MX.sym("p", 2)
            total = solver(x0=x, p=p)["qf"]
            whole = ca.Function("whole", [x, p], [total, ca.jacobian(total, p)])
            way = f"CVODES {label} {tolerance:.0e}"
            try:
                (value, slopes), seconds = timed(partial(whole, start, numbers))
            except RuntimeError as problem_of_run:
                measured.append({"way": way, "error": None, "seconds": None, "status": str(problem_of_run)[-80:]})
                continue
            error = error_of([float(value), *np.array(slopes).ravel()])
            measured.append({"way": way, "error": error, "seconds": seconds, "status": "ok"})
    return [{"peer": "CasADi", "version": str(ca.CasadiMeta.version()), **row} for row in measured]


def main() -> None:
    """Print one line for each tolerance."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    measured = rows()
    for row in measured:
        print(row["way"], row["error"], row["seconds"], row["status"])
    if options.json is not None:
        options.json.write_text(json.dumps(measured))


if __name__ == "__main__":
    main()
