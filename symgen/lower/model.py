"""The program of a model: what every method of it shares."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.formulate.equations import Equations
from symgen.ir.program import STATUS, Block, Entry, Layout, ModelProgram, Target
from symgen.lower.algebra import System
from symgen.lower.hoist import Hoister
from symgen.lower.manifold import manifold_blocks
from symgen.lower.parts import (
    Outputs,
    Stored,
    constraint_entries,
    geometry_outputs,
    loaded_rows,
    pivot_outputs,
    spread,
    to_status,
)
from symgen.lower.vectors import Vector


def lower_model(equations: Equations, digest: str) -> ModelProgram:
    """Lower what all methods share: geometry with the rank-deciding factorisation, corrections, measures, observation.

    Parameters
    ----------
    equations : Equations
        The derived equations.
    digest : str
        Digest of the canonical description, for the emitted header.
    """
    system = System(equations)
    g, m = system.graph, equations.m
    factor = system.gram_factor()
    jacobian = constraint_entries(g, equations)
    stored = Stored(g, factor)
    sections: dict[str, tuple[int, int]] = {}
    offset = 0
    sizes = {
        "status": len(STATUS),
        "winding": len(equations.windings),  # right behind the status: both are kept with every output
        "multipliers": m,
        "mask": m,
        "saved": m,
        "residual": m,
        "nu": m,
        "pivot": m,
        "change": equations.nv,
        "mass": equations.nv,
        "jacobian": sum(e.slot is not None for e in jacobian),
        "lower": len(stored.lower),
        "reciprocal": len(stored.reciprocal),
    }
    for name, size in sizes.items():
        if name == "winding" and not size:
            continue
        sections[name] = (offset, size)
        offset += size
    layout = Layout(equations.nq, equations.nv, m, len(equations.parameters), sections)
    hoister = Hoister(g, layout.parameters)
    blocks = [
        hoister.block(
            "geometry",
            "Phi, nu, D, and the factorisation of D D^T that decides rank",
            [
                *geometry_outputs(system, jacobian),
                *pivot_outputs(system, factor),
                *stored.outputs("lower", "reciprocal"),
            ],
            ("t", "y", "p", "w"),
        ),
        spread(hoister, equations, jacobian, stored),
        measure(hoister, equations, jacobian),
        observe(hoister, system),
        hoister.block(
            "masses",
            "diagonal of M",
            [(Target("mass", j), b.entries[k][k]) for b in equations.mass for k, j in enumerate(b.columns)],
            ("p", "w"),
        ),
        *manifold_blocks(hoister, equations),
    ]
    blocks.insert(0, hoister.prepare())
    return ModelProgram(
        name=equations.name,
        digest=digest,
        layout=layout,
        blocks=tuple(blocks),
        jacobian=jacobian,
        hoisted=len(hoister.slots),
        order=system.order,
        fill=sum(len(c) for c in factor.lower.values()) - sum(i > j for i, j in system.gram(None)),
        tables=equations.tables,
    )


# -- blocks of the model ----------------------------------------------------------------------------------------------


def measure(hoister: Hoister, equations: Equations, jacobian: Sequence[Entry]) -> Block:
    """Return the block that measures a state after its geometry."""
    g = hoister.graph
    outputs: Outputs = []
    residuals: list[int] = []
    for i, row in enumerate(loaded_rows(g, jacobian, equations.m)):
        total = g.total(g.mul(e, g.input("v", j)) for j, e in row)
        if equations.rows[i].nu != g.zero:
            total = g.sub(total, g.input("nu", i))
        residuals.append(total)
        outputs.append((Target("residual", i), total))
    outputs.append(to_status("velocity_violation", g.call("sqrt", g.dot(residuals, residuals))))
    outputs += [to_status("kinetic", equations.kinetic), to_status("potential", equations.potential)]
    outputs += [(Target("winding", i), node) for i, node in enumerate(equations.windings)]
    purpose = "D v - nu with the D and nu that `geometry` left, and the energies"
    return hoister.block("measure", purpose, outputs, ("t", "y", "p", "w"))


def observe(hoister: Hoister, system: System) -> Block:
    """Return the block of what is reported at outputs only."""
    g, e = system.graph, system.equations
    accelerations = Vector(g, tuple(g.input("ydot", e.nq + i) for i in range(e.nv)))
    outputs: Outputs = [(Target("out", i), n) for i, n in enumerate(system.D @ accelerations - system.gamma)]
    for k, c in enumerate(e.joint_coordinates):
        outputs += [(Target("out", e.m + 2 * k), c.value), (Target("out", e.m + 2 * k + 1), c.rate)]
    return hoister.block(
        "observe", "D v' - gamma, then joint coordinates and their rates", outputs, ("t", "y", "p", "w", "ydot", "out")
    )
