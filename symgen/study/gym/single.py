"""An environment of one run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import gymnasium
import numpy as np

from symgen.base.errors import InputError, StepError

if TYPE_CHECKING:
    from symgen.study.gym.task import Array, Task


class Environment(gymnasium.Env):  # type: ignore[misc]  # a class without types
    """An environment of one stepped run; `symgen.gym.make` makes it.

    A step that fails truncates the episode, with the reason in ``info["failure"]``; an event that ends runs terminates
    it, with its name in ``info["event"]``. `reset` returns remarks on the model in ``info["remarks"]``.

    Parameters
    ----------
    task : Task
        What it does.

    Attributes
    ----------
    run : SteppedRun
        The run, between its steps.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": []}

    def __init__(self, task: Task) -> None:
        self.task, self.render_mode = task, None
        self.observation_space, self.action_space = task.spaces
        self.run = task.model.start(task.settings)
        self._meter = self.run.meter(task.formulas)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        """Begin an episode; ``options["start"]`` has values of the start, which replace `reset`."""
        super().reset(seed=seed)
        self.run.reset(self.task.draw_start(self.np_random) if not options else options.get("start"))
        return self._meter()[: len(self.task.observe)], self.task.remarks

    def step(self, action: object) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Hold an action for a time `dt`."""
        task, info, event = self.task, dict[str, Any](), None
        action = np.asarray(action, dtype=np.float64)
        if action.shape != task.low.shape:
            raise InputError("action", f"an array of shape {task.low.shape}", f"one of shape {action.shape}")
        try:
            event = self.run.step(task.dt, dict(zip(task.act, action.tolist(), strict=True)))
        except StepError as error:
            info["failure"] = error.reason
        observations, reward, ended = task.judge_step(self._meter(), action)
        if event is not None:
            info["event"] = event.name
        over = bool(task.is_time_over(self.run.t)) or "failure" in info
        return observations, float(reward), bool(ended) or event is not None, over, info
