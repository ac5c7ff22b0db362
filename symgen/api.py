"""The Python interface: a model, its compiled forms, and runs."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.evaluate import evaluate
from symgen.describe.load import load as load_mechanism
from symgen.describe.mechanism import Mechanism
from symgen.errors import InputError, nearest
from symgen.integrators import INTEGRATORS
from symgen.methods import METHODS
from symgen.pipeline import MethodChoice, choose_method, compile_model
from symgen.runtime.assembly import Start, assemble, has_light_bodies
from symgen.runtime.run import Array, RunSpec
from symgen.vocabulary.expressions import ZERO

if TYPE_CHECKING:
    from symgen.integrators._base import Integrator
    from symgen.model import CompiledModel
    from symgen.result.result import Result
    from symgen.vocabulary.expressions import Expr

#: Adaptive runs without asked output times report this many equidistant ones.
DEFAULT_OUTPUTS = 1001
#: Default tolerances of adaptive runs.
RTOL, ATOL = 1e-8, 1e-10


def load(model: str | Path | Mechanism) -> Model:
    """Return a model by catalogue name (``"n-four-bar:40"``), path of a TOML file, or from a `Mechanism`.

    Raises
    ------
    InputError
        If there is no such model or the file is wrong.
    """
    return Model(model if isinstance(model, Mechanism) else load_mechanism(model))


@dataclass(frozen=True)
class Settings:
    """Everything that shapes a run beside the model; see `Model.simulate` for the meaning."""

    method: str = "direct-correction"
    integrator: str | None = None  # None: the method's default
    step: float | None = None
    rtol: float | None = None
    atol: float | None = None
    until: float | None = None
    output_step: float | None = None
    times: Sequence[float] | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    options: Mapping[str, str | float] = field(default_factory=dict)
    strict: bool = False
    verify: bool = False
    max_violation: float = 1e-6
    max_energy_error: float = 0.05
    repeat: int = 1


def changed(settings: Settings, changes: Mapping[str, object]) -> Settings:
    """Return `settings` with some replaced.

    Raises
    ------
    InputError
        If a name is not a setting; says the nearest one.
    """
    known = [f.name for f in fields(Settings)]
    for name in changes:
        if name not in known:
            raise InputError("settings", "the name of a setting", f"'{name}'", nearest(name, known))
    return replace(settings, **changes)  # type: ignore[arg-type]  # values are checked by make_plan


def simulate(model: str | Path | Mechanism, settings: Settings | None = None, **changes: object) -> Result:
    """Load and run a model in one go; see `load` and `Model.simulate`."""
    return load(model).simulate(settings, **changes)  # type: ignore[arg-type]  # names are checked by changed


@dataclass(frozen=True)
class Model:
    """A mechanism that can be compiled and run.

    Attributes
    ----------
    mechanism : Mechanism
        The validated description.
    """

    mechanism: Mechanism

    @property
    def name(self) -> str:
        """Name of the mechanism."""
        return self.mechanism.name

    def parameters(self, changed: Mapping[str, float] | None = None) -> dict[str, float]:
        """Return all parameter values, `changed` ones replaced.

        Raises
        ------
        InputError
            If a name is not a parameter or a value is not finite.
        """
        values = {p.name: p.value for p in self.mechanism.parameters}
        for name, value in (changed or {}).items():
            if name not in values:
                raise InputError(
                    f"parameter '{name}'", f"a parameter of {self.name}", "none of that name", nearest(name, values)
                )
            if not math.isfinite(value):
                raise InputError(f"parameter '{name}'", "a finite number", str(value))
            values[name] = float(value)
        return values

    def compile(self, method: str = "direct-correction", options: Mapping[str, str] | None = None) -> CompiledModel:
        """Return the emitted functions for one method, generated if the cache does not have them.

        Parameters
        ----------
        method : str
            Name of the method.
        options : mapping, optional
            Its structural options, e.g. ``{"weight": "mass"}``.
        """
        return compile_model(self.mechanism, choose_method(method, options))

    def initial_state(self, parameters: Mapping[str, float]) -> tuple[Array, list[float | None]]:
        """Return q as described (not yet closed) and the given velocities, None where there is none.

        Parameters
        ----------
        parameters : mapping
            Values of all parameters.
        """
        q: list[float] = []
        v: list[float | None] = []

        def value(e: Expr, where: str) -> float:
            return evaluate(e, parameters, f"{self.name}: {where}")

        for body in self.mechanism.bodies:
            where = f"bodies.{body.name}"
            angle = value(body.angle, f"{where}.angle")
            x, y = (value(e, f"{where}.position") for e in body.position)
            cx, cy = (value(e, f"{where}.centre_of_mass") for e in body.centre_of_mass)
            c, s = math.cos(angle), math.sin(angle)
            q += [x + c * cx - s * cy, y + s * cx + c * cy]
            v += [None if e is None else value(e, f"{where}.velocity") for e in body.velocity]
            if not body.is_point:
                q.append(angle)
                omega = body.angular_velocity
                v.append(None if omega is None else value(omega, f"{where}.angular_velocity"))
        return np.array(q), v

    def assemble(
        self,
        compiled: CompiledModel,
        parameters: Mapping[str, float] | None = None,
        method_parameters: Mapping[str, float] | None = None,
        strict: bool = False,
    ) -> Start:
        """Return the consistent start of a run.

        Raises
        ------
        AssemblyError
            If the mechanism cannot be closed.
        """
        values = self.parameters(parameters)
        q, v = self.initial_state(values)
        p = compiled.parameter_array(values, method_parameters or {})
        return assemble(compiled, q, v, p, strict=strict)

    def ready(
        self, plan: Plan, parameters: Mapping[str, float] | None = None, strict: bool = False
    ) -> tuple[CompiledModel, Start]:
        """Return the compiled model and the consistent start of a plan.

        Where light bodies spoil the elimination of v' and the plan leaves the choice, the same law is solved with
        M + W D^T D instead, and a note says so.
        """
        compiled = compile_model(self.mechanism, plan.choice)
        start = self.assemble(compiled, parameters, plan.method_parameters, strict)
        if not plan.solver_is_free or not has_light_bodies(compiled, start):
            return compiled, start
        choice = replace(plan.choice, options={**plan.choice.options, "solver": "augmented"})
        compiled = compile_model(self.mechanism, choice)
        start = self.assemble(compiled, parameters, plan.method_parameters, strict)
        note = "light bodies make D M^-1 D^T nearly singular: accelerations are solved with M + W D^T D"
        return compiled, replace(start, notes=(*start.notes, note))

    def simulate(
        self, settings: Settings | None = None, progress: Callable[[float], None] | None = None, **changes: object
    ) -> Result:
        """Run the model.

        Parameters
        ----------
        settings : Settings, optional
            All settings at once.
        progress : callable, optional
            Called about ten times a second with the time reached.
        **changes
            Single settings: ``method``, ``integrator``, ``step`` [s] (constant, or first of an adaptive run), ``rtol``,
            ``atol``, ``until`` [s], ``output_step`` [s] or ``times`` [s], ``parameters`` (values by name), ``options``
            (``"method.alpha": 5``), ``strict`` (refuse an inconsistent start), ``verify`` (settle an `unverified` run by
            a rerun at another step), ``max_violation``, ``max_energy_error``, ``repeat`` (warm up, then time that many
            runs and report the shortest).

        Returns
        -------
        Result
            Also of a failed or interrupted run, with status and reason.
        """
        from symgen.auto import resolve
        from symgen.result.build import build_result
        from symgen.store.stats import seconds_in_cache
        from symgen.study.timing import repeated

        chosen, reasons = resolve(self, changed(settings or Settings(), changes))
        plan = make_plan(self, chosen)
        before = seconds_in_cache()
        compiled, start = self.ready(plan, chosen.parameters, chosen.strict)
        start = replace(start, notes=(*reasons, *start.notes))
        outcome, spread = repeated(compiled, plan.tableau, start, plan.spec, chosen.repeat, progress)
        # assembly calls emitted functions too: compiling them belongs to the run
        outcome = replace(outcome, compile_seconds=seconds_in_cache() - before)
        return build_result(self, chosen, plan, compiled, outcome, spread)


@dataclass(frozen=True)
class Plan:
    """Settings resolved: method, integrator and what the loop gets."""

    choice: MethodChoice
    tableau: Integrator
    method_parameters: Mapping[str, float]
    spec: RunSpec
    warnings: tuple[str, ...]
    solver_is_free: bool = False  # the solver was not asked for and may be chosen by the start


def make_plan(model: Model, s: Settings) -> Plan:
    """Resolve and check settings.

    Raises
    ------
    InputError
        If a name, option or number is wrong.
    """
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
    adaptive = tableau.adaptive and integrator_options.get("adaptive", "true") == "true"
    defaults = model.mechanism.defaults
    until = _positive("until", defaults.until if s.until is None else s.until)
    step = s.step if adaptive or s.step is not None else defaults.step
    if step is not None:
        step = _positive("step", step)
        if not adaptive and until / step > 2e9:
            raise InputError("step", "at most 2e9 steps", f"{until / step:.3g}")
    rtol = _positive("rtol", RTOL if s.rtol is None else s.rtol)
    atol = _positive("atol", ATOL if s.atol is None else s.atol)
    if not isinstance(s.repeat, int) or not 1 <= s.repeat <= 1000:
        raise InputError("repeat", "a whole number from 1 to 1000", f"{s.repeat}")
    warnings = list[str]()
    limit = method.largest_step(
        {p.name: method_parameters.get(p.name, p.default) for p in method.parameters}, tableau.real_boundary
    )
    if not adaptive and limit is not None and step is not None and step > limit:
        warnings.append(
            f"the step {step:g} s exceeds {limit:.3g} s, where {method.name} is unstable with {tableau.name}"
        )
    spec = RunSpec(
        until=until,
        step=step,
        adaptive=adaptive,
        times=_output_times(s, defaults.output_step, until, step, adaptive),
        rtol=rtol,
        atol=atol,
        largest_step=np.inf if limit is None else limit,
        max_violation=_positive("max_violation", s.max_violation),
        max_energy_error=_positive("max_energy_error", s.max_energy_error),
        integrator_parameters={
            q.name: float(integrator_options[q.name]) for q in tableau.parameters if q.name in integrator_options
        },
    )
    asked = any(key.partition(".")[2] == "solver" for key in s.options)
    free = "solver" in choice.options and not asked
    if any(ZERO in (body.mass, body.inertia) for body in model.mechanism.bodies):
        if method.needs_regular_mass(choice.options):
            raise InputError(f"method '{method.name}'", "one that does with massless bodies", "one that inverts M")
        if free:
            choice, free = replace(choice, options={**choice.options, "solver": "augmented"}), False
    return Plan(choice, tableau, method_parameters, spec, tuple(warnings), free)


def split_options(s: Settings, tableau: Integrator) -> tuple[MethodChoice, dict[str, float], dict[str, str]]:
    """Return the method with structural options, its numeric parameters, and the integrator's options.

    Keys are ``method.NAME`` or the method's own name, ``integrator.NAME`` or the integrator's own name.
    """
    base = choose_method(s.method).method
    numeric = {p.name: p for p in base.parameters}
    structural: dict[str, str] = {}
    parameters: dict[str, float] = {}
    integrator: dict[str, str] = {}
    for key, value in s.options.items():
        owner, _, name = key.partition(".")
        if owner in ("method", base.name):
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


def _output_times(s: Settings, default: float | None, until: float, step: float | None, adaptive: bool) -> Array:
    if s.times is not None:
        given = np.asarray(s.times, dtype=np.float64)
        if given.ndim != 1 or not np.all(np.isfinite(given)) or np.any(np.diff(given) <= 0.0):
            raise InputError("times", "finite, increasing output times", "others")
        if len(given) and (given[0] < 0.0 or given[-1] > until * (1.0 + 1e-12)):
            raise InputError("times", f"output times from 0 to {until:g}", f"{given[0]:g} to {given[-1]:g}")
        return np.minimum(given, until)  # a multiple of a step may exceed the end by rounding
    every = s.output_step if s.output_step is not None else default
    if every is None:
        if adaptive:
            return np.linspace(0.0, until, DEFAULT_OUTPUTS)
        assert step is not None, "a constant step is given"
        every = step
    every = _positive("output_step", every)
    if until / every > 2e7:
        raise InputError("output_step", "at most 2e7 outputs", f"{until / every:.3g}")
    count = math.floor(until / every * (1.0 + 1e-12))
    times: Array = np.arange(count + 1, dtype=np.float64) * every
    if until - times[-1] > 1e-9 * every:
        times = np.append(times, until)
    times[-1] = min(times[-1], until)
    return times


def _positive(name: str, value: float) -> float:
    number = _number(name, value)
    if not number > 0.0:
        raise InputError(name, "a number above 0", f"{value}")
    return number


def _number(name: str, value: object) -> float:
    try:
        number = float(value)  # type: ignore[arg-type]  # anything else raises
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise InputError(f"option {name}" if "." in name else name, "a finite number", f"'{value}'")
    return number
