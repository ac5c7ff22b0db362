"""Functions of the state for those who compute with a mechanism: its dynamics, and frames on its bodies.

Each is one block over q, v, a further vector of the length of v (accelerations or efforts) and the numbers ``p``:
parameters in the order of the file, the file's own states, and the time last. No block keeps anything between calls:
angles whose turns runs count are on the branch of (-pi, pi], joints hold, no row with bounds is in force.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from symgen.base.errors import InputError
from symgen.base.ir.derivative import Key, jacobian
from symgen.base.ir.graph import Graph
from symgen.base.ir.interpolation import Interpolation
from symgen.base.ir.program import MODE_NUMBERS, Block, OutputSlot, table_of_payload
from symgen.derive.formulate.equations import Equations
from symgen.derive.formulate.formulate import formulate
from symgen.derive.formulate.measure_nodes import ModelNodes
from symgen.derive.lower.factor import FactorNodes, factorise_symmetric, minimum_degree
from symgen.derive.lower.placed_point import PlacedPoint
from symgen.derive.lower.side_program import copy_to_own_graph
from symgen.describe.mechanism import Mechanism, Vec

#: Vectors that blocks take, by the spaces of their elements: coordinates, velocities, accelerations, efforts.
SPACES = {"q": "coordinates", "v": "velocities", "a": "accelerations", "e": "efforts"}

#: A pivot of M with less than this part of its diagonal is rounding.
NO_MASS = 1e-14


@dataclass(frozen=True)
class Values:
    """A quantity as nodes of a graph, row by row.

    Attributes
    ----------
    graph : Graph
        Their graph.
    nodes : tuple of int
        All elements.
    shape : tuple of int
        Shape of the quantity.
    flag : int, optional
        Node that is true where they are wrong.
    """

    graph: Graph
    nodes: tuple[int, ...]
    shape: tuple[int, ...]
    flag: int | None = None


@dataclass
class StateFunctions:
    """The quantities of a mechanism as nodes.

    Parameters
    ----------
    mechanism : Mechanism
        With its tree for joint coordinates; without rows with bounds.
    """

    mechanism: Mechanism
    _values: dict[str, Values] = field(default_factory=dict)

    @cached_property
    def equations(self) -> Equations:
        """The derived equations."""
        return formulate(self.mechanism)

    @cached_property
    def model(self) -> ModelNodes:
        """Bodies in a graph of their own, for frames."""
        return ModelNodes(self.mechanism)

    @property
    def sizes(self) -> dict[str, int]:
        """Lengths of the vectors that blocks take."""
        e = self.equations
        numbers = len(e.parameters) + len(e.states) + 1
        return {"q": e.nq, "v": e.nv, "a": e.nv, "e": e.nv, "p": numbers}

    # -- dynamics ------------------------------------------------------------------------------------------------------

    def values(self, name: str) -> Values:
        """Return a quantity by its name, such as ``mass_matrix``."""
        if name not in self._values:
            self._values[name] = self._in_own_graph(_QUANTITIES[name](self))
        return self._values[name]

    def derivative(self, name: str, space: str, kept: Sequence[int] = ()) -> Values:
        """Return the derivatives of a quantity by q, v, a, e or p; of ``NAME of rows`` with these rows."""
        return self._keys_of_space(self.solved_quantity(name, kept) if kept else self.values(name), space)

    def solved_quantity(self, name: str, kept: Sequence[int]) -> Values:
        """Return ``forward_dynamics of rows`` or ``inverse_dynamics of rows`` in one graph, with independent rows."""
        forward = name.startswith("forward")
        return self._in_own_graph(self._constrained_accelerations(kept) if forward else self._shortest_efforts(kept))

    def balance_of_actuators(self, actuators: Sequence[str]) -> Values:
        """Return `balance` with named actuators."""
        return self._in_own_graph(self.balance(actuators))

    def _in_own_graph(self, values: Values) -> Values:
        """Return values in a graph of their own, as they are without a run."""
        ends = [*values.nodes, *([] if values.flag is None else [values.flag])]
        graph, nodes = copy_to_own_graph(values.graph, self._without_run_state(values.graph, ends))
        flag = None if values.flag is None else nodes.pop()
        return Values(graph, tuple(nodes), values.shape, flag)

    def _without_run_state(self, graph: Graph, nodes: Sequence[int]) -> list[int]:
        """Return nodes with what only runs know: no turns are counted, and rows that may be off are in force."""
        known = dict[Key, int]()
        for space, i in graph.inputs_of(nodes):
            if space == "winding":
                known[space, i] = graph.zero
            elif space == "modes":
                known[space, i] = graph.one if i % MODE_NUMBERS == 0 else graph.zero
        return graph.replace_inputs(nodes, known) if known else list(nodes)

    def _keys_of_space(self, values: Values, space: str) -> Values:
        g, size = values.graph, self.sizes[space]
        keys = [self.key_of_number(i) for i in range(size)] if space == "p" else [(space, i) for i in range(size)]
        slopes = jacobian(g, values.nodes, keys)
        nodes = [slope.get(key, g.zero) for slope in slopes for key in keys]
        return Values(g, tuple(nodes), (len(values.nodes), size) if values.shape else (size,), values.flag)

    def key_of_number(self, i: int) -> Key:
        """Return the input that the number at a place of ``p`` is."""
        own, count = i - len(self.mechanism.parameters), len(self.mechanism.states)
        if own < 0:
            return "p", i
        return ("z", own + 1) if own < count else ("t", 0)

    def _mass_by_place(self) -> dict[tuple[int, int], int]:
        return {
            (i, j): node
            for block in self.equations.mass
            for i, line in zip(block.columns, block.entries, strict=True)
            for j, node in zip(block.columns, line, strict=True)
            if node != self.equations.graph.zero
        }

    def _dense_mass(self) -> list[int]:
        entries, n, zero = self._mass_by_place(), self.equations.nv, self.equations.graph.zero
        return [entries.get((i, j), zero) for i in range(n) for j in range(n)]

    def _dense_jacobian(self) -> list[int]:
        e = self.equations
        return [dict(row.entries).get(j, e.graph.zero) for row in e.rows for j in range(e.nv)]

    def _input_vector(self, space: str) -> list[int]:
        return [self.equations.graph.input(space, i) for i in range(self.equations.nv)]

    def mass_matrix(self) -> Values:
        """Return M."""
        n = self.equations.nv
        return Values(self.equations.graph, tuple(self._dense_mass()), (n, n))

    def bias(self) -> Values:
        """Return -f."""
        g = self.equations.graph
        return Values(g, tuple(g.neg(n) for n in self.equations.forces), (self.equations.nv,))

    def inverse_dynamics(self, forces: Sequence[int] | None = None) -> Values:
        """Return M a - f, with other nodes for f where they are given."""
        g, accelerations = self.equations.graph, self._input_vector("a")
        result = [g.neg(n) for n in (self.equations.forces if forces is None else forces)]
        for (i, j), node in sorted(self._mass_by_place().items()):
            result[i] = g.add(result[i], g.mul(node, accelerations[j]))
        return Values(g, tuple(result), (self.equations.nv,))

    def _forces_with_efforts(self) -> list[int]:
        g = self.equations.graph
        return [g.add(f, e) for f, e in zip(self.equations.forces, self._input_vector("e"), strict=True)]

    def forward_dynamics(self) -> Values:
        """Return v' of mechanisms without rows: M^-1 (f + efforts)."""
        return self._constrained_accelerations(())

    def _constrained_accelerations(self, kept: Sequence[int]) -> Values:
        """Return v' of M v' + D^T lambda = f + efforts, D v' = gamma, with independent rows."""
        e, g = self.equations, self.equations.graph
        factor, light = self._factor_with_doubt(self._mass_by_place(), e.nv, g.zero)
        free = factor.solve(g, self._forces_with_efforts())
        if kept:
            rows = self._dense_rows(kept)
            along = [factor.solve(g, row) for row in rows]
            count = range(len(rows))
            schur = {(i, j): g.dot(rows[i], along[j]) for i in count for j in count if j <= i}
            schur |= {(j, i): node for (i, j), node in schur.items()}
            inner, light = self._factor_with_doubt({k: n for k, n in schur.items() if n != g.zero}, len(rows), light)
            lacking = [g.sub(g.dot(row, free), e.rows[i].gamma) for row, i in zip(rows, kept, strict=True)]
            loads = inner.solve(g, lacking)
            free = [g.sub(x, g.dot([a[i] for a in along], loads)) for i, x in enumerate(free)]
        return Values(g, tuple(free), (e.nv,), light)

    def _shortest_efforts(self, kept: Sequence[int]) -> Values:
        """Return the shortest efforts of M a - f beside independent rows."""
        e, g, rows = self.equations, self.equations.graph, self._dense_rows(kept)
        needed, count = list(self.inverse_dynamics().nodes), range(len(rows))
        square = {(i, j): g.dot(rows[i], rows[j]) for i in count for j in count}
        inner, light = self._factor_with_doubt({k: n for k, n in square.items() if n != g.zero}, len(rows), g.zero)
        loads = inner.solve(g, [g.dot(row, needed) for row in rows])
        efforts = [g.sub(x, g.dot([row[i] for row in rows], loads)) for i, x in enumerate(needed)]
        return Values(g, tuple(efforts), (e.nv,), light)

    def _dense_rows(self, kept: Sequence[int]) -> list[list[int]]:
        e = self.equations
        return [[dict(e.rows[i].entries).get(j, e.graph.zero) for j in range(e.nv)] for i in kept]

    def _factor_with_doubt(
        self, matrix: Mapping[tuple[int, int], int], size: int, light: int
    ) -> tuple[FactorNodes, int]:
        """Return the factors of a matrix, and a node that is true where `light` is or a pivot is rounding."""
        g = self.equations.graph
        near = [frozenset(j for i, j in matrix if i == k and j != k) for k in range(size)]
        order, _ = minimum_degree(near)
        factor = factorise_symmetric(g, matrix, order, lambda row, pivot, diagonal: g.div(g.one, pivot))
        for k, pivot in factor.pivots.items():
            sound = g.call("gt", pivot, g.mul(g.constant(NO_MASS), factor.diagonal[k]))
            light = g.call("not", sound) if light == g.zero else g.call("or", light, g.call("not", sound))
        return factor, light

    def system(self) -> Values:
        """Return M, f + efforts, D and gamma in one line, from which a kernel computes v'."""
        nodes = [
            *self._dense_mass(),
            *self._forces_with_efforts(),
            *self._dense_jacobian(),
            *(row.gamma for row in self.equations.rows),
        ]
        return Values(self.equations.graph, tuple(nodes), (len(nodes),))

    def balance(self, actuators: Sequence[str] = ()) -> Values:
        """Return M a - f, then D, in one line, from which a kernel computes efforts of loops.

        Present values of named actuators follow, and what 1 of each exerts along the velocities. Limits of their inputs
        and forces, written with `min` and `max`, do not act.

        Raises
        ------
        InputError
            If the force of an input is not affine in it.
        """
        forces = self._forces_without_limits(actuators)
        nodes = [*self.inverse_dynamics(forces).nodes, *self._dense_jacobian()]
        ways = [self._value_and_direction(name, forces) for name in actuators]
        nodes += [value for value, _ in ways] + [n for _, way in ways for n in way]
        return Values(self.equations.graph, tuple(nodes), (len(nodes),))

    def _forces_without_limits(self, actuators: Sequence[str]) -> Sequence[int]:
        """Return f with the varying argument in place of a `min` or `max` of which one argument reads named inputs."""
        e, g = self.equations, self.equations.graph
        named = {("p", i) for i, p in enumerate(e.parameters) if p.name in actuators}
        images, reading = dict[int, int](), set[int]()
        for node in g.required_nodes(e.forces):
            op, args, payload = g.nodes[node]
            varying = [a for a in args if a in reading]
            if not varying:
                images[node] = node
                if op == "input" and g.key(node) in named:
                    reading.add(node)
                continue
            reading.add(node)
            limited = op in ("min", "max") and len(varying) == 1
            images[node] = images[varying[0]] if limited else g.apply(op, tuple(images[a] for a in args), payload)
        return [images[node] for node in e.forces]

    def _value_and_direction(self, name: str, forces: Sequence[int]) -> tuple[int, list[int]]:
        """Return value and way of an actuator: an input of the file, or an effort along a coordinate of a joint."""
        e, g = self.equations, self.equations.graph
        names = [p.name for p in e.parameters]
        if name in names:
            key: Key = ("p", names.index(name))
            way = [slope.get(key, g.zero) for slope in jacobian(g, forces, [key])]
            if key in g.inputs_of(way):
                raise InputError(f"actuator '{name}'", "an input that forces are affine in", "another one")
            return g.input(*key), way
        rate = next(c.rate for c in e.joint_coordinates if c.name == name)
        (slope,) = jacobian(g, [rate], [("v", i) for i in range(e.nv)])
        return g.zero, [slope.get(("v", i), g.zero) for i in range(e.nv)]

    def constraint_jacobian(self) -> Values:
        """Return D."""
        e = self.equations
        return Values(e.graph, tuple(self._dense_jacobian()), (e.m, e.nv))

    def row_values(self, which: str) -> Values:
        """Return Phi, nu or gamma."""
        e = self.equations
        found = [getattr(row, which) for row in e.rows]
        return Values(e.graph, tuple(e.graph.zero if n is None else n for n in found), (e.m,))

    def rates(self) -> Values:
        """Return q' = N v."""
        e = self.equations
        return Values(e.graph, e.q_rates, (e.nq,))

    def energy(self, which: str) -> Values:
        """Return an energy."""
        return Values(self.equations.graph, (getattr(self.equations, which),), ())

    # -- frames --------------------------------------------------------------------------------------------------------

    def frame(self, body: str, point: Vec, what: str, axes: str) -> Values:
        """Return a quantity of a point with the axes of its body.

        Parameters
        ----------
        body : str
            The body, or the ground.
        point : tuple of Expr
            The point in its frame.
        what : {"pose", "velocity", "jacobian", "jacobian_rate"}
            Its homogeneous matrix, velocity and angular velocity, their Jacobian, and their rates at v' = 0.
        axes : {"world", "local"}
            Axes of components: the ground's or the body's.
        """
        g, placed = self.model.graph, PlacedPoint(self.model, body, point)
        shape: tuple[int, ...] = (placed.dimension + 1,) * 2
        if what == "pose":
            nodes = placed.homogeneous_matrix()
        else:
            twist = placed.velocity(axes == "local")
            size, nv = len(twist), self.equations.nv
            if what == "velocity":
                nodes, shape = twist, (size,)
            elif what == "jacobian":
                slopes = jacobian(g, twist, [("v", i) for i in range(nv)])
                nodes, shape = [s.get(("v", i), g.zero) for s in slopes for i in range(nv)], (size, nv)
            else:
                nodes, shape = self._derivatives_along_motion(twist), (size,)
        return self._in_own_graph(Values(g, tuple(nodes), shape))

    def _derivatives_along_motion(self, nodes: Sequence[int]) -> list[int]:
        """Return the derivatives of nodes along the motion where v' is 0."""
        model, g = self.model, self.model.graph
        rates: dict[Key, int] = {("t", 0): g.one} | {("q", i): n for i, n in enumerate(model.q_rates())}
        rates |= {("z", i): model.expression(x.rate) for i, x in enumerate(self.mechanism.states, 1)}
        slopes = jacobian(g, nodes, rates)
        return [g.sum_of(g.mul(n, rates[key]) for key, n in sorted(slope.items())) for slope in slopes]


_QUANTITIES: Mapping[str, Callable[[StateFunctions], Values]] = {
    "mass_matrix": StateFunctions.mass_matrix,
    "bias": StateFunctions.bias,
    "forward_dynamics": StateFunctions.forward_dynamics,
    "inverse_dynamics": StateFunctions.inverse_dynamics,
    "system": StateFunctions.system,
    "balance": StateFunctions.balance,
    "constraint_jacobian": StateFunctions.constraint_jacobian,
    "violation": lambda x: x.row_values("phi"),
    "nu": lambda x: x.row_values("nu"),
    "gamma": lambda x: x.row_values("gamma"),
    "rates": StateFunctions.rates,
    "kinetic_energy": lambda x: x.energy("kinetic"),
    "potential_energy": lambda x: x.energy("potential"),
}


@dataclass(frozen=True)
class FunctionProgram:
    """A function of the state: its block, the lengths of its arguments and the shape of its result."""

    mechanism: str
    block: Block
    sizes: Mapping[str, int]
    shape: tuple[int, ...]
    tables: tuple[Interpolation, ...]


def lower_function(
    functions: StateFunctions, name: str, purpose: str, vectors: Iterable[str], values: Values
) -> FunctionProgram:
    """Return a quantity as one function.

    Parameters
    ----------
    functions : StateFunctions
        The mechanism.
    name, purpose : str
        Of the function.
    vectors : iterable of str
        Its arguments before ``p``, of `SPACES`.
    values : Values
        The quantity.
    """
    arguments = (*vectors, "p")
    outputs = tuple((OutputSlot("out", i), node) for i, node in enumerate(values.nodes))
    block = Block(name, purpose, values.graph, outputs, (*arguments, "out"), values.flag)
    read = {
        table_of_payload(values.graph.nodes[n].payload)[0] for n in block.needed if values.graph.nodes[n].op == "table"
    }
    tables = tuple(t.interpolated for t in functions.mechanism.tables if t.name in read)
    sizes = {space: functions.sizes[space] for space in arguments}
    return FunctionProgram(functions.mechanism.name, block, sizes, values.shape, tables)
