"""Runs against the reference: how far off, how far off they may be, and whether their status is honest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from benchmarks.plain.moving import Array
from benchmarks.verification.reference import GROUPS, Reference, groups, placed
from benchmarks.verification.runs import Configuration, Outcome

#: An adaptive run may be off by this many tolerances, times what a disturbance grows by.
TOLERANCES = 50.0
#: A run with constant steps may be off by this many times the error of the reference's own run with the same steps.
COARSE = 20.0
#: By so much, at least, the error of a run by `rk4` falls with half the step where it is the step's: 16 in the limit.
FALLS = 8.0
#: What is left to rounding, of the size of each group.
ROUNDING = 1e-10
#: A run by a method that does not keep to D v' = gamma, or with all chosen automatically, is wrong beyond this [m].
WRONG = 1e-3
#: Methods whose accelerations or corrections are only near those of the equations of motion.
NEARLY = (
    "baumgarte adaptive-baumgarte penalty augmented-lagrangian augmented-hamiltonian generalized-alpha "
    "index3-augmented-lagrangian lagrange velocity-projection udwadia-kalaba energy-projection compliant-constraints "
    "invariant-stabilization braun-goldfarb hamiltonian-baumgarte controllable-velocity-projection "
    "stiffness-scaled-penalty half-explicit rattle discrete-gradient"
).split()


@dataclass(frozen=True)
class Verdict:
    """What is to be said of a run.

    Attributes
    ----------
    honest : bool
        Not both `ok` and wrong, and nothing raised but sentences.
    right : bool or None
        Whether it agrees with the reference; None where there is nothing to compare.
    errors, bounds : mapping
        By group; errors of a run without outputs are empty.
    wrong : tuple of str
        Groups beyond their bound.
    """

    honest: bool
    right: bool | None
    errors: Mapping[str, float]
    bounds: Mapping[str, float]
    wrong: tuple[str, ...]


def bounds(reference: Reference, configuration: Configuration) -> dict[str, float]:
    """Return by how much each group of a run may differ.

    Adaptive runs may be off by `TOLERANCES` times the tolerance, a tolerance counting as an error of the size of
    positions that grows as the reference itself shows; those with constant steps by `COARSE` times the error of the
    reference's Runge-Kutta run with the same steps. A method that is only near the equations may be off by `WRONG`.
    """
    limits = {}
    size = max(1.0, reference.scales["q"])
    for name in GROUPS:
        disturbed = reference.scales[name] + reference.growth[name] * size
        if name in ("lam", "reactions"):  # forces that balance to nothing leave their rounding
            disturbed = max(disturbed, reference.scales["energies"] / size)
        if configuration.rtol is not None:
            allowed = TOLERANCES * configuration.rtol * disturbed
        elif reference.coarse is None:
            allowed = np.inf
        else:
            allowed = COARSE * reference.coarse[name] + ROUNDING * disturbed
            if configuration.method == "auto" or configuration.method in NEARLY or configuration.integrator != "rk4":
                allowed = max(allowed, WRONG * (size if name == "q" else max(1.0, disturbed)))
        limits[name] = allowed + 10.0 * reference.own[name]
    return limits


def errors(reference: Reference, outcome: Outcome) -> dict[str, float]:
    """Return the largest difference of each group at the outputs that a run has."""
    system, count = reference.system, len(outcome.t)
    if not count or not np.allclose(outcome.t, reference.times[:count], rtol=0.0, atol=1e-9 * reference.times[-1]):
        return {}
    theirs: dict[str, Array] = {}
    wanted = groups(system, reference.motion)
    order = {"q": system.names_q, "v": system.names_v}
    for name, names in order.items():
        theirs[name] = outcome.columns[name][:, [outcome.names[name].index(n) for n in names]]
    theirs["q"] = placed(system, theirs["q"])
    labels = ("Fx", "Fy", "Fz", "Mx", "My", "Mz") if system.document.spatial else ("Fx", "Fy", "M")
    order |= {"lam": system.rows, "reactions": [f"{j.name}.{label}" for j in system.joints for label in labels]}
    # rows that symgen leaves out as repeated have no columns
    common = {
        name: np.array([n in outcome.names[name] for n in order[name]], dtype=bool) for name in ("lam", "reactions")
    }
    for name in common:
        theirs[name] = _columns(outcome, name, order[name])
    theirs["energies"] = outcome.energies - np.array([0.0, outcome.energies[0, 1], 0.0])
    unique = reference.motion.unique
    gaps = {}
    for name in GROUPS:
        mine, other = wanted[name][:count], theirs[name]
        gap = np.abs(mine - other)
        if name == "lam" and unique is not None and len(unique):
            gap = gap[:, unique & common[name]]
        if name == "reactions" and reference.motion.unique_reactions is not None:
            gap = gap[:, np.repeat(reference.motion.unique_reactions, len(labels)) & common[name]]
        gaps[name] = float("inf") if not np.isfinite(gap).all() else float(gap.max(initial=0.0))
    return gaps


def _columns(outcome: Outcome, table: str, names: list[str]) -> Array:
    """Return columns by name, 0 for those that are not there."""
    columns = {n: k for k, n in enumerate(outcome.names[table])}
    missing = np.zeros(len(outcome.t))
    values = [outcome.columns[table][:, columns[n]] if n in columns else missing for n in names]
    return np.column_stack(values) if values else np.zeros((len(outcome.t), 0))


def of_the_step(
    reference: Reference, configuration: Configuration, outcome: Outcome, finer: Outcome | None
) -> dict[str, float]:
    """Return the groups whose error is the step's own, and how large it may be for that reason.

    On the constraints both sides have the same accelerations. Off them, where the stages of a step are, each has a
    continuation of its own: by Euler parameters whose length is not 1, and by rows of which one side leaves out those
    that depend on others and the other takes the mean. So the errors of two Runge-Kutta schemes of one step may differ
    by any factor, and `COARSE` is no bound for all. What tells an error of the step from any other is that it falls
    with the step by the scheme's order: a law, a row or a branch that is wrong is as wrong with half of it.

    Parameters
    ----------
    finer : Outcome, optional
        The same run with half the step.
    """
    if (
        finer is None
        or finer.status != outcome.status
        or configuration.integrator != "rk4"
        or configuration.rtol is not None
    ):
        return {}
    off, half, limits = errors(reference, outcome), errors(reference, finer), {}
    size = max(1.0, reference.scales["q"])
    for name in off.keys() & half.keys():
        disturbed = reference.scales[name] + reference.growth[name] * size
        if half[name] <= off[name] / FALLS + ROUNDING * disturbed + 10.0 * reference.own[name]:
            limits[name] = WRONG * (size if name == "q" else max(1.0, disturbed))
    return limits


def judge(
    reference: Reference, configuration: Configuration, outcome: Outcome, finer: Outcome | None = None
) -> Verdict:
    """Return what is to be said of a run.

    A run that ended early and says so is right where its outputs are. With a run of half the step, `finer`, one with
    constant steps may be off by what is shown to be its step's error.
    """
    if outcome.status in ("refused", "raised"):
        return Verdict(outcome.status == "refused", None, {}, {}, ())
    allowed, off = bounds(reference, configuration), errors(reference, outcome)
    for name, bound in of_the_step(reference, configuration, outcome, finer).items():
        allowed[name] = max(allowed[name], bound)
    wrong = tuple(name for name, size in off.items() if not size <= allowed[name])
    complete = len(outcome.t) == len(reference.times)
    if outcome.status == "ok" and (not off or not complete):
        wrong = (*wrong, "outputs")
    return Verdict(outcome.status != "ok" or not wrong, not wrong if off else None, off, allowed, wrong)
