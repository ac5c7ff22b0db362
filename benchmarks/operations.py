"""Operations by plan of elimination: S of all rows, and velocities eliminated with rows that fix them.

    python -m benchmarks.operations [MODEL ...]

Operations of the emitted right-hand side of `direct-correction` and of a round of its correction, in coordinates of
bodies and of joints; what a derivation by hand takes, where there is one; and what CasADi's elimination of common parts
leaves of the right-hand side, where CasADi can be imported.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterator
from unittest.mock import patch

from rich.table import Table

import symgen
from benchmarks.show import show
from symgen.base.ir.program import BY_PIVOTS, Block, EliminationPlan
from symgen.derive.formulate.equations import Equations
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.law import lower_law
from symgen.derive.lower.model import lower_model
from symgen.derive.lower.plans import cheapest_plan, closing_plan
from symgen.derive.methods import METHODS
from symgen.run.compiling.choices import mechanism_on_tree
from symgen.run.compiling.free_by_loops import free_velocities

MODELS = (
    *("four-bar", "slider-crank", "andrews", "jansen-leg", "n-four-bar:10", "spatial-slider-crank", "bricard"),
    *("front-suspension", "stewart-platform", "chain:10"),
)
#: Accelerations and multipliers of all bodies by hand: of the four-bar from the acceleration of its crank, by division
#: by the sine of the angle between coupler and rocker, without a test; it fails where these are in line.
BY_HAND = {("four-bar", "bodies"): 115}
#: Functions of a round of the correction.
CORRECTION = ("geometry", "refactor", "spread")


def blocks(equations: Equations, plan: EliminationPlan, free: tuple[int, ...] = ()) -> dict[str, Block]:
    """Return the emitted functions of `direct-correction` by name, with a plan of elimination and free velocities."""
    method = METHODS.get("direct-correction", "")
    with patch("symgen.derive.lower.model.cheapest_plan", return_value=plan):
        model = lower_model(equations, "")
    law = lower_law(equations, model, method, method.complete_options({}), closing=closing_plan(equations, plan, free))
    return {block.name: block for block in (*model.blocks, *law.blocks)}


def rows(names: tuple[str, ...], casadi: bool) -> Iterator[list[str]]:
    """Yield the rows of the table."""
    if casadi:
        from benchmarks.peers.casadi_graph import shared_by_casadi
    for name in names:
        mechanism = symgen.load(name).mechanism
        for coordinates, described in (("bodies", mechanism), ("joints", mechanism_on_tree(mechanism))):
            equations = formulate(described)
            plan = cheapest_plan(equations)
            old, new = blocks(equations, EliminationPlan()), blocks(equations, plan, free_velocities(described))
            pivots = new.get(BY_PIVOTS, new["rhs"])
            yield [
                name,
                coordinates,
                f"{len(plan.rows)} of {equations.m}",
                *(str(block.operations) for block in (old["rhs"], pivots, new["rhs"])),
                *(str(sum(each[x].operations for x in CORRECTION if x in each)) for each in (old, new)),
                str(BY_HAND.get((name, coordinates), "")),
                *((str(shared_by_casadi(new["rhs"])),) if casadi else ()),
            ]


def main(names: tuple[str, ...] = MODELS) -> None:
    """Print the table."""
    table = Table("", "coordinates", "rows that fix", title="Operations")
    casadi = importlib.util.find_spec("casadi") is not None
    for head in (
        "`rhs` by S",
        "`rhs` by pivots",
        "`rhs`",
        "correction by S",
        "correction",
        "`rhs` by hand",
        *(("CasADi's `cse` of `rhs`",) if casadi else ()),
    ):
        table.add_column(head, justify="right")
    for row in rows(names, casadi):
        table.add_row(*row)
    show(table)
    if not casadi:
        print("No column of CasADi, which is not installed: pip install casadi.")


if __name__ == "__main__":
    main(tuple(sys.argv[1:]) or MODELS)
