"""From a question to an ensemble: names resolved, settings checked, what does not fit refused, before anything runs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from msgspec import structs
from numpy.typing import ArrayLike

from symgen.base.errors import InputError, suggest
from symgen.base.plugins import loaded_plugin_files
from symgen.base.settings import Settings
from symgen.base.vocabulary.expressions import names_in_expression
from symgen.describe.facts.kinks import discontinuities_of
from symgen.describe.facts.lengths import origin_of_sizes
from symgen.describe.facts.sides import sided_joints
from symgen.describe.facts.typed_units import units_of_number
from symgen.describe.formulas.evaluate import dependent_parameters, parameter_values, scalar_values
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.parts.event_sections import RECORD, STOP
from symgen.result.part_limits import limits_of_parts
from symgen.run.breaks.foreseen_seams import Foreseen, foresee_in_run, times_between
from symgen.run.breaks.refused_motions import refuse_jumps
from symgen.run.compiling.choices import LARGEST_STRAIGHT, mechanism_on_tree
from symgen.run.compiling.mass_formulas import has_coupled_masses
from symgen.run.compiling.pipeline import compile_model
from symgen.run.compiling.side import add_integrals, can_integrate
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.automatic import AUTO, CONSTANT, EXPLICIT
from symgen.run.planning.plan import Plan, Purpose, refuse_events
from symgen.run.planning.prepare import make_plan
from symgen.run.planning.tree_starts import tree_code
from symgen.study.ensemble.axes import Grid, make_grid
from symgen.study.ensemble.driving import Driving, read_by_motions
from symgen.study.ensemble.ensemble import Ensemble
from symgen.study.ensemble.judged_parts import JudgedParts
from symgen.study.ensemble.kernel import kernel_of_recipe
from symgen.study.ensemble.measured_quantities import first_integral, make_measures
from symgen.study.ensemble.recipe import Code, EventPlan, Module, Recipe, run_code_identity
from symgen.study.ensemble.row_quantities import choose_quantities
from symgen.study.ensemble.time_statistics import ends_of, read_statistics, split_statistic
from symgen.study.ensemble.varied_names import METHOD, Names, start_targets

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.derive.methods._base import Method
    from symgen.describe.mechanism import Event, Mechanism
    from symgen.result.signals import Signal
    from symgen.run.compiling.method_choice import MethodChoice
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.integrator import Integrator


def make_ensemble(
    model: Model,
    settings: Settings,
    vary: Mapping[str, ArrayLike | str],
    runs: Mapping[str, ArrayLike | str],
    quantities: Sequence[str] | None,
    target: str = "cpu",
) -> Ensemble:
    """Resolve and check everything.

    Parameters
    ----------
    model : Model
        The model.
    settings : Settings
        How; without output times, only the end is kept.
    vary, runs : mapping
        See `symgen.study.ensemble.parameter_sweep.sweep`.
    quantities : sequence of str or None
        Names of the selected quantities.
    target : {"cpu", "lanes", "cuda"}
        Target of the runs.

    Raises
    ------
    InputError
        If a name, number or combination is wrong.
    """
    _check_settings(settings, target)
    taken = (*settings.inputs, *settings.parameters, *settings.start)
    settings, ends, along = _settings_for(model.mechanism, settings, quantities, target)
    plan = make_plan(model.mechanism, settings, Purpose.ROWS)
    mechanism, spec = plan.mechanism, plan.spec
    names, grid = _names_and_grid(plan, vary, runs, taken)
    moving = read_by_motions(mechanism, grid.names)
    if not moving:  # before anything is derived; where it depends on what varies, rows fail one by one
        refuse_jumps(mechanism, plan.parameters, spec.until)
    kept_names, events = _quantities_and_events(mechanism, plan, quantities)
    acting = mechanism if target == "cpu" else structs.replace(mechanism, outputs=())  # others integrate no outputs
    passed_times = foresee_in_run(acting, events, spec.adaptive, plan.integrator.order, (0.0, spec.step))
    if target != "cpu" and not spec.adaptive:
        _check_jumps(target, passed_times, parameter_values(mechanism, plan.parameters), grid.names, spec.until)
    passed_places = discontinuities_of(acting)
    examined = any(x.holds for x in passed_places)  # rows that may jump, also by constant steps
    looks = (spec.adaptive and bool(passed_places)) or examined
    ends_steps = spec.adaptive or target == "cpu"
    driving = Driving(plan.inputs, grid.names, spec.until, passed_times if ends_steps else None, moving)
    joint = plan.coordinates == "joint"
    compiled = compile_model(mechanism, plan.choice)
    targets = start_targets(names, grid.names, plan.holds, compiled.info)
    if target != "cpu":
        inputs, passed = replace(driving, foreseen=None).jumps, looks or driving.jumps
        _check_target(target, inputs, examined, passed, bool(events))
    _check_loop(target, plan.integrator, spec.adaptive)
    parts, choose = [*map(split_statistic, kept_names or ())], partial(choose_quantities, mechanism, compiled.info)
    kept = choose(None if kept_names is None else [name for _, name in parts])
    over = read_statistics(parts, kept, choose) or (ends_of(kept) if along else None)
    judged = JudgedParts.of_mechanism(mechanism, compiled.info) if target == "cpu" else None
    sums = _has_integrals(mechanism, kept, target)
    watch = EventPlan(mechanism, events, ends) if joint or events or looks or mechanism.bounded else None
    # single runs add up all that outputs ask for, which their steps follow, too
    adds = sums or ((watch is not None or (driving.jumps and spec.adaptive)) and can_integrate(compiled))
    compiled, first, spare = _law_and_code(plan, compiled, adds, target, kept)
    recipe = Recipe(
        first=first,
        spare=spare,
        integrator=plan.integrator.name,
        spec=spec,
        method_parameters=dict(plan.method_parameters),
        quantities=kept if judged is None else (*kept, *judged.columns),
        held=targets.held,
        strict=plan.settings.strict,
        code=run_code_identity(),
        target=target,
        tree=mechanism_on_tree(mechanism) if joint else None,
        watch=watch,
        sides=tuple(side for side in sided_joints(mechanism) if side.held),
        seams=driving.jumps,
        plugins=loaded_plugin_files(),
        over=over,
        weighed=mechanism if has_coupled_masses(mechanism) else None,
        judged=judged,
        datum=tuple(origin_of_sizes(mechanism, scalar_values(parameter_values(mechanism, plan.parameters)))),
    )
    if target == "cuda":  # before anything runs: whether a thread of the device can hold a run
        _ = kernel_of_recipe(recipe).first_model
    model = replace(model, mechanism=mechanism)
    warnings = (
        *plan.warnings,
        *_warnings_of_missed(plan, passed_times, grid),
        *_warning_on_parts(mechanism, target, ends),
    )
    notes = *mechanism.remarks, *plan.notes, *plan.bound
    return Ensemble(model, plan, compiled, grid, targets, recipe, driving, warnings, notes)


def _settings_for(
    mechanism: Mechanism, settings: Settings, quantities: Sequence[str] | None, target: str
) -> tuple[Settings, bool, bool]:
    """Return the settings of runs on a target, whether only the end of each is an output, and whether it alone is kept.

    Where parts bend, runs that no event ends have all outputs, at which the limits of parts are judged.
    """
    size = mechanism.body_coordinates
    if size > LARGEST_STRAIGHT:
        raise InputError("sweep", f"a mechanism of at most {LARGEST_STRAIGHT} coordinates", f"{size} coordinates")
    settings = replace(settings, shape="straight")  # loops over rows are those of one mechanism
    ends = (
        settings.times is None
        and settings.output_step is None
        and not any(split_statistic(x)[0] for x in quantities or ())
    )
    stopping = any(event.action == STOP for event in mechanism.events) or bool(settings.stop_when)
    along = ends and target == "cpu" and not stopping and bool(limits_of_parts(mechanism))
    ends = ends and not along
    if ends:
        end = mechanism.defaults.until if settings.until is None else settings.until
        settings = replace(settings, times=(end,))
    if target != "cpu":
        named = settings.integrator or mechanism.defaults.integrator
        explicit = EXPLICIT if named == AUTO else named or CONSTANT  # others have no loop there
        settings = replace(settings, coordinates="absolute", integrator=explicit)
        refuse_events(f"target '{target}'", mechanism, settings)
    return settings, ends, along


def _names_and_grid(
    plan: Plan, vary: Mapping[str, ArrayLike | str], runs: Mapping[str, ArrayLike | str], taken: Sequence[str]
) -> tuple[Names, Grid]:
    """Return the names of what may vary, and the grid of what does, where `taken` numbers are set already."""
    mechanism = plan.mechanism
    options = tuple(METHOD + parameter.name for parameter in plan.choice.method.parameters)
    names = replace(Names.of_mechanism(mechanism), options=options)
    names.check((*vary, *runs), (*taken, *(METHOD + name for name in plan.method_parameters)))
    grid = make_grid(vary, runs, names.starts, lambda name: units_of_number(mechanism, name))
    _check_method(plan.choice.method, grid)
    return names, grid


def _has_integrals(mechanism: Mechanism, kept: Sequence[Signal], target: str) -> bool:
    """Return whether a quantity is integrated over time; refuse that on targets that add nothing up."""
    integral = first_integral(mechanism, kept)
    if integral is not None and target != "cpu":
        expected = "quantities without integral(...), which are added up by cpu alone"
        raise InputError(f"target '{target}'", expected, f"'{integral}'", "leave `target` out, or name others")
    return integral is not None


def _check_loop(target: str, integrator: Integrator, adaptive: bool) -> None:
    """Refuse an integrator without a loop over many runs on a target."""
    name = integrator.name
    if target not in integrator.row_targets:
        others = ", ".join(other for other, kind in INTEGRATORS.items() if target in kind.row_targets)
        expected = "one with a loop over many runs" + f" on target '{target}'" * (target != "cpu")
        raise InputError(f"integrator '{name}'", expected, "one without", f"{others} have one")
    if target == "lanes" and adaptive:  # runs side by side take the same steps
        got, hint = f"'{name}' with adaptive steps", "integrator.adaptive=false with `step`, or rk4"
        raise InputError("target 'lanes'", "a constant step", got, hint)


def _law_and_code(
    plan: Plan, compiled: CompiledModel, adds: bool, target: str, kept: Sequence[Signal]
) -> tuple[CompiledModel, Code, Code | None]:
    """Return the law, with sums where `adds` is set, and the code of runs: of most, and of those with light bodies."""
    mechanism, joint = plan.mechanism, plan.coordinates == "joint"

    def add_sums(law: CompiledModel) -> CompiledModel:
        return add_integrals(mechanism, law) if adds else law

    compiled, spare = add_sums(compiled), None
    pressed = any(row.pressed for row in mechanism.bounded)  # for which there is one solver
    if plan.solver_is_free and not pressed:  # the few runs with light bodies are not worth lanes of their own
        choice = plan.choice.with_options(solver="augmented")
        other, where = add_sums(compile_model(mechanism, choice)), "cpu" if target == "lanes" else target
        spare = _code_for_solver(mechanism, choice, other, where, joint, kept)
    return compiled, _code_for_solver(mechanism, plan.choice, compiled, target, joint, kept), spare


def _code_for_solver(
    mechanism: Mechanism,
    choice: MethodChoice,
    compiled: CompiledModel,
    target: str,
    joint: bool,
    kept: Sequence[Signal],
) -> Code:
    """Return the code that runs use for one solver, with the evaluation of quantities after the loops."""
    return Code(
        Module.of_compiled(compiled),
        Module.of_compiled(compile_model(mechanism, choice, target=target)) if target != "cpu" else None,
        Module.of_compiled(tree_code(mechanism, choice, compiled)[1]) if joint else None,
        make_measures(mechanism, compiled, kept),
    )


def _warnings_of_missed(plan: Plan, passed_times: Foreseen, grid: Grid) -> tuple[str, ...]:
    """Return warnings of changes that steps of all runs may miss; none where these depend on what varies."""
    if passed_times.reads & {*grid.names, *(name for name, _ in dependent_parameters(plan.mechanism.parameters))}:
        return ()
    return plan.missed if passed_times else ()


def _warning_on_parts(mechanism: Mechanism, target: str, ends: bool) -> tuple[str, ...]:
    """Return a warning where the limits of parts that bend are not judged along whole runs."""
    if not limits_of_parts(mechanism) or (target == "cpu" and not ends):
        return ()
    if target == "cpu":
        return ("how far parts bend is judged at the ends of runs alone, as an event may end them before",)
    return ("how far parts bend is not judged on this target; rows on 'cpu' and single runs judge it",)


def _check_settings(settings: Settings, target: str) -> None:
    """Refuse settings that mean something for single runs alone."""
    if not isinstance(settings.start, Mapping):
        raise InputError("start", "values by the names of coordinates and velocities", "the last state of another run")
    if settings.verify:
        raise InputError("verify", "single runs", "an ensemble", "run doubtful ones again by themselves")
    if settings.repeat != 1:
        raise InputError("repeat", "single runs", "an ensemble")
    if settings.shape == "looped":
        raise InputError("shape", "straight code for an ensemble", "looped")
    if settings.coordinates == "joint" and target != "cpu":
        raise InputError(f"target '{target}'", "absolute coordinates", "joint", "leave `target` out")


def _check_method(method: Method, grid: Grid) -> None:
    """Refuse values of the method's parameters that single runs refuse."""
    values = {name: x for axis in grid.axes for name, x in axis.values.items()}
    for parameter in method.parameters:
        least = values[name].min() if (name := METHOD + parameter.name) in values else parameter.minimum
        if least < parameter.minimum:
            raise InputError(f"vary '{name}'", f"at least {parameter.minimum:g}", f"{least:g}")


def _check_target(target: str, jumps: bool, examined: bool, passed: bool, events: bool) -> None:
    """Refuse what needs something to be done between two parts of a run, where nothing but loops can run."""
    constant = "leave `target` out, or take constant steps: integrator.adaptive=false with `step`"
    for what, there, hint in (
        ("inputs that jump", jumps, "leave `target` out"),
        ("rows with jumps or kinks", examined, "leave `target` out"),
        ("jumps and kinks of formulas, at which adaptive steps end", passed, constant),
        ("events", events, "leave `target` out"),
    ):
        if there:
            raise InputError(f"target '{target}'", f"no {what}", "some", hint)


def _check_jumps(
    target: str, times: Foreseen, values: Mapping[str, float], varied: Iterable[str], until: float
) -> None:
    """Refuse formulas that jump at known times of a run, where no loop ends constant steps there."""
    for jump in times.sides:
        inside, whole = times_between((jump,), times.mechanism, values, until, True)
        if inside or not whole or {*names_in_expression(jump.argument)} & {*varied}:
            text = to_text(jump.argument)
            expected = "no formulas that jump at times known beforehand"
            raise InputError(f"target '{target}'", expected, f"one where {text} passes 0", "leave `target` out")


def _quantities_and_events(
    mechanism: Mechanism, plan: Plan, quantities: Sequence[str] | None
) -> tuple[Sequence[str] | None, tuple[Event, ...]]:
    """Return the quantities that are no events, and the events that runs look for: none where nothing comes of them.

    Raises
    ------
    InputError
        If a requested event does not exist.
    """
    words = [] if "event" in {body.name for body in mechanism.bodies} else quantities or ()
    chosen = [name for name in words if name.partition(".")[0] == "event"]
    names = [event.name for event in plan.events]
    for name in chosen:
        if name.partition(".")[2] not in ("", *names):
            options = [f"event.{x}" for x in names]
            raise InputError(f"quantity '{name}'", f"an event of {mechanism.name}", "none", suggest(name, options))
    further = len(plan.events) > len(mechanism.events)
    if chosen or further or any(event.action != RECORD for event in plan.events):
        return [name for name in quantities if name not in chosen] if chosen and quantities else quantities, plan.events
    return quantities, ()
