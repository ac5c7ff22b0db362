"""From what is asked for to an answer: where an analysis is made, and the analysis there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen import arguments
from symgen.analyses.algebra import eigenvalues_of, split
from symgen.analyses.equilibrium import Equilibrium, at_rest_from, equilibria, judged, stability_in_motion
from symgen.analyses.linearise import LinearSystem, linear_system, named_states
from symgen.analyses.modes import Modes, modes
from symgen.analyses.reduced import tangent
from symgen.analyses.settle import Settled, settle
from symgen.analyses.steady import at_rest, system
from symgen.analyses.subject import LARGE, Subject, subject_of
from symgen.errors import AnalysisError, AssemblyError, InputError, nearest, quoted

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result
    from symgen.settings import Settings

Array = NDArray[np.float64]

#: Places that are asked for by a word; another one is a time of a run.
PLACES = ("equilibrium", "start", "steady")
#: A turning that changes rates by less than this part of the largest change changes nothing.
SPUN = 1e-9
#: Tolerances of a run that leads to a state that is linearised about.
FOLLOWED = {"method": "direct-correction", "integrator": "dop853", "rtol": 1e-12, "atol": 1e-14}


def place_of(at: object, where: str = "at") -> str | float:
    """Return a checked place: one of `PLACES`, or a time [s].

    Raises
    ------
    InputError
        If it is neither.
    """
    if isinstance(at, str):
        if at in PLACES:
            return at
        try:
            return arguments.number(where, float(at), positive=True)
        except ValueError:
            raise InputError(where, f"{', '.join(PLACES)} or a time in s", quoted(at), nearest(at, PLACES)) from None
    return arguments.number(where, at, positive=True)


def is_large(mechanism: Mechanism, settings: Settings) -> bool:
    """Whether sparse matrices are asked for, or a mechanism is so large that they are taken."""
    size = mechanism.body_coordinates
    return settings.shape == "looped" or (settings.shape == "auto" and size > LARGE)


@dataclass(frozen=True)
class Asked:
    """What is analysed, and where.

    Attributes
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        ``parameters``, ``inputs``, ``start`` and ``coordinates`` are looked at.
    at : {"equilibrium", "start", "steady"} or float
        At the equilibrium that the start leads to, at the start, in the steady motion that the start leads to, or
        at a time of the run from the start [s].
    run : callable
        Settings -> result of a run.
    cyclic : sequence of str
        Coordinates that turn on in a steady motion; found by default.

    Raises
    ------
    InputError
        If there is no such place.
    """

    mechanism: Mechanism
    settings: Settings
    at: str | float
    run: Callable[[Settings], Result]
    cyclic: Sequence[str] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", place_of(self.at))
        object.__setattr__(self, "cyclic", arguments.words("cyclic", self.cyclic))
        if self.cyclic and self.at != "steady":
            raise InputError("cyclic", "names where a steady motion is searched (at steady)", ", ".join(self.cyclic))


def arrived(asked: Asked) -> Asked:
    """Return the same about the start, which is the state of a run where a time is asked for.

    Raises
    ------
    AnalysisError
        If the run fails or does not come to the time.
    """
    if isinstance(asked.at, str):
        return asked
    settings, at = asked.settings, asked.at
    result = asked.run(replace(settings, until=at, output_step=None, times=(at,), **FOLLOWED))  # type: ignore[arg-type]  # of settings
    if result.status == "failed":
        raise AnalysisError(f"the run to t = {at:g} s failed: {result.reason}")
    if result.end < at:
        raise AnalysisError(f"the run to t = {at:g} s is over at t = {result.end:.6g} s: an event ends it")
    return replace(asked, settings=replace(settings, start=result), at="start")  # type: ignore[arg-type]  # gone on from


def subject_at(asked: Asked, by: Sequence[str] = ()) -> tuple[Subject, Array]:
    """Return what is analysed, and the state that it is analysed about.

    Parameters
    ----------
    asked : Asked
        What is asked for.
    by : sequence of str
        Parameters that derivatives are wanted by.

    Raises
    ------
    InputError
        If the start is wrong.
    AnalysisError
        If no equilibrium or steady motion is found, or the run fails or does not come to the time asked for.
    """
    asked = arrived(asked)
    mechanism, settings, at = asked.mechanism, asked.settings, asked.at
    if at == "steady":
        subject = subject_of(mechanism, replace(settings, coordinates="joint"), by)
        moving = steady_motion(subject, asked.cyclic)
        return moving.subject, moving.y
    subject = subject_of(mechanism, settings, by)
    if at == "equilibrium":
        rest = at_rest_from(subject)
        return rest.subject, rest.y
    if not subject.closed:
        raise InputError("at start", "a start that closes the mechanism", "one that does not", "ask for an equilibrium")
    return subject, subject.y


def steady_motion(subject: Subject, cyclic: Sequence[str] = ()) -> Settled:
    """Return a motion in which cyclic coordinates turn on at the speed of the start and nothing else changes.

    Parameters
    ----------
    subject : Subject
        In joint coordinates.
    cyclic : sequence of str
        Names of these coordinates; those that nothing depends on by default.

    Raises
    ------
    InputError
        If a name is no coordinate of the tree's joints, or something depends on it, or a body that no joint's angle
        belongs to spins at the start and would go on.
    AnalysisError
        If there is no such motion.
    """
    names = [q.name for q in subject.compiled.info.coordinates]
    free = _without_effect(subject)
    for name in cyclic:
        if name not in names:
            expected = f"a coordinate of the joints of {subject.mechanism.name}"
            raise InputError(f"cyclic '{name}'", expected, "none of that name", nearest(name, names))
        if names.index(name) not in free:
            raise InputError(
                f"cyclic '{name}'", "a coordinate that no force and no row depends on", "one that changes them"
            )
    turning = [names.index(name) for name in cyclic] or free
    e = subject.evaluated(subject.y)
    motion = e.by("motion", "v")
    kept = np.zeros(subject.nv, dtype=np.bool_)
    for i in turning:
        kept |= motion[i] != 0.0
    y = subject.y.copy()
    v = y[subject.nq : subject.nq + subject.nv]
    _refuse_spins(subject, v, kept, driven=bool(np.any(e.by("positions", "t"))))
    begun = v.copy()
    v[~kept] = 0.0
    found = settle(subject, y)
    _refuse_lost(found.subject, found.y, np.where(kept, 0.0, begun))
    return found


def _refuse_spins(subject: Subject, v: Array, kept: NDArray[np.bool_], driven: bool) -> None:
    """Refuse a start whose only turning is that of bodies free to turn about any axis: no coordinate is its angle."""
    names = subject.compiled.info.velocities
    turns = np.array([q.unit == "rad/s" for q in names], dtype=np.bool_) & (np.abs(v) > 0.0)
    spins = [first + k for _, first in subject.compiled.info.spins for k in range(3) if turns[first + k]]
    if spins and not driven and not np.any(turns & kept):
        _refuse_spin(names[spins[0]].name)


def _refuse_lost(subject: Subject, y: Array, lost: Array) -> None:
    """Refuse to leave out a turning that would have gone on: of a body about an axis that nothing depends on.

    What swings at the start comes to rest in a steady motion. What spins about an axis along which the body may be
    turned, while nothing changes, would not.
    """
    spins = [first for _, first in subject.compiled.info.spins if np.any(lost[first : first + 3])]
    if not spins:
        return
    x = tangent(subject, y)
    free = split(subject.rows(x.base)[subject.holonomic])[0]
    size = np.abs(x.matrix).max(initial=1.0)
    for first in spins:
        about = np.zeros((subject.nv, 3))
        about[first : first + 3] = np.eye(3)
        turned = free.T @ about
        changes = np.vstack([x.matrix[:, : x.positions] @ turned / size, about - free @ turned])
        _, felt, axes = np.linalg.svd(changes)
        spin = axes[felt <= SPUN] @ lost[first : first + 3]
        if np.abs(spin).max(initial=0.0) > SPUN * np.abs(lost).max():
            k = int(np.argmax(np.abs(lost[first : first + 3])))
            _refuse_spin(subject.compiled.info.velocities[first + k].name)


def _refuse_spin(name: str) -> None:
    expected = "joints whose angles or displacements turn on"
    got = f"'{name}', the turning of a body about any axis, which no coordinate counts"
    raise InputError("steady", expected, got, "give it joints with axes, such as three hinges")


def _without_effect(subject: Subject) -> list[int]:
    """Return the coordinates that nothing depends on: along which all derivatives vanish, here and elsewhere.

    What a driver moves depends on time as its own row does, which therefore counts for nothing.
    """
    rng = np.random.default_rng(0)
    found = np.ones(subject.nq, dtype=np.bool_)
    for k in range(3):
        y = subject.y.copy()
        y[: subject.nq] += 0.3 * k * rng.standard_normal(subject.nq)
        v = y[subject.nq : subject.nq + subject.nv]
        v[:] = rng.standard_normal(subject.nv)
        e = subject.evaluated(y, rng.standard_normal(subject.nv), rng.standard_normal(subject.m))
        for group in ("motion", "balance", "accelerations", "velocities", "positions"):
            by = np.abs(e.by(group, "q"))
            # each row by itself: a soft spring is one beside a stiff one as well
            size = np.max([np.abs(e.by(group, s)).max(axis=1, initial=1e-300) for s in ("q", "v", "a", "lam")], axis=0)
            if group not in ("motion", "balance"):
                size = np.where(e.by("positions", "t")[:, 0] == 0.0, size, np.inf)
            found &= np.all(by <= 1e-11 * size[:, np.newaxis], axis=0)
    return [int(i) for i in np.flatnonzero(found)]


def asked_steady(mechanism: Mechanism, settings: Settings, cyclic: Sequence[str] = ()) -> Equilibrium:
    """Return a steady motion as an equilibrium; see `symgen.api.Model.steady`."""
    subject = subject_of(mechanism, replace(settings, coordinates="joint"))
    found = steady_motion(subject, arguments.words("cyclic", cyclic))
    subject = found.subject
    x = tangent(subject, found.y)
    names = named_states(subject, x, (), False, "steady")
    told = judged(subject, found.y, found.steps)
    if at_rest(subject, x):
        return told
    # what turns on may slow down as the rest moves out: the stiffness at constant speeds does not tell
    return replace(told, stability=stability_in_motion(eigenvalues_of(system(x, names)[0])[0]))


def scanned(
    mechanism: Mechanism, settings: Settings, scan: tuple[str, Sequence[float] | Array]
) -> tuple[Equilibrium, ...]:
    """Return the equilibria over a range of a coordinate; see `symgen.analyses.equilibrium.equilibria`."""
    name, values = range_of("scan", scan)
    subject = subject_of(mechanism, settings)
    subject.position(name)
    return _of_bodies(mechanism, settings, subject, equilibria(subject, (name, values)))


def asked_equilibrium(mechanism: Mechanism, settings: Settings) -> Equilibrium:
    """Return the equilibrium that the start leads to; see `symgen.api.Model.equilibrium`."""
    if settings.coordinates == "absolute" and is_large(mechanism, settings):
        from symgen.analyses.large import large_equilibrium

        return large_equilibrium(mechanism, settings)
    try:
        subject = subject_of(mechanism, settings)
    except AssemblyError:  # a tree is put together from bodies that close
        settings = replace(settings, coordinates="absolute")
        subject = subject_of(mechanism, settings)
    return _of_bodies(mechanism, settings, subject, equilibria(subject))[0]


def _of_bodies(
    mechanism: Mechanism, settings: Settings, subject: Subject, found: tuple[Equilibrium, ...]
) -> tuple[Equilibrium, ...]:
    """Return equilibria with coordinates of bodies and multipliers of all joints, also where a tree carries them."""
    if subject.coordinates == "absolute":
        return found
    bodies = subject_of(mechanism, replace(settings, coordinates="absolute"))
    whole = list[Equilibrium]()
    for one in found:
        y = np.zeros_like(bodies.y)
        y[: bodies.nq] = [one.q[name] for name in bodies.state_names[: bodies.nq]]
        own = judged(bodies.turned(one.q), y, one.iterations)
        whole.append(replace(own, y=one.y, lam=one.lam))
    return tuple(whole)


def range_of(where: str, given: object) -> tuple[str, Array]:
    """Return a name and its values, checked.

    Raises
    ------
    InputError
        If it is no pair of a name and finite numbers.
    """
    if not isinstance(given, tuple) or len(given) != 2 or not isinstance(given[0], str):
        raise InputError(where, "a pair of a name and its values", quoted(given))
    return given[0], np.array(arguments.numbers(f"{where} {given[0]}", given[1]), dtype=np.float64)


def asked_modes(asked: Asked, states: Sequence[str] = (), count: int | None = None) -> Modes:
    """Return the modes at a place; see `symgen.api.Model.modes`."""
    states = arguments.words("states", states)
    if count is not None:
        from symgen.analyses.large import lowest_modes

        if states or asked.cyclic or asked.at != "equilibrium":
            raise InputError(
                "count", "modes about an equilibrium, without states of their own", "another place, or states"
            )
        if asked.settings.coordinates == "joint":
            raise InputError("count", "coordinates of bodies", "those of joints", "ask for all modes")
        return lowest_modes(asked.mechanism, asked.settings, arguments.whole("count", count, 1, 10_000))
    asked = arrived(asked)  # inputs may be others there than at the start
    subject, y = subject_at(asked)

    def bodies() -> Subject:
        return subject_of(asked.mechanism, replace(asked.settings, coordinates="absolute"))

    return modes(subject, y, None, states, bodies=bodies)


def asked_system(
    asked: Asked, states: Sequence[str] = (), instantaneous: bool = False, by: Sequence[str] = ()
) -> LinearSystem:
    """Return the linear system at a place; see `symgen.api.Model.linearise`."""
    states = arguments.words("states", states)
    subject, y = subject_at(asked, arguments.words("by", by))
    return linear_system(subject, y, None, states, arguments.switch("instantaneous", instantaneous))
