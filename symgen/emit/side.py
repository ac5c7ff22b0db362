"""Formulas of a run as the source text of a module of their own."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.emit.emit import straight, table_codes
from symgen.emit.module import ModulePiece, function, module, templates_digest
from symgen.ir.program import FORMAT
from symgen.lower.side import SideProgram


def emit_side(program: SideProgram) -> str:
    """Return the source of a module with one function, straight code whatever the shape of the model's."""
    codes, header = _printed(program, "out[{}]")
    return module(f"{program.blocks[0].purpose}, for model `{program.mechanism}`.", header, codes, {}, {})


def _printed(program: SideProgram, place: str, first: int = 0) -> tuple[list[ModulePiece], list[str]]:
    """Return the functions, and lines that say what stands in each place, from the `first` on."""
    codes = [*table_codes(program.tables), *straight(program.blocks, program.layout, program)]
    formulas = [f"{place.format(i)} {formula}" for i, formula in enumerate(program.formulas, first)]
    return codes, [f"format {FORMAT}, templates {templates_digest()}", "", *formulas]


#: What a law with integrals has in place of its own: arguments, and what is called behind the law's own.
_FOLLOWED = {
    "rhs": ("t, y, p, w, iw, ydot", "integrands(t, y, p, w, ydot)"),
    "confirm": ("t, y, p, w, iw, ydot", "integrands(t, y, p, w, ydot)"),
    "residual": ("t, y, k, p, w, r", "accumulate(t, y, k, p, w)"),
}


def emit_integrals(program: SideProgram, law: Mapping[str, str], power: int) -> str:
    """Return the source of a law's module whose right-hand side has rates of integrals behind that of the work.

    Parameters
    ----------
    program : SideProgram
        From `symgen.lower.side.lower_integrands`.
    law : mapping of str to str
        Functions of the law, each with the stem of the module in the same folder that it is imported from.
    power : int
        Where in ``w`` a residual leaves the rate of the work.
    """
    codes, header = _printed(program, "z[{}]' =", 1)
    exports = [name for name in law if name not in _FOLLOWED]
    known = {name: (law[name], name) for name in exports}
    for name, (arguments, more) in _FOLLOWED.items():
        if name not in law:
            continue
        known[f"law_{name}"] = (law[name], name)
        body = [f"flag = law_{name}({arguments})", more, "return flag"]
        if name == "residual":
            body.insert(1, f"w[{program.layout.offset('auxiliary')}] = w[{power}]")
        calls = f"law_{name}", more.partition("(")[0]
        codes.append(function(name, arguments, "As the law's, with integrals.", body, calls=calls))
    return module(f"A law of model `{program.mechanism}`, with integrals.", header, codes, known, {}, exports=exports)
