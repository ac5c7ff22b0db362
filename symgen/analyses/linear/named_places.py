"""Places of analyses, and the analyses there."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.linear.eigenmodes import Modes, modes_about
from symgen.analyses.linear.linear_system import LinearSystem, eigenvectors_of_states, linear_system
from symgen.analyses.rest.band import Band, band_of_rests
from symgen.analyses.rest.cyclic import steady_motion
from symgen.analyses.rest.equilibria import (
    Equilibrium,
    judge_equilibrium,
    scan_equilibria,
    stability_in_motion,
    value_of_coordinate,
)
from symgen.analyses.rest.held_rows import rest_within_bounds
from symgen.analyses.rest.lawful import find_lawful_rest, multipliers_of_bodies, with_bodies
from symgen.analyses.rest.settle import Settled, settle_position
from symgen.analyses.rest.steady import at_rest, named_states
from symgen.analyses.state.moving_drivers import note_on_moving_drivers, refuse_moving_drivers
from symgen.analyses.state.one_sided import refuse_impossible_mode
from symgen.analyses.state.reduced import tangent_system
from symgen.analyses.state.subject import LARGE, Subject, make_subject
from symgen.base import arguments
from symgen.base.errors import AnalysisError, AssemblyError, InputError, quote, suggest
from symgen.describe.bounds.bounded_modes import two_sided_rows
from symgen.describe.formulas.evaluate import parameter_values
from symgen.run.compiling.pipeline import straight_alone

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result

Array = NDArray[np.float64]

#: Places selected by a word; another one is a time of a run.
PLACES = ("equilibrium", "start", "steady")
#: Largest distance of an equilibrium from the coordinates that name it [rad, or the length of the mechanism].
BESIDE = 0.1
#: Tolerances of a run that leads to a state that is linearised about.
FOLLOWED = {"method": "direct-correction", "integrator": "dop853", "rtol": 1e-12, "atol": 1e-14}


@dataclass(frozen=True)
class NamedPlace:
    """A mechanism and the place of its analysis.

    Attributes
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        ``parameters``, ``inputs``, ``start`` and ``coordinates`` are looked at.
    at : {"equilibrium", "start", "steady"}, float or mapping
        At the equilibrium that the start leads to, at the start, in the steady motion that the start leads to, at
        a time of the run from the start [s], or at the equilibrium with values of coordinates by name.
    run : callable
        Settings -> result of a run.
    cyclic : sequence of str
        Coordinates that turn on in a steady motion; found by default.

    Raises
    ------
    InputError
        If the place does not exist.
    """

    mechanism: Mechanism
    settings: Settings
    at: str | float | Mapping[str, float]
    run: Callable[[Settings], Result]
    cyclic: Sequence[str] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", self._check_place())
        object.__setattr__(self, "cyclic", arguments.words("cyclic", self.cyclic))
        if self.cyclic and self.at != "steady":
            raise InputError("cyclic", "names where a steady motion is searched (at steady)", ", ".join(self.cyclic))

    def _check_place(self) -> str | float | Mapping[str, float]:
        at, time = self.at, math.nan
        if isinstance(at, Mapping) and at:
            return {name: arguments.number(f"at '{name}'", value) for name, value in at.items()}
        if isinstance(at, str) and at in PLACES:
            return at
        with suppress(InputError, ValueError):
            time = arguments.number("at", float(at) if isinstance(at, str) else at, positive=True)
        if math.isnan(time):
            expected = f"{', '.join(PLACES)}, a time above 0 in s, or coordinates of an equilibrium"
            hint = suggest(at, PLACES) if isinstance(at, str) else ""
            raise InputError("at", expected, arguments.kind_of_value(at), hint)
        return time


def place_after_run(place: NamedPlace) -> NamedPlace:
    """Return the same about the start, which is the state of a run if the place is a time.

    Raises
    ------
    AnalysisError
        If the run fails or does not reach the time.
    """
    if isinstance(place.at, str | Mapping):
        return place
    settings, at = place.settings, place.at
    result = place.run(replace(settings, until=at, output_step=None, times=(at,), **FOLLOWED))  # type: ignore[arg-type]  # of settings
    if result.status == "failed":
        raise AnalysisError(f"the run to t = {at:g} s failed: {result.reason}")
    if result.end < at:
        raise AnalysisError(f"the run to t = {at:g} s is over at t = {result.end:.6g} s: an event ends it")
    return replace(place, settings=replace(settings, start=result), at="start")  # type: ignore[arg-type]  # gone on from


def subject_at(place: NamedPlace, by: Sequence[str] = ()) -> tuple[Subject, Array]:
    """Return the mechanism, and the state that it is analysed about.

    Parameters
    ----------
    place : NamedPlace
        The place.
    by : sequence of str
        Parameters that the form is differentiated by.

    Raises
    ------
    InputError
        If the start is wrong.
    AnalysisError
        If no equilibrium or steady motion is found, or the run fails or does not reach its time.
    """
    place = place_after_run(place)
    settings = replace(place.settings, coordinates="joint") if place.at == "steady" else place.settings
    if place.at == "start" and (held := rest_within_bounds(place.mechanism, settings, by)) is not None:
        return held, held.y
    if place.at == "equilibrium":
        rest = find_lawful_rest(place.mechanism, settings, by, sinking=False).settled
        _refuse_moving_drivers(rest)
        return rest.subject, rest.y
    subject = make_subject(place.mechanism, settings, by)
    if place.at == "start":
        if not subject.closed:
            expected = "a start that closes the mechanism"
            raise InputError("at start", expected, "one that does not", "ask for an equilibrium")
        _refuse_mode(subject, subject.y)
        return subject, subject.y
    if not isinstance(place.at, Mapping):
        rest = steady_motion(subject, place.cyclic)
        _refuse_mode(rest.subject, rest.y)
    else:
        rest = rest_at(subject, place.at)
        _refuse_moving_drivers(rest)
        if subject.mode:
            refuse_impossible_mode(rest.subject, rest.y, judge_equilibrium(rest).lam)
    return rest.subject, rest.y


def _refuse_moving_drivers(rest: Settled) -> None:
    """Refuse motions beside a driver that moves, where it leaves any."""
    subject = rest.subject
    if tangent_system(subject, rest.y).size:
        refuse_moving_drivers("at equilibrium", subject.mechanism, subject.compiled, subject.p, subject.t)


def _refuse_mode(subject: Subject, y: Array) -> None:
    """Refuse a state in motion at which a one-sided row cannot be in its mode."""
    if subject.mode:
        refuse_impossible_mode(subject, y, tangent_system(subject, y).lam)


def rest_at(subject: Subject, values: Mapping[str, float]) -> Settled:
    """Find the equilibrium with some coordinates: everything else comes to rest while these are held, then all does.

    Raises
    ------
    InputError
        If a name is no coordinate.
    AnalysisError
        If there is none within `BESIDE`.
    """
    y = subject.y.copy()
    y[subject.nq :] = 0.0
    held = settle_position(subject, y, tuple(values.items()))
    rest = settle_position(held.subject, held.y)
    for name, value in values.items():
        there, unit = value_of_coordinate(rest.subject, rest.y, name), subject.unit(name)
        if abs(there - value) > BESIDE * (subject.length if unit == "m" else 1.0):
            raise AnalysisError(
                f"no equilibrium is near {name} = {value:g} {unit}: it comes to rest at {there:.6g} {unit}"
            )
    return rest


def steady_from(mechanism: Mechanism, settings: Settings, cyclic: Sequence[str] = ()) -> Equilibrium:
    """Find a steady motion as an equilibrium; see `symgen.api.Model.steady`."""
    subject = make_subject(mechanism, replace(settings, coordinates="joint"))
    rest = steady_motion(subject, arguments.words("cyclic", cyclic))
    _refuse_mode(rest.subject, rest.y)
    x = tangent_system(rest.subject, rest.y)
    names = named_states(rest.subject, x, (), False, "steady")
    if at_rest(rest.subject, x):
        return judge_equilibrium(rest)
    # what turns on may slow down as the rest moves out: the stiffness at constant speeds does not tell
    return replace(judge_equilibrium(rest), stability=stability_in_motion(eigenvectors_of_states(x, names, None)[0]))


def scan_for_rests(
    mechanism: Mechanism, settings: Settings, scan: tuple[str, Sequence[float] | Array]
) -> tuple[Equilibrium, ...]:
    """Find the equilibria over a range of a coordinate; see `symgen.api.Model.equilibria`."""
    name, values = check_range("scan", scan)
    subject = make_subject(mechanism, settings)
    rests = scan_equilibria(subject, name, values)
    settled = (Settled(subject.turn_to_joint_angles(rest.q), rest.y, rest.lam, rest.iterations) for rest in rests)
    return _add_notes(mechanism, settings, _rests_of_bodies(mechanism, settings, subject, rests), settled)


def rest_from(mechanism: Mechanism, settings: Settings) -> Equilibrium:
    """Find the equilibrium that the start leads to; see `symgen.api.Model.equilibrium`."""
    large = mechanism.body_coordinates > LARGE and not straight_alone(mechanism)
    looped = settings.shape == "looped" or (settings.shape == "auto" and large)
    if settings.coordinates == "absolute" and looped:
        from symgen.analyses.linear.large import large_equilibrium

        return large_equilibrium(mechanism, settings)
    try:
        subject = make_subject(mechanism, settings)
    except AssemblyError:  # a tree is put together from bodies that close
        settings = replace(settings, coordinates="absolute")
        subject = make_subject(mechanism, settings)
        if subject.closed:  # it is the tree that cannot start there, as in a run
            raise
    found = find_lawful_rest(mechanism, settings, subject=subject)
    rests = _rests_of_bodies(mechanism, settings, found.start, (found.equilibrium,))
    return _add_notes(mechanism, settings, rests, (found.settled,))[0]


def _add_notes(
    mechanism: Mechanism, settings: Settings, rests: tuple[Equilibrium, ...], settled: Iterable[Settled]
) -> tuple[Equilibrium, ...]:
    """Return equilibria with a note on drivers that move, and with the bands in which rows with two bounds hold."""
    settled = tuple(settled)
    rests = tuple(
        replace(rest, notes=(*note_on_moving_drivers(x.mechanism, x.compiled, x.p, x.t), *rest.notes))
        for rest, x in zip(rests, (each.subject for each in settled), strict=True)
    )
    if not any(not row.signed for row in two_sided_rows(mechanism)):
        return rests
    values = parameter_values(mechanism, settings.parameters)
    bands = [Band({}, "") if x.subject.held else band_of_rests(mechanism, values, x) for x in settled]
    return tuple(
        replace(rest, band=dict(band.values), notes=(*rest.notes, *filter(None, [band.note])))
        for rest, band in zip(rests, bands, strict=True)
    )


def _rests_of_bodies(
    mechanism: Mechanism, settings: Settings, subject: Subject, rests: tuple[Equilibrium, ...]
) -> tuple[Equilibrium, ...]:
    """Return equilibria with coordinates of bodies and multipliers of all joints, also where a tree carries them."""
    if subject.coordinates == "absolute":
        return rests
    bodies, whole = with_bodies(mechanism, settings, subject), list[Equilibrium]()
    for rest in rests:
        y = np.zeros_like(bodies.y)
        y[: bodies.nq] = [rest.q[name] for name in bodies.state_names[: bodies.nq]]
        there = bodies.turn_to_joint_angles(rest.q)
        known = multipliers_of_bodies(there, y, rest.multipliers)
        own = judge_equilibrium(Settled(there, y, rest.lam, rest.iterations), known)
        whole.append(replace(own, y=rest.y, lam=rest.lam, notes=tuple(dict.fromkeys((*own.notes, *rest.notes)))))
    return tuple(whole)


def check_range(where: str, pair: object) -> tuple[str, Array]:
    """Return a name and its values, checked.

    Raises
    ------
    InputError
        If it is no pair of a name and finite numbers.
    """
    if not isinstance(pair, tuple) or len(pair) != 2 or not isinstance(pair[0], str):
        raise InputError(where, "a pair of a name and its values", quote(pair))
    return pair[0], np.array(arguments.numbers(f"{where} {pair[0]}", pair[1]), dtype=np.float64)


def _number_text(x: float) -> str:
    return f"{x:.6g}" if abs(x) > 1e-12 else "0"


def modes_at(place: NamedPlace, states: Sequence[str] = (), count: int | None = None) -> Modes:
    """Return the modes at a place; see `symgen.api.Model.modes`."""
    states = arguments.words("states", states)
    if count is not None:
        from symgen.analyses.linear.large import lowest_modes

        if states or place.cyclic or place.at != "equilibrium":
            raise InputError(
                "count", "modes about an equilibrium, without states of their own", "another place, or states"
            )
        if place.settings.coordinates == "joint":
            raise InputError("count", "coordinates of bodies", "those of joints", "ask for all modes")
        return lowest_modes(place.mechanism, place.settings, arguments.whole_number("count", count, 1, 10_000))
    place = place_after_run(place)  # inputs may be others there than at the start
    subject, y = subject_at(place)

    absolute = replace(place.settings, coordinates="absolute")
    return modes_about(subject, y, states, lambda: make_subject(place.mechanism, absolute))


def system_at(
    place: NamedPlace, states: Sequence[str] = (), instantaneous: bool = False, by: Sequence[str] = ()
) -> LinearSystem:
    """Return the linear system at a place; see `symgen.api.Model.linearise`."""
    states = arguments.words("states", states)
    subject, y = subject_at(place, arguments.words("by", by))
    result = linear_system(subject, y, states, arguments.truth_value("instantaneous", instantaneous))
    if place.at != "equilibrium" and not isinstance(place.at, Mapping):
        return result
    where = ", ".join(
        f"{name} = {_number_text(result.about[name])}" for name in result.states[: (len(result.states) + 1) // 2]
    )
    note = f"about the {stability_in_motion(result.eigenvalues())} equilibrium at {where}"
    return replace(result, notes=(note, *result.notes) if where else result.notes)
