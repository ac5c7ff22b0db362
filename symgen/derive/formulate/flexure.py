"""Beam elements on the graph: deformation, energy, and the forces along their measures.

The deformation of an element is ``psi = log(H_a^-1 H_b)``. With s = 2 y, twice the vector between the frames along the
mean of their axes, and b = 2 sin(phi) times the axis of the relative rotation, both of which are sums of components:

    psi = (c s - k b (b . s), c b),    c = phi / (2 sin(phi)),    k = (2 c - 1) / (4 sin(phi)^2)

in space, and (c s, phi) in the plane. c is a polynomial, in the plane of phi^2 and in space of X = 3 - tr R =
4 sin(phi/2)^2, so that nothing branches and nothing is 0/0. The polynomials interpolate at Chebyshev's points and are
exact to rounding up to 1 rad.

The strain along the element is eps_0 + x eps'. To third order in its length h (Magnus 1954) ``psi = h eps_0 +
h^3/12 [eps_0, eps']``, and the least energy for a fixed psi is ``d^T F^-1 d / 2`` with
``F = h C + h/12 ad_psi C ad_psi^T``, d = psi - psi_0 and the compliances C. F is factorised, so that the energy is
positive for every psi. The derivatives are written with ``P = F^-1 d``, the force and moment in the middle, and
``z = C ad_psi^T P``:

    dU/du = P_u - h/12 z_w x P_u,    dU/dw = P_w - h/12 (z_u x P_u + z_w x P_w)
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from symgen.base.ir.graph import Graph
from symgen.base.vocabulary.measures import Exerted, Flexed, Flexure
from symgen.derive.formulate.exertion import Exertion, exertion_of_effort
from symgen.derive.formulate.measure_nodes import ModelNodes
from symgen.derive.formulate.vector_algebra import Triple, Vectors
from symgen.describe.mechanism import Force

#: (phi / (2 sin(phi)) - 1/2) / X as polynomials: of X = phi^2, and of X = 4 sin(phi/2)^2.
PLANE = (
    0.0833333333333333,
    0.009722222222229683,
    0.0010251322748866787,
    0.00010499338937181313,
    1.0668002641254997e-05,
    1.081748197120773e-06,
    1.0944999281316765e-07,
    1.1334729726974714e-08,
    9.405336743716293e-10,
    1.9314450479883942e-10,
)
SPACE = (
    0.08333333333333336,
    0.01666666666665895,
    0.0035714285718970273,
    0.0007936507825101004,
    0.00018037531756933965,
    4.162404021285129e-05,
    9.717177615260453e-06,
    2.2708156570980033e-06,
    5.717051734289924e-07,
    8.555376417390312e-08,
    7.139360495939216e-08,
    -1.595479009670583e-08,
    8.674838726041646e-09,
)


def exertions_of_force(model: ModelNodes, source: Force | Exerted) -> list[Exertion]:
    """Return the exertions of the efforts and beam elements of a force, measure by measure."""
    exerted = [exertion_of_effort(model, effort) for effort in source.efforts]
    return exerted + [
        part for flexure in source.flexures for part in Flexing(model, flexure).exertions_along_measures()
    ]


def flexure_component(model: ModelNodes, source: Flexed) -> int:
    """Return a component of the strain or of the force and moment in the middle of an element."""
    flexing, i = Flexing(model, source.flexure), source.component
    if source.stress:
        return model.graph.add(flexing.stress[i], flexing.damping_force[i])
    return model.graph.div(flexing.excess[i], flexing.length)


class Flexing:
    """A beam element in a model, as nodes; six components in space, three in the plane.

    Parameters
    ----------
    model : ModelNodes
        The mechanism.
    flexure : Flexure
        The element.
    """

    def __init__(self, model: ModelNodes, flexure: Flexure) -> None:
        g = self.graph = model.graph
        self.model, self.flexure = model, flexure
        self.length = model.expression(flexure.length)
        self.compliances = [model.expression(e) for e in flexure.compliances]
        self.measures = [model.measure(m) for m in flexure.measures]
        self.values = [m.value for m in self.measures]
        self.spatial, self.algebra = len(flexure.compliances) == 6, Vectors(g)
        if not self.spatial:
            self.values[2] = g.add(self.values[2], model.expression(flexure.turn))
        self.twelfth = g.mul(g.constant(1.0 / 12.0), self.length)

    # -- deformation -------------------------------------------------------------------------------------------------

    @cached_property
    def series_factors(self) -> tuple[int, int, int, int]:
        """The factor c and (c - 1/2) / X, each with its derivative with respect to X."""
        g, x = self.graph, self.series_argument
        value = slope = g.zero
        for coefficient in reversed(SPACE if self.spatial else PLANE):
            slope = g.add(g.mul(slope, x), value)
            value = g.add(g.mul(value, x), g.constant(coefficient))
        return g.add(g.constant(0.5), g.mul(x, value)), g.add(value, g.mul(x, slope)), value, slope

    @cached_property
    def series_argument(self) -> int:
        """The argument X of the series."""
        g = self.graph
        return g.sub(g.constant(3.0), self.values[6]) if self.spatial else g.mul(self.values[2], self.values[2])

    @cached_property
    def factor_across(self) -> tuple[int, int]:
        """The factor k = (c - 1/2) / X / (4 - X) and its derivative with respect to X."""
        g, (_, _, value, slope) = self.graph, self.series_factors
        rest = g.sub(g.constant(4.0), self.series_argument)
        k = g.div(value, rest)
        return k, g.div(g.add(slope, k), rest)

    @cached_property
    def vectors(self) -> tuple[Triple, Triple]:
        """The vectors s and b."""
        v = self.values
        return (v[0], v[1], v[2]), (v[3], v[4], v[5])

    @cached_property
    def deformation(self) -> list[int]:
        """The components of psi."""
        g, v, c = self.graph, self.algebra, self.series_factors[0]
        if not self.spatial:
            return [g.mul(c, self.values[0]), g.mul(c, self.values[1]), self.values[2]]
        s, b = self.vectors
        pull = g.mul(self.factor_across[0], v.dot(b, s))
        return [*v.sub(v.scale(c, s), v.scale(pull, b)), *v.scale(c, b)]

    @cached_property
    def rate(self) -> list[int]:
        """The rate of psi along the motion."""
        g, v, (c, slope, _, _) = self.graph, self.algebra, self.series_factors
        rates = [m.rate(g, self.model.velocities) for m in self.measures]
        if not self.spatial:
            change = g.mul(g.mul(g.constant(2.0), slope), g.mul(self.values[2], rates[2]))
            parts = [g.add(g.mul(c, rates[i]), g.mul(change, self.values[i])) for i in range(2)]
            return [*parts, rates[2]]
        (s, b), (k, bent), x = self.vectors, self.factor_across, g.neg(rates[6])
        ds, db, change = v.triple(rates[:3]), v.triple(rates[3:6]), g.mul(slope, x)
        along = v.dot(b, s)
        pull = g.add(g.mul(g.mul(bent, x), along), g.mul(k, g.add(v.dot(db, s), v.dot(b, ds))))
        moved = v.add(v.scale(c, ds), v.scale(change, s))
        moved = v.sub(moved, v.add(v.scale(pull, b), v.scale(g.mul(k, along), db)))
        return [*moved, *v.add(v.scale(c, db), v.scale(change, b))]

    @cached_property
    def excess(self) -> list[int]:
        """The deformation relative to the unloaded element, d = psi - psi_0."""
        rest = [self.model.expression(e) for e in self.flexure.rest]
        return [self.graph.sub(p, r) for p, r in zip(self.deformation, rest, strict=True)]

    # -- forces ------------------------------------------------------------------------------------------------------

    @cached_property
    def flexibility(self) -> list[list[int]]:
        """The lower triangle of F."""
        return self.flexibility_of(self.compliances)

    def flexibility_of(self, c: Sequence[int]) -> list[list[int]]:
        """Return the lower triangle of F for a diagonal of C."""
        g, v, h, k = self.graph, self.algebra, self.length, self.twelfth
        psi = self.deformation
        if self.spatial:
            nothing, u, w = (g.zero,) * 3, v.triple(psi[:3]), v.triple(psi[3:])
            units = [v.triple([g.one if i == j else g.zero for j in range(3)]) for i in range(3)]
            columns = [[*v.cross(w, e), *nothing] for e in units] + [[*v.cross(u, e), *v.cross(w, e)] for e in units]
        else:
            turn = psi[2]
            columns = [[g.zero, turn, g.zero], [g.neg(turn), g.zero, g.zero], [psi[1], g.neg(psi[0]), g.zero]]
        weighted = [[g.mul(c[j], x) for x in column] for j, column in enumerate(columns)]
        rows = [
            [g.mul(k, g.sum_of(g.mul(columns[m][i], weighted[m][j]) for m in range(len(c)))) for j in range(i + 1)]
            for i in range(len(c))
        ]
        for i, row in enumerate(rows):
            row[i] = g.add(g.mul(h, c[i]), row[i])
        return rows

    @cached_property
    def factors(self) -> tuple[list[list[int]], list[int]]:
        """The factors of F = L D L^T: L below its diagonal of ones, and 1 / D."""
        g, f = self.graph, self.flexibility
        lower, inverse = list[list[int]](), list[int]()
        for i, row in enumerate(f):
            scaled = list[int]()
            for j in range(i):
                scaled.append(g.sub(row[j], g.dot(scaled, lower[j])))
            lower.append([g.mul(x, inverse[j]) for j, x in enumerate(scaled)])
            inverse.append(g.div(g.one, g.sub(row[i], g.dot(lower[i], scaled))))
        return lower, inverse

    def solve_flexibility(self, right: Sequence[int]) -> list[int]:
        """Return F^-1 times a vector."""
        g, (lower, inverse) = self.graph, self.factors
        forward = list[int]()
        for row, x in zip(lower, right, strict=True):
            forward.append(g.sub(x, g.dot(row, forward)))
        result = [g.mul(x, d) for x, d in zip(forward, inverse, strict=True)]
        for i in reversed(range(len(result))):
            for j in range(i):
                result[j] = g.sub(result[j], g.mul(lower[i][j], result[i]))
        return result

    @cached_property
    def stress(self) -> list[int]:
        """The force and moment in the middle, P = F^-1 d."""
        return self.solve_flexibility(self.excess)

    @cached_property
    def damping_force(self) -> list[int]:
        """The damping force and moment: tau F^-1 psi', or F^-1 F_T F^-1 psi' with a time for each strain."""
        g, damping = self.graph, self.flexure.damping
        if isinstance(damping, tuple):
            times = [self.model.expression(e) for e in damping]
            delayed = self.flexibility_of([g.mul(c, x) for c, x in zip(self.compliances, times, strict=True)])
            return self.solve_flexibility(_product_with_symmetric(g, delayed, self.solve_flexibility(self.rate)))
        time = self.model.expression(damping)
        if time == g.zero:
            return [time] * len(self.compliances)
        return [g.mul(time, x) for x in self.solve_flexibility(self.rate)]

    @cached_property
    def gradient(self) -> list[int]:
        """The gradient of the energy in psi."""
        g, v, c, k = self.graph, self.algebra, self.compliances, self.twelfth
        p, psi = self.stress, self.deformation
        if not self.spatial:
            moment = g.sub(g.mul(psi[0], p[1]), g.mul(psi[1], p[0]))
            lever = g.mul(g.mul(k, c[2]), moment)
            spread = g.add(g.mul(c[1], g.mul(p[0], p[0])), g.mul(c[0], g.mul(p[1], p[1])))
            return [
                g.sub(p[0], g.mul(lever, p[1])),
                g.add(p[1], g.mul(lever, p[0])),
                g.sub(p[2], g.mul(g.mul(k, psi[2]), spread)),
            ]
        pu, pw, u, w = v.triple(p[:3]), v.triple(p[3:]), v.triple(psi[:3]), v.triple(psi[3:])
        zu, zw = v.cross(pu, w), v.add(v.cross(pu, u), v.cross(pw, w))
        zu, zw = (
            v.triple([g.mul(g.mul(k, a), x) for a, x in zip(c[i : i + 3], z, strict=True)])
            for i, z in ((0, zu), (3, zw))
        )
        return [*v.sub(pu, v.cross(zw, pu)), *v.sub(pw, v.add(v.cross(zu, pu), v.cross(zw, pw)))]

    def forces_along_measures(self, force: Sequence[int]) -> list[int]:
        """Return the forces along the measures for forces along psi."""
        g, v, (c, slope, _, _) = self.graph, self.algebra, self.series_factors
        if not self.spatial:
            turned = g.dot(self.values[:2], force[:2])
            bend = g.mul(g.mul(g.mul(g.constant(2.0), slope), self.values[2]), turned)
            return [g.mul(c, force[0]), g.mul(c, force[1]), g.add(force[2], bend)]
        (s, b), (k, bent) = self.vectors, self.factor_across
        fu, fw = v.triple(force[:3]), v.triple(force[3:])
        along, work = v.dot(b, s), v.dot(b, fu)
        on_s = v.sub(v.scale(c, fu), v.scale(g.mul(k, work), b))
        on_b = v.sub(v.scale(c, fw), v.scale(k, v.add(v.scale(along, fu), v.scale(work, s))))
        by_x = g.sub(g.mul(slope, g.add(v.dot(s, fu), v.dot(b, fw))), g.mul(bent, g.mul(along, work)))
        return [*on_s, *on_b, g.neg(by_x)]

    def exertions_along_measures(self) -> list[Exertion]:
        """Return the exertions along the measures; the first one carries the energy and power of the element."""
        g, force = self.graph, self.gradient
        energy = g.mul(g.constant(0.5), g.dot(self.excess, self.stress))
        power = g.zero
        if any(x != g.zero for x in self.damping_force):
            force = [g.add(x, y) for x, y in zip(force, self.damping_force, strict=True)]
            power = g.neg(g.dot(self.damping_force, self.rate))
        result = list[Exertion]()
        for measure, along in zip(self.measures, self.forces_along_measures(force), strict=True):
            rate = measure.rate(g, self.model.velocities)
            result.append(Exertion(measure.row, rate, g.neg(along), power, energy))
            energy = power = g.zero
        return result


def _product_with_symmetric(g: Graph, lower: Sequence[Sequence[int]], vector: Sequence[int]) -> list[int]:
    """Return a symmetric matrix, given by its lower triangle, times a vector."""
    n = range(len(vector))
    return [g.dot([lower[max(i, j)][min(i, j)] for j in n], vector) for i in n]
