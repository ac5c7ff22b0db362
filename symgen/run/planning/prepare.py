"""The pipeline of a run: settings to a plan, a plan to code and a consistent start.

    Settings --make_plan--> Plan --begin--> Prepared --integrate--> Outcome --build_result--> Result

`prepare` lists the steps. Whoever needs a run, its start or its code calls it: single runs, steps from Python, rows of
sweeps, comparisons, cells of stress studies, references, analyses, pages and commands.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import AssemblyError
from symgen.base.memory import without_garbage_collection
from symgen.derive.methods import METHODS
from symgen.derive.methods.baumgarte import MOTION
from symgen.run.planning.automatic import (
    AUTO,
    SLOW,
    STRUCTURAL,
    TOGETHER,
    automatic_choice,
    facts_of_plan,
    rate_of_motion,
    slow_steps,
    trial_settings,
)
from symgen.run.planning.continuation import continue_run
from symgen.run.planning.inputs import put_inputs
from symgen.run.planning.plan import Plan, Purpose, resolve_settings
from symgen.run.planning.starts import Code, begin_start, compiled_for, open_start
from symgen.run.planning.tree import TreeRun
from symgen.run.planning.tree_starts import run_on_tree, tree_taken_up
from symgen.run.single.run import integrate
from symgen.run.single.simulation import Simulation

if TYPE_CHECKING:
    from collections.abc import Callable

    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.single.outcome import Outcome
    from symgen.run.single.run import Array
    from symgen.run.starts.assembly import Start

#: Time over which the rate of a motion is taken [s].
FIRST = 1.0


@dataclass(frozen=True)
class Assembled:
    """Code and consistent start of a run.

    Attributes
    ----------
    compiled, start : CompiledModel, Start
        In the coordinates of the state.
    tree : TreeRun or None
        The map from joints to bodies where the state has joint coordinates.
    closed : bool
        Whether the start satisfies the constraints; False only for `Purpose.DESCRIBED`.
    """

    compiled: CompiledModel
    start: Start
    tree: TreeRun | None = None
    closed: bool = True

    @property
    def of_bodies(self) -> tuple[CompiledModel, Start]:
        """Code and start in the coordinates of bodies."""
        return (self.compiled, self.start) if self.tree is None else (self.tree.bodies, self.tree.body_start)


@dataclass(frozen=True)
class Prepared:
    """A run that can begin.

    Attributes
    ----------
    plan : Plan
        Settings, resolved.
    assembled : Assembled
        Code and consistent start.
    spec : RunSpec
        Steps, tolerances, limits and outputs, with the functions of events and switches.
    """

    plan: Plan
    assembled: Assembled
    spec: RunSpec

    @property
    def compiled(self) -> CompiledModel:
        """Code in the coordinates of the state."""
        return self.assembled.compiled

    @property
    def start(self) -> Start:
        """Consistent start in the coordinates of the state."""
        return self.assembled.start

    @property
    def tree(self) -> TreeRun | None:
        """The map from joints to bodies; None in coordinates of bodies."""
        return self.assembled.tree

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism, with its tree in joint coordinates."""
        return self.plan.mechanism if self.tree is None else self.tree.mechanism

    def with_spec(self, **changes: Any) -> Prepared:
        """Return the same run with other steps, tolerances, limits or outputs."""
        return replace(self, spec=replace(self.spec, **changes))

    def simulation(self) -> Simulation:
        """Return the run as arrays that a loop works on."""
        return Simulation(self.compiled, self.plan.integrator, self.start, self.spec)

    def integrate(self, progress: Callable[[float], None] | None = None, start: Start | None = None) -> Outcome:
        """Integrate, and return what the loop leaves, in the coordinates of the state.

        Parameters
        ----------
        progress : callable, optional
            Called about ten times a second with the time reached.
        start : Start, optional
            Another start.
        """
        return integrate(self.compiled, self.plan.integrator, start or self.start, self.spec, progress)

    def of_bodies(self, outcome: Outcome) -> Outcome:
        """Return an outcome of `integrate` in the coordinates of bodies."""
        return outcome if self.tree is None else self.tree.carry_outcome(outcome)

    def positions(self, outcome: Outcome) -> Array:
        """Return the coordinates of bodies at the outputs of `integrate`, shape (k, nq)."""
        return outcome.states[:, : self.compiled.info.nq] if self.tree is None else self.tree.positions(outcome)


@dataclass(frozen=True)
class Preparation:
    """A run whose settings are resolved.

    Attributes
    ----------
    plan : Plan
        Settings, resolved.
    near : array or None
        Coordinates that the mechanism is closed from; None for the described ones.
    assembled : Assembled or None
        Code and start where an automatic choice has made them.
    """

    plan: Plan
    near: Array | None = None
    assembled: Assembled | None = None

    def run(self, shared: dict[Any, Assembled] | None = None, code: Code = compiled_for) -> Prepared:
        """Compile the code and close the start.

        Parameters
        ----------
        shared : dict, optional
            Code and starts of runs with the same mechanism and parameters, by `Plan.key`; this run's are added.
        code : callable
            Returns the code of a mechanism for a method; one that keeps it serves many values of parameters.

        Raises
        ------
        InputError, AssemblyError
            If the start is refused, or the mechanism cannot be closed.
        """
        assembled = self.assembled if shared is None else shared.get(self.plan.key, self.assembled)
        assembled = assembled or code_and_start(self.plan, self.near, code)
        if shared is not None:
            shared[self.plan.key] = assembled
        return prepared_run(self.plan, assembled)


@without_garbage_collection()
def prepare(
    mechanism: Mechanism, settings: Settings, purpose: Purpose = Purpose.MOTION, near: Array | None = None
) -> Prepared:
    """Make a run ready: resolve its settings, compile its code, close its start.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        The settings of the run.
    purpose : Purpose
        Purpose of the run.
    near : array, optional
        Coordinates that the mechanism is closed from; the described ones by default.

    Raises
    ------
    InputError
        If a setting is wrong or the start is refused.
    AssemblyError
        If the mechanism cannot be closed.
    """
    return find_preparation(mechanism, settings, purpose, near).run()


def make_plan(mechanism: Mechanism, settings: Settings, purpose: Purpose = Purpose.MOTION) -> Plan:
    """Resolve and check the settings of a run; parameters as for `prepare`.

    Raises
    ------
    InputError
        If a setting is wrong.
    AssemblyError
        If an automatic choice needs the start, and the mechanism cannot be closed.
    """
    return find_preparation(mechanism, settings, purpose).plan


def find_preparation(
    mechanism: Mechanism, settings: Settings, purpose: Purpose = Purpose.MOTION, near: Array | None = None
) -> Preparation:
    """Resolve the settings of a run; parameters and errors as for `prepare`.

    An automatic choice compiles code and closes the start; they serve the run too if the choice leaves them valid.
    """
    settings, gains = _gains_of_method(mechanism, settings)
    inputs = put_inputs(mechanism, settings)
    mechanism, settings = inputs.mechanism, inputs.settings
    if settings.integrator is None and mechanism.defaults.integrator is not None:
        settings = replace(settings, integrator=mechanism.defaults.integrator)
    if AUTO not in (settings.method, settings.integrator):
        return Preparation(resolve_settings(inputs, settings, purpose, gains), near)
    trial = trial_settings(mechanism, settings)
    plan = resolve_settings(inputs, trial, purpose)
    assembled = code_and_start(plan, near)
    facts = facts_of_plan(mechanism, *assembled.of_bodies, plan.spec.until)
    method, integrator, notes = automatic_choice(facts, settings.method, settings.integrator)
    notes = *gains, *notes
    if method == STRUCTURAL and settings.method == AUTO:
        options = {**settings.options, "integrator.adaptive": "true"}
        settings = replace(settings, method=method, integrator=integrator, options=options)
        return Preparation(resolve_settings(inputs, settings, purpose, notes), near)
    chosen = resolve_settings(inputs, replace(trial, integrator=integrator), purpose, notes)
    same = assembled if chosen.choice == plan.choice else None
    if purpose is Purpose.MOTION and settings.integrator == AUTO and integrator == TOGETHER and same is not None:
        facts = replace(facts, slow=slow_steps(prepared_run(chosen, same)))
        if facts.slow > SLOW:
            _, integrator, notes = automatic_choice(facts, settings.method, settings.integrator)
            notes = *gains, *notes
            chosen = resolve_settings(inputs, replace(trial, integrator=integrator), purpose, notes)
            same = assembled if chosen.choice == plan.choice else None
    return Preparation(chosen, near, same)


def first_rate(mechanism: Mechanism, settings: Settings) -> tuple[float | None, float, float]:
    """Return rms(v') / rms(v) of a run's first second [1/s], None where nothing moves; its beginning and end [s]."""
    begin_at = 0.0 if isinstance(settings.start, Mapping) else settings.start.last_state.t
    until = min(begin_at + FIRST, mechanism.defaults.until if settings.until is None else settings.until)
    plain: dict[str, Any] = {"step": None, "rtol": 1e-6, "atol": None, "options": {}, "coordinates": "absolute"}
    short: dict[str, Any] = {"until": until, "times": np.linspace(begin_at, until, 201).tolist(), "output_step": None}
    first = replace(settings, method="direct-correction", integrator="dop853", **plain, **short)
    return rate_of_motion(prepare(mechanism, first)), begin_at, until


def _gains_of_method(mechanism: Mechanism, settings: Settings) -> tuple[Settings, tuple[str, ...]]:
    """Return the settings with the gains of ``rule=motion``, and a note; others as they are.

    A short run by another method gives the motion, so that the gains of this method have no part in it.
    """
    method = None if settings.method == AUTO else METHODS.get(settings.method, "method")
    rules = [] if method is None else [o for o in method.options if o.name == "rule" and MOTION in o.values]
    keys = [] if method is None else [f"{owner}.rule" for owner in dict.fromkeys(("method", method.name))]
    if method is None or not rules or MOTION not in (settings.options.get(key) for key in keys):
        return settings, ()
    rate, begin_at, until = first_rate(mechanism, settings)
    options = {key: value for key, value in settings.options.items() if key not in keys}
    if rate is None:
        return replace(settings, options=options), (f"rule={MOTION}: nothing moves, so that the gains stay",)
    own = {key.partition(".")[2] for key in options}
    gains = {f"method.{p.name}": rate for p in method.parameters if p.name not in own}
    names = " = ".join(key.removeprefix("method.") for key in gains)
    note = f"rule={MOTION}: {names} = {rate:.4g} 1/s, rms(v')/rms(v) of the motion from {begin_at:g} to {until:g} s"
    return replace(settings, options=options | gains), (note,)


def code_and_start(plan: Plan, near: Array | None = None, code: Code = compiled_for) -> Assembled:
    """Compile the code of a plan and close its start.

    Parameters
    ----------
    plan : Plan
        The run.
    near : array, optional
        Coordinates that the mechanism is closed from; the described ones by default.
    code : callable
        Returns the code of a mechanism for a method.

    Raises
    ------
    InputError, AssemblyError
        If the start is refused, or the mechanism cannot be closed.
    """
    joint = plan.coordinates == "joint"
    tree = tree_taken_up(plan, plan.last) if joint and plan.last is not None else None
    if tree is None:
        if plan.last is not None:
            bodies = continue_run(plan, plan.last)
        else:
            try:
                bodies = begin_start(plan, near, code)
            except AssemblyError:
                if joint or plan.purpose is not Purpose.DESCRIBED:
                    raise
                return Assembled(*open_start(plan), closed=False)
        if not joint:
            return Assembled(*bodies)
        tree = run_on_tree(plan, *bodies)
    return Assembled(tree.compiled, tree.start, tree)


def prepared_run(plan: Plan, assembled: Assembled) -> Prepared:
    """Return a run from its plan, its code and its start, which runs with an equal `Plan.key` may share."""
    run = Prepared(plan, add_notes(plan, assembled), plan.spec)
    if plan.purpose in (Purpose.STATE, Purpose.DESCRIBED):
        return run
    from symgen.run.compiling.events import compile_events

    rtol = plan.spec.rtol if plan.spec.adaptive else None
    return run.with_spec(
        seams=plan.seams, events=compile_events(run.mechanism, run.compiled, plan.events, rtol, plan.choice.directed)
    )


def add_notes(plan: Plan, assembled: Assembled) -> Assembled:
    """Return code and start with remarks on the model and notes of a plan before the notes of the start."""
    start = assembled.start
    return replace(
        assembled, start=replace(start, notes=(*plan.mechanism.remarks, *plan.notes, *plan.bound, *start.notes))
    )
