"""The Python interface: a model, its compiled forms, and runs."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.evaluate import evaluate, orientation
from symgen.describe.load import load as load_mechanism
from symgen.describe.mechanism import Mechanism, SpatialBody
from symgen.describe.orientation import matrix, rotate
from symgen.errors import InputError, nearest
from symgen.pipeline import choose_method, compile_model
from symgen.plan import Plan, Settings, changed, make_plan
from symgen.runtime.assembly import Start, assemble, has_light_bodies
from symgen.runtime.run import Array

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.pipeline import MethodChoice
    from symgen.result.result import Result
    from symgen.vocabulary.expressions import Expr


def load(model: str | Path | Mechanism) -> Model:
    """Return a model by catalogue name (``"n-four-bar:40"``), path of a TOML file, or from a `Mechanism`.

    Raises
    ------
    InputError
        If there is no such model or the file is wrong.
    """
    return Model(model if isinstance(model, Mechanism) else load_mechanism(model))


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

    def compile(
        self, method: str = "direct-correction", options: Mapping[str, str] | None = None, shape: str = "straight"
    ) -> CompiledModel:
        """Return the emitted functions for one method, generated if the cache does not have them.

        Parameters
        ----------
        method : str
            Name of the method.
        options : mapping, optional
            Its structural options, e.g. ``{"weight": "mass"}``.
        shape : {"straight", "looped"}
            Code for this mechanism alone, or loops over tables that all mechanisms share.
        """
        return self.compiled(replace(choose_method(method, options), shape=shape))

    def compiled(self, choice: MethodChoice) -> CompiledModel:
        """Return the emitted functions for a choice of method, options and shape, from the cache if it has them."""
        return compile_model(self.mechanism, choice)

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
            position = [value(e, f"{where}.position") for e in body.position]
            centre = [value(e, f"{where}.centre_of_mass") for e in body.centre_of_mass]
            v += [None if e is None else value(e, f"{where}.velocity") for e in body.velocity]
            if isinstance(body, SpatialBody):
                e = orientation(body, parameters, self.name)
                q += [x + dx for x, dx in zip(position, rotate(matrix(e), tuple(centre)), strict=True)]
                if not body.is_point:
                    q += e
                    v += [None if x is None else value(x, f"{where}.angular_velocity") for x in body.angular_velocity]
                continue
            angle = value(body.angle, f"{where}.angle")
            c, s = math.cos(angle), math.sin(angle)
            q += [position[0] + c * centre[0] - s * centre[1], position[1] + s * centre[0] + c * centre[1]]
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
        compiled = self.compiled(plan.choice)
        start = self.assemble(compiled, parameters, plan.method_parameters, strict)
        if not plan.solver_is_free or not has_light_bodies(compiled, start):
            return compiled, start
        choice = replace(plan.choice, options={**plan.choice.options, "solver": "augmented"})
        compiled = self.compiled(choice)
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
            Single settings: ``method``, ``integrator``, ``step`` [s] (constant, or first of an adaptive run),
            ``rtol``, ``atol``, ``until`` [s], ``output_step`` [s] or ``times`` [s], ``parameters`` (values by name),
            ``options`` (``"method.alpha": 5``), ``strict`` (refuse an inconsistent start), ``verify`` (settle an
            `unverified` run by a rerun at another step), ``max_violation``, ``max_energy_error``, ``repeat`` (warm
            up, then time that many runs and report the shortest), ``shape`` (``auto``, ``straight`` or ``looped``).

        Returns
        -------
        Result
            Also of a failed or interrupted run, with status and reason.
        """
        from symgen.auto import resolve, settle
        from symgen.result.build import build_result
        from symgen.store import ahead
        from symgen.store.stats import seconds_in_cache
        from symgen.study.timing import repeated

        asked = changed(settings or Settings(), changes)
        chosen, reasons = resolve(self, asked)
        plan = make_plan(self, chosen)
        before = seconds_in_cache()
        ahead.start(plan.tableau.loop(plan.spec))
        compiled, start = self.ready(plan, chosen.parameters, chosen.strict)
        start = replace(start, notes=(*reasons, *start.notes))
        outcome, spread = repeated(compiled, plan.tableau, start, plan.spec, chosen.repeat, progress)
        doubt = None
        if reasons:  # something was chosen automatically
            settled = settle(self, asked, plan, compiled, outcome)
            plan, outcome, doubt = settled.plan, settled.outcome, settled.doubt
            if settled.note is not None:
                notes = (*outcome.start.notes, settled.note)
                outcome = replace(outcome, start=replace(outcome.start, notes=notes))
        # assembly calls emitted functions too: compiling them belongs to the run
        outcome = replace(outcome, compile_seconds=seconds_in_cache() - before)
        return build_result(self, chosen, plan, compiled, outcome, spread, doubt)
