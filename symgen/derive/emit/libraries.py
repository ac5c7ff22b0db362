"""Functions of the state as Python for libraries that differentiate: every operation is one of theirs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symgen.base.errors import InputError
from symgen.base.escapes import comment_text
from symgen.base.vocabulary.elementary_functions import ELEMENTARY
from symgen.derive.emit.function_modules import VectorAccess
from symgen.derive.emit.printer import Printer
from symgen.derive.lower.function_programs import FunctionProgram

#: Names of the arguments in the modules.
ARGUMENTS = {"q": "q", "v": "v", "a": "a", "e": "effort", "p": "p"}


@dataclass(frozen=True)
class Syntax:
    """How a library writes operations.

    Attributes
    ----------
    prefix : str
        Name of the library in the module.
    calls : mapping of str to str
        Its names of operations, where they are other ones.
    result : str
        The last line of a function, with ``{values}`` and ``{shape}``.
    default : str
        Default of ``p``, the last argument.
    """

    prefix: str
    calls: Mapping[str, str]
    result: str
    default: str = ""


JAX = Syntax(
    "jnp",
    {
        **{"where": "where", "min": "minimum", "max": "maximum", "abs": "abs", "sign": "sign", "atan2": "arctan2"},
        **{"asin": "arcsin", "acos": "arccos", "atan": "arctan"},
        **{"asinh": "arcsinh", "acosh": "arccosh", "atanh": "arctanh"},
        **{"and": "logical_and", "or": "logical_or", "not": "logical_not"},
    },
    "return jnp.array([{values}]).reshape({shape})",
    "=P",
)
CASADI = Syntax(
    "ca",
    {
        **{"where": "if_else", "min": "fmin", "max": "fmax", "abs": "fabs", "sign": "sign", "atan2": "atan2"},
        **{"and": "logic_and", "or": "logic_or", "not": "logic_not"},
    },
    "return [{values}]",
)


class LibraryPrinter(Printer):
    """Prints a block with the operations of a library, which choose and compare without branches."""

    syntax: Syntax

    def operation(self, op: str, args: tuple[int, ...], payload: object) -> tuple[str, int]:
        """Return text and precedence of one operation."""
        texts = [self.text[a][0] for a in args]
        if op in self.syntax.calls or op in ELEMENTARY or op == "floor":
            name = self.syntax.calls.get(op, op)
            return f"{self.syntax.prefix}.{name}({', '.join(texts)})", 5
        return super().operation(op, args, payload)


@dataclass(frozen=True)
class LibraryAccess(VectorAccess):
    """Elements of vectors by the names of arguments that people read."""

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""
        name, text = super().read(space, index)
        return name, text.replace("e[", "effort[", 1) if space == "e" else text


def function_text(where: str, program: FunctionProgram, parameters: int, name: str, syntax: Syntax) -> str:
    """Return the text of a function that returns its elements.

    Parameters
    ----------
    where : str
        What needs it, for messages.
    program : FunctionProgram
        The function.
    parameters : int
        Number of parameters in ``p`` before own states and the time.
    name : str
        Its name.
    syntax : Syntax
        The library.

    Raises
    ------
    InputError
        If it reads a table.
    """
    if program.tables:
        names = ", ".join(table.name for table in program.tables)
        raise InputError(where, "a mechanism without tables", names)
    printer = LibraryPrinter(program.block, LibraryAccess(parameters, program.sizes["p"]))
    printer.syntax = syntax
    lines = printer.lines()
    values = ", ".join(text.partition(" = ")[2].partition("  #")[0] for text in lines.outputs)
    arguments = ", ".join(ARGUMENTS[x] for x in program.sizes) + syntax.default
    document = f'"""Return {comment_text(program.block.purpose)}."""'
    body = [document, *lines.inputs, *lines.terms, syntax.result.format(values=values, shape=program.shape)]
    return "\n".join([f"def {name}({arguments}):", *(f"    {line}" for line in body)])
