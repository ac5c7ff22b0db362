"""Computation of numbers that depend on parameters alone once a run, not at every evaluation."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.ir.graph import PARAMETER, Graph
from symgen.base.ir.program import Block, OutputSlot


class Hoister:
    """Moves parameter-only subexpressions of one module's blocks to places after the parameters in ``p``.

    Parameters
    ----------
    graph : Graph
        The graph that all blocks of the module are built in.
    first : int
        Index in ``p`` of the first hoisted number.
    parameters : int
        Number of a method's parameters, which follow the numbers of `reserve`.
    """

    def __init__(self, graph: Graph, first: int, parameters: int = 0) -> None:
        self.graph, self.first, self.parameters = graph, first, parameters
        self.slots: dict[int, int] = {}
        self.reserved = 0

    @property
    def first_parameter(self) -> int:
        """Index in ``p`` of the method's first parameter."""
        return self.first + self.reserved

    def reserve(self, ends: Sequence[int]) -> None:
        """Reserve places before the method's parameters for the numbers of `ends`: call it before any block is made.

        So a law's own functions depend neither on the number of the method's parameters nor on other hoisted numbers.
        """
        for node in self.graph.required_nodes(ends, self._is_hoisted):
            if self._is_hoisted(node):
                self.slots.setdefault(node, len(self.slots))
        self.reserved = len(self.slots)

    def _place_in_parameters(self, slot: int) -> int:
        return self.first + slot + (self.parameters if slot >= self.reserved else 0)

    def _input_of_block(self, graph: Graph, space: str, index: int) -> int:
        """Return an input as blocks read it."""
        return graph.input("p", self.first_parameter + index) if space == "parameter" else graph.input(space, index)

    def block_with_hoisted(
        self,
        name: str,
        purpose: str,
        outputs: Sequence[tuple[OutputSlot, int]],
        arguments: tuple[str, ...],
        flag: int | None = None,
    ) -> Block:
        """Return a block in a graph of its own, hoisted nodes read from ``p``."""
        source, target = self.graph, Graph()
        ends = [n for _, n in outputs] + ([] if flag is None else [flag])  # the flag is last

        def image(node: int) -> int:
            if self._is_hoisted(node):
                return target.input("p", self._place_in_parameters(self.slots.setdefault(node, len(self.slots))))
            return self._input_of_block(target, *source.key(node))

        moved = target.rebuild_from(source, ends, image, self._is_hoisted)
        places = tuple((where, node) for (where, _), node in zip(outputs, moved, strict=False))
        return Block(name, purpose, target, places, arguments, None if flag is None else moved[-1])

    def _is_hoisted(self, node: int) -> bool:
        return self.graph.depends[node] == PARAMETER and self.graph.nodes[node].op != "input"

    def prepare_block(self) -> Block:
        """Return the block that fills the hoisted numbers; call it after all other blocks."""
        graph = Graph()
        nodes = sorted(self.slots, key=self.slots.__getitem__)
        images = graph.copy_from(
            self.graph, nodes, {key: self._input_of_block(graph, *key) for key in self.graph.inputs_of(nodes)}
        )
        outputs = tuple(
            (OutputSlot("p", self._place_in_parameters(self.slots[n])), image)
            for n, image in zip(nodes, images, strict=True)
        )
        return Block("prepare", "numbers that depend on parameters alone", graph, outputs, ("p",))
