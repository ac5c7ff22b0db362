"""Emission for several runs at once: blocks in loops over lanes, which become vector instructions."""

from __future__ import annotations

import re

from symgen.emit.emit import Function, render, templates_digest
from symgen.emit.printer import LaneAccess, print_block
from symgen.errors import InputError
from symgen.formulate.equations import Equations
from symgen.ir.program import FORMAT, LANES, STATUS, SUFFIXES, LawProgram, ModelProgram, lane_bases

_BLOCKS = ("normalise", "move", "geometry", "spread", "measure", "rhs")


def emit_lanes_model(program: ModelProgram) -> str:
    """Return the source of the module that all methods of a model share: sines that are no calls, and tables."""
    return render("lanes/model.py.j2", {**_common(program), "tables": program.tables})


def emit_lanes_law(program: LawProgram, model: ModelProgram, equations: Equations, summary: str, reference: str) -> str:
    """Return the source of the module of one method.

    Raises
    ------
    InputError
        If the method is more than a formula with one correction.
    """
    layout, correction = program.layout, program.correction
    if program.form != "direct" or program.closed or correction.metric not in ("identity", "mass"):
        expected = "a method that is a formula with at most one correction (--target lanes)"
        raise InputError(f"method '{program.method}'", expected, "one that iterates, or chooses coordinates")
    n_p = program.parameter_offset + len(program.parameters) + program.hoisted
    bases = lane_bases(layout.nq + layout.nv + 1, n_p, layout.nw)
    access = LaneAccess(layout, {}, bases, LANES)
    blocks = {b.name: b for b in (*model.blocks, *program.blocks)}  # a law's own take the place of the model's
    wanted = [name for name in _BLOCKS if name in blocks and (correction.any or name not in ("move", "spread"))]
    functions = [
        Function(b.name, b.purpose, b.arguments, print_block(b, access), b.operations, b.tree_operations)
        for b in (blocks[name] for name in wanted)
    ]
    text = " ".join(line for f in functions for line in (*f.lines.terms, *f.lines.outputs))
    known = ("cosine", "sine", *(f"table_{name}" for name, _, _ in model.tables))
    place = {
        name: access.of_lane(f"p[{program.parameter_offset + i}]") for i, (name, _) in enumerate(program.parameters)
    }
    return render(
        "lanes/law.py.j2",
        {
            **_common(model),
            "layout": layout,
            "program": program,
            "functions": functions,
            "summary": summary,
            "reference": reference,
            "model": f"model{SUFFIXES['lanes']}",
            "called": [name for name in known if re.search(rf"\b{name}\(", text)],
            "status": {name: layout.offset("status") + i for i, name in enumerate(STATUS)},
            "spatial": bool(equations.spins),
            "tolerance": place.get("tolerance", "1e-13"),
            **{name: bases[name] for name in ("ydot", "p", "w", "spare", "numbers")},
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
