"""Short runs for tests: an outcome with everything that the loop left behind."""

import numpy as np

from symgen.api import Model
from symgen.base.settings import Settings
from symgen.run.planning.prepare import make_plan
from symgen.run.single.outcome import Outcome
from symgen.run.single.run import integrate


def run(model: Model, **settings) -> Outcome:
    """The outcome of a run, not judged."""
    chosen = Settings(**settings)
    plan = make_plan(model.mechanism, chosen)
    compiled = model.compile(plan.choice.method.name, plan.choice.options)
    start = model.assemble(compiled, chosen.parameters, plan.method_parameters, chosen.strict)
    return integrate(compiled, plan.integrator, start, plan.spec)


def positions(outcome: Outcome) -> np.ndarray:
    """q at the outputs."""
    return outcome.states[:, : outcome.compiled.info.nq]


def fixed(integrator: str) -> dict:
    """Settings for constant steps with an integrator that could adapt."""
    return {"integrator": integrator} | (
        {} if integrator == "rk4" else {"options": {f"{integrator}.adaptive": "false"}}
    )


def interrupt(monkeypatch, module, name, call):
    """Let a function of a module end as Ctrl-C does at one of its calls, counted from 1; its calls, in a list."""
    function, calls = getattr(module, name), []

    def counted(*arguments):
        calls.append(1)
        if len(calls) == call:
            raise KeyboardInterrupt
        return function(*arguments)

    monkeypatch.setattr(module, name, counted)
    return calls
