"""The step of a scheme as Python text of its own, from the source of the loops that symgen compiles.

A loop is an instance of the frame with meanings of names (`symgen.run.loops.frame`). The text holds the functions that
a step enters, with these meanings, as ordinary functions for Numba: no annotations, records as named tuples, numbers in
place of names of other modules. So a package runs the scheme that runs have, digit by digit.
"""

from __future__ import annotations

import ast
import inspect
import math
import textwrap
import types
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from symgen.compile.native.annotations import Record
from symgen.compile.native.pieces import Piece
from symgen.run.layout.records import ModelSystem, Run, Sizes, Span
from symgen.run.loops import frame_parts, unbound
from symgen.run.loops.frame import RECIPES

#: Functions that a step enters, and records that its caller makes.
ROOTS = "prepare", "attempt", "renew", "correct", "note_step"
_MADE: tuple[type[Any], ...] = (Sizes, Span, Run, ModelSystem)


def text_of_scheme(loop: Callable[..., int], scheme: Record, title: str) -> str:
    """Return the text of a module with `ROOTS`, and with the records that they take, for a compiled loop.

    Parameters
    ----------
    loop : compiled function
        A loop with constant steps, of `symgen.run.loops.frame.loop`.
    scheme : record
        Its scheme.
    title : str
        First line of the module.
    """
    _, meanings = RECIPES[loop]
    texts = _Texts(meanings)
    for name in ROOTS:
        texts.add_function(meanings.get(name) or getattr(frame_parts, name, None) or getattr(unbound, name), name)
    for record in (*_MADE, type(scheme), *(type(x) for x in scheme if isinstance(x, tuple))):
        texts.add_record(record)
    head = f'"""{title}\n\nWritten by symgen from the source of its own loops.\n"""'
    records = [f'{r.__name__} = record("{r.__name__}", {" ".join(r._fields)!r})' for r in texts.records.values()]
    imports = "import math\nfrom collections import namedtuple as record\n\nfrom numba import njit"
    numbers = [f"{name} = {_literal(value)}" for name, value in sorted(texts.numbers.items())]
    parts = [head, imports, "\n".join(records), "\n".join(numbers), *texts.functions.values()]
    return "\n\n".join(part for part in parts if part) + "\n"


def functions_of_loop(loop: Callable[..., int], root: Callable[..., int]) -> dict[str, str]:
    """Return the text of all functions that a function of a loop enters, by name, the callees first.

    Docstrings, comments and annotations are left out, so that equal texts do the same.

    Parameters
    ----------
    loop : compiled function
        Of `symgen.run.loops.frame.loop`.
    root : function
        Such as `symgen.run.loops.frame.integrate`.
    """
    texts = _Texts(RECIPES[loop][1])
    texts.add_function(root)
    return {"": repr(sorted(texts.numbers.items())), **texts.functions}


def _literal(value: float) -> str:
    return "math.inf" if value == math.inf else repr(value)


@dataclass
class _Texts:
    """Functions, records and numbers that functions name, each once.

    Parameters
    ----------
    meanings : mapping
        Meanings of names in the loop.
    """

    meanings: Mapping[str, Any]
    functions: dict[str, str] = field(default_factory=dict)
    numbers: dict[str, float] = field(default_factory=dict)
    records: dict[str, type[Any]] = field(default_factory=dict)
    _named: dict[Any, str] = field(default_factory=dict)

    def add_record(self, record: type[Any]) -> None:
        """Add a named tuple."""
        self.records[record.__name__] = record

    def add_function(self, function: Callable[..., Any], name: str = "") -> str:
        """Add a function after all that it calls; return its name in the text."""
        plain: Any = function.plain if isinstance(function, Piece) else getattr(function, "py_func", function)
        if plain in self._named:
            return self._named[plain]
        name = name or plain.__name__.lstrip("_")
        while name in self._named.values():  # another module has one of this name
            name += "_"
        self._named[plain] = name
        (definition,) = ast.parse(textwrap.dedent(inspect.getsource(plain))).body
        assert isinstance(definition, ast.FunctionDef), "a function is defined by def"
        names = _Names(self, {**plain.__globals__, **self._meant(plain)})
        definition = names.visit(definition)
        definition.name, definition.decorator_list, definition.returns = name, [], None
        if ast.get_docstring(definition) is not None:
            definition.body = definition.body[1:] or [ast.Pass()]
        for argument in definition.args.args:
            argument.annotation = None
        text = ast.unparse(ast.fix_missing_locations(definition))
        self.functions[name] = f'@njit(error_model="numpy")\n{text}'
        return name

    def _meant(self, plain: types.FunctionType) -> dict[str, Any]:
        return {name: self.meanings[name] for name in plain.__code__.co_names if name in self.meanings}

    def name_of(self, name: str, value: Any) -> str:
        """Return how a text names a value that a function names, which is added."""
        if isinstance(value, bool | int | float):
            while self.numbers.setdefault(name, value) != value:  # another module has another number of this name
                name += "_"
            return name
        if isinstance(value, type) and issubclass(value, Record):
            self.add_record(value)
            return value.__name__
        return name if value is math or isinstance(value, types.BuiltinFunctionType) else self.add_function(value)


class _Names(ast.NodeTransformer):
    """Names of other modules as names of the text.

    Parameters
    ----------
    texts : _Texts
        The texts.
    known : mapping
        Values of the global names of a function.
    """

    def __init__(self, texts: _Texts, known: Mapping[str, Any]) -> None:
        self.texts, self.known, self.local = texts, known, set[str]()

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.FunctionDef:
        """Note local names first; leave annotations out."""
        self.local = {argument.arg for argument in node.args.args}
        self.local |= {n.id for n in ast.walk(node) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
        node.body = [self.visit(statement) for statement in node.body]
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.Assign:
        """Return an assignment without its annotation."""
        assert node.value is not None, "a local variable has a value"
        return ast.Assign([node.target], self.visit(node.value))

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        """Return the name of a number or function of another module."""
        if isinstance(node.value, ast.Name) and node.value.id not in self.local:
            module = self.known.get(node.value.id)
            if isinstance(module, types.ModuleType) and module is not math:
                value = self.texts.meanings.get(node.attr, getattr(module, node.attr))
                return ast.Name(self.texts.name_of(node.attr, value), node.ctx)
        return self.generic_visit(node)

    def visit_Name(self, node: ast.Name) -> ast.Name:
        """Return the name of what a global name means."""
        if node.id in self.local or node.id not in self.known:
            return node
        return ast.Name(self.texts.name_of(node.id, self.known[node.id]), node.ctx)
