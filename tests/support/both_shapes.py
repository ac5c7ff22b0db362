"""Every emitted function of both shapes at one state, in a process of its own in which nothing is compiled.

``python -m support.both_shapes`` writes JSON: case -> quantity -> largest difference over its scale.
"""

import json
import sys
from collections.abc import Iterator, Mapping
from types import MappingProxyType

import numpy as np

from support.emitted import mechanism_of
from support.models import EVERYTHING, GEARED, READING, ROUGH, parallelogram
from symgen.api import Model, load
from symgen.base.errors import AssemblyError
from symgen.base.ir.program import BY_PIVOTS, COUNTERS, STATUS
from symgen.derive.lower.looped.looped_law import is_loopable
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.describe import catalogue
from symgen.describe.files.builder import MechanismBuilder
from symgen.run.layout.abi import N_COUNTERS

#: Methods that solve with large penalties amplify rounding by them.
PENALTY = {"penalty": 1e3}


def spatial(name: str = "spatial", rotor: Mapping[str, float] = MappingProxyType({})) -> Model:
    """A body with products of inertia on a ball joint, one hinged to it, and a free one."""
    builder = MechanismBuilder(name, space="spatial", gravity=[0.0, 0.4, -9.81])
    tensor = [[0.02, 0.001, 0.002], [0.001, 0.03, 0.0], [0.002, 0.0, 0.01]]
    for name, inertia in zip("abc", (tensor, np.diag([0.02, 0.01, 0.03]), tensor), strict=True):
        builder.body(
            *(name,),
            **{"mass": 1.3, "inertia": inertia, "position": [0.1, 0.5, 0.2], "angular_velocity": [0.3, 0.2, -0.4]},
            **{"points": {"O": [0.0, -0.5, 0.1], "P": [0.0, 0.5, 0.0]}, "centre_of_mass": [0.01, 0.0, 0.02]},
        )
    builder.joint("ball", "spherical", between=["ground", "a"], at=[[0.0, 0.0, 0.0], "O"])
    builder.joint("hinge", "revolute", between=["a", "b"], at=["P", "O"], axis=[1.0, 0.3, 0.0], **rotor)
    builder.force("aim", "force", body="c", force=["b.P.x*c.O.vz", "sin(hinge.angle)", "a.P.vy - 0.3*hinge.rate"])
    builder.force("turn", "torque", body="c", torque=["hinge.angle", 0.0, "c.P.y"])
    return load(builder.build())


def models() -> dict[str, Model]:
    """Return the mechanisms that are tried, by name."""
    found = {name: load(name) for name in (*catalogue.names(), "n-four-bar:3", "chain:3")}
    for description in (EVERYTHING, GEARED, READING, ROUGH, parallelogram()):
        mechanism = mechanism_of(description)
        found[mechanism.name] = load(mechanism)
    found["spatial"] = spatial()
    found["spatial-geared"] = spatial("spatial-geared", {"rotor_inertia": 2e-3, "gear_ratio": 5.0})
    return found


def choices() -> Iterator[tuple[str, dict[str, str]]]:
    """Yield every method and option that has a looped shape."""
    for name in METHODS.names:
        method = METHODS.get(name)
        variants = [{}] + [{o.name: value} for o in method.options for value in o.values[1:]]
        for given in variants:
            options = method.complete_options(given)
            if EXPLICIT_FORMS & set(method.forms) and is_loopable(method, options, False):
                yield name, given


def off_constraints(model: Model, info, values) -> tuple[np.ndarray, np.random.Generator]:
    """Return a state beside the described start, and the generator that made it."""
    q, v = model.initial_state(values)
    y, rng = np.zeros(info.ny), np.random.default_rng(3)
    y[:-1] = [*q, *(0.0 if x is None else x for x in v)]
    y[:-1] += 0.2 * rng.standard_normal(info.ny - 1)
    return y, rng


def evaluate(model: Model, name: str, options: dict[str, str], shape: str) -> dict[str, np.ndarray]:
    """Return what every function of a compiled model leaves, at a state off the constraints."""
    compiled = model.compile(name, options, shape)
    info, law = compiled.info, compiled.law_module
    known = {p for p, _ in compiled.law.parameters}
    values = model.parameters()
    y, rng = off_constraints(model, info, values)
    p = compiled.parameter_array(values, {k: x for k, x in PENALTY.items() if k in known})
    compiled.model.prepare(p)
    law.prepare(p)
    w, t = compiled.scratch(), 0.3
    compiled.section(w, "status")[[STATUS.index("length_scale"), STATUS.index("speed_scale")]] = 1.0
    w[STATUS.index("step")] = 1e-3
    iw, rate = np.zeros(N_COUNTERS, dtype=np.int64), np.zeros_like(y)
    found: dict[str, np.ndarray] = {}

    def keep(name: str, *sections: str) -> None:
        for section in sections:
            if section == "winding" and not info.windings:
                continue
            found[f"{name} {section}"] = compiled.section(w, section).copy()

    compiled.model.masses(p, w)
    keep("masses", "mass")
    for where in (compiled.model, law):
        if hasattr(where, "geometry") or hasattr(where, "spread"):
            kind = "law" if where is law else "model"
            geometry = getattr(where, "geometry", compiled.model.geometry)  # straight laws may share the model's
            geometry(t, y.copy(), p, w)
            keep(f"{kind} geometry", "residual", "nu")
            found[f"{kind} geometry D"] = compiled.jacobian(w)
            # pivots depend on the order of elimination, which is not the same; the rank does not
            found[f"{kind} geometry status"] = w[[0, STATUS.index("rank")]]
            compiled.model.measure(t, y.copy(), p, w)
            keep(f"{kind} measure", "residual", "winding")
            found[f"{kind} measure status"] = w[1:4].copy()
            if hasattr(where, "spread"):
                where.spread(p, w)
                keep(f"{kind} spread", "change")
    d = compiled.jacobian(w)
    law.rhs(t, y.copy(), p, w, iw, rate)  # a pivot that is suspicious in one order need not be so in another
    found["rhs"] = rate.copy()
    found["rhs D^T lambda"] = d.T @ compiled.section(w, "multipliers")
    if hasattr(law, "confirm"):
        law.confirm(t, y.copy(), p, w, iw, rate)
        found["confirm"] = rate.copy()
        if BY_PIVOTS not in compiled.law.operations:  # pivots of loops in closed form may settle it before
            found["confirm counters"] = np.array([iw[COUNTERS.index("suspects")], iw[COUNTERS.index("light")]]) * 1.0
    out = np.zeros(info.m + 2 * len(info.joint_coordinates))
    compiled.model.observe(t, y.copy(), p, w, rng.standard_normal(info.ny), out)
    found["observe"] = out
    try:
        start = model.assemble(compiled, None, {k: x for k, x in PENALTY.items() if k in known})
    except AssemblyError:
        start = None  # made to hold every kind, not to be closed
    if start is not None:
        near, iw[:] = start.y.copy(), 0
        near[: info.nq] += 1e-4 * rng.standard_normal(info.nq)
        bits = law.accept(t, near, start.p, start.w, iw)
        found["accept"], found["accept bits"] = near, np.array([float(bits)])
        found["counters"] = iw[[COUNTERS.index(c) for c in ("iterations", "law_iterations")]] * 1.0
    if info.spins:
        turned = y.copy()
        compiled.section(w, "change")[:] = 0.1 * rng.standard_normal(info.nv)
        compiled.model.turn(turned, w)
        found["turn"] = turned
    return found


def differences(straight: dict[str, np.ndarray], looped: dict[str, np.ndarray]) -> dict[str, float]:
    """Return the largest difference between the shapes in each quantity, over its size or 1."""
    # one row alone has no pivot to be suspicious of, which straight code knows and looped code does not ask; without a
    # row its laws have no geometry either
    known = {"confirm", "confirm counters"}
    if not straight.get("model geometry residual", np.ones(1)).size:
        known |= {key for key in looped if key.startswith(("law geometry", "law measure", "law spread"))}
    assert straight.keys() ^ looped.keys() <= known, straight.keys() ^ looped.keys()
    return {
        key: float(
            np.max(np.abs(straight[key] - looped[key]), initial=0.0) / np.max(np.abs(straight[key]), initial=1.0)
        )
        for key in straight.keys() & looped.keys()
    }


def report(evaluated, cases, is_tried) -> None:
    """Write the differences of cases to standard output; words name mechanisms or methods, `-` leaves out.

    Parameters
    ----------
    evaluated : callable
        Takes a model, a case and a shape; returns arrays by quantity.
    cases : mapping
        Cases by label, of which the first word is the method.
    is_tried : callable
        Takes names of a mechanism and a case; whether it is tried where no words are given.
    """
    wanted = {word for word in sys.argv[1:] if not word.startswith("-")}
    left_out = {word[1:] for word in sys.argv[1:]} - wanted
    results = {}
    for mechanism, model in models().items():
        for label, case in cases.items():
            named = wanted & {mechanism, label.split()[0]}
            if mechanism not in left_out and (named if wanted else mechanism in DEEP or is_tried(case)):
                shapes = (evaluated(model, case, shape) for shape in ("straight", "looped"))
                results[f"{mechanism} {label}"] = differences(*shapes)
    json.dump(results, sys.stdout)


#: Mechanisms that every method is tried on; the others see those that every part of the code is in.
DEEP = ("slider-crank", "everything", "geared", "rough", "spatial", "spatial-geared", "n-four-bar:3")
FEW = ({"lagrange": {}}, {"direct-correction": {"weight": "mass"}}, {"penalty": {}}, {"mass-orthogonal-projection": {}})

if __name__ == "__main__":
    cases = {" ".join([m, *(f"{k}={x}" for k, x in options.items())]): (m, options) for m, options in choices()}
    report(lambda model, case, shape: evaluate(model, *case, shape), cases, lambda case: {case[0]: case[1]} in FEW)
