"""Measures of a mechanism's markers, instantiated from kernels in the model's graph."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from symgen.base.ir.program import JAMMING
from symgen.base.vocabulary.expressions import Reading, sum_of_terms
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    BladeSpeed,
    Carrying,
    Component,
    Direction,
    Dot,
    Driven,
    Exerted,
    Flexed,
    FormulaMeasure,
    FormulaSpeed,
    Integral,
    Lap,
    Marker,
    Measure,
    OnChain,
    PieceNumber,
    PointSpeed,
    Speed,
    SphereSlip,
    Spin,
    Sum,
    Swing,
    Turn,
    Turning,
    Wrapped,
    axes,
)
from symgen.derive.formulate.chain_nodes import numbers_of_piece
from symgen.derive.formulate.derived_measure import DerivedMeasure
from symgen.derive.formulate.euler_parameters import rate_of_parameters, rotation_matrix_rows
from symgen.derive.formulate.formula_measures import formula_measure
from symgen.derive.formulate.frames import FRAME_SLOTS, SPATIAL_SLOTS
from symgen.derive.formulate.interface_frames import InterfaceFrame, interface_frame
from symgen.derive.formulate.joint_tree import Tree
from symgen.derive.formulate.measure_kernels import derive_kernel
from symgen.derive.formulate.tree_plane import PlanarTree
from symgen.derive.formulate.tree_space import SpatialTree
from symgen.describe.bounds.bounded_modes import mode_names
from symgen.describe.bounds.by_reaction import jamming_names
from symgen.describe.contacts.on_chain import QUANTITIES
from symgen.describe.coordinate_names import ACCELERATIONS
from symgen.describe.formulas.formula_nodes import Formulas


@dataclass
class ModelNodes(Formulas):
    """Nodes of the mechanism's names and measures."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.time = self.names["t"]
        self.spatial = self.mechanism.space == "spatial"
        self.velocities = tuple(self.graph.input("v", i) for i in range(self.size))
        self.tree: Tree | None = None
        if self.mechanism.topology is not None:
            self.tree = SpatialTree(self) if self.spatial else PlanarTree(self)
            self.velocities = self.tree.velocities
            self.names |= self.tree.names
        self.names |= {name: self.graph.input("modes", i) for name, i in mode_names(self.mechanism).items()}
        self.names |= {name: self.graph.input(JAMMING, i) for name, i in jamming_names(self.mechanism).items()}
        self._memo: dict[object, DerivedMeasure] = {}
        self._frames: dict[str, list[int]] = {}
        self._interfaces: dict[str, InterfaceFrame] = {}
        #: Place of each row among the multipliers, for formulas that may read forces of rows.
        self.places_of_rows: Mapping[str, int] = {}
        #: Raw angles of measures with counted turns, in the order of their slots in the section ``winding``.
        self.windings: list[int] = []

    def kind(self, body: str) -> str:
        """Return the frame kind of a body."""
        kind = "ground" if body == GROUND else "point" if self.mechanism.body(body).is_point else "rigid"
        return f"{kind}3" if self.spatial else kind

    def frame_inputs(self, body: str) -> list[int]:
        """Return the nodes of a frame's slots."""
        if body not in self._frames:
            if (interface := self.interface(body)) is not None:
                self._frames[body] = list(interface.slots)
            elif self.tree is not None:
                self._frames[body] = self.tree.frame(body)
            else:
                self._frames[body] = self._spatial_inputs(body) if self.spatial else self._planar_inputs(body)
        return self._frames[body]

    def interface(self, body: str) -> InterfaceFrame | None:
        """Return the frame of an interface of a modal body, None for any other body."""
        carried = None if body == GROUND else self.mechanism.body(body).carried
        if carried is None:
            return None
        if body not in self._interfaces:
            self._interfaces[body] = interface_frame(self, carried)
        return self._interfaces[body]

    def modes(self, body: str) -> tuple[list[int], list[int]]:
        """Return the nodes of the coordinates of a modal body's modes, and of their velocities."""
        own, modal = self.mechanism.body(body), self.mechanism.body(body).modal
        count = 0 if modal is None else len(modal.stiffness)
        q, v = self.first_q[body] + len(own.coordinates) - count, self.first[body] + len(own.speeds) - count
        return [self.graph.input("q", q + i) for i in range(count)], list(self.velocities[v : v + count])

    def _spatial_inputs(self, body: str) -> list[int]:
        g, kind = self.graph, self.kind(body)
        if kind == "ground3":
            return [g.zero] * len(SPATIAL_SLOTS)
        i, j = self.first_q[body], self.first[body]
        position, velocity = [g.input("q", i + k) for k in range(3)], [g.input("v", j + k) for k in range(3)]
        if kind == "point3":
            return [*position, *(g.zero,) * 9, *velocity, *(g.zero,) * 3]
        return [
            *position,
            *rotation_matrix_rows(g, self.euler_parameters(body)),
            *velocity,
            *(g.input("v", j + 3 + k) for k in range(3)),
        ]

    def euler_parameters(self, body: str) -> list[int]:
        """Return the nodes of a spatial body's Euler parameters."""
        return [self.graph.input("q", self.first_q[body] + 3 + k) for k in range(4)]

    def q_rates(self) -> tuple[int, ...]:
        """Return q' = N v: in space e' = G^T omega / 2, which keeps the length of e."""
        if self.tree is not None:
            return tuple(self.tree.q_rates)
        g, rates = self.graph, list[int]()
        for body in self.mechanism.bodies:
            j = self.first[body.name]
            if not self.spatial or body.is_point or body.carried is not None:
                rates += self.velocities[j : j + len(body.speeds)]
                continue
            rates += self.velocities[j : j + 3]
            rates += rate_of_parameters(g, self.euler_parameters(body.name), self.velocities[j + 3 : j + 6])
            rates += self.velocities[j + 6 : j + len(body.speeds)]
        return tuple(rates)

    def _planar_inputs(self, body: str) -> list[int]:
        g, kind = self.graph, self.kind(body)
        if kind == "ground":
            return [g.zero] * len(FRAME_SLOTS)
        i, j = self.first[body], self.first_q[body]
        x, y, vx, vy = g.input("q", j), g.input("q", j + 1), g.input("v", i), g.input("v", i + 1)
        if kind == "point":
            return [x, y, g.one, g.zero, vx, vy, g.zero]
        theta = g.input("q", j + 2)
        return [x, y, g.call("cos", theta), g.call("sin", theta), vx, vy, g.input("v", i + 2)]

    def reading(self, r: Reading) -> int:
        """Return the node of a measure's value, rate or second derivative; the last one requires v'."""
        if isinstance(r.source, Flexed):
            from symgen.derive.formulate.flexure import flexure_component

            return flexure_component(self, r.source)
        if isinstance(r.source, Exerted):
            from symgen.derive.formulate.flexure import exertions_of_force

            exerted = exertions_of_force(self, r.source)
            return self.graph.sum_of(self.graph.mul(e.total, e.rate) if r.source.power else e.total for e in exerted)
        if isinstance(r.source, Driven):
            return self._effort_of_row(r.source)
        assert not isinstance(r.source, Carrying | Integral), "functions of a run read these"
        derived, g = self.measure_or_velocity(r.source), self.graph
        if r.order == 0:
            return derived.value
        if r.order == 1:
            return derived.rate(g, self.velocities)
        return g.add(derived.velocity_part(g, self.accelerations), derived.bias)

    def _effort_of_row(self, source: Driven) -> int:
        """Return what a row exerts along its measure, or the power of that."""
        g, place = self.graph, self.places_of_rows.get(source.row)
        # a row that repeats another one is left out: the other one carries the whole effort
        effort = g.zero if place is None else g.neg(g.input("multipliers", place))
        if not source.power:
            return effort
        return g.mul(effort, self.measure_or_velocity(source.measure).velocity_part(g, self.velocities))

    def name_accelerations(self) -> None:
        """Give the accelerations of bodies their names, for formulas that may read v'."""
        speeds = [(body.name, speed) for body in self.mechanism.bodies for speed in body.speeds]
        if self.tree is None:
            rates = {f"{body}.{speed}": n for (body, speed), n in zip(speeds, self.accelerations, strict=True)}
        else:
            rates = self.tree.accelerations(self.state_rates)
        for body, speed in speeds:
            self.names[f"{body}.{ACCELERATIONS[speed]}"] = rates[f"{body}.{speed}"]

    @property
    def accelerations(self) -> tuple[int, ...]:
        """Nodes of the accelerations of bodies, for graphs with the input v'."""
        g, rates = self.graph, self.state_rates
        if self.tree is None:
            return rates
        products = (g.sum_of(g.mul(n, rates[j]) for j, n in sorted(c.items()) if j >= 0) for c in self.tree.columns)
        return tuple(g.add(a, b) for a, b in zip(products, self.tree.biases, strict=True))

    @property
    def state_rates(self) -> tuple[int, ...]:
        """Nodes of v', for graphs with this input."""
        nq, nv = len(self.q_rates()), self.size if self.tree is None else self.tree.size
        return tuple(self.graph.input("ydot", nq + i) for i in range(nv))

    def row_over_state(self, row: Mapping[int, int], bias: int) -> tuple[dict[int, int], int, int]:
        """Return a row over the velocities of the state, its quadratic velocity term and the drivers' part of J v."""
        if self.tree is None:
            return dict(row), bias, self.graph.zero
        g, pulled = self.graph, dict[int, int]()
        drift, carried = g.zero, g.zero
        for i, node in sorted(row.items()):
            for j, entry in sorted(self.tree.columns[i].items()):
                pulled[j] = g.add(pulled.get(j, g.zero), g.mul(node, entry))
            carried = g.add(carried, g.mul(node, self.tree.biases[i]))
        for j in sorted(j for j in pulled if j < 0):
            drift = g.add(drift, g.mul(pulled.pop(j), self.tree.coordinates[j].rate))
        return {j: node for j, node in pulled.items() if node != g.zero}, g.add(carried, bias), drift

    # -- measures ----------------------------------------------------------------------------------------------------

    def measure(self, m: Measure) -> DerivedMeasure:
        """Return value, row and bias of a measure; equal measures are derived once."""
        derived = self._memo.get(m)
        if derived is None:
            derived = self._memo[m] = self._measure_of_coordinate(m) or self._derive_measure(m)
        return derived

    def _measure_of_coordinate(self, m: Measure) -> DerivedMeasure | None:
        """Return a measure that is a coordinate of the state: its rate follows the velocities of bodies."""
        if self.tree is None or m not in self.tree.measures:
            return None
        g, (coordinate, velocity, sign) = self.graph, self.tree.measures[m]
        factor = g.constant(sign)
        return DerivedMeasure(g.mul(factor, g.input("q", coordinate)), {self.size + velocity: factor}, g.zero)

    def _derive_measure(self, m: Measure) -> DerivedMeasure:
        if isinstance(m, FormulaMeasure):
            return formula_measure(self, m)
        if isinstance(m, OnChain):
            return formula_measure(self, FormulaMeasure(QUANTITIES[m.quantity](m.chain)))
        if isinstance(m, PieceNumber):
            x, y = (
                self.measure(Component(m.chain.origin, m.chain.centre, e)).value for e in axes(m.chain.origin.body, 2)
            )
            self._memo.update(numbers_of_piece(self, m.chain, (x, y)))
            return self._memo[m]
        if isinstance(m, Sum):
            return self._sum_of_measures(m)
        if isinstance(m, Angle):
            return self._planar_angle(m)
        if isinstance(m, Lap):
            return self._lap_on_branch(m)
        if isinstance(m, Wrapped):
            of = self.measure(m.of)
            value = self._on_branch(m, of.value, self.expression(m.period))
            return DerivedMeasure(value, of.row, of.bias, of.drift)
        if isinstance(m, Turning):
            return self._turn_on_branch(m)
        bodies, constants = self._bodies_and_constants(m)
        kind = m.__struct_config__.tag
        assert isinstance(kind, str), "measures are tagged by the names of their kernels"
        derived = self._insert_kernel(kind, bodies, constants)
        # the angular velocity is not the rate of a measure: the value is 0
        return DerivedMeasure(self.graph.zero, derived.row, derived.bias) if isinstance(m, Spin) else derived

    def _bodies_and_constants(self, m: Measure) -> tuple[tuple[str, ...], list[int]]:
        """Return the bodies of a measure's frames and its constants: points, directions, then numbers."""
        fields = [getattr(m, name) for name in m.__struct_fields__]
        points = [x for x in fields if isinstance(x, Marker)]
        directions = [x for x in fields if isinstance(x, Direction)]
        numbers = [x for x in fields if not isinstance(x, Marker | Direction | str)]
        bodies = [x for x in fields if isinstance(x, str)] + [x.body for x in points] + [x.body for x in directions]
        located = [node for x in points for node in self.local(x)]
        turned = [node for x in directions for node in self.direction(x)]
        return tuple(bodies), [*located, *turned, *map(self.expression, numbers)]

    def measure_or_velocity(self, m: Measure | Speed) -> DerivedMeasure:
        """Return a measure, or a velocity that is not the rate of one, with the value 0."""
        if isinstance(m, Speed):
            derived = self.speed(m)
            return DerivedMeasure(self.graph.zero, derived.row, derived.bias, derived.drift)
        return self.measure(m)

    def _sum_of_measures(self, m: Sum) -> DerivedMeasure:
        g = self.graph
        value, bias, drift, row = g.zero, g.zero, g.zero, dict[int, int]()
        for coefficient, part in m.terms:
            k, derived = self.expression(coefficient), self.measure(part)
            value = g.add(value, g.mul(k, derived.value))
            bias = g.add(bias, g.mul(k, derived.bias))
            drift = g.add(drift, g.mul(k, derived.drift))
            for i, node in derived.row.items():
                row[i] = g.add(row.get(i, g.zero), g.mul(k, node))
        return DerivedMeasure(value, {i: n for i, n in row.items() if n != g.zero}, bias, drift)

    def speed(self, speed: Speed) -> DerivedMeasure:
        """Return the velocity measure of a nonholonomic row; `value` is the kernel's u = J v."""
        if isinstance(speed, FormulaSpeed):
            return formula_measure(self, speed)
        if isinstance(speed, PointSpeed):
            constants = [*self.local(speed.at), *self.direction(speed.along)]
            return self._insert_kernel("point-speed", (speed.at.body, speed.along.body), constants)
        if isinstance(speed, BladeSpeed):
            constants = [*self.local(speed.at), *self.direction(speed.normal), *self.direction(speed.blade)]
            return self._insert_kernel("blade-speed", (speed.normal.body, speed.at.body), constants)
        if isinstance(speed, SphereSlip):
            constants = [*self.local(speed.a), *self.local(speed.b), *self.direction(speed.zero)]
            constants += [*self.direction(speed.along), *map(self.expression, (*speed.radii, speed.side))]
            return self._insert_kernel("sphere-slip", (speed.a.body, speed.b.body, speed.zero.body), constants)
        constants = [*self.local(speed.centre), *self.direction(speed.along), *self.direction(speed.normal)]
        constants.append(self.expression(speed.radius))
        bodies = speed.along.body, speed.centre.body
        if speed.axis is None:
            return self._insert_kernel("sphere-speed", bodies, constants)
        return self._insert_kernel("disc-speed", bodies, [*constants, *self.direction(speed.axis)])

    def _turn_on_branch(self, m: Turning) -> DerivedMeasure:
        """Return an angle in space, on the branch nearest to its value in the section ``winding``.

        s = atan2(y, x) of two measures, s' = (x y' - y x') / (x^2 + y^2), and s'' once more by the chain rule.
        """
        g = self.graph
        if isinstance(m, Turn):
            y, x = self.measure(Dot(m.quarter, m.pointer)), self.measure(Dot(m.zero, m.pointer))
        else:
            y, x = self.measure(Component(m.a, m.b, m.quarter)), self.measure(Component(m.a, m.b, m.zero))
        square = g.add(g.mul(x.value, x.value), g.mul(y.value, y.value))
        if isinstance(m, Swing):
            least = self.expression(m.least)
            square = g.call("max", square, g.mul(least, least))
        across, along = g.div(x.value, square), g.div(y.value, square)
        row = {
            i: g.sub(g.mul(across, y.row.get(i, g.zero)), g.mul(along, x.row.get(i, g.zero)))
            for i in sorted({*x.row, *y.row})
        }
        rates = y.rate(g, self.velocities), x.rate(g, self.velocities)
        rate = g.sub(g.mul(across, rates[0]), g.mul(along, rates[1]))
        growth = g.mul(g.constant(2.0), g.add(g.mul(along, rates[0]), g.mul(across, rates[1])))
        bias = g.sub(g.sub(g.mul(across, y.bias), g.mul(along, x.bias)), g.mul(rate, growth))
        value = self._on_branch(m, g.call("atan2", y.value, x.value), g.constant(math.tau))
        return DerivedMeasure(value, {i: n for i, n in row.items() if n != g.zero}, bias)

    def _lap_on_branch(self, m: Lap) -> DerivedMeasure:
        """Return the way round a closed chain, on the branch nearest to its value in the section ``winding``."""
        way = self.measure(OnChain(m.chain, "way"))
        length = self.expression(sum_of_terms(*(piece.length for piece in m.chain.pieces)))
        return DerivedMeasure(self._on_branch(m, way.value, length), way.row, way.bias, way.drift)

    def _on_branch(self, m: Measure, value: int, period: int) -> int:
        """Return a periodic value with as many periods as bring it next to that in the section ``winding``."""
        g, before = self.graph, self.graph.input("winding", self.place_of_turn(m))
        periods = g.call("floor", g.add(g.div(g.sub(before, value), period), g.constant(0.5)))
        counted = g.add(value, g.mul(period, periods))
        self.windings.append(counted)
        return counted

    def place_of_turn(self, m: Measure) -> int:
        """Return the slot of an angle in the section ``winding``: after the angles derived before."""
        return len(self.windings)

    def _planar_angle(self, m: Angle) -> DerivedMeasure:
        g, value, row = self.graph, self.graph.zero, dict[int, int]()
        for body, sign in ((m.b, g.one), (m.a, g.constant(-1.0))):
            if body != GROUND:
                interface = self.interface(body)
                angle = self.names[f"{body}.theta"] if interface is None else interface.angle
                value = g.add(value, g.mul(sign, angle))
                turning = {self.first[body] + 2: g.one} if interface is None else interface.columns[2]
                for i, factor in turning.items():
                    row[i] = g.add(row.get(i, g.zero), g.mul(sign, factor))
        return DerivedMeasure(value, {i: n for i, n in row.items() if n != g.zero}, g.zero)

    def _insert_kernel(self, kind: str, bodies: tuple[str, ...], constants: list[int]) -> DerivedMeasure:
        slots: dict[str, int] = {}
        for body in bodies:
            slots.setdefault(body, len(slots))
        kernel = derive_kernel(kind, tuple((slots[b], self.kind(b)) for b in bodies))
        flat = [node for body in slots for node in self.frame_inputs(body)] + constants
        nodes = self.graph.copy_from(kernel.graph, kernel.outputs, {("slot", i): n for i, n in enumerate(flat)})
        g, row, bias, entries = self.graph, dict[int, int](), nodes[-1], iter(nodes[1:-1])
        for body, part in zip(slots, kernel.row, strict=True):
            interface = self.interface(body)
            for offset, entry in zip(range(len(part)), entries, strict=False):
                if entry == g.zero:
                    continue
                if interface is None:
                    i = self.first[body] + offset
                    row[i] = g.add(row.get(i, g.zero), entry)
                    continue
                for i, factor in interface.columns[offset].items():
                    row[i] = g.add(row.get(i, g.zero), g.mul(entry, factor))
                bias = g.add(bias, g.mul(entry, interface.biases[offset]))
        return DerivedMeasure(nodes[0], {i: node for i, node in row.items() if node != g.zero}, bias)
