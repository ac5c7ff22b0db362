"""What an environment observes, drives and rewards, and where its episodes begin."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from symgen.base import arguments
from symgen.base.errors import InputError, quote, suggest
from symgen.base.settings import Settings, change_settings, differs_from_default
from symgen.result.part_limits import remarks_without_limits
from symgen.run.integrators import INTEGRATORS

if TYPE_CHECKING:
    from symgen.api import Model

Array = NDArray[np.float64]

#: Values of a start by name: numbers or bounds; or a function of a generator that returns numbers.
Reset = Mapping[str, float | tuple[float, float]] | Callable[[np.random.Generator], Mapping[str, float]]
#: A function of observations and actions.
Reward = Callable[[Array, Array], Any]

#: Times are the same up to this part of a step.
_SAME = 1e-6


@dataclass(frozen=True)
class Task:
    """What an environment does.

    Attributes
    ----------
    model, settings : Model, Settings
        Of the runs.
    observe, act : tuple of str
        Formulas, and names of inputs.
    low, high : Array
        Bounds of the inputs.
    reward : str or callable
        A formula, or a function of observations and actions.
    reset : mapping, callable or None
        Of the start.
    end : str or None
        A formula that is above 0 where an episode is terminated.
    dt, until : float
        Time of a step, and of an episode [s].
    """

    model: Model
    settings: Settings
    observe: tuple[str, ...]
    act: tuple[str, ...]
    low: Array
    high: Array
    reward: str | Reward
    reset: Reset | None
    end: str | None
    dt: float
    until: float

    @property
    def formulas(self) -> tuple[str, ...]:
        """All formulas: observations, then reward and end where they are formulas."""
        reward = (self.reward,) if isinstance(self.reward, str) else ()
        return *self.observe, *reward, *(() if self.end is None else (self.end,))

    @property
    def spaces(self) -> tuple[Any, Any]:
        """Spaces of observations and actions."""
        box = gymnasium.spaces.Box
        return box(-np.inf, np.inf, (len(self.observe),), np.float64), box(self.low, self.high, dtype=np.float64)

    @property
    def remarks(self) -> dict[str, Any]:
        """Remarks on the model, as facts of a reset; empty without any."""
        said = remarks_without_limits(self.model.mechanism)
        return {"remarks": said} if said else {}

    def judge_step(self, values: Array, action: Array) -> tuple[Array, Any, Any]:
        """Return observations, rewards, and whether episodes are terminated, from values of the formulas."""
        n = len(self.observe)
        observations = np.ascontiguousarray(values[..., :n])
        reward = (
            values[..., n]
            if isinstance(self.reward, str)
            else np.asarray(self.reward(observations, action), np.float64)
        )
        if reward.shape != observations.shape[:-1]:
            expected = f"an array of shape {observations.shape[:-1]}" if observations.ndim > 1 else "a number"
            raise InputError("reward", f"a function that returns {expected}", arguments.kind_of_value(reward))
        ended = np.zeros(observations.shape[:-1], dtype=bool) if self.end is None else values[..., -1] > 0.0
        return observations, reward, ended

    def is_time_over(self, t: object) -> Any:
        """Whether episodes have reached their time."""
        return np.asarray(t) >= self.until - _SAME * self.dt

    def draw_start(self, generator: np.random.Generator) -> Mapping[str, float] | None:
        """Return values of a start; None for the start of the run."""
        if self.reset is None:
            return None
        if callable(self.reset):
            return arguments.mapping("reset", self.reset(generator), "a function that returns numbers by name")
        pairs = self.reset.items()
        return {name: generator.uniform(*x) if isinstance(x, tuple) else float(x) for name, x in pairs}


def make_task(
    model: Model,
    observe: Any,
    act: Any,
    reward: Any,
    reset: Any,
    end: Any,
    dt: Any,
    settings: Settings | None,
    changes: Mapping[str, Any],
) -> Task:
    """Return the task of an environment, from the arguments of `symgen.gym.make`.

    Raises
    ------
    InputError
        If one is wrong.
    """
    dt, mechanism = arguments.number("dt", dt, positive=True), model.mechanism
    observed = arguments.words("observe", observe)
    if not observed:
        raise InputError("observe", "at least one name", "none")
    bounds = act if isinstance(act, Mapping) else dict.fromkeys(arguments.words("act", act), (-np.inf, np.inf))
    if not bounds:
        raise InputError("act", "at least one input", "none")
    for name in bounds:
        if name not in mechanism.inputs:
            hint = suggest(str(name), mechanism.inputs) if mechanism.inputs else "it declares none"
            raise InputError("act", f"an input of {mechanism.name}", quote(str(name)), hint)
    pairs = np.array([_ordered_bounds(f"act '{name}'", pair, np.inf) for name, pair in bounds.items()])
    if not isinstance(reward, str):
        if reward is None or arguments.callable_or_none("reward", reward) is None:
            raise InputError("reward", "a formula or a function", "None")
    if reset is not None and not callable(reset):
        reset = arguments.mapping("reset", reset, "numbers or pairs of bounds by the names of a start")
        reset = {name: _number_or_bounds(f"reset '{name}'", x) for name, x in reset.items()}
    if end is not None:
        arguments.text("end", end, "a formula")
    settings = _settings_of_environment(change_settings(settings, changes), dt, mechanism.defaults.step)
    for name in bounds:
        if name in settings.inputs:
            raise InputError(f"act '{name}'", "an input that nothing else sets", "one that is set by `inputs`")
    until = mechanism.defaults.until if settings.until is None else settings.until
    low, high = pairs.T.copy()
    return Task(model, settings, observed, tuple(bounds), low, high, reward, reset, end, dt, until)


def _settings_of_environment(settings: Settings, dt: float, step: float) -> Settings:
    """Return settings with the integrator, the step and the coordinates that environments take by default."""
    integrator = settings.integrator or "rk4"
    settings = replace(settings, integrator=integrator)
    if not differs_from_default(settings, "coordinates"):
        settings = replace(settings, coordinates="auto")
    kind = INTEGRATORS.get(integrator, "integrator") if integrator != "auto" else None
    adaptive = settings.rtol is not None or settings.atol is not None or (kind is not None and kind.adaptive)
    if settings.step is None and kind is not None and not adaptive:
        settings = replace(settings, step=dt / np.ceil(dt / step * (1.0 - _SAME)))  # a grid that steps end on
    return settings


def _ordered_bounds(where: str, pair: object, limit: float) -> tuple[float, float]:
    """Return two bounds in order, finite or up to a limit."""
    numbers = arguments.list_entries(where, pair, "a pair of bounds")
    try:
        low, high = (float(x) for x in numbers)
    except (TypeError, ValueError):
        low, high = 1.0, 0.0
    if not (low < high or (low == high and limit < np.inf)):
        raise InputError(where, "a pair of bounds, the lower one first", arguments.kind_of_value(pair))
    return low, high


def _number_or_bounds(where: str, x: object) -> float | tuple[float, float]:
    """Return a number, or bounds of a distribution."""
    if isinstance(x, tuple | list):
        low, high = _ordered_bounds(where, x, 0.0)
        return arguments.number(where, low), arguments.number(where, high)
    return arguments.number(where, x)
