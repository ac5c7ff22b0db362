"""Formulas of a run as the source text of a module of their own."""

from __future__ import annotations

from symgen.emit.emit import straight, table_codes
from symgen.emit.module import module, templates_digest
from symgen.ir.program import FORMAT
from symgen.lower.side import SideProgram


def emit_side(program: SideProgram) -> str:
    """Return the source of a module with one function, straight code whatever the shape of the model's."""
    codes = [*table_codes(program.tables), *straight([program.block], program.layout, program)]
    header = [
        f"format {FORMAT}, templates {templates_digest()}",
        "",
        *(f"out[{i}] {formula}" for i, formula in enumerate(program.formulas)),
    ]
    return module(f"{program.block.purpose}, for model `{program.mechanism}`.", header, codes, {}, {})
