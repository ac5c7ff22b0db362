"""Settings resolved: names looked up, numbers checked, unsuitable pairs refused, before anything is derived."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.errors import InputError, quote, suggest
from symgen.base.settings import Settings
from symgen.derive.lower.windings import follows_places
from symgen.derive.methods import METHODS
from symgen.describe.bounds.bounded_modes import refuse_bounds
from symgen.describe.facts.digest import digest
from symgen.describe.facts.keys_for_jumps import advice_on_jumps
from symgen.describe.facts.short_changes import longest_step
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.parts.event_sections import RECORD, STOP, read_events, watched_event
from symgen.describe.parts.holds import read_holds
from symgen.run.breaks.foreseen_seams import foresee_in_run, merge_seams
from symgen.run.breaks.refused_motions import refuse_jumps
from symgen.run.compiling.method_choice import MethodChoice
from symgen.run.integrators import INTEGRATORS
from symgen.run.loops.integrator import chooses_steps
from symgen.run.loops.run_spec import MAX_ATTEMPTS, RunSpec, Seam
from symgen.run.planning.automatic import usual_integrator
from symgen.run.planning.options import split_options
from symgen.run.planning.outputs import output_times
from symgen.run.planning.run_code import code_of_run

if TYPE_CHECKING:
    from symgen.derive.methods._base import Method
    from symgen.describe.mechanism import Event, Hold, Mechanism
    from symgen.run.loops.integrator import Integrator
    from symgen.run.planning.inputs import Inputs
    from symgen.run.single.last_state import LastState

#: Evaluations of an adaptive run in a second of motion, where nothing is known of the motion.
ADAPTIVE_EVALUATIONS = 2000.0
#: Default tolerances of adaptive runs.
RTOL, ATOL = 1e-8, 1e-10
#: Largest change of an angle in a step where the angle of a place counts turns [rad]: less than half a turn, in which
#: such an angle may change by nearly twice as much.
LARGEST_TURN = 1.0


class Purpose(Enum):
    """Purpose of a prepared run.

    Attributes
    ----------
    MOTION
        To be integrated: something has a mass, and no driver jumps.
    ROWS
        To be integrated for many parameters: drivers are checked row by row.
    STATE
        To be looked at where it starts.
    DESCRIBED
        To be looked at where it starts, or as it is described if nothing closes it.
    """

    MOTION = auto()
    ROWS = auto()
    STATE = auto()
    DESCRIBED = auto()


@dataclass(frozen=True)
class Plan:
    """A run before its code exists.

    Attributes
    ----------
    mechanism : Mechanism
        With the inputs of the run in their places.
    settings : Settings
        Without inputs and without ``auto``.
    inputs : Inputs
        The inputs of the run.
    purpose : Purpose
        Purpose of the run.
    choice : MethodChoice
        The method with its structural options and the shape of its code.
    integrator : Integrator
        The scheme.
    method_parameters : mapping of str to float
        Parameters of the method that differ from its defaults.
    spec : RunSpec
        Steps, tolerances, limits and outputs.
    seams : tuple of Seam
        Parts of the run between times at which steps end.
    warnings : tuple of str
        Warnings that hold for all values of parameters.
    missed : tuple of str
        Warnings of what steps may miss, which depends on parameters.
    notes : tuple of str
        Reasons of automatic choices.
    bound : tuple of str
        Why adaptive steps have a bound that nobody set.
    solver_is_free : bool
        Whether the start may choose the solver of the law.
    holds : tuple of Hold
        Values that the start keeps.
    last : LastState or None
        The last state of another run, from which this one goes on.
    events : tuple of Event
        Events that the run looks for.
    coordinates : {"absolute", "joint"}
        Coordinates of the state.
    shape_reason, coordinates_reason : str
        Why the code has this shape, and the state these coordinates.
    """

    mechanism: Mechanism
    settings: Settings
    inputs: Inputs
    purpose: Purpose
    choice: MethodChoice
    integrator: Integrator
    method_parameters: Mapping[str, float]
    spec: RunSpec
    seams: tuple[Seam, ...]
    warnings: tuple[str, ...]
    missed: tuple[str, ...]
    notes: tuple[str, ...]
    bound: tuple[str, ...]
    solver_is_free: bool
    holds: tuple[Hold, ...]
    last: LastState | None
    events: tuple[Event, ...]
    coordinates: str
    shape_reason: str
    coordinates_reason: str

    @property
    def all_warnings(self) -> tuple[str, ...]:
        """Warnings of a single run."""
        return (*self.warnings, *self.missed)

    @property
    def parameters(self) -> Mapping[str, float]:
        """Values of parameters that differ from the described ones."""
        return self.settings.parameters

    @property
    def verify(self) -> bool | None:
        """Whether a second run estimates the error, None where nobody set it."""
        own = self.settings.verify
        return self.mechanism.defaults.verify if own is None else own

    @property
    def key(self) -> tuple[str, tuple[tuple[str, float], ...]]:
        """Dependencies of code and start beside mechanism and parameters."""
        return f"{self.choice.stem} {self.choice.shape} {self.coordinates}", tuple(
            sorted(self.method_parameters.items())
        )


def resolve_settings(inputs: Inputs, s: Settings, purpose: Purpose, notes: tuple[str, ...] = ()) -> Plan:
    """Resolve and check the settings of a run.

    Parameters
    ----------
    inputs : Inputs
        The mechanism with its inputs.
    s : Settings
        Settings of the run, without inputs and without ``auto``.
    purpose : Purpose
        Purpose of the run.
    notes : tuple of str
        Reasons of automatic choices.

    Raises
    ------
    InputError
        If a name, option or number is wrong.
    """
    mechanism = inputs.mechanism
    if purpose in (Purpose.MOTION, Purpose.ROWS):
        refuse_weightless(mechanism)
    method = METHODS.get(s.method, "method")
    last = None if isinstance(s.start, Mapping) else s.start.last_state
    if last is not None:
        _refuse_other(mechanism, last)
    begin, shape, own_run = 0.0 if last is None else last.t, _shape(s, last), mechanism.defaults
    until = own_run.until if s.until is None else s.until
    integrator = _integrator(mechanism, s, method, shape, until - begin)
    choice, method_parameters, integrator_options = split_options(s, integrator)
    zero: complex | None = getattr(integrator, "zero", None)
    method_parameters = method.placed(choice.options, zero, integrator.name) | method_parameters
    adaptive = chooses_steps(integrator, s.options)
    step = s.step
    if step is None:  # the first one may be longer than the run, whose end cuts it
        step = own_run.first_step if adaptive else own_run.step
    _check_steps(s, step, begin, until, adaptive)
    own, warnings = _stable_step(method, method_parameters, integrator, None if adaptive else step)
    events = events_of_run(mechanism, s)
    longest, why = longest_step(mechanism, until - begin, events, inputs.driven.jumps if inputs.driven else ())
    times = foresee_in_run(mechanism, events, adaptive, integrator.order, (begin, step))
    values = parameter_values(mechanism, s.parameters) if times else {}
    rtol = getattr(integrator, "rtol", RTOL)  # schemes of low order have larger ones by default
    spec = RunSpec(
        until=until,
        step=step,
        adaptive=adaptive,
        times=output_times(s, mechanism, (begin, until), step, adaptive),
        rtol=rtol if s.rtol is None else s.rtol,
        atol=ATOL / RTOL * rtol if s.atol is None else s.atol,
        relative=s.atol is None,
        largest_step=min(own or np.inf, longest),
        largest_turn=LARGEST_TURN if follows_places(mechanism) else np.inf,
        max_violation=s.max_violation,
        max_velocity_violation=limit_of_velocities(method, s.max_violation),
        max_energy_error=np.inf if method.correction(choice.options).energy else s.max_energy_error,
        max_attempts=MAX_ATTEMPTS if s.max_attempts is None else s.max_attempts,
        in_place=advice_on_jumps(mechanism),
        # not the end of this run: a run that is continued needs the same duration
        duration=None if adaptive else mechanism.defaults.until,
        integrator_parameters={
            q.name: float(integrator_options[q.name]) for q in integrator.parameters if q.name in integrator_options
        },
    )
    evaluations = expected_evaluations(integrator, until - begin, step, adaptive)
    code = code_of_run(mechanism, s, choice, shape, evaluations)
    if purpose is Purpose.MOTION:
        refuse_jumps(mechanism, s.parameters, until)
    return Plan(
        mechanism=mechanism,
        settings=s,
        inputs=inputs,
        purpose=purpose,
        choice=code.choice,
        integrator=integrator,
        method_parameters=method_parameters,
        spec=spec,
        seams=merge_seams(inputs.seams, times.seams(values, until)),
        warnings=warnings,
        missed=tuple(times.sentence_on_missed_changes(values, until)),
        notes=(*notes, *code.notes),
        bound=(why,) if why and adaptive and purpose in (Purpose.MOTION, Purpose.ROWS) else (),
        solver_is_free=code.solver_is_free,
        holds=() if last is not None else read_holds(mechanism, "start", s.start),
        last=last,
        events=events,
        coordinates=code.coordinates.name,
        shape_reason=code.shape.reason,
        coordinates_reason=code.coordinates.reason,
    )


def _integrator(mechanism: Mechanism, s: Settings, method: Method, shape: str, duration: float) -> Integrator:
    """Return the integrator of a run: the requested one, or the usual one for it."""
    name = s.integrator
    if name is None:
        evaluations = ADAPTIVE_EVALUATIONS * duration
        name = usual_integrator(mechanism, s.method, s.coordinates, shape, evaluations)
    integrator = INTEGRATORS.get(name, "integrator")
    _refuse_pair(method, integrator)
    return integrator


def _stable_step(
    method: Method, parameters: Mapping[str, float], integrator: Integrator, step: float | None
) -> tuple[float | None, tuple[str, ...]]:
    """Return the step up to which a method is stable [s], None for any, and warnings of a constant step above it."""
    values = {p.name: parameters.get(p.name, p.default) for p in method.parameters}
    own = method.largest_step(values, integrator.real_boundary)
    if own is None or step is None or step <= own:
        return own, ()
    what = f"the step {step:g} s exceeds {own:.3g} s, where {method.name} is unstable with {integrator.name}"
    return own, (what,)


def _refuse_pair(method: Method, integrator: Integrator) -> None:
    """Refuse an integrator that does not solve the form of a method."""
    if set(method.forms) & set(integrator.forms):
        return
    fits = [n for n, i in INTEGRATORS.items() if set(i.forms) & set(method.forms)]
    raise InputError(
        f"integrator '{integrator.name}'",
        f"one that solves the form of {method.name} ({', '.join(method.forms)})",
        f"one for {', '.join(integrator.forms)}",
        "these do: " + ", ".join(fits),
    )


def _check_steps(s: Settings, step: float | None, begin: float, until: float, adaptive: bool) -> None:
    """Refuse an end before the start, and constant steps that are too long or too many."""
    if not until > begin:
        raise InputError("until", f"an end after t = {begin:g} s, where the run goes on", f"{until:g}")
    if s.step is not None and s.step > until:  # the mechanism's own is meant for longer runs
        raise InputError("step", f"at most until = {until:g}", f"{s.step:g}")
    if not adaptive and step is not None and (until - begin) / step > (s.max_attempts or 2e9):
        expected = "at most 2e9 steps" if s.max_attempts is None else f"at most max_attempts = {s.max_attempts:g} steps"
        raise InputError("step", expected, f"{(until - begin) / step:.3g}")


def limit_of_velocities(method: Method, max_violation: float) -> float | None:
    """Return the largest violation of velocities that a run by a method may have, None where it is `max_violation`."""
    # where velocities follow it is an error of the discretisation, not drift: half the digits are asked of it
    return math.sqrt(max_violation) if method.velocities_follow else None


def _refuse_other(mechanism: Mechanism, last: LastState) -> None:
    """Refuse to go on from a run of another mechanism."""
    names = [f"{b.name}.{n}" for b in mechanism.bodies for n in b.coordinates]
    speeds = [f"{b.name}.{n}" for b in mechanism.bodies for n in b.speeds]
    other = last.digest not in ("", digest(mechanism)) or {*names} != {*last.q} or {*speeds} != {*last.v}
    if other or last.mechanism not in ("", mechanism.name):
        got, hint = f"one of {last.mechanism}" if last.mechanism not in ("", mechanism.name) else "one of others", ""
        given = {*last.q, *last.v}
        if not last.mechanism and (missing := [name for name in (*names, *speeds) if name not in given]):
            unknown = given - {*names, *speeds}
            got, hint = f"no column {quote(missing[0])}", suggest(missing[0], unknown) if unknown else ""
        raise InputError("start", f"the result of a run of {mechanism.name} with the same equations", got, hint)
    if not all(math.isfinite(x) for x in (last.t, *last.q.values(), *last.v.values())):
        raise InputError("start", "a last state that is finite", "one that is not")


def _shape(s: Settings, last: LastState | None) -> str:
    """Return the shape of the settings; a run that goes on from another keeps that one's unless a shape is given."""
    before = {} if last is None or last.made is None else last.made
    return str(before.get("shape", s.shape)) if s.shape == "auto" else s.shape


def events_of_run(mechanism: Mechanism, s: Settings) -> tuple[Event, ...]:
    """Return the events of a run: the mechanism's, then the settings', each once."""
    conditions = (
        *(watched_event(mechanism, "stop_when", text, STOP) for text in s.stop_when),
        *(watched_event(mechanism, "record_when", text, RECORD) for text in s.record_when),
    )
    once = {event.name: event for event in reversed(conditions)}  # one that ends runs is recorded as well
    return (*mechanism.events, *read_events(mechanism, s.events), *reversed(once.values()))


def refuse_ends(where: str, mechanism: Mechanism, s: Settings) -> None:
    """Refuse events that end runs where all have to come to one end.

    Raises
    ------
    InputError
        If there are any.
    """
    for event in events_of_run(mechanism, s):
        if event.action == STOP:
            hint = f"without {event.name} in [events], or with its action 'record', it is taken"
            raise InputError(where, "a mechanism whose runs no event ends", f"the event '{event.name}'", hint)


def refuse_events(where: str, mechanism: Mechanism, s: Settings) -> None:
    """Refuse events, and bounded rows, where runs do not look for them; events that are only recorded change nothing.

    Raises
    ------
    InputError
        If there are others.
    """
    refuse_bounds(where, mechanism)
    own = len(mechanism.events)
    for i, event in enumerate(events_of_run(mechanism, s)):
        if event.action != RECORD or i >= own:
            expected = "a mechanism whose motion has no events" if i < own else "no events"
            does = {RECORD: "is recorded", STOP: "ends runs"}.get(event.action, "changes the state")
            hint = "single runs look for events"
            if i < own:
                hint += f"; without {event.name} in [events], or with its action 'record', it is taken"
            raise InputError(where, expected, f"the event '{event.name}', which {does}", hint)


def refuse_weightless(mechanism: Mechanism) -> None:
    """Refuse to simulate a mechanism in which nothing has a mass: joints and drivers alone determine its motion."""
    if mechanism.bodies and all(body.weightless for body in mechanism.bodies):
        first, hint = quote(mechanism.bodies[0].name), "symgen kinematics and symgen inverse do without"
        raise InputError(f"body {first}", "a mass, of one body at least", "a mechanism in which nothing has one", hint)


def expected_evaluations(integrator: Integrator, until: float, step: float | None, adaptive: bool) -> float:
    """Return about how many evaluations a run takes, to choose the shape of its code by."""
    if adaptive or step is None:
        return ADAPTIVE_EVALUATIONS * until
    return float(integrator.stages + 1) * until / step  # an accepted state costs about one more
