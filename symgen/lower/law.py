"""The program of a law: what one method adds to its model's program."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from symgen.formulate.equations import Equations
from symgen.ir.program import Block, LawProgram, Layout, ModelProgram, Target
from symgen.lower.algebra import System
from symgen.lower.descriptor import descriptor_form
from symgen.lower.factor import Factor
from symgen.lower.hoist import Hoister
from symgen.lower.parts import (
    Outputs,
    Stored,
    geometry_outputs,
    loaded_rows,
    pivot_outputs,
    spread,
    to_status,
    transposed_product,
)
from symgen.lower.vectors import Sparse, Vector
from symgen.methods._base import Acceleration, Dense, Iteration, Method, multiplier_law

#: Room for columns of a tangent basis beyond nv - m: dependent rows add to the degrees of freedom.
_SPARE_DEGREES = 6

_RHS = ("t", "y", "p", "w", "iw", "ydot")


def lower_law(
    equations: Equations, model: ModelProgram, method: Method, options: Mapping[str, str], implicit: bool = False
) -> LawProgram:
    """Lower one method: its acceleration law, and its correction where the model's does not do.

    Parameters
    ----------
    equations : Equations
        The derived equations.
    model : ModelProgram
        The program of the model.
    method : Method
        The method.
    options : mapping
        Its structural options, complete.
    implicit : bool
        Whether the descriptor form for implicit integrators is added.
    """
    builder = _Builder(equations, model, method)
    law = method.law(builder.system, options)
    if isinstance(law, Acceleration):
        form = "direct"
        builder.direct(law, "accelerate" if method.integrates == "independent" else "rhs")
    elif isinstance(law, Iteration):
        form = "iterated"
        builder.iterated(law)
    elif isinstance(law, Dense):
        form = "dense"
        builder.orthogonal(law)
    else:
        form = "tangent"
        builder.tangent()
    correction = method.correction(options)
    if correction.metric == "mass":
        builder.mass_metric()
    elif correction.metric == "independent":
        builder.independent_metric()
    elif correction.metric == "augmented":
        builder.augmented_metric()
    unknowns, level = 0, ""
    pattern: tuple[tuple[int, int], ...] = ()
    if implicit:
        descriptor = method.descriptor(builder.system, options)
        assert descriptor is not None, "the caller has checked that the method gives a form the integrator solves"
        found = descriptor_form(builder.hoister, builder.system, descriptor)
        builder.blocks += found.blocks
        unknowns, level, pattern = found.unknowns, descriptor.level, found.pattern
    return LawProgram(
        method=method.name,
        key=method.stem(options, implicit),
        layout=Layout(equations.nq, equations.nv, equations.m, len(equations.parameters), builder.sections),
        blocks=(builder.hoister.prepare(), *builder.blocks),
        parameters=tuple((p.name, p.default) for p in method.parameters),
        parameter_offset=builder.parameter_offset,
        hoisted=len(builder.hoister.slots),
        form=form,
        closed=method.integrates == "independent",
        correction=correction,
        options=dict(options),
        degrees=builder.degrees,
        unknowns=unknowns,
        level=level,
        tangent=pattern,
    )


class _Builder:
    """Collects the blocks and scratch sections of one law."""

    def __init__(self, equations: Equations, model: ModelProgram, method: Method) -> None:
        self.equations, self.model, self.method = equations, model, method
        self.parameter_offset = model.layout.parameters + model.hoisted
        self.system = System(equations, [p.name for p in method.parameters], self.parameter_offset)
        self.hoister = Hoister(self.system.graph, self.parameter_offset + len(method.parameters))
        self.sections = dict(model.layout.sections)
        self.size = model.layout.nw
        self.blocks: list[Block] = []
        self.degrees = 0

    def section(self, name: str, size: int) -> None:
        """Add a section of the law's own to ``w``."""
        self.sections[name] = (self.size, size)
        self.size += size

    # -- laws --------------------------------------------------------------------------------------------------------

    def direct(self, law: Acceleration, name: str) -> None:
        """Add the whole law as one straight-line function."""
        purpose = f"q', v', power and multipliers by {self.method.name}"
        flag = self.system.flag()
        if flag is not None:
            purpose += "; 1 where a pivot of S is suspicious"
        outputs = self._rates(law.acceleration, law.multipliers)
        outputs += [(Target("multipliers", i), n) for i, n in enumerate(law.multipliers)]
        self.blocks.append(self.hoister.block(name, purpose, outputs, _RHS, flag))

    def _rates(self, acceleration: Vector, multipliers: Vector, position: Vector | None = None) -> Outputs:
        e, g = self.equations, self.system.graph
        outputs: Outputs = [(Target("ydot", i), n) for i, n in enumerate(e.q_rates if position is None else position)]
        outputs += [(Target("ydot", e.nq + i), n) for i, n in enumerate(acceleration)]
        power = g.sub(e.power, multipliers.dot(self.system.nu).node)
        outputs.append((Target("ydot", e.nq + e.nv), power))
        return outputs

    def iterated(self, law: Iteration) -> None:
        """Add what an iterated law is put together from: ``begin``, ``iterate`` and ``finish``."""
        g, system = self.system.graph, self.system
        for name, size in system.kept_sections.items():
            self.section(name, size)
        for state in law.state:
            if state.section not in self.sections:
                self.section(state.section, len(state.start.nodes))
        begin: Outputs = list(system.kept)
        iterate: Outputs = []
        for state in law.state:
            begin += [(Target(state.section, i), n) for i, n in enumerate(state.start)]
            iterate += [(Target(state.section, i), n) for i, n in enumerate(state.following)]
        relative = g.div(
            law.increment.dot(law.increment).node,
            g.add(g.one, law.state[0].following.dot(law.state[0].following).node),
        )
        iterate.append(to_status("increment", g.call("sqrt", relative)))
        final = [system.variable(s.section, len(s.start.nodes)) for s in law.state]
        if law.rates is None:
            finish = self._rates(final[0], final[1])
        else:
            finish = self._rates(law.rates.velocity, law.rates.multipliers, law.rates.position)
            # what is integrated is not v: v' and lambda for results come from a law of their own
            observed = multiplier_law(system, system.gamma)
            outputs = self._rates(observed.acceleration, observed.multipliers)
            outputs += [(Target("multipliers", i), n) for i, n in enumerate(observed.multipliers)]
            self.blocks.append(self.hoister.block("rates", "q', v' and multipliers for results", outputs, _RHS))
        add = self.hoister.block
        self.blocks += [
            add("begin", "matrices and start of the iteration", begin, ("t", "y", "p", "w")),
            add("iterate", f"one iteration of {self.method.name}", iterate, ("p", "w")),
            add("finish", "rates of the state, and power", finish, ("t", "y", "p", "w", "ydot")),
        ]

    def tangent(self) -> None:
        """Add what a law on a tangent basis is put together from."""
        e, g, system, jacobian = self.equations, self.system.graph, self.system, self.model.jacobian
        # redundant rows leave more degrees of freedom than the count of rows says
        self.degrees = min(e.nv, max(1, e.nv - e.m) + _SPARE_DEGREES)
        self._dense()
        for name, size in {
            **{"basis": e.nv * self.degrees, "trial": e.nv * self.degrees, "small": self.degrees**2},
            **{"reduced": self.degrees, "force": e.nv, "weighed": e.nv},
        }.items():
            self.section(name, size)
        constraints = Sparse(g, tuple(tuple(row) for row in loaded_rows(g, jacobian, e.m)), e.nv)
        factor = Stored(g, system.gram_factor()).loaded("lower", "reciprocal")
        change = system.variable("change", e.nv)
        accelerations = Vector(g, tuple(g.input("ydot", e.nq + j) for j in range(e.nv)))
        rest = system.f - system.mass(accelerations)
        multipliers = system.solve(factor, constraints @ rest)
        add = self.hoister.block
        finish = [
            *((Target("ydot", i), n) for i, n in enumerate(e.q_rates)),
            *_to("multipliers", multipliers),
            (Target("ydot", e.nq + e.nv), g.sub(e.power, multipliers.dot(system.nu).node)),
        ]
        aim = [*_to("residual", [g.neg(n) for n in system.gamma]), *_to("force", system.f)]
        self.blocks += [
            add("aim", "the section `residual` = -gamma, the section `force` = f", aim, ("t", "y", "p", "w")),
            add("strike", "the section `residual` = D times `change`", _to("residual", constraints @ change), ("w",)),
            add("weigh", "the section `weighed` = M times `change`", _to("weighed", system.mass(change)), ("p", "w")),
            add("finish", "q', power and multipliers", finish, ("t", "y", "p", "w", "ydot")),
        ]

    def orthogonal(self, law: Dense) -> None:
        """Add what a law on an orthogonal factorisation of D^T is put together from."""
        e, g, system = self.equations, self.system.graph, self.system
        self._dense()
        for name, size in {
            **{"row_length": e.m, "row_chosen": e.m, "row_corner": e.m, "row_factor": e.m},
            **{"basis": e.nv * e.nv, "small": e.nv * e.nv, "reduced": e.nv, "force": e.nv, "weighed": e.nv},
        }.items():
            self.section(name, size)
        change = system.variable("change", e.nv)
        multipliers = system.variable("multipliers", e.m)
        add = self.hoister.block
        finish = [
            *((Target("ydot", i), n) for i, n in enumerate(e.q_rates)),
            (Target("ydot", e.nq + e.nv), g.sub(e.power, multipliers.dot(system.nu).node)),
        ]
        aim = [*_to("residual", law.target), *_to("force", system.f)]
        self.blocks += [
            add("aim", "the section `residual` = what D v' shall be, `force` = f", aim, ("t", "y", "p", "w")),
            add("weigh", "the section `weighed` = M times `change`", _to("weighed", system.mass(change)), ("p", "w")),
            add("finish", "q' and power", finish, ("t", "y", "p", "w", "ydot")),
        ]

    def _dense(self) -> None:
        """Add D as a dense matrix, for the choice of independent columns, or for an orthogonal factorisation."""
        if "dense" in self.sections:
            return
        e, dense = self.equations, list[tuple[Target, int]]()
        self.section("dependent", e.nv)
        self.section("dense", e.m * e.nv)
        for row, entries in enumerate(loaded_rows(self.system.graph, self.model.jacobian, e.m)):
            dense += [(Target("dense", row * e.nv + column), node) for column, node in entries]
        self.blocks.append(self.hoister.block("expand", "D as a dense matrix", dense, ("p", "w")))

    # -- metrics of corrections ----------------------------------------------------------------------------------------

    def mass_metric(self) -> None:
        """Add geometry and spread in the metric of M: S = D M^-1 D^T, rows skipped as D D^T decides."""
        system = self.system
        rank = system.gram_factor()
        self._weighted(rank, system.factor_with(rank, system.gram(system.inverse_mass)), system.minv, "D M^-1 D^T", [])

    def independent_metric(self) -> None:
        """Add geometry and spread that change dependent coordinates only: W^-1 = P, in ``dependent``."""
        e, g, system = self.equations, self.system.graph, self.system
        self._dense()
        weight = [{j: g.input("dependent", j)} for j in range(e.nv)]
        rank = system.gram_factor()
        factor = system.factor_with(rank, system.gram(weight))
        # det(D P D^T) / det(D D^T): squared cosines of the angles between tangent space and independent coordinates
        quality = g.one
        for i in factor.order:
            kept = g.mul(rank.pivots[i], rank.reciprocal[i])  # 0 for rows that D D^T skips: they say nothing
            ratio = g.mul(factor.pivots[i], rank.reciprocal[i])
            quality = g.mul(quality, g.add(ratio, g.sub(g.one, kept)))

        def project(x: Vector) -> Vector:
            return Vector(g, tuple(g.mul(weight[j][j], n) for j, n in enumerate(x)))

        self._weighted(rank, factor, project, "D P D^T", [to_status("partition_quality", quality)])

    def _weighted(
        self, rank: Factor, factor: Factor, weight: Callable[[Vector], Vector], matrix: str, more: Outputs
    ) -> None:
        system, jacobian = self.system, self.model.jacobian
        stored = Stored(system.graph, factor)
        self.section("law_lower", len(stored.lower))
        self.section("law_reciprocal", len(stored.reciprocal))
        outputs = [
            *geometry_outputs(system, jacobian),
            *pivot_outputs(system, rank),
            *more,
            *stored.outputs("law_lower", "law_reciprocal"),
        ]
        purpose = f"Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of {matrix}"
        self.blocks += [
            self.hoister.block("geometry", purpose, outputs, ("t", "y", "p", "w")),
            spread(self.hoister, self.equations, jacobian, stored, ("law_lower", "law_reciprocal"), weight),
        ]

    def augmented_metric(self) -> None:
        """Add the mass-orthogonal projection by iterations with M + a D^T D (Bayo and Ledesma 1996).

        ``(M + a D^T D) dv = -M delta - D^T (a r + lambda)``, ``delta += dv``, ``lambda += a r`` with the residual r of
        positions or velocities after the change; delta and lambda are kept in sections of their own. The block raises
        lambda before it solves, so lambda begins at -a r.
        """
        e, g, system = self.equations, self.system.graph, self.system
        penalties = system.penalties(system.parameter("penalty"))
        rank, factor = system.gram_factor(), system.augmented_factor(penalties)
        stored = Stored(g, factor)
        self.section("law_lower", len(stored.lower))
        self.section("law_reciprocal", len(stored.reciprocal))
        self.section("moved", e.nv)
        self.section("force_of_constraints", e.m)
        outputs = [
            *geometry_outputs(system, self.model.jacobian),
            *pivot_outputs(system, rank),
            *stored.outputs("law_lower", "law_reciprocal"),
        ]
        residual = Vector(g, tuple(g.input("residual", i) for i in range(e.m)))
        moved = Vector(g, tuple(g.input("moved", j) for j in range(e.nv)))
        forces = Vector(g, tuple(g.input("force_of_constraints", i) for i in range(e.m)))
        raised = forces + penalties.times(residual)
        pressed = raised + penalties.times(residual)
        right = system.mass(moved) + Vector(g, tuple(transposed_product(g, self.model.jacobian, pressed.nodes, e.nv)))
        x = stored.loaded("law_lower", "law_reciprocal").solve(g, [g.neg(n) for n in right])
        changes = [
            *_to("change", x),
            *((Target("moved", j), g.add(moved.nodes[j], n)) for j, n in enumerate(x)),
            *_to("force_of_constraints", raised),
        ]
        purpose = "Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of M + a D^T D"
        self.blocks += [
            self.hoister.block("geometry", purpose, outputs, ("t", "y", "p", "w")),
            self.hoister.block("spread", "one iteration of the mass-orthogonal projection", changes, ("p", "w")),
        ]


def _to(section: str, nodes: Vector | list[int]) -> Outputs:
    return [(Target(section, i), n) for i, n in enumerate(nodes)]
