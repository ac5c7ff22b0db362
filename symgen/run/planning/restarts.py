"""Runs that begin again and again from other values: plan, code, memory and steps stay."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

from symgen.base.settings import setting_description
from symgen.describe.parts.holds import canonical_hold_name, read_holds
from symgen.run.layout.start_records import Instant
from symgen.run.planning.prepare import Assembled, add_notes
from symgen.run.planning.starts import Again, DescribedStart
from symgen.run.planning.tree_starts import begin_on_tree, first_turned_over, map_to_tree
from symgen.run.starts.kept import KeptTree
from symgen.run.starts.start_words import turned_over_error

if TYPE_CHECKING:
    from symgen.describe.mechanism import Hold
    from symgen.run.planning.prepare import Prepared
    from symgen.run.starts.tree_start import Carried


class Restarts:
    """A run that begins again and again from other values.

    Parameters
    ----------
    run : Prepared
        The run, not one that goes on from another one.
    """

    def __init__(self, run: Prepared) -> None:
        self._run = run
        self._kept: KeptTree | None = None
        self._again = dict[tuple[str, ...], Again | None]()

    def state(self, start: Mapping[str, float]) -> Instant | None:
        """Return state and scratch of the run from another start, None where this code does not serve there.

        Parameters
        ----------
        start : mapping of str to float
            Values that the start holds, by name.

        Raises
        ------
        InputError, AssemblyError
            As `prepare`.
        """
        if not self._serves:
            return None
        names, values = tuple(start), tuple(start.values())
        if (again := self._again.get(names)) is not None and all(isinstance(x, float) and x - x == 0.0 for x in values):
            if (closed := again(values)) is not None:
                return self._settle_start(closed)
        holds = self._holds_position(start)
        closed, light = self._described.state(holds)
        if light:
            return None
        if names not in self._again:
            mechanism = self._run.plan.mechanism
            self._again[names] = self._described.again(holds, [canonical_hold_name(mechanism, name) for name in names])
        return self._settle_start(closed)

    def _settle_start(self, closed: Instant) -> Instant:
        """Return a copy of a start of bodies, in the coordinates of the state."""
        if (tree := self._run.tree) is None:
            return Instant(*(array.copy() for array in closed))
        if self._kept is None:
            self._kept = KeptTree(self._carried, closed, tree.start.p)
        y, w, alike = self._kept.settle(closed.y, closed.w)
        y[tree.compiled.info.work :] = closed.y[tree.bodies.info.work :]
        if (over := first_turned_over(alike)) >= 0:
            raise turned_over_error(tree.bodies.info, over)
        return Instant(y, tree.start.p, w)

    def start_at(self, start: Mapping[str, float]) -> Prepared:
        """Return the run from another start, where `state` has one, with its notes and changes."""
        plan, tree = self._run.plan, self._run.tree
        plan = replace(plan, settings=replace(plan.settings, start=start), holds=self._holds_position(start))
        compiled, closed = self._run.assembled.of_bodies[0], self._described.start(plan.holds)
        assembled = Assembled(compiled, closed)
        if tree is not None:
            parts = tree.whole, tree.mechanism, self._carried, closed, plan.method_parameters, plan.events
            tree = begin_on_tree(*parts)
            assembled = Assembled(tree.compiled, tree.start, tree)
        return replace(self._run, plan=plan, assembled=add_notes(plan, assembled))

    def _holds_position(self, start: Mapping[str, float]) -> tuple[Hold, ...]:
        return read_holds(self._run.plan.mechanism, "start", setting_description("start").check("start", start))

    @cached_property
    def _serves(self) -> bool:
        """Whether the code is the plan's own and begins at time 0."""
        plan, (compiled, _) = self._run.plan, self._run.assembled.of_bodies
        return plan.last is None and compiled.law.options.get("solver") == plan.choice.options.get("solver")

    @cached_property
    def _described(self) -> DescribedStart:
        plan, (compiled, _) = self._run.plan, self._run.assembled.of_bodies
        settings = plan.parameters, plan.method_parameters, plan.settings.strict
        return DescribedStart(plan.mechanism, compiled, *settings, plan.solver_is_free)

    @cached_property
    def _carried(self) -> Carried:
        tree = self._run.tree
        assert tree is not None, "the state is that of joints"
        return map_to_tree(tree.whole, tree.mechanism, tree.bodies, tree.compiled)
