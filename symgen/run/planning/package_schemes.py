"""The schemes of methods that have one of their own, for packages: the text of their step, and its numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import AssemblyError, InputError
from symgen.base.settings import Settings
from symgen.compile.store.loaded_modules import plain_function
from symgen.run.compiling.straight import BY_RIGHT_SIDE
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import code_and_start, make_plan, prepared_run
from symgen.run.printed.scheme_text import text_of_scheme

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.compile.native.annotations import Record
    from symgen.run.planning.plan import Plan


@dataclass(frozen=True)
class PackageScheme:
    """A scheme as a package has it.

    Parameters
    ----------
    stem, text : str
        Module with its step.
    numbers : mapping
        For ``model.json``: sizes, arrays and records that the step takes.
    """

    stem: str
    text: str
    numbers: Mapping[str, Any]


def scheme_of_package(plan: Plan) -> PackageScheme | None:
    """Return the scheme of a method with constant steps; None where any explicit scheme serves.

    A method that its scheme refuses for this mechanism has the sentence, and no text.

    Parameters
    ----------
    plan : Plan
        A run by the method.
    """
    method = plan.choice.method
    if BY_RIGHT_SIDE & set(method.forms):
        return None
    integrator = plan.integrator
    own = {f"method.{name}": value for name, value in plan.choice.options.items()}
    if integrator.adaptive:
        own["integrator.adaptive"] = "false"
    settings = Settings(
        *(method.name, integrator.name, plan.mechanism.defaults.step),
        options=own,
        shape="straight",
        coordinates=plan.coordinates,
    )
    try:
        plan = make_plan(plan.mechanism, settings, Purpose.STATE)
        simulation = prepared_run(plan, code_and_start(plan)).simulation()
    except (AssemblyError, InputError) as error:
        return PackageScheme("", "", {"refused": str(error)})
    simulation.enter(simulation.outputs(np.zeros(0)), until=0.0)
    setup, state = simulation.setup, simulation.state
    numbers = {
        "module": f"step_{integrator.name.replace('-', '_')}",
        "sizes": list(simulation.sizes),
        "span": [_finite(x) for x in simulation.span],
        "record": _as_json(setup.scheme),
        "arrays": {name: getattr(state, name).tolist() for name in ("share", "metric", "scales")},
        "lengths": {name: len(getattr(state, name)) for name in ("clock", "gauges", "control", "passages")},
        "memory": setup.memory,
        "room": setup.room,
    }
    title = f"One step of the scheme `{integrator.name}`: {integrator.reference}."
    return PackageScheme(str(numbers["module"]), text_of_scheme(setup.loop, setup.scheme, title), numbers)


def _as_json(value: Record | NDArray[Any] | float | Callable[..., int]) -> Any:
    """Return a number, an array with its kind, a record with its name, or the name of a function of the model."""
    if isinstance(value, tuple):
        return {type(value).__name__: {name: _as_json(x) for name, x in value._asdict().items()}}
    if isinstance(value, np.ndarray):
        return {"integers" if value.dtype.kind == "i" else "numbers": value.tolist()}
    return value if isinstance(value, int | float) else {"function": plain_function(value).__name__}


def _finite(number: float) -> float | str:
    return float(number) if np.isfinite(number) else str(float(number))
