"""The compiled models of an ensemble, as modules that travel: for first runs, for light bodies, for other targets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from symgen.compiling.choose_tree import on_tree
from symgen.compiling.integrals import with_integrals
from symgen.compiling.pipeline import compile_model
from symgen.ensemble.measures import make_measures
from symgen.ensemble.recipe import Code, Module, Tree
from symgen.running.tree import tree_code

if TYPE_CHECKING:
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Mechanism
    from symgen.ensemble.quantities import Quantity
    from symgen.running.plan import Plan
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

    def codes(self, target: str, joint: bool, plain: bool) -> dict[str, Any]:
        """Return what a `Recipe` has of code.

        Parameters
        ----------
        target : {"cpu", "lanes", "cuda"}
            What runs them.
        joint : bool
            Whether the tree of joints is run.
        plain : bool
            Whether a loop over its rows leaves all that is kept.
        """
        plan, spare = self.plan, None
        first = self._code(plan.choice, target, joint)
        if plan.solver_is_free:  # the few runs with light bodies are not worth lanes of their own
            spare = self._code(plan.choice.given(solver="augmented"), "cpu" if target == "lanes" else target, joint)
        return {"first": first, "spare": spare, "tree": Tree(on_tree(self.mechanism), plain) if joint else None}

    def _code(self, choice: MethodChoice, target: str, joint: bool) -> Code:
        compiled = self.first if choice is self.plan.choice else self._made(choice)
        return Code(
            Module.of(compiled),
            Module.of(compile_model(self.mechanism, choice, target=target)) if target != "cpu" else None,
            Module.of(tree_code(self.mechanism, choice, compiled)[1]) if joint else None,
            make_measures(self.mechanism, compiled, self.kept),
        )
