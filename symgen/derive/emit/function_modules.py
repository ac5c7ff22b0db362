"""Functions of the state as source text: one module each, straight code."""

from __future__ import annotations

from dataclasses import dataclass

from symgen.base.errors import plural
from symgen.base.ir.program import FORMAT, OutputSlot
from symgen.derive.emit.emit import table_codes
from symgen.derive.emit.module import function_source, module_source, templates_digest
from symgen.derive.emit.printer import Access, Printer
from symgen.derive.lower.function_programs import FunctionProgram


@dataclass(frozen=True)
class VectorAccess(Access):
    """Text of elements of separate vectors; own states and the time follow the parameters in ``p``."""

    parameters: int
    numbers: int

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""
        if space == "t":
            return "t", f"p[{self.numbers - 1}]"
        if space == "z":
            return f"z{index}", f"p[{self.parameters + index - 1}]"
        return f"{space}{index}", f"{space}[{index}]"

    def write(self, target: OutputSlot) -> str:
        """Return the left-hand side of an output."""
        return f"{target.space}[{target.index}]"


def emit_function(program: FunctionProgram, parameters: int) -> str:
    """Return the source of a module with one function; the first numbers of ``p`` are `parameters`."""
    block = program.block
    lines = Printer(block, VectorAccess(parameters, program.sizes["p"])).lines()
    body = [*lines.inputs, *lines.terms, *lines.outputs, f"return int({lines.flag})" if lines.flag else "return 0"]
    purpose = f"{block.purpose}: {plural(block.operations, 'operation')}."
    code = function_source(block.name, ", ".join(block.arguments), purpose, body, calls=lines.functions)
    header = [f"format {FORMAT}, templates {templates_digest()}"]
    title = f"{block.purpose}, for model `{program.mechanism}`."
    return module_source(title, header, [*table_codes(program.tables), code], {}, {})
