"""From equations to programs: what every method of the model shares, and what one method adds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symgen.formulate.equations import Equations
from symgen.ir.graph import Graph
from symgen.ir.program import COUNTERS, STATUS, Block, Entry, LawProgram, Layout, ModelProgram, Target
from symgen.lower.algebra import SKIP, System, Vector
from symgen.lower.factor import Factor
from symgen.lower.hoist import Hoister
from symgen.methods._base import Method

__all__ = ["COUNTERS", "STATUS", "lower_law", "lower_model"]

Outputs = list[tuple[Target, int]]


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
    jacobian = _jacobian(g, equations)
    stored = _Stored(g, factor)
    sections: dict[str, tuple[int, int]] = {}
    offset = 0
    sizes = {
        "status": len(STATUS),
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
        sections[name] = (offset, size)
        offset += size
    layout = Layout(equations.nq, equations.nv, m, len(equations.parameters), sections)
    hoister = Hoister(g, layout.parameters)
    blocks = [
        hoister.block(
            "geometry",
            "Phi, nu, D, and the factorisation of D D^T that decides rank",
            [
                *_geometry_outputs(system, jacobian),
                *_pivot_outputs(system, factor),
                *stored.outputs("lower", "reciprocal"),
            ],
            ("t", "y", "p", "w"),
        ),
        _spread(hoister, equations, jacobian, stored, None),
        _measure(hoister, equations, jacobian),
        _observe(hoister, system),
        hoister.block(
            "masses",
            "diagonal of M",
            [(Target("mass", j), b.entries[k][k]) for b in equations.mass for k, j in enumerate(b.columns)],
            ("p", "w"),
        ),
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


def lower_law(equations: Equations, model: ModelProgram, method: Method, options: Mapping[str, str]) -> LawProgram:
    """Lower one method: its acceleration law, and its correction where the metric is not the identity."""
    layout = model.layout
    offset = layout.parameters + model.hoisted
    system = System(equations, [p.name for p in method.parameters], offset)
    g = system.graph
    law = method.accelerations(system, options)
    outputs: Outputs = [(Target("ydot", i), n) for i, n in enumerate(equations.q_rates)]
    outputs += [(Target("ydot", layout.nq + i), n) for i, n in enumerate(law.acceleration)]
    power = g.sub(equations.power, law.multipliers.dot(system.nu).node)
    outputs.append((Target("ydot", layout.nq + layout.nv), power))
    outputs += [(Target("multipliers", i), n) for i, n in enumerate(law.multipliers)]

    hoister = Hoister(g, offset + len(method.parameters))
    blocks = [
        hoister.block(
            "rhs",
            f"q', v', power and multipliers by {method.name}; 1 where a pivot of S is suspicious",
            outputs,
            ("t", "y", "p", "w", "iw", "ydot"),
            system.flag(),
        )
    ]
    metric = method.metric(options)
    sections = dict(layout.sections)
    if metric == "mass" and (method.position_correction or method.velocity_correction):
        blocks += _mass_metric(hoister, system, model.jacobian, sections, layout.nw)
    blocks.insert(0, hoister.prepare())
    return LawProgram(
        method=method.name,
        key=method.stem(options),
        layout=Layout(layout.nq, layout.nv, layout.m, layout.parameters, sections),
        blocks=tuple(blocks),
        parameters=tuple((p.name, p.default) for p in method.parameters),
        parameter_offset=offset,
        hoisted=len(hoister.slots),
        position_correction=method.position_correction,
        velocity_correction=method.velocity_correction,
        metric=metric,
        options=dict(options),
    )


# -- parts ------------------------------------------------------------------------------------------------------------


class _Stored:
    """The variable entries of a factor, kept in ``w`` between the block that factorises and those that solve."""

    def __init__(self, graph: Graph, factor: Factor) -> None:
        self.graph, self.factor = graph, factor
        self.lower = [(k, i, n) for k in factor.order for i, n in factor.lower[k] if graph.value(n) is None]
        self.reciprocal = [(k, factor.reciprocal[k]) for k in factor.order if graph.value(factor.reciprocal[k]) is None]

    def outputs(self, lower: str, reciprocal: str) -> Outputs:
        """Return what the factorising block writes."""
        return [(Target(lower, i), n) for i, (_, _, n) in enumerate(self.lower)] + [
            (Target(reciprocal, i), n) for i, (_, n) in enumerate(self.reciprocal)
        ]

    def loaded(self, lower: str, reciprocal: str) -> Factor:
        """Return the factor as the solving block reads it."""
        g, f = self.graph, self.factor
        slots = {(k, i): g.input(lower, s) for s, (k, i, _) in enumerate(self.lower)}
        columns = {k: tuple((i, slots.get((k, i), n)) for i, n in f.lower[k]) for k in f.order}
        reciprocals = dict(f.reciprocal) | {k: g.input(reciprocal, s) for s, (k, _) in enumerate(self.reciprocal)}
        return Factor(f.order, columns, reciprocals, f.pivots, f.diagonal)


def _jacobian(g: Graph, equations: Equations) -> tuple[Entry, ...]:
    entries: list[Entry] = []
    slot = 0
    for i, row in enumerate(equations.rows):
        for j, node in row.entries:
            constant = g.value(node)
            entries.append(Entry(i, j, constant, None if constant is not None else slot))
            slot += constant is None
    return tuple(entries)


def _geometry_outputs(system: System, jacobian: Sequence[Entry]) -> Outputs:
    g, rows = system.graph, system.equations.rows
    outputs: Outputs = [(Target("residual", i), n) for i, n in enumerate(system.phi)]
    outputs.append(_status("position_violation", g.call("sqrt", system.phi.dot(system.phi).node)))
    outputs += [(Target("nu", i), r.nu) for i, r in enumerate(rows) if r.nu != g.zero]
    entries = [node for row in rows for _, node in row.entries]
    outputs += [(Target("jacobian", e.slot), n) for e, n in zip(jacobian, entries, strict=True) if e.slot is not None]
    return outputs


def _pivot_outputs(system: System, factor: Factor) -> Outputs:
    """Relative pivots (the squared sine of the angle between a row and those eliminated before it), the rank they decide,
    and the smallest one over the rows that are not masked.
    """
    g = system.graph
    outputs: Outputs = []
    rank, smallest = g.zero, g.one
    for i in range(len(factor.order)):
        if factor.pivots[i] == factor.diagonal[i]:
            rank = g.add(rank, g.one)
            continue
        relative = g.div(factor.pivots[i], factor.diagonal[i])
        outputs.append((Target("pivot", i), relative))
        rank = g.add(rank, g.call("step", factor.pivots[i], g.mul(g.constant(SKIP), factor.diagonal[i])))
        smallest = g.call("min", smallest, g.add(relative, system.mask[i]))
    return [*outputs, _status("rank", rank), _status("smallest_pivot", smallest)]


def _status(name: str, node: int) -> tuple[Target, int]:
    return Target("status", STATUS.index(name)), node


def _loaded_rows(g: Graph, jacobian: Sequence[Entry], m: int) -> list[list[tuple[int, int]]]:
    rows: list[list[tuple[int, int]]] = [[] for _ in range(m)]
    for e in jacobian:
        node = g.constant(e.constant) if e.constant is not None else g.input("jacobian", e.slot or 0)
        rows[e.row].append((e.column, node))
    return rows


def _spread(
    hoister: Hoister, equations: Equations, jacobian: Sequence[Entry], stored: _Stored, system: System | None
) -> Block:
    """The correction x = -D^+ r of a residual r, D^+ = W^-1 D^T (D W^-1 D^T)^-1; W is M where `system` is given, else 1."""
    g = hoister.graph
    names = ("lower", "reciprocal") if system is None else ("law_lower", "law_reciprocal")
    y = stored.loaded(*names).solve(g, [g.neg(g.input("residual", i)) for i in range(equations.m)])
    x = [g.zero] * equations.nv
    for i, row in enumerate(_loaded_rows(g, jacobian, equations.m)):
        for j, entry in row:
            x[j] = g.add(x[j], g.mul(entry, y[i]))
    if system is not None:
        x = list(system.minv(Vector(g, tuple(x))))
    outputs = [(Target("change", j), n) for j, n in enumerate(x)]
    return hoister.block(
        "spread", "the correction -D^+ times the section `residual`, of v, or of q by N", outputs, ("p", "w")
    )


def _measure(hoister: Hoister, equations: Equations, jacobian: Sequence[Entry]) -> Block:
    g = hoister.graph
    outputs: Outputs = []
    residuals: list[int] = []
    for i, row in enumerate(_loaded_rows(g, jacobian, equations.m)):
        total = g.total(g.mul(e, g.input("v", j)) for j, e in row)
        if equations.rows[i].nu != g.zero:
            total = g.sub(total, g.input("nu", i))
        residuals.append(total)
        outputs.append((Target("residual", i), total))
    outputs.append(_status("velocity_violation", g.call("sqrt", g.dot(residuals, residuals))))
    outputs += [_status("kinetic", equations.kinetic), _status("potential", equations.potential)]
    purpose = "D v - nu with the D and nu that `geometry` left, and the energies"
    return hoister.block("measure", purpose, outputs, ("t", "y", "p", "w"))


def _observe(hoister: Hoister, system: System) -> Block:
    g, e = system.graph, system.equations
    accelerations = Vector(g, tuple(g.input("ydot", e.nq + i) for i in range(e.nv)))
    outputs: Outputs = [(Target("out", i), n) for i, n in enumerate(system.D @ accelerations - system.gamma)]
    for k, c in enumerate(e.joint_coordinates):
        outputs += [(Target("out", e.m + 2 * k), c.value), (Target("out", e.m + 2 * k + 1), c.rate)]
    return hoister.block(
        "observe", "D v' - gamma, then joint coordinates and their rates", outputs, ("t", "y", "p", "w", "ydot", "out")
    )


def _mass_metric(
    hoister: Hoister, system: System, jacobian: Sequence[Entry], sections: dict[str, tuple[int, int]], nw: int
) -> list[Block]:
    """Geometry and spread in the metric of M: S = D M^-1 D^T is factorised, rows being skipped as D D^T decides."""
    g = system.graph
    rank = system.gram_factor()
    factor = system.schur_with(rank)
    stored = _Stored(g, factor)
    sections["law_lower"] = (nw, len(stored.lower))
    sections["law_reciprocal"] = (nw + len(stored.lower), len(stored.reciprocal))
    geometry = hoister.block(
        "geometry",
        "Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T",
        [
            *_geometry_outputs(system, jacobian),
            *_pivot_outputs(system, rank),
            *stored.outputs("law_lower", "law_reciprocal"),
        ],
        ("t", "y", "p", "w"),
    )
    return [geometry, _spread(hoister, system.equations, jacobian, stored, system)]
