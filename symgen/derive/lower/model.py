"""The program of a model, shared by all its methods."""

from __future__ import annotations

from symgen.base.ir.program import (
    CARRYING,
    JAMMING,
    MODE_NUMBERS,
    SECTIONS,
    STATUS,
    Block,
    ModelLayout,
    ModelProgram,
    OutputSlot,
    size_of_carrying,
)
from symgen.derive.formulate.equations import Equations
from symgen.derive.lower.factor import fill_of_order
from symgen.derive.lower.hoist import Hoister
from symgen.derive.lower.law import law_block
from symgen.derive.lower.modes_of_states import modes_of_states
from symgen.derive.lower.plans import cheapest_plan
from symgen.derive.lower.position_changes import position_change_blocks
from symgen.derive.lower.record import record_model
from symgen.derive.lower.scalar import ScalarNodes
from symgen.derive.lower.scalar_values import Outputs, to_status


def lower_model(equations: Equations, digest: str) -> ModelProgram:
    """Lower the shared functions: geometry with the rank-deciding factorisation, corrections, measures, observation.

    Parameters
    ----------
    equations : Equations
        The derived equations.
    digest : str
        Digest of the canonical description, for the emitted header.
    """
    m, plan = equations.m, cheapest_plan(equations)
    record = record_model().choose_solution(plan.schur)
    scalars = ScalarNodes(equations, record.operations, plan=plan)
    scalars.compute(record.output_operations)
    geometry, spread = record.parts
    sections: dict[str, tuple[int, int]] = {}
    offset = 0
    sizes = {"m": m, "nv": equations.nv, "jacobian": sum(e.slot is not None for e in scalars.jacobian)}
    for name, size in (
        ("status", len(STATUS)),
        ("winding", len(equations.windings)),  # right after the status: both are kept with every output
        ("modes", MODE_NUMBERS * sum(row.held is not None for row in equations.rows)),  # and so are these
        *((name, sizes[size]) for name, size in SECTIONS),
        *((name, len(scalars.stored[name])) for name in ("lower", "reciprocal") if name in scalars.stored),
        ("mass_entry", len(scalars.mass_entries)),
        (JAMMING, len(equations.drags)),
        (
            CARRYING,
            size_of_carrying(sum(row.bounded for row in equations.rows), any(x.signed for x in equations.drags)),
        ),
    ):
        if size or name not in ("winding", "modes", "mass_entry", JAMMING, CARRYING):
            sections[name] = (offset, size)
            offset += size
    layout = ModelLayout(
        *(equations.nq, equations.nv, m, len(equations.parameters), sections, len(equations.states)),
        switchable=sum(row.held is not None for row in equations.rows),
        bounded=sum(row.bounded for row in equations.rows),
    )
    hoister = Hoister(scalars.graph, layout.parameters)
    blocks = [
        law_block(hoister, scalars, geometry, modes_of_states(equations)),
        law_block(hoister, scalars, spread),
        measure_block(hoister, scalars),
        observe_block(hoister, scalars),
        hoister.block_with_hoisted("masses", "diagonal of M", diagonal_at_origin(scalars), ("p", "w")),
        *position_change_blocks(hoister, equations),
    ]
    if equations.bodies:
        outputs = [(OutputSlot("out", i), node) for i, node in enumerate(equations.bodies)]
        purpose = "coordinates, velocities and accelerations of bodies"
        blocks.append(hoister.block_with_hoisted("bodies", purpose, outputs, ("t", "y", "p", "w", "ydot", "out")))
    blocks.insert(0, hoister.prepare_block())
    return ModelProgram(
        name=equations.name,
        digest=digest,
        layout=layout,
        blocks=tuple(blocks),
        jacobian=scalars.jacobian,
        hoisted=len(hoister.slots),
        order=scalars.order,
        fill=fill_of_order(scalars.neighbours(scalars.rows), scalars.order),
        tables=equations.tables,
        plan=plan,
    )


def diagonal_at_origin(scalars: ScalarNodes) -> Outputs:
    """Return the diagonal of M; where it changes with the position, that at coordinates and time of 0."""
    equations, g = scalars.equations, scalars.graph
    diagonal = [(OutputSlot("mass", j), b.entries[k][k]) for b in equations.mass for k, j in enumerate(b.columns)]
    if not scalars.mass_entries:
        return diagonal
    origin = {("t", 0): g.zero} | {("q", i): g.zero for i in range(equations.nq)}
    origin |= {("q", i): g.one for i, _ in equations.spins}
    return [
        (target, node)
        for (target, _), node in zip(diagonal, g.replace_inputs([n for _, n in diagonal], origin), strict=True)
    ]


# -- blocks of the model ----------------------------------------------------------------------------------------------


def measure_block(hoister: Hoister, scalars: ScalarNodes) -> Block:
    """Return the block that measures a state after its geometry."""
    equations, residuals = scalars.equations, scalars.velocity_residuals()
    outputs: Outputs = [(OutputSlot("residual", i), node) for i, node in enumerate(residuals)]
    outputs += scalars.violation("velocity", residuals)
    outputs += [to_status("kinetic", equations.kinetic), to_status("potential", equations.potential)]
    outputs += [(OutputSlot("winding", i), node) for i, node in enumerate(equations.windings)]
    outputs += [(OutputSlot("modes", place), node) for place, node in equations.renewed]
    purpose = "D v - nu with the D and nu that `geometry` left, and the energies"
    return hoister.block_with_hoisted("measure", purpose, outputs, ("t", "y", "p", "w"))


def observe_block(hoister: Hoister, scalars: ScalarNodes) -> Block:
    """Return the block of quantities reported at outputs only."""
    g, e = hoister.graph, scalars.equations
    changes = scalars.product(scalars.rows, scalars.section("rates.v", e.nv))
    left = [
        scalars.node_in_force(i, g.sub(n, row.gamma)) for i, (n, row) in enumerate(zip(changes, e.rows, strict=True))
    ]
    outputs: Outputs = [(OutputSlot("out", i), n) for i, n in enumerate(left)]
    for k, c in enumerate(e.joint_coordinates):
        outputs += [(OutputSlot("out", e.m + 2 * k), c.value), (OutputSlot("out", e.m + 2 * k + 1), c.rate)]
    return hoister.block_with_hoisted(
        "observe", "D v' - gamma, then joint coordinates and their rates", outputs, ("t", "y", "p", "w", "ydot", "out")
    )
