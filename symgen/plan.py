"""From settings to a plan: names resolved, numbers checked, unsuitable pairs refused, before anything is run."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.errors import InputError, nearest
from symgen.integrators import INTEGRATORS
from symgen.methods import METHODS
from symgen.pipeline import MethodChoice, choose_method
from symgen.runtime.run import Array, RunSpec
from symgen.shapes import choose_shape

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.integrators._base import Integrator

#: Adaptive runs without asked output times report this many equidistant ones.
DEFAULT_OUTPUTS = 1001
#: Evaluations of an adaptive run in a second of motion, where nothing is known of the motion.
ADAPTIVE_EVALUATIONS = 2000.0
#: Default tolerances of adaptive runs.
RTOL, ATOL = 1e-8, 1e-10


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
    shape: str = "auto"


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

    @property
    def key(self) -> tuple[str, tuple[tuple[str, float], ...]]:
        """What a compiled model and its start depend on: module, shape and parameters of the method."""
        return f"{self.choice.stem} {self.choice.shape}", tuple(sorted(self.method_parameters.items()))


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
    max_violation = _positive("max_violation", s.max_violation)
    spec = RunSpec(
        until=until,
        step=step,
        adaptive=adaptive,
        times=_output_times(s, defaults.output_step, until, step, adaptive),
        rtol=rtol,
        atol=atol,
        largest_step=np.inf if limit is None else limit,
        max_violation=max_violation,
        # an error of the discretisation, not drift: half the digits are asked of it
        max_velocity_violation=math.sqrt(max_violation) if method.velocities_follow else None,
        max_energy_error=_positive("max_energy_error", s.max_energy_error),
        integrator_parameters={
            q.name: float(integrator_options[q.name]) for q in tableau.parameters if q.name in integrator_options
        },
    )
    asked = any(key.partition(".")[2] == "solver" for key in s.options)
    free = "solver" in choice.options and not asked
    if any(body.massless for body in model.mechanism.bodies):
        if method.needs_regular_mass(choice.options):
            raise InputError(f"method '{method.name}'", "one that does with massless bodies", "one that inverts M")
        if free:
            choice, free = replace(choice, options={**choice.options, "solver": "augmented"}), False
    shape = choose_shape(model.mechanism, choice, s.shape, expected_evaluations(tableau, until, step, adaptive))
    choice = replace(choice, shape=shape.shape)
    return Plan(choice, tableau, method_parameters, spec, tuple(warnings), free, shape.reason)


def expected_evaluations(tableau: Integrator, until: float, step: float | None, adaptive: bool) -> float:
    """Return about how many evaluations a run takes, to choose the shape of its code by."""
    if adaptive or step is None:
        return ADAPTIVE_EVALUATIONS * until
    return float(getattr(tableau, "stages", 1) + 1) * until / step  # an accepted state costs about one more


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
