"""From settings to a plan: names resolved, numbers checked, unsuitable pairs refused, before anything is run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.arguments import shown
from symgen.compiling.choose_coordinates import choose_coordinates, weighed
from symgen.compiling.choose_shape import choose_shape
from symgen.compiling.pipeline import MethodChoice, choose_method, for_masses
from symgen.describe.digest import digest
from symgen.describe.evaluate import parameter_values
from symgen.describe.events import RECORD, STOP, events_of, watched
from symgen.describe.holds import holds_of
from symgen.describe.kinks import switches_of
from symgen.errors import InputError, nearest, quoted
from symgen.integrators import INTEGRATORS
from symgen.memory import require
from symgen.methods import METHODS
from symgen.runtime.foreseen import foreseen
from symgen.runtime.run import MAX_STEPS, Array, RunSpec
from symgen.settings import Settings, told_constant

if TYPE_CHECKING:
    from symgen.describe.mechanism import Event, Hold, Mechanism
    from symgen.methods._base import Method
    from symgen.runtime.integrator import Integrator
    from symgen.runtime.last_state import LastState

#: Adaptive runs without asked output times report this many equidistant ones.
DEFAULT_OUTPUTS = 1001
#: Evaluations of an adaptive run in a second of motion, where nothing is known of the motion.
ADAPTIVE_EVALUATIONS = 2000.0
#: Default tolerances of adaptive runs.
RTOL, ATOL = 1e-8, 1e-10


@dataclass(frozen=True)
class Plan:
    """Settings resolved: method, integrator and what the loop gets."""

    choice: MethodChoice
    tableau: Integrator
    method_parameters: Mapping[str, float]
    spec: RunSpec
    warnings: tuple[str, ...]
    solver_is_free: bool = False  # the solver was not asked for and may be chosen by the start
    shape_reason: str = ""
    holds: tuple[Hold, ...] = ()
    last: LastState | None = None  # what the run goes on from
    events: tuple[Event, ...] = ()
    coordinates: str = "absolute"
    coordinates_reason: str = ""
    missed: tuple[str, ...] = ()  # those of the warnings that parameters decide

    @property
    def key(self) -> tuple[str, tuple[tuple[str, float], ...]]:
        """What a compiled model and its start depend on: module, shape and parameters of the method."""
        return f"{self.choice.stem} {self.choice.shape} {self.coordinates}", tuple(
            sorted(self.method_parameters.items())
        )


def make_plan(mechanism: Mechanism, s: Settings) -> Plan:
    """Resolve and check settings.

    Raises
    ------
    InputError
        If a name, option or number is wrong.
    """
    if s.inputs:  # single runs have put them into the mechanism
        name, expected = next(iter(s.inputs)), "a single run; here an input is a number, as parameters are"
        raise InputError("inputs", expected, "one of a run", f"parameters or --set give it one, such as {name}=2")
    method = METHODS.get(s.method, "--method")
    tableau = INTEGRATORS.get(s.integrator or method.default_integrator, "--integrator")
    if not set(method.forms) & set(tableau.forms):
        fits = [n for n, i in INTEGRATORS.items() if set(i.forms) & set(method.forms)]
        raise InputError(
            f"integrator '{tableau.name}'",
            f"one that solves the form of {method.name} ({', '.join(method.forms)})",
            f"one for {', '.join(tableau.forms)}",
            "these do: " + ", ".join(fits),
        )
    choice, method_parameters, integrator_options = split_options(s, tableau)
    last = None if isinstance(s.start, Mapping) else s.start.last_state
    begin = 0.0 if last is None else last.t
    if last is not None:
        _check_same(mechanism, last)
    adaptive = tableau.adaptive and not told_constant(s.options, tableau.name)
    defaults = mechanism.defaults
    until = defaults.until if s.until is None else s.until
    step = s.step if adaptive or s.step is not None else defaults.step
    if not until > begin:
        raise InputError("until", f"an end after t = {begin:g} s, where the run goes on", f"{until:g}")
    if s.step is not None and s.step > until:  # the mechanism's own is meant for longer runs
        raise InputError("step", f"at most until = {until:g}", f"{s.step:g}")
    if not adaptive and step is not None and (until - begin) / step > (s.max_steps or 2e9):
        expected = "at most 2e9 steps" if s.max_steps is None else f"at most max_steps = {s.max_steps:g} steps"
        raise InputError("step", expected, f"{(until - begin) / step:.3g}")
    warnings = list[str]()
    limit = method.largest_step(
        {p.name: method_parameters.get(p.name, p.default) for p in method.parameters}, tableau.real_boundary
    )
    if not adaptive and limit is not None and step is not None and step > limit:
        warnings.append(
            f"the step {step:g} s exceeds {limit:.3g} s, where {method.name} is unstable with {tableau.name}"
        )
    events = events_asked(mechanism, s)
    known = foreseen(mechanism, events)
    values = parameter_values(mechanism, s.parameters) if known else {}
    missed = known.missed(values, until, None if adaptive else step)
    spec = RunSpec(
        until=until,
        step=step,
        adaptive=adaptive,
        times=_output_times(s, mechanism, (begin, until), step, adaptive),
        rtol=RTOL if s.rtol is None else s.rtol,
        atol=ATOL if s.atol is None else s.atol,
        relative=s.atol is None,
        largest_step=np.inf if limit is None else limit,
        max_violation=s.max_violation,
        max_velocity_violation=limit_of_velocities(method, s.max_violation),
        max_energy_error=s.max_energy_error,
        max_steps=MAX_STEPS if s.max_steps is None else s.max_steps,
        compares=not adaptive and "ode" not in tableau.forms and bool(switches_of(mechanism)),
        pieces=known.pieces(values, until) if adaptive else (),
        # not the end of this run: where it is gone on with, it has to be the same
        duration=None if adaptive else defaults.until,
        integrator_parameters={
            q.name: float(integrator_options[q.name]) for q in tableau.parameters if q.name in integrator_options
        },
    )
    free = "solver" in choice.options and not _asked(s, "solver")
    massless = mechanism.has_massless
    choice, free = for_masses(mechanism, choice, free), free and not massless
    asked_shape = _shape(s, last)
    if s.coordinates == "joint":
        choose_coordinates(mechanism, s.coordinates, asked_shape)
        asked_shape = "straight"
    shape = choose_shape(mechanism, choice, asked_shape, expected_evaluations(tableau, until - begin, step, adaptive))
    choice = replace(choice, shape=shape.name)
    coordinates = choose_coordinates(mechanism, s.coordinates, shape.name)
    if coordinates.name == "joint" and not _asked(s, "weight"):
        choice = weighed(choice, massless)
    holds = () if last is not None else holds_of(mechanism, "start", s.start)
    return Plan(
        choice,
        tableau,
        method_parameters,
        spec,
        (*warnings, *missed),
        free,
        shape.reason,
        holds,
        last,
        events,
        coordinates.name,
        coordinates.reason,
        tuple(missed),
    )


def limit_of_velocities(method: Method, max_violation: float) -> float | None:
    """Return the largest violation of velocities that a run by a method may have, None where it is `max_violation`."""
    # where velocities follow it is an error of the discretisation, not drift: half the digits are asked of it
    return math.sqrt(max_violation) if method.velocities_follow else None


def _asked(s: Settings, option: str) -> bool:
    """Whether settings give an option of the method."""
    return any(key.partition(".")[2] == option for key in s.options)


def _check_same(mechanism: Mechanism, last: LastState) -> None:
    """Refuse to go on from a run of another mechanism."""
    names = [f"{b.name}.{n}" for b in mechanism.bodies for n in b.coordinates]
    speeds = [f"{b.name}.{n}" for b in mechanism.bodies for n in b.speeds]
    other = last.digest not in ("", digest(mechanism)) or {*names} != {*last.q} or {*speeds} != {*last.v}
    if other or last.mechanism not in ("", mechanism.name):
        got = f"one of {last.mechanism}" if last.mechanism not in ("", mechanism.name) else "one of others"
        raise InputError("start", f"the result of a run of {mechanism.name} with the same equations", got)
    if not all(math.isfinite(x) for x in (last.t, *last.q.values(), *last.v.values())):
        raise InputError("start", "a last state that is finite", "one that is not")


def _shape(s: Settings, last: LastState | None) -> str:
    """Return the shape asked for; a run that goes on from another keeps that one's unless asked otherwise."""
    kept = {} if last is None or last.made is None else last.made
    return str(kept.get("shape", s.shape)) if s.shape == "auto" else s.shape


def events_asked(mechanism: Mechanism, s: Settings) -> tuple[Event, ...]:
    """Return the events of a run: those of the mechanism, then those that are asked for beside, each once."""
    asked = (
        *(watched(mechanism, "stop_when", text, STOP) for text in s.stop_when),
        *(watched(mechanism, "record_when", text, RECORD) for text in s.record_when),
    )
    once = {event.name: event for event in reversed(asked)}  # one that ends runs is recorded as well
    return (*mechanism.events, *events_of(mechanism, s.events), *reversed(once.values()))


def refuse_events(where: str, mechanism: Mechanism, s: Settings) -> None:
    """Refuse events where runs do not look for them; those of a mechanism that are only recorded change nothing.

    Raises
    ------
    InputError
        If there are others.
    """
    own = len(mechanism.events)
    for i, event in enumerate(events_asked(mechanism, s)):
        if event.action != RECORD or i >= own:
            expected = "a mechanism whose motion has no events" if i < own else "no events"
            does = {RECORD: "is recorded", STOP: "ends runs"}.get(event.action, "changes velocities")
            hint = "single runs look for events"
            if i < own:
                hint += f"; without {event.name} in [events], or with its action 'record', it is taken"
            raise InputError(where, expected, f"the event '{event.name}', which {does}", hint)


def refuse_weightless(mechanism: Mechanism) -> None:
    """Refuse to simulate a mechanism in which nothing has a mass: joints and drivers alone say how it moves."""
    if mechanism.bodies and all(body.weightless for body in mechanism.bodies):
        first, hint = quoted(mechanism.bodies[0].name), "symgen kinematics and symgen inverse do without"
        raise InputError(f"body {first}", "a mass, of one body at least", "a mechanism in which nothing has one", hint)


def expected_evaluations(tableau: Integrator, until: float, step: float | None, adaptive: bool) -> float:
    """Return about how many evaluations a run takes, to choose the shape of its code by."""
    if adaptive or step is None:
        return ADAPTIVE_EVALUATIONS * until
    return float(tableau.stages + 1) * until / step  # an accepted state costs about one more


def split_options(s: Settings, tableau: Integrator) -> tuple[MethodChoice, dict[str, float], dict[str, str]]:
    """Return the method with structural options, its numeric parameters, and the integrator's options.

    Keys are ``method.NAME`` or the method's own name, ``integrator.NAME`` or the integrator's own name.
    """
    base = choose_method(s.method).method
    numeric = {p.name: p for p in base.parameters}
    structural: dict[str, str] = {}
    parameters: dict[str, float] = {}
    integrator: dict[str, str] = {}
    seen = set[tuple[bool, str]]()
    for key, value in s.options.items():
        owner, _, name = key.partition(".")
        one = owner in ("method", base.name), name
        if one in seen:
            raise InputError(f"option {key}", "each option once", f"{name} by two names of its owner")
        seen.add(one)
        if one[0]:
            if name in numeric:
                parameters[name] = _number(key, value)
                if parameters[name] < numeric[name].minimum:
                    raise InputError(f"option {key}", f"at least {numeric[name].minimum:g}", f"{value}")
            else:
                structural[name] = str(value)
        elif owner in ("integrator", tableau.name):
            integrator[name] = _integrator_option(key, name, value, tableau)
        else:
            known_owners = ("method", base.name, "integrator", tableau.name)
            raise InputError(
                f"option {key}", "method.NAME or integrator.NAME", f"'{key}'", nearest(owner, known_owners)
            )
    return choose_method(s.method, structural, not {"ode", "one-step"} & set(tableau.forms)), parameters, integrator


def _integrator_option(key: str, name: str, value: str | float, integrator: Integrator) -> str:
    """Return the checked text of an integrator's option: a switch or a number."""
    numeric = {q.name: q for q in integrator.parameters}
    if name in numeric:
        q, number = numeric[name], _number(key, value)
        if not q.minimum <= number <= q.maximum:
            raise InputError(f"option {key}", f"from {q.minimum:g} to {q.maximum:g}", f"{value}")
        return repr(number)
    if integrator.adaptive and name == "adaptive" and str(value).lower() in ("true", "false"):
        return str(value).lower()
    known = [*numeric, *(("adaptive=true", "adaptive=false") if integrator.adaptive else ())]
    raise InputError(
        f"option {key}",
        f"an option of {integrator.name}",
        f"'{name}={value}'",
        nearest(name, known) if known else "it has none",
    )


def _output_times(
    s: Settings, mechanism: Mechanism, span: tuple[float, float], step: float | None, adaptive: bool
) -> Array:
    size, (begin, until) = output_size(mechanism), span
    if s.times is not None:
        try:
            given = np.asarray(s.times, dtype=np.float64)
        except (TypeError, ValueError):
            raise InputError("times", "finite, increasing output times", shown(s.times)) from None
        if given.ndim != 1 or not np.all(np.isfinite(given)) or np.any(np.diff(given) <= 0.0):
            raise InputError("times", "finite, increasing output times", "others")
        if len(given) and (given[0] < begin * (1.0 - 1e-12) or given[-1] > until * (1.0 + 1e-12)):
            raise InputError("times", f"output times from {begin:g} to {until:g}", f"{given[0]:g} to {given[-1]:g}")
        require("times", f"{len(given):.3g} outputs of {mechanism.name}", size * len(given))
        return np.clip(given, begin, until)  # a multiple of a step may exceed the end by rounding
    every = s.output_step if s.output_step is not None else mechanism.defaults.output_step
    if every is None:
        if adaptive:
            require("model", f"{DEFAULT_OUTPUTS} outputs of {mechanism.name}", size * DEFAULT_OUTPUTS)
            return np.linspace(begin, until, DEFAULT_OUTPUTS)
        assert step is not None, "a constant step is given"
        every = step
    found = multiples(every, until, size)
    return found if begin == 0.0 else np.concatenate([[begin], found[found > begin + 1e-9 * every]])


def output_size(mechanism: Mechanism, saved: bool = False) -> float:
    """Return about how much memory an output of a run takes [bytes].

    Parameters
    ----------
    mechanism : Mechanism
        What is run.
    saved : bool
        Whether all tables of it are made and put into a file, which is done in memory.
    """
    state = sum(len(b.coordinates) + len(b.speeds) for b in mechanism.bodies)
    rows = sum(len(joint.rows) for joint in mechanism.joints)
    if not saved:
        return 8.0 * (state + len(mechanism.joints) + 16)  # status, energies, and angles that are counted
    reported = sum(2 * len(j.coordinates) + (6 if mechanism.space == "spatial" else 3) for j in mechanism.joints)
    entries = 12 * rows  # of D at every output, for the reactions
    return 8.0 * (5 * (2 * state + rows + reported + 16) + entries)  # tables, their copy, and the file


def check_saving(mechanism: Mechanism, s: Settings) -> None:
    """Refuse a run whose tables would not fit into memory when they are saved.

    Raises
    ------
    InputError
        If they would not.
    """
    until = mechanism.defaults.until if s.until is None else s.until
    every = s.output_step or mechanism.defaults.output_step
    if s.times is not None:
        count = float(len(s.times))
    elif every is not None:
        count = until / every
    elif _has_constant_steps(s):
        count = until / (s.step or mechanism.defaults.step)
    else:
        count = DEFAULT_OUTPUTS
    require("--save", f"{count:.3g} outputs of {mechanism.name}", count * output_size(mechanism, saved=True))


def _has_constant_steps(s: Settings) -> bool:
    """Whether settings name, or a method has by itself, an integrator with constant steps."""
    name = s.integrator or (METHODS.get(s.method).default_integrator if s.method in METHODS else "")
    return name in INTEGRATORS and not INTEGRATORS.get(name).adaptive


def multiples(every: float, until: float, size: float) -> Array:
    """Return the multiples of an output step, and the end; `size` is what an output takes [bytes]."""
    require("output_step", f"{until / every:.3g} outputs", size * until / every)
    if until / every > 2e7:
        raise InputError("output_step", "at most 2e7 outputs", f"{until / every:.3g}")
    count = math.floor(until / every * (1.0 + 1e-12))
    times: Array = np.arange(count + 1, dtype=np.float64) * every
    if until - times[-1] > 1e-9 * every:
        times = np.append(times, until)
    times[-1] = min(times[-1], until)
    return times


def _number(key: str, value: str | float) -> float:
    """Return the number of an option, which a command gives as text."""
    try:
        number = float(value)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise InputError(f"option {key}", "a finite number", shown(value))
    return number
