"""Lines that find what rows in force carry for others, at the beginning of a function whose formulas read it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from symgen.base.ir.program import CARRYING, ModelLayout
from symgen.derive.emit.printer import ElementAccess, Printer
from symgen.derive.lower.carrying import CarriedSums

_NAME = re.compile(r"[A-Za-z_]\w*")


@dataclass(frozen=True)
class _Apart(ElementAccess):
    """Inputs under names of their own."""

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""
        name, expression = super().read(space, index)
        return (name if name == expression else f"of_{name}"), expression


def carried_lines(
    sums: CarriedSums, layout: ModelLayout, names: Mapping[tuple[str, int], str]
) -> tuple[list[str], frozenset[str]]:
    """Return the lines and the functions that they call.

    They have no branch: a row that nothing carries adds to a spare number. So a function that begins with them is
    straight, and what follows compiles to the same operations as without them.
    """
    printer = Printer(sums.block, _Apart(layout, names), prefix="c")
    printed, first, modes = printer.lines(), layout.offset(CARRYING), layout.offset("modes")
    texts = [printer.text[node][0] for node in sums.block.nodes]
    divided, shared = first + sums.count + 1, first + 2 * (sums.count + 1)
    lines = [f"w[{first + 1 + k}] = 0.0" for k in range(sums.count)]
    for i, name in enumerate(sums.names):
        held, constant, limit = (f"w[{modes + sums.modes[f'{name}.{x}']}]" for x in ("held", "constant", "limit"))
        lines.append(f"carrier{i} = int(min(max({constant}, 0.0), {float(sums.count)!r})*(1.0 - {held}))")
        lines.append(f"w[{first} + carrier{i}] = w[{first} + carrier{i}] + abs({limit})*({texts[3 * i]})")
    if sums.shares:
        lines += [f"w[{divided + k}] = 0.0" for k in range(sums.count + 1)]
        for i, place in enumerate(sums.places):
            total = f"({texts[3 * i + 1]} + w[{first + 1 + place}])"
            lines.append(f"w[{divided + 1 + place}] = ({texts[3 * i + 2]})/{total}")
        lines += [f"w[{shared + 1 + place}] = w[{divided} + carrier{i}]" for i, place in enumerate(sums.places)]
    read = set(_NAME.findall("\n".join(lines)))
    for line in reversed([*printed.inputs, *printed.terms]):  # sums that nothing shares read fewer
        name, _, value = line.partition(" = ")
        if name in read:
            lines.insert(0, line)
            read.update(_NAME.findall(value))
    return ["# what rows in force carry", *lines], printed.functions
