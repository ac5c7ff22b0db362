"""Looped code of a page: its tables, the functions that they call, and numbers that follow from parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from symgen.compile.native import types
from symgen.compile.native.formula_lines import JAVASCRIPT
from symgen.compile.native.javascript_code import ADDRESSED, INDEX_TABLES, js_number
from symgen.run.compiling.checked import checked_function
from symgen.run.compiling.printed_meanings import source_of_piece
from symgen.run.layout.kernel_addresses import KERNEL
from symgen.run.planning.start_lines import room_for_lines
from symgen.run.starts.hoisting import copy_masses, sum_products

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.compile.native.language import Function
    from symgen.run.compiling.looped_model import HoistedNumbers, LoopedModel, MassDiagonal


#: Names of the loops that fill numbers of a run.
_SUMS, _COPIES = "sumProducts", "copyMasses"
#: Tables of the first one, in the order of its arguments; no other text has these names.
_TABLES_OF_SUMS = ("placesOfSums", "targetsOfSums", "velocitiesOfSums", "productsOfSums", "onesOfSums")


def addressed_functions(compiled: LoopedModel) -> dict[str, Function]:
    """Return the functions that are called through tables, or fill numbers of a run, by their names in the text.

    Raises
    ------
    Foreign
        If one is not in the language, or was left to Python.
    """
    functions = {
        f"generic{k}": checked_function(called[0], types.FunctionType(called[1]))
        for k, called in enumerate(compiled.called)
        if called is not None
    }
    functions |= {
        _name_of_preparation(k): checked_function(compiled.kernels[stem].prepare, types.FunctionType(KERNEL))
        for k, stem in enumerate(_preparing_kernels(compiled.model.prepare))
    }
    return functions | {_SUMS: source_of_piece(sum_products), _COPIES: source_of_piece(copy_masses)}


def text_of_tables(compiled: LoopedModel) -> str:
    """Return the tables and the list of functions that are called through them."""
    listed = ", ".join("null" if called is None else f"generic{k}" for k, called in enumerate(compiled.called))
    return (
        f"const {INDEX_TABLES} = new Int32Array({_list_text(compiled.tables.numbers)});\n"
        f"const {ADDRESSED} = [{listed}];\n"
    )


def written_functions(compiled: LoopedModel) -> dict[str, str]:
    """Return the texts of ``prepareModel`` and ``masses``, which call loops of the runtime with tables of the model.

    Raises
    ------
    NotInLines
        If a formula of a parameter has no form in JavaScript.
    """
    texts = {"prepareModel": _preparation(compiled.model.prepare), "masses": _masses(compiled.model.masses)}
    return {name: "\n".join(lines) for name, lines in texts.items()}


def _name_of_preparation(k: int) -> str:
    return f"prepareKernel{k}"


def _preparing_kernels(hoisted: HoistedNumbers) -> list[str]:
    return list(dict.fromkeys(stem for stem, _ in hoisted.groups))


def _list_text(values: Iterable[float]) -> str:
    return f"[{','.join(map(js_number, values))}]"


def _preparation(hoisted: HoistedNumbers) -> list[str]:
    """Return the function that fills the numbers after the parameters."""
    lines = room_for_lines(hoisted.mechanism, JAVASCRIPT)
    constants = [
        f"p[{place}] = {lines.result(lines.value(formula, hoisted.mechanism.name))};"
        for place, formula in hoisted.constants
    ]
    names = {stem: _name_of_preparation(k) for k, stem in enumerate(_preparing_kernels(hoisted))}
    calls = [f"{names[stem]}(0, p, p, p, {INDEX_TABLES}, {at}, p);" for stem, at in hoisted.groups]
    return [
        *_tables(dict(zip(_TABLES_OF_SUMS, hoisted.sums, strict=True))),
        "function prepareModel(p) {",
        *lines.lines,
        *constants,
        *calls,
        f"return {_SUMS}({', '.join(_TABLES_OF_SUMS)}, p);",
        "}",
    ]


def _masses(diagonal: MassDiagonal) -> list[str]:
    """Return the function that writes the diagonal of M to its section."""
    tables = {"placesOfMasses": diagonal.places, "addedMasses": diagonal.added}
    return [
        *_tables(tables),
        "function masses(p, w) {",
        f"return {_COPIES}({', '.join(tables)}, p, w);",
        "}",
    ]


def _tables(tables: Mapping[str, NDArray[Any]]) -> list[str]:
    return [f"const {name} = {_list_text(table.tolist())};" for name, table in tables.items()]
