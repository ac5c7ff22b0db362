"""Functions of the state outside the model: formulas of a run, in their own module.

Further functions of a run (switching functions of events, quantities of a user) are lowered apart, so that they leave
the modules of the model unchanged.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from symgen.base.ir.derivative import Key, jacobian
from symgen.base.ir.graph import Graph
from symgen.base.ir.interpolation import Interpolation
from symgen.base.ir.program import CARRYING, JAMMING, STATUS, Block, ModelLayout, OutputSlot
from symgen.base.vocabulary.expressions import Expr, Reading
from symgen.base.vocabulary.measures import Carrying, Integral, Measure
from symgen.base.vocabulary.quantities import Quantity
from symgen.derive.formulate.measure_nodes import ModelNodes
from symgen.derive.lower.carrying import CarriedSums, carried_sums, formulas_of_carried, slot_of_carrying
from symgen.derive.lower.windings import Beside
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.formulas.results_read import integrals_of_outputs
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.topology import state_quantities

#: Inputs of formulas that rates along the motion take as constant.
FORCES = frozenset({"ydot", "multipliers", JAMMING, CARRYING})


@dataclass(frozen=True)
class SideProgram:
    """Functions of formulas; `formulas` are readable names of their outputs, `carried` what the first one reads."""

    mechanism: str
    blocks: tuple[Block, ...]
    layout: ModelLayout
    parameters: tuple[Quantity, ...]
    coordinates: tuple[Quantity, ...]
    velocities: tuple[Quantity, ...]
    tables: tuple[Interpolation, ...]
    formulas: tuple[str, ...]
    carried: CarriedSums | None = None

    @property
    def reads(self) -> tuple[str, ...]:
        """Inputs of the function: ``t``, ``q``, ``v``, ``p``, ``ydot`` and sections of ``w``."""
        blocks = self.blocks[:1] if self.carried is None else (self.blocks[0], self.carried.block)
        read = {space for block in blocks for space, _ in block.graph.inputs_of(block.nodes)}
        return tuple(sorted(read if self.carried is None else read | {"modes"}))

    @property
    def of_forces(self) -> tuple[int, ...]:
        """Numbers of the outputs that depend on accelerations or forces."""
        first = self.blocks[0]
        spaces = [{space for space, _ in first.graph.inputs_of([node])} for node in first.nodes]
        return tuple(i for i, read in enumerate(spaces) if read & FORCES)


@dataclass
class SideModel(ModelNodes):
    """The names of a mechanism as nodes; the model counts turns of angles.

    Parameters
    ----------
    beside : Beside
        Readable parts of the compiled model.
    """

    beside: Beside = field(kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._places = {measure: i for i, measure in enumerate(self.beside.turning)}
        self.places_of_rows = self.beside.rows
        self.name_accelerations()

    def reading(self, r: Reading) -> int:
        """Return the node of a reading: a measure, the effort along measures, or an integral."""
        if isinstance(r.source, Integral):
            place = 1 + len(self.mechanism.states) + integrals_of_outputs(self.mechanism)[r.source]
            return self.graph.input("z", place)  # after the work and states
        if isinstance(r.source, Carrying):
            return self.graph.input(CARRYING, slot_of_carrying(self.mechanism, r.source))
        return super().reading(r)

    def place_of_turn(self, m: Measure) -> int:
        """Return the place of an angle in the section ``winding``."""
        return self._places[m]

    def rates(self, nodes: Sequence[int]) -> list[int]:
        """Return the derivatives of `nodes` along the motion: q' = N v, and v' from ``ydot``."""
        g = self.graph
        rates = {("t", 0): g.one}
        rates |= {("q", i): rate for i, rate in enumerate(self.q_rates())}
        rates |= {("v", i): node for i, node in enumerate(self.state_rates)}
        rates |= {("z", i): self.expression(x.rate) for i, x in enumerate(self.mechanism.states, 1)}
        return [
            g.sum_of(g.mul(slope, rates[key]) for key, slope in sorted(slopes.items()))
            for slopes in jacobian(g, nodes, rates)
        ]

    def sizes(self, nodes: Sequence[int]) -> list[int]:
        """Return the sizes that rounding of `nodes` is relative to: terms of differences, and effects of the state.

        Coordinates and velocities count with at least the mechanism's length and speed: they are rounded where others
        are as large.
        """
        g = self.graph
        length, speed = (g.input("status", STATUS.index(f"{scale}_scale")) for scale in ("length", "speed"))
        least = {"m": length, "m/s": speed, "rad/s": g.div(speed, length)}
        of: dict[Key, int] = {("t", 0): g.call("abs", g.input("t", 0))}
        for space, part in zip("qv", state_quantities(self.mechanism), strict=True):
            for i, quantity in enumerate(part):
                of[space, i] = g.add(g.call("abs", g.input(space, i)), least.get(quantity.unit, g.one))
        of |= {("z", i): g.call("abs", g.input("z", i)) for i in range(1, len(self.mechanism.states) + 1)}
        sizes = list[int]()
        for node, slopes in zip(nodes, jacobian(g, nodes, of), strict=True):
            op, terms, _ = g.nodes[node]
            parts = [g.call("abs", term) for term in (terms if op in ("add", "sub") else (node,))]
            sizes.append(g.sum_of([*parts, *(g.mul(g.call("abs", slopes[key]), of[key]) for key in sorted(slopes))]))
        return sizes


def copy_to_own_graph(
    source: Graph, nodes: Sequence[int], renamed: Callable[[Key], Key] = lambda key: key
) -> tuple[Graph, list[int]]:
    """Return a separate graph for some nodes, inputs renamed."""
    graph = Graph()
    return graph, graph.copy_from(source, nodes, {key: graph.input(*renamed(key)) for key in source.inputs_of(nodes)})


def lower_side(
    mechanism: Mechanism,
    name: str,
    purpose: str,
    formulas: Sequence[tuple[str, Expr]],
    beside: Beside,
    rates: int = 0,
    sizes: bool = False,
) -> SideProgram:
    """Lower formulas of a run.

    Parameters
    ----------
    mechanism : Mechanism
        Their mechanism.
    name, purpose : str
        Of the function.
    formulas : sequence of (str, Expr)
        Readable name of each, and the formula.
    beside : Beside
        Readable parts of the compiled model.
    rates : int
        Number of derivatives of all formulas along the motion after their values; v' counts as constant.
    sizes : bool
        Whether their sizes follow, see `SideModel.sizes`.

    Raises
    ------
    OverflowError
        If numbers that meet in a formula overflow.
    """
    model = SideModel(mechanism, beside=beside)
    nodes = [model.expression(e) for _, e in formulas]
    labels = [label for label, _ in formulas]
    for k in range(rates):
        nodes += model.rates(nodes[k * len(formulas) :])
        labels += [f"rate of {label}" for label in labels[k * len(formulas) :]]
    if sizes:
        nodes += model.sizes(nodes[: len(formulas)])
        labels += [f"size of {label}" for label, _ in formulas]
    graph, images = copy_to_own_graph(model.graph, nodes)
    outputs = tuple((OutputSlot("out", i), image) for i, image in enumerate(images))
    block = Block(name, purpose, graph, outputs, ("t", "y", "p", "w", "ydot", "out"))
    places = {place for space, place in graph.inputs_of(images) if space == CARRYING}
    if not places:
        return side_program(mechanism, (block,), beside, labels)
    graph, images = copy_to_own_graph(model.graph, [model.expression(e) for e in formulas_of_carried(mechanism)])
    numbers = Block(name, purpose, graph, tuple((OutputSlot(CARRYING, i), x) for i, x in enumerate(images)), ())
    carried = carried_sums(mechanism, numbers, beside.sections, places)
    return side_program(mechanism, (block,), beside, labels, carried)


def lower_integrands(mechanism: Mechanism, beside: Beside) -> SideProgram:
    """Lower the integrands of a mechanism's outputs: their values are rates of auxiliary states after the work.

    ``integrands(t, y, p, w, ydot)`` sets them after a right-hand side, ``accumulate(t, y, k, p, w)`` after a
    residual, with v' and lambda among its unknowns, in the section ``auxiliary``.

    Raises
    ------
    OverflowError
        If numbers that meet in a formula overflow.
    """
    model = SideModel(mechanism, beside=beside)
    integrands = integrals_of_outputs(mechanism)
    nodes = [model.expression(integral.of) for integral in integrands]
    coordinates, velocities = state_quantities(mechanism)
    first, work = len(coordinates) + len(velocities), len(coordinates) + len(velocities) + len(mechanism.states)

    def place_of_unknown(key: Key) -> Key:
        """Return the places of v' and lambda in a residual."""
        return {"ydot": ("k", key[1]), "multipliers": ("k", first + key[1])}.get(key[0], key)

    graph, images = copy_to_own_graph(model.graph, nodes)
    rates = tuple((OutputSlot("ydot", work + 1 + i), image) for i, image in enumerate(images))
    stage, inside = copy_to_own_graph(model.graph, nodes, place_of_unknown)
    stored = tuple((OutputSlot("auxiliary", 1 + i), image) for i, image in enumerate(inside))
    blocks = (
        Block("integrands", "rates of integrals", graph, rates, ("t", "y", "p", "w", "ydot")),
        Block("accumulate", "the same of a stage with the unknowns k", stage, stored, ("t", "y", "k", "p", "w")),
    )
    return side_program(mechanism, blocks, beside, [to_text(integral.of) for integral in integrands])


def side_program(
    mechanism: Mechanism,
    blocks: tuple[Block, ...],
    beside: Beside,
    labels: Sequence[str],
    carried: CarriedSums | None = None,
) -> SideProgram:
    """Return blocks as the program of a separate module; `labels` name the outputs."""
    coordinates, velocities = state_quantities(mechanism)
    every = blocks if carried is None else (*blocks, carried.block)
    used = {table for block in every for table, _ in block.tables}
    return SideProgram(
        mechanism=mechanism.name,
        blocks=blocks,
        layout=ModelLayout(
            *(len(coordinates), len(velocities), 0, len(mechanism.parameters), dict(beside.sections)),
            len(mechanism.states),
        ),
        parameters=tuple(Quantity(p.name, p.unit) for p in mechanism.parameters),
        coordinates=coordinates,
        velocities=velocities,
        tables=tuple(t.interpolated for t in mechanism.tables if t.name in used),
        formulas=tuple(labels),
        carried=carried,
    )
