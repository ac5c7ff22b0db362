"""Runs of symgen beside the simulation, and what is to be said of each."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.bounded.draw import Drawn, planar_angle
from benchmarks.bounded.motion import Event, Motion, Simulation, Unusable
from benchmarks.bounded.tree import Array
from benchmarks.mechanisms.toml import text
from benchmarks.plain.turning import rotation

UNTIL, OUTPUTS = 2.0, 20
#: Size of the disturbance by which it is told how disturbances grow, and the largest growth that is of use.
DISTURBANCE, GROWS = 1e-8, 300.0
#: Largest difference of two simulations of different tolerance, times the growth.
OWN = 3e-10
#: Closures whose smallest singular value comes below this are too near a singular position.
NARROW = 0.05
#: What a run may be off by, times the growth: at the usual tolerances, and at tight ones.
USUAL, TIGHT = 1e-6, 1e-9


@dataclass(frozen=True)
class Kind:
    """A kind of run.

    Attributes
    ----------
    settings : mapping
        Arguments of `simulate`.
    bound : float
        What it may be off by, times the growth of disturbances.
    """

    name: str
    settings: Mapping[str, Any]
    bound: float = USUAL


_TIGHT = {"rtol": 1e-11, "atol": 1e-12}
RUNS = {
    kind.name: kind
    for kind in (
        Kind("default", {}),
        Kind("dop853", {"integrator": "dop853", **_TIGHT}, TIGHT),
        Kind("radau5", {"integrator": "radau5", "rtol": 1e-9, "atol": 1e-11}),
        Kind("rk4", {"integrator": "rk4", "step": 5e-4}),
        Kind("joint", {"coordinates": "joint"}),
        Kind("joint dop853", {"coordinates": "joint", "integrator": "dop853", **_TIGHT}, TIGHT),
        Kind("lagrange", {"method": "lagrange", "integrator": "dop853", **_TIGHT}, TIGHT),
    )
}
#: The name of the rows of a sweep in tables.
ROWS = "sweep"


@dataclass
class Reference:
    """The simulation's motion of a drawn mechanism.

    Attributes
    ----------
    times, places : Array
        Output times, and there what is compared of each body: places, in the plane angles, in space rotation matrices.
    growth : float
        Largest change over the disturbance of the start that caused it, at least 1.
    events : list of Event
        In their order.
    """

    drawn: Drawn
    times: Array
    places: dict[str, Array]
    growth: float
    events: list[Event]


@dataclass
class Verdict:
    """What became of a run.

    Attributes
    ----------
    outcome : str
        ``right``, ``coarse`` (of tight tolerances, right to the usual ones), ``WRONG`` (and `ok`), ``unverified``,
        ``failed``, ``sentence``, or ``raised`` where it ended with an exception out of a run.
    error : float
        Largest difference to the simulation.
    """

    run: str
    outcome: str
    error: float
    reason: str = ""
    seconds: float = 0.0
    events: int = 0
    t: float = field(default=float("nan"))


def places(mechanism: Drawn, motion: Motion) -> dict[str, Array]:
    """Return what is compared of a motion."""
    tree, spatial = mechanism.tree, "space" in mechanism.raw["mechanism"]
    found: dict[str, list[Array]] = {name: [] for name in mechanism.bodies}
    for t, u in zip(motion.t, motion.u, strict=True):
        state = tree.at(t, u, np.zeros(tree.n))
        for name, k in mechanism.bodies.items():
            if spatial:
                found[name].append(np.concatenate([state.places[k], state.turns[k].ravel()]))
            else:
                found[name].append(np.array([*state.places[k][:2], planar_angle(tree, k, u)]))
    return {name: np.array(rows) for name, rows in found.items()}


def distance(one: Mapping[str, Array], other: Mapping[str, Array]) -> float:
    """Return the largest difference of what is compared, as far as both go."""
    count = min(len(x) for x in (*one.values(), *other.values()))
    return max(float(np.abs(one[name][:count] - other[name][:count]).max(initial=0.0)) for name in one)


def reference(mechanism: Drawn, until: float = UNTIL) -> Reference:
    """Return the simulation of a mechanism, over half the time as often as disturbances grow too much.

    Raises
    ------
    Unusable
        If no part of the motion can serve.
    """
    reason = ""
    for _ in range(3):
        times = np.linspace(0.0, until, OUTPUTS + 1)
        try:
            return _reference(mechanism, times)
        except Unusable as error:
            reason = str(error)
        until *= 0.5
    raise Unusable(reason)


def _reference(mechanism: Drawn, times: Array) -> Reference:
    tree, rows = mechanism.tree, mechanism.rows

    def run(u: Array, v: Array, rtol: float) -> Motion:
        return Simulation(tree, rows, rtol, 0.1 * rtol).run(u, v, [float(t) for t in times])

    motion = run(mechanism.u, mechanism.v, 1e-12)
    if motion.narrowest < NARROW:
        raise Unusable(f"a singular position: {motion.narrowest:.2g}")
    own = distance(places(mechanism, motion), places(mechanism, run(mechanism.u, mechanism.v, 1e-10)))
    growth = 1.0
    for sign in (1.0, -1.0):
        v = mechanism.v * (1.0 + sign * DISTURBANCE)
        u = _displaced(mechanism, sign * DISTURBANCE)
        changed = distance(places(mechanism, motion), places(mechanism, run(u, v, 1e-12)))
        growth = max(growth, changed / DISTURBANCE)
    if growth > GROWS:
        raise Unusable(f"disturbances grow {growth:.2g} times")
    if own > OWN * growth:
        raise Unusable(f"two tolerances differ by {own:.2g}, disturbances grow {growth:.2g} times")
    return Reference(mechanism, times, places(mechanism, motion), growth, motion.events)


def _displaced(mechanism: Drawn, size: float) -> Array:
    """Return the coordinates of a start that is a little beside; what lies on a stop stays there."""
    tree, u = mechanism.tree, mechanism.u
    still = np.array([0.0 if _at_a_bound(mechanism, k) else 1.0 for k in range(tree.n)])
    if tree.closures:
        if not still.all():
            return u
        slopes = tree.closed(tree.at(0.0, u, mechanism.v))[1]
        still -= np.linalg.pinv(slopes) @ (slopes @ still)
    u = u + size * still
    for _ in range(3 if tree.closures else 0):
        gaps, slopes, _ = tree.closed(tree.at(0.0, u, mechanism.v))
        u = u - np.linalg.pinv(slopes) @ gaps
    return u


def _at_a_bound(mechanism: Drawn, k: int) -> bool:
    state = mechanism.tree.at(0.0, mechanism.u, mechanism.v)
    for row in mechanism.rows:
        measured = row.of(state)
        value = float(measured.value)
        if measured.slopes[k] and min(abs(value - row.lower), abs(row.upper - value)) < 1e-6:
            return True
    return False


def tables(mechanism: Drawn, result: Any) -> dict[str, Array]:
    """Return what is compared of a result."""
    spatial = "space" in mechanism.raw["mechanism"]
    found = {}
    for name in mechanism.bodies:
        if spatial:
            place = np.column_stack([result[f"{name}.{a}"] for a in "xyz"])
            turns = np.column_stack([result[f"{name}.e{i}"] for i in range(4)])
            found[name] = np.column_stack(
                [place, np.array([rotation(e).ravel() for e in turns]).reshape(len(turns), 9)]
            )
        else:
            found[name] = np.column_stack([result[f"{name}.{label}"] for label in ("x", "y", "theta")])
    return found


def judged(name: str, status: str, error: float, bound: float, growth: float, reason: str) -> Verdict:
    """Return the verdict of a run with a status."""
    if status == "ok":
        return Verdict(
            name,
            "right" if error <= bound * growth else "coarse" if error <= USUAL * growth else "WRONG",
            error,
            reason,
        )
    if status == "unverified":
        return Verdict(name, "unverified", error, reason)
    return Verdict(name, "failed", error, reason)


def compared(kind: Kind, against: Reference, path: Path) -> Verdict:
    """Return the verdict of one run of a file."""
    import symgen

    began = time.perf_counter()
    times = against.times
    try:
        result = symgen.load(path).simulate(until=float(times[-1]), times=times, **kind.settings)
    except symgen.SymgenError as refusal:
        verdict = Verdict(kind.name, "sentence", float("nan"), str(refusal))
        if " at t = " in verdict.reason:  # out of a run
            verdict.outcome = "raised"
    except Exception as other:  # whatever else is raised is looked for here
        verdict = Verdict(kind.name, "raised", float("nan"), f"{type(other).__name__}: {other}")
    else:
        error = distance(against.places, tables(against.drawn, result))
        if len(result.t) < len(times) and result.status == "ok":
            error = float("inf")
        verdict = judged(kind.name, result.status, error, kind.bound, against.growth, result.reason or "")
        verdict.events = len(result.events)
        verdict.t = float(result.t[-1])
        if verdict.outcome == "unverified":
            verdict.reason = "; ".join(result.warnings) or verdict.reason
    verdict.seconds = time.perf_counter() - began
    return verdict


def swept(against: Reference, path: Path) -> Verdict:
    """Return the verdict of rows of a sweep, all with the file's own numbers; they are to be the same."""
    import symgen

    began = time.perf_counter()
    first = next(iter(against.drawn.bodies))
    mechanism = against.drawn
    spatial = "space" in mechanism.raw["mechanism"]
    labels = ("x", "y", "z") if spatial else ("x", "y", "theta")
    names = [f"{name}.{label}" for name in mechanism.bodies for label in labels]
    mass = mechanism.tree.links[mechanism.bodies[first]].mass
    changed = {"parameters": {"own_mass": mass}}
    raw = {**mechanism.raw, **changed}
    raw["bodies"] = {n: ({**b, "mass": "own_mass"} if n == first else b) for n, b in raw["bodies"].items()}
    other = path.with_name("swept.toml")
    other.write_text(text(raw), encoding="utf-8")
    settings: dict[str, Any] = {"integrator": "dop853", **_TIGHT, "verify": False}
    try:
        found = symgen.sweep(
            other,
            {"own_mass": [mass, mass]},
            until=float(against.times[-1]),
            times=against.times,
            quantities=tuple(names),
            jobs=1,
            **settings,
        )
    except symgen.SymgenError as refusal:
        return Verdict(ROWS, "sentence", float("nan"), str(refusal), time.perf_counter() - began)
    except Exception as wrong:  # whatever else is raised is looked for here
        return Verdict(ROWS, "raised", float("nan"), f"{type(wrong).__name__}: {wrong}", time.perf_counter() - began)
    status = str(np.asarray(found.status).ravel()[0])
    error = 0.0
    for name, body in against.places.items():
        for c, label in enumerate(labels):
            error = max(error, float(np.abs(np.asarray(found[f"{name}.{label}"])[0] - body[:, c]).max()))
    reason = "" if status == "ok" else str(np.asarray(found.reason).ravel()[0])
    verdict = judged(ROWS, status, error, TIGHT, against.growth, reason)
    verdict.seconds = time.perf_counter() - began
    return verdict


def examined(mechanism: Drawn, runs: tuple[str, ...], until: float = UNTIL) -> tuple[Reference | str, list[Verdict]]:
    """Return the reference of a mechanism, or why there is none, and the verdicts of runs."""
    try:
        against = reference(mechanism, until)
    except Unusable as error:
        return str(error), []
    verdicts = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "drawn.toml"
        path.write_text(text(mechanism.raw), encoding="utf-8")
        for name in runs:
            verdicts.append(swept(against, path) if name == ROWS else compared(RUNS[name], against, path))
    return against, verdicts
