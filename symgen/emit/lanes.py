"""Emission for several runs at once: every block in a loop over lanes, which the compiler turns into vector instructions."""

from __future__ import annotations

import re
from collections.abc import Sequence

from symgen.emit.emit import Function, render, templates_digest
from symgen.emit.printer import LaneAccess, print_block
from symgen.errors import InputError
from symgen.formulate.equations import Equations
from symgen.ir.program import COUNTERS, FORMAT, LANES, STATUS, SUFFIXES, Block, LawProgram, Layout, ModelProgram

_MODEL = f"model{SUFFIXES['lanes']}"
_SHARED = ("geometry", "spread", "measure", "move", "normalise")
#: Numbers that `accept` keeps for each lane behind the sections of ``w``.
SPARE = 2


def emit_lanes_model(program: ModelProgram) -> str:
    """Return the source of the module that all methods of a model share."""
    blocks = [b for b in program.blocks if b.name in _SHARED]
    return render(
        "lanes/model.py.j2",
        {
            **_common(program),
            "tables": program.tables,
            "functions": _functions(blocks, program.layout),
        },
    )


def emit_lanes_law(program: LawProgram, model: ModelProgram, equations: Equations, summary: str, reference: str) -> str:
    """Return the source of the module that one method adds beside the shared one.

    Raises
    ------
    InputError
        If the method is more than a formula and one correction.
    """
    layout, correction = program.layout, program.correction
    if program.form != "direct" or program.closed or correction.metric not in ("identity", "mass"):
        expected = "a method that is a formula with at most one correction (--target lanes)"
        raise InputError(f"method '{program.method}'", expected, "one that iterates, or chooses coordinates")
    blocks = [b for b in program.blocks if b.name in ("rhs", *_SHARED)]
    functions = _functions(blocks, layout)
    own = {b.name for b in blocks}
    text = " ".join(line for f in functions for line in (*f.lines.terms, *f.lines.outputs))
    called = {"sine", "cosine", *(f"table_{name}" for name, _, _ in model.tables)}
    shared = {name for name in called if re.search(rf"\b{name}\(", text)} | {"geometry", "measure"}
    shared |= {"spread"} if correction.any else set()
    if equations.spins:
        shared |= {"normalise"} | ({"move"} if correction.any else set())
    access = LaneAccess(layout, {}, LANES)
    place = {
        name: access.of_lane(f"p[{program.parameter_offset + i}]") for i, (name, _) in enumerate(program.parameters)
    }
    return render(
        "lanes/law.py.j2",
        {
            **_common(model),
            "layout": layout,
            "counters": {name: i for i, name in enumerate(COUNTERS)},
            "program": program,
            "functions": functions,
            "summary": summary,
            "reference": reference,
            "model": _MODEL,
            "shared": sorted(shared - own),
            "status": {name: layout.offset("status") + i for i, name in enumerate(STATUS)},
            "spatial": bool(equations.spins),
            "tolerance": place.get("tolerance", "1e-13"),
            "last": layout.nw,
            "still": layout.nw + 1,
        },
    )


def _common(model: ModelProgram) -> dict[str, object]:
    return {
        "name": model.name,
        "digest": model.digest,
        "format": FORMAT,
        "templates_digest": templates_digest(),
        "lanes": LANES,
    }


def _functions(blocks: Sequence[Block], layout: Layout) -> list[Function]:
    access = LaneAccess(layout, {}, LANES)
    return [
        Function(b.name, b.purpose, b.arguments, print_block(b, access), b.operations, b.tree_operations)
        for b in blocks
    ]
