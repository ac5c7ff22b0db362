"""From a question to an ensemble: names resolved, settings checked, what does not fit refused, before anything runs."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from symgen.compiling.choose_shape import LARGEST_STRAIGHT
from symgen.compiling.integrals import with_integrals
from symgen.compiling.pipeline import compile_model
from symgen.describe.derived import derived
from symgen.describe.digest import identity
from symgen.describe.holds import ORIENTATION
from symgen.ensemble.axes import Grid, make_grid
from symgen.ensemble.kernel import integrator_of_rows, kernel_of
from symgen.ensemble.lanes import check_lanes
from symgen.ensemble.measures import integrated, make_measures, measurable
from symgen.ensemble.quantities import choose_quantities
from symgen.ensemble.recipe import Module, Recipe, code_identity
from symgen.ensemble.starts import Rows, make_rows
from symgen.errors import InputError, nearest
from symgen.ir.program import LANES
from symgen.plan import Plan, make_plan, refuse_events
from symgen.runtime.model_arrays import velocity_of
from symgen.settings import Settings

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Hold
    from symgen.runtime.compiled import CompiledModel, ModelInfo
    from symgen.vocabulary.expressions import Expr

#: A chunk should take about so many seconds, and its arrays no more than so many bytes.
CHUNK_SECONDS, CHUNK_BYTES = 0.2, 32e6
#: The same bound where a CUDA device runs them.
CHUNK_BYTES_CUDA = 128e6
#: Seconds an operation of a right-hand side takes, and evaluations in a simulated second of an adaptive run: guesses
#: that shape nothing but the size of chunks.
_OPERATION, _EVALUATIONS = 4e-10, 1e4


@dataclass(frozen=True, repr=False)
class Ensemble:
    """Many runs of one model, fully resolved.

    Attributes
    ----------
    model : Model
        What is run.
    settings, plan : Settings, Plan
        As asked for, and resolved.
    compiled : CompiledModel
        Its law; compiled when it is first run.
    grid : Grid
        What varies.
    held, given : mapping of str to int
        Coordinates and velocities that vary or have values of their own at the start, with their index in q and v.
    recipe : Recipe
        What a run is apart from its row.
    notes : tuple of str
        What was chosen, and why.
    constant : mapping of str to Expr
        Values of those that do not vary.
    """

    model: Model
    settings: Settings
    plan: Plan
    compiled: CompiledModel
    grid: Grid
    held: Mapping[str, int]
    given: Mapping[str, int]
    recipe: Recipe
    notes: tuple[str, ...] = ()
    constant: Mapping[str, Expr] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<Ensemble of {self.model.name}: {len(self)} runs with {self.plan.choice.method.name}>"

    def __len__(self) -> int:
        return len(self.grid)

    @property
    def target(self) -> str:
        """What runs it: ``cpu``, ``lanes`` or ``cuda``."""
        return self.recipe.target

    @property
    def sizes(self) -> tuple[int, int, int, int]:
        """Runs, quantities, output times, and runs in a chunk."""
        return len(self), len(self.recipe.quantities), len(self.recipe.spec.times), self.chunk

    @cached_property
    def parameters(self) -> dict[str, float]:
        """Values of all parameters, before any varies."""
        return self.model.parameters(self.settings.parameters)

    @cached_property
    def chunk(self) -> int:
        """Runs in a chunk; it depends on nothing but the ensemble, so that another process can continue it."""
        spec, info, law = self.recipe.spec, self.compiled.info, self.compiled.law
        stages = self.plan.tableau.stages
        evaluations = spec.until * _EVALUATIONS
        if not spec.adaptive and spec.step is not None:
            evaluations = stages * spec.until / spec.step
        seconds = 2e-5 + _OPERATION * evaluations * sum(law.operations.get(name, 0) for name in ("rhs", "accept"))
        numbers = law.nw + 4 * info.ny + 100 + len(self.recipe.columns) * len(spec.times)
        if self.target == "cuda":  # a device wants tens of thousands of runs at once, whatever they take
            return int(max(1.0, min(131072.0, CHUNK_BYTES_CUDA / (8 * numbers))))
        most = min(CHUNK_SECONDS / seconds, CHUNK_BYTES / (8 * numbers), len(self) / 16)
        found = int(max(1.0, min(65536.0, math.ceil(most))))
        return found if self.target == "cpu" else LANES * math.ceil(found / LANES)

    def rows(self, first: int, last: int) -> Rows:
        """Return what distinguishes the runs from `first` to `last` (exclusive)."""
        varied = self.grid.values(first, last)
        settled = self.settings.parameters
        return make_rows(self.model.mechanism, self.parameters, varied, self.held, self.given, settled, self.constant)

    @cached_property
    def description(self) -> dict[str, Any]:
        """What is computed: two ensembles of the same description give the same rows."""
        found = hashlib.sha256()
        for axis in self.grid.axes:
            for name, values in axis.values.items():
                found.update(f"{axis.dimension}\0{name}\0".encode() + values.tobytes())
        formulas = {name for name, _ in derived(self.model.mechanism.parameters)}
        settled = sorted(formulas & set(self.settings.parameters))  # these have numbers in place of their formulas
        return {
            **({"settled": settled} if settled else {}),
            "mechanism": identity(self.model.mechanism),
            "varied": found.hexdigest(),
            "parameters": self.parameters,
            "start": {name: repr(value) for name, value in self.constant.items()},
            "recipe": self.recipe.digest,
            "runs": len(self),
            "chunk": self.chunk,
        }


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
        What is run.
    settings : Settings
        How; without output times, only the end is kept.
    vary, runs : mapping
        See `symgen.ensemble.sweep.sweep`.
    quantities : sequence of str or None
        What is kept.
    target : {"cpu", "lanes", "cuda"}
        What runs it.

    Raises
    ------
    InputError
        If a name, number or combination is wrong.
    """
    from symgen.auto import resolve

    if not isinstance(settings.start, Mapping):
        raise InputError("start", "values by the names of coordinates and velocities", "the last state of another run")
    if settings.verify:
        raise InputError("verify", "single runs", "an ensemble", "run doubtful ones again by themselves")
    if settings.repeat != 1:
        raise InputError("repeat", "single runs", "an ensemble")
    if settings.shape == "looped":
        raise InputError("shape", "straight code for an ensemble", "looped")
    if settings.coordinates == "joint":
        raise InputError("coordinates", "absolute ones for an ensemble", "joint")
    settings = replace(settings, coordinates="absolute")
    coordinates, velocities = _names(model)
    if len(coordinates) > LARGEST_STRAIGHT:
        found = f"{len(coordinates)} coordinates"
        raise InputError("sweep", f"a mechanism of at most {LARGEST_STRAIGHT} coordinates", found)
    chosen, notes = resolve(model.mechanism, replace(settings, shape="straight"))
    if chosen.times is None and chosen.output_step is None:
        end = model.mechanism.defaults.until if chosen.until is None else chosen.until
        chosen = replace(chosen, times=(end,))
    if chosen.shape == "looped":
        raise InputError("shape", "straight code for an ensemble", "'looped'")
    chosen = replace(chosen, shape="straight")  # batch loops hold the code of one mechanism
    plan = make_plan(model.mechanism, chosen)
    refuse_events("sweep", model.mechanism, chosen)
    # before anything is derived
    parameters = model.parameters(chosen.parameters)
    for name in (*vary, *runs):
        _check_name(name, model.name, parameters, coordinates, velocities)
    grid = make_grid(vary, runs, (*coordinates, *velocities))
    holds = tuple(hold for hold in plan.holds if hold.name not in grid.names)
    places = _held(model, holds, coordinates, velocities)
    compiled = compile_model(model.mechanism, plan.choice)
    kept = choose_quantities(compiled.info, quantities, partial(measurable, model.mechanism, compiled.info))
    integral = integrated(model.mechanism, kept)
    if integral is not None and target != "cpu":
        expected = "quantities without integral(...), which are added up by cpu alone"
        raise InputError(f"target '{target}'", expected, f"'{integral}'", "leave --target out, or name others")

    def made(choice: MethodChoice) -> CompiledModel:
        found = compiled if choice is plan.choice else compile_model(model.mechanism, choice)
        return found if integral is None else with_integrals(model.mechanism, found)

    compiled = made(plan.choice)
    integrator_of_rows(plan.tableau.name, plan.spec)
    constant = {hold.name: hold.value for hold in holds if hold.value is not None}
    held = {name: coordinates.index(name) for name in (*grid.names, *constant) if name in coordinates}
    given = {name: velocities.index(name) for name in (*grid.names, *constant) if name in velocities}
    if target == "lanes":
        check_lanes(plan.tableau.name, plan.spec)
    spare = spare_other = other = spare_measures = None
    if target != "cpu":
        other = Module.of(compile_model(model.mechanism, plan.choice, target=target))
    if plan.solver_is_free:
        choice = replace(plan.choice, options={**plan.choice.options, "solver": "augmented"})
        light = made(choice)
        spare, spare_measures = Module.of(light), make_measures(model.mechanism, light, kept)
        if target == "cuda":  # the few runs with light bodies are not worth lanes of their own
            spare_other = Module.of(compile_model(model.mechanism, choice, target=target))
    recipe = Recipe(
        module=Module.of(compiled),
        spare=spare,
        integrator=plan.tableau.name,
        spec=plan.spec,
        method_parameters=dict(plan.method_parameters),
        quantities=kept,
        held=tuple((index, velocity_of(index, compiled.info)) for index in held.values()),
        kept=tuple(velocities.index(hold.name) for hold in holds if hold.name in velocities),
        fixed=tuple(sorted({j for hold in places for j in _columns(hold, compiled.info)})),
        strict=chosen.strict,
        code=code_identity(),
        target=target,
        other=other,
        spare_other=spare_other,
        measures=make_measures(model.mechanism, compiled, kept),
        spare_measures=spare_measures,
    )
    if target == "cuda":  # before anything runs: whether a thread of the device can hold a run
        _ = kernel_of(recipe).first
    return Ensemble(model, chosen, plan, compiled, grid, held, given, recipe, notes, constant)


def _names(model: Model) -> tuple[list[str], list[str]]:
    """Return the names of coordinates and velocities in the order of q and v."""
    bodies = model.mechanism.bodies
    coordinates = [f"{body.name}.{name}" for body in bodies for name in body.coordinates]
    return coordinates, [f"{body.name}.{name}" for body in bodies for name in body.speeds]


def _check_name(
    name: str, model: str, parameters: Mapping[str, float], coordinates: Sequence[str], velocities: Sequence[str]
) -> None:
    known = [*parameters, *coordinates, *velocities]
    if name not in known:
        expected = f"a parameter, or an initial coordinate or velocity of {model}"
        raise InputError(f"vary '{name}'", expected, "none of that name", nearest(name, known))
    if name in coordinates and name.rpartition(".")[2] in ("e0", "e1", "e2", "e3"):
        raise InputError(
            f"vary '{name}'",
            "a coordinate that can change by itself",
            "an Euler parameter",
            "write the orientation with a parameter, and vary that",
        )


def _held(
    model: Model, holds: Sequence[Hold], coordinates: Sequence[str], velocities: Sequence[str]
) -> tuple[str, ...]:
    """Return the names of positions that stay as they are described.

    Raises
    ------
    InputError
        If a joint coordinate is held that is no coordinate of a body: starts of many runs have no rows for it.
    """
    found = []
    for hold in holds:
        if hold.name.endswith(f".{ORIENTATION}") or (hold.name in coordinates and hold.value is None):
            found.append(hold.name)
        elif hold.name not in coordinates and hold.name not in velocities:
            expected = "coordinates and velocities of bodies, in starts of many runs"
            raise InputError("start", expected, f"joint coordinate '{hold.name}' of {model.name}")
    return tuple(found)


def _columns(name: str, info: ModelInfo) -> tuple[int, ...]:
    """Return the velocities that change a coordinate, or the orientation of a body in space."""
    body, _, what = name.partition(".")
    if what == ORIENTATION:
        at = next(at for first, at in info.spins if info.coordinates[first].name == f"{body}.e0")
        return at, at + 1, at + 2
    return (velocity_of([q.name for q in info.coordinates].index(name), info),)
