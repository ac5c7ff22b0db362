"""The descriptor form of a law as blocks: the residual that implicit integrators solve, and its derivatives."""

from __future__ import annotations

from dataclasses import replace

from symgen.base.ir.derivative import jacobian
from symgen.base.ir.program import Block, OutputSlot
from symgen.derive.formulate.equations import Equations
from symgen.derive.lower.hoist import Hoister
from symgen.derive.lower.recorded_law import EQUATIONS, RecordedLaw
from symgen.derive.lower.scalar import ScalarNodes
from symgen.derive.lower.scalar_values import Outputs, to_status


def unknowns_of_form(equations: Equations, form: RecordedLaw) -> int:
    """Return the number of unknowns of a form for implicit integrators.

    Parameters
    ----------
    equations : Equations
        The derived equations.
    form : RecordedLaw
        The form.

    Returns
    -------
    int
        q', v', multipliers, those of the stabilised form twice, and rates of states.
    """
    multipliers = equations.m * (2 if form.form == "stabilised" else 1)
    return equations.nq + equations.nv + multipliers + len(equations.states)


def blocks_of_form(
    hoister: Hoister, law: ScalarNodes, form: RecordedLaw, unknowns: int
) -> tuple[list[Block], tuple[tuple[int, int], ...]]:
    """Return the blocks ``residual`` and ``tangent``, and equation and unknown of each number of the latter.

    ``residual(t, y, k, p, w, r)`` writes F to r and the power of forces without potential and of drivers to the status;
    ``tangent(t, y, k, p, w, j)`` the structural nonzeros of dF/dk and dF/dy, equation by equation; from `unknowns` on,
    unknowns are q and v. Rates of states are the last unknowns, and the last of the derivatives by the state.

    Parameters
    ----------
    hoister : Hoister
        What stores numbers that parameters alone decide.
    law : ScalarNodes
        Values of the law.
    form : RecordedLaw
        The form.
    unknowns : int
        Their number, see `unknowns_of_form`.

    Returns
    -------
    blocks : list of Block
        The two functions.
    pattern : tuple of (int, int)
        Equation and unknown of each entry of ``tangent``.
    """
    e, scalars = law.equations, law.for_tape(form.operations)
    if e.drags:
        scalars.pressing = law.section("k_first", e.m)
    scalars.evaluate_remaining(range(len(form.operations)))
    (part,) = form.parts
    groups = {place: scalars.values[index] for place, index in part.outputs}
    rows = [(group, node) for group in EQUATIONS if group in groups for node in groups[group]]
    own = unknowns - len(e.states)
    g = law.graph
    for i in range(e.nq + e.nv, own):  # the equation of a row that is off: its unknown is 0
        group, node = rows[i]
        held = e.rows[(i - e.nq - e.nv) % e.m].held
        if held is not None:
            rows[i] = group, g.add(g.mul(held, node), g.mul(g.sub(g.one, held), g.input("k", i)))
    unknown = {("ydot", e.nq + i): g.input("k", e.nq + i) for i in range(e.nv)}
    unknown |= {("multipliers", i): g.input("k", e.nq + e.nv + i) for i in range(e.m)}
    rates = g.replace_inputs(e.state_rates, unknown) if e.reads_results else e.state_rates
    rows[own:own] = [("states", g.sub(g.input("k", own + i), rate)) for i, rate in enumerate(rates)]
    arguments = ("t", "y", "k", "p", "w", "r")
    residual = [(OutputSlot("r", i), node) for i, (_, node) in enumerate(rows)]
    residual.append(to_status("power", groups["power"]))
    first = {"k": 0, "q": unknowns, "v": unknowns + e.nq, "z": unknowns + own - 1}
    keys = [("k", i) for i in range(unknowns)] + [("q", i) for i in range(e.nq)] + [("v", i) for i in range(e.nv)]
    keys += [("z", i) for i in range(1, len(e.states) + 1)]
    tangent: Outputs = []
    pattern: list[tuple[int, int]] = []
    derived = range(unknowns)
    if form.form == "explicit":  # M and D are enough
        derived, keys = range(e.nq, e.nq + e.nv), keys[:unknowns]
    for i, derivatives in zip(derived, jacobian(law.graph, [rows[i][1] for i in derived], keys), strict=True):
        for space, index in sorted(derivatives):
            tangent.append((OutputSlot("j", len(tangent)), derivatives[space, index]))
            pattern.append((i, index + first[space]))
    entries = "entries of dF/dk and dF/dy of the descriptor form"
    return [
        replace(hoister.block_with_hoisted("residual", part.purpose, residual, arguments), role=part.role),
        replace(hoister.block_with_hoisted("tangent", entries, tangent, (*arguments[:-1], "j")), role=part.role),
    ], tuple(pattern)
