"""The compiled models of an ensemble, as modules that travel: for first runs, for light bodies, for other targets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from symgen.compiling.integrals import with_integrals
from symgen.compiling.pipeline import compile_model
from symgen.ensemble.measures import make_measures
from symgen.ensemble.recipe import Module, Tree
from symgen.tree_run import tree_code

if TYPE_CHECKING:
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Mechanism
    from symgen.ensemble.quantities import Quantity
    from symgen.plan import Plan
    from symgen.runtime.compiled import CompiledModel


@dataclass(frozen=True)
class Made:
    """What the runs of an ensemble are made of.

    Attributes
    ----------
    mechanism : Mechanism
        What is run.
    compiled : CompiledModel
        Its code for the method.
    plan : Plan
        How.
    adds : bool
        Whether outputs are integrated.
    kept : sequence of Quantity
        What is measured behind the loops of many runs.
    """

    mechanism: Mechanism
    compiled: CompiledModel
    plan: Plan
    adds: bool
    kept: Sequence[Quantity]

    def _made(self, choice: MethodChoice) -> CompiledModel:
        found = self.compiled if choice is self.plan.choice else compile_model(self.mechanism, choice)
        return with_integrals(self.mechanism, found) if self.adds else found

    @cached_property
    def first(self) -> CompiledModel:
        """The law that is run first."""
        return self._made(self.plan.choice)

    def modules(self, target: str, joint: bool, plain: bool) -> dict[str, Any]:
        """Return what a `Recipe` has of modules.

        Parameters
        ----------
        target : {"cpu", "lanes", "cuda"}
            What runs them.
        joint : bool
            Whether the tree of joints is run.
        plain : bool
            Whether a loop over its rows leaves all that is kept.
        """
        mechanism, plan, compiled = self.mechanism, self.plan, self.first
        found: dict[str, Any] = {"module": Module.of(compiled), "spare": None}
        found["measures"] = make_measures(mechanism, compiled, self.kept)
        carried = tree_code(mechanism, plan.choice, compiled) if joint else None
        spare_tree = None
        if target != "cpu":
            found["other"] = Module.of(compile_model(mechanism, plan.choice, target=target))
        if plan.solver_is_free:
            choice = plan.choice.given(solver="augmented")
            light = self._made(choice)
            found |= {"spare": Module.of(light), "spare_measures": make_measures(mechanism, light, self.kept)}
            if joint:
                spare_tree = Module.of(tree_code(mechanism, choice, light)[1])
            if target == "cuda":  # the few runs with light bodies are not worth lanes of their own
                found["spare_other"] = Module.of(compile_model(mechanism, choice, target=target))
        if carried is not None:
            found["tree"] = Tree(carried[0], Module.of(carried[1]), spare_tree, plain)
        return found
