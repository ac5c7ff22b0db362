"""From what is asked for to an answer: where an analysis is made, and the analysis there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen import arguments
from symgen.analyses.cyclic import steady_motion
from symgen.analyses.edges import edges
from symgen.analyses.equilibrium import Equilibrium, at_rest_from, equilibria, judged, stability_in_motion
from symgen.analyses.linearise import LinearSystem, linear_system, named_states
from symgen.analyses.modes import Modes, modes
from symgen.analyses.reduced import tangent
from symgen.analyses.steady import at_rest
from symgen.analyses.subject import LARGE, Subject, subject_of
from symgen.analyses.vibration import eigenvectors
from symgen.errors import AnalysisError, AssemblyError, InputError, nearest, quoted

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result
    from symgen.settings import Settings

Array = NDArray[np.float64]

#: Places that are asked for by a word; another one is a time of a run.
PLACES = ("equilibrium", "start", "steady")
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
class NamedPlace:
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


def arrived(place: NamedPlace) -> NamedPlace:
    """Return the same about the start, which is the state of a run where a time is asked for.

    Raises
    ------
    AnalysisError
        If the run fails or does not come to the time.
    """
    if isinstance(place.at, str):
        return place
    settings, at = place.settings, place.at
    result = place.run(replace(settings, until=at, output_step=None, times=(at,), **FOLLOWED))  # type: ignore[arg-type]  # of settings
    if result.status == "failed":
        raise AnalysisError(f"the run to t = {at:g} s failed: {result.reason}")
    if result.end < at:
        raise AnalysisError(f"the run to t = {at:g} s is over at t = {result.end:.6g} s: an event ends it")
    return replace(place, settings=replace(settings, start=result), at="start")  # type: ignore[arg-type]  # gone on from


def subject_at(place: NamedPlace, by: Sequence[str] = ()) -> tuple[Subject, Array]:
    """Return what is analysed, and the state that it is analysed about.

    Parameters
    ----------
    place : NamedPlace
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
    place = arrived(place)
    mechanism, settings, at = place.mechanism, place.settings, place.at
    if at == "steady":
        subject = subject_of(mechanism, replace(settings, coordinates="joint"), by)
        moving = steady_motion(subject, place.cyclic)
        return moving.subject, moving.y
    subject = subject_of(mechanism, settings, by)
    if at == "equilibrium":
        rest = at_rest_from(subject)
        return rest.subject, rest.y
    if not subject.closed:
        raise InputError("at start", "a start that closes the mechanism", "one that does not", "ask for an equilibrium")
    return subject, subject.y


def steady_from(mechanism: Mechanism, settings: Settings, cyclic: Sequence[str] = ()) -> Equilibrium:
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
    return replace(told, stability=stability_in_motion(eigenvectors(x, names, None)[0]))


def scanned(
    mechanism: Mechanism, settings: Settings, scan: tuple[str, Sequence[float] | Array]
) -> tuple[Equilibrium, ...]:
    """Return the equilibria over a range of a coordinate; see `symgen.analyses.equilibrium.equilibria`."""
    name, values = range_of("scan", scan)
    subject = subject_of(mechanism, settings)
    subject.position(name)
    return _of_bodies(mechanism, settings, subject, equilibria(subject, (name, values)))


def rest_from(mechanism: Mechanism, settings: Settings) -> Equilibrium:
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


def modes_at(place: NamedPlace, states: Sequence[str] = (), count: int | None = None) -> Modes:
    """Return the modes at a place; see `symgen.api.Model.modes`."""
    states = arguments.words("states", states)
    if count is not None:
        from symgen.analyses.large import lowest_modes

        if states or place.cyclic or place.at != "equilibrium":
            raise InputError(
                "count", "modes about an equilibrium, without states of their own", "another place, or states"
            )
        if place.settings.coordinates == "joint":
            raise InputError("count", "coordinates of bodies", "those of joints", "ask for all modes")
        return lowest_modes(place.mechanism, place.settings, arguments.whole("count", count, 1, 10_000))
    place = arrived(place)  # inputs may be others there than at the start
    subject, y = subject_at(place)

    def bodies() -> Subject:
        return subject_of(place.mechanism, replace(place.settings, coordinates="absolute"))

    return replace(modes(subject, y, None, states, bodies=bodies), notes=edges(subject, y))


def system_at(
    place: NamedPlace, states: Sequence[str] = (), instantaneous: bool = False, by: Sequence[str] = ()
) -> LinearSystem:
    """Return the linear system at a place; see `symgen.api.Model.linearise`."""
    states = arguments.words("states", states)
    subject, y = subject_at(place, arguments.words("by", by))
    found = linear_system(subject, y, None, states, arguments.switch("instantaneous", instantaneous))
    accelerations = tangent(subject, y).a if found.outputs else None
    return replace(found, notes=edges(subject, y, accelerations, found.outputs))
