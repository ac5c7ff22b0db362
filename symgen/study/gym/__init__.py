"""Environments of Gymnasium: a model, what is observed, driven and rewarded.

In: a model, names and formulas, settings of a run.
Out: a `gymnasium.Env`, or a `gymnasium.vector.VectorEnv` whose step is one compiled call over rows.
Imports: NumPy, gymnasium; `api` and rooms below.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.base.keywords import RunKeywords, make_entry

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.study.gym.many import Environments
    from symgen.study.gym.single import Environment
    from symgen.study.gym.task import Reset, Reward, Task

#: Most runs of a vectorised environment.
MOST = 1_000_000


@make_entry
def make(
    model: str | Path | Mechanism | Model,
    observe: Sequence[str],
    act: Sequence[str] | Mapping[str, tuple[float, float]],
    reward: str | Reward,
    reset: Reset | None = None,
    *,
    end: str | None = None,
    dt: float = 0.02,
    settings: Settings | None = None,
    **changes: Unpack[RunKeywords],
) -> Environment:
    """Return an environment of one run.

    Parameters
    ----------
    model : str, Path, Mechanism or Model
        An argument of `symgen.load`, or its result.
    observe : sequence of str
        Names of columns of results, and formulas of them.
    act : sequence of str, or mapping of str to (float, float)
        Inputs that an action sets for a time `dt`, with their bounds; without bounds they take any number.
    reward : str or callable
        A formula, evaluated after each step; or a function of observations and actions, whose last axis has their
        elements.
    reset : mapping or callable, optional
        Values of the start by name: a number, or a pair of bounds of a uniform distribution. Or a function of a NumPy
        generator that returns numbers by name.
    end : str, optional
        A formula: an episode is terminated where it is above 0. It is truncated at the setting ``until``.
    dt : float
        Time of a step [s].
    settings : Settings, optional
        Settings of the run.
    **changes
        Single settings by name, as listed above; by default the integrator is ``rk4`` with the step of the model, at
        most `dt`, in joint coordinates where they suit.

    Raises
    ------
    InputError
        If an argument is wrong, or Gymnasium is missing.
    """
    task = _make_task(model, observe, act, reward, reset, end, dt, settings, changes)
    from symgen.study.gym.single import Environment

    return Environment(task)


@make_entry
def make_vec(
    model: str | Path | Mechanism | Model,
    num_envs: int,
    observe: Sequence[str],
    act: Sequence[str] | Mapping[str, tuple[float, float]],
    reward: str | Reward,
    reset: Reset | None = None,
    *,
    end: str | None = None,
    dt: float = 0.02,
    jobs: int | None = None,
    settings: Settings | None = None,
    **changes: Unpack[RunKeywords],
) -> Environments:
    """Return an environment of many runs: a step is one compiled call over rows on each core.

    Parameters
    ----------
    model, observe, act, reward, reset, end, dt, settings
        As for `make`.
    num_envs : int
        Number of runs.
    jobs : int, optional
        Threads; by default one for every core.
    **changes
        Single settings by name, as listed above, as for `make`.

    Raises
    ------
    InputError
        If an argument is wrong, Gymnasium is missing, or runs of the model are not served by one call.
    """
    task = _make_task(model, observe, act, reward, reset, end, dt, settings, changes)
    from symgen.study.gym.many import Environments

    return Environments(task, arguments.whole_number("num_envs", num_envs, 1, MOST), jobs)


def _make_task(model: Any, *parts: Any) -> Task:
    """Return the task of an environment."""
    try:
        import gymnasium  # noqa: F401  # missing here, it is a sentence
    except ImportError:
        raise InputError("gym", "the package 'gymnasium'", "none", "pip install symgen[gym]") from None
    from symgen.api import load
    from symgen.study.gym.task import make_task

    return make_task(load(model), *parts)


__all__ = ["make", "make_vec"]
