"""The language of emitted functions after checking: numbers, elements of arrays, loops and choices, each with its type.

A value is a ``float`` (64 bits), an ``int`` (64 bits, signed) or a ``bool``; arrays are one-dimensional and contiguous.
Tables of looped code hold ``unsigned`` numbers of 32 bits, which become ``int`` where they are read.
It depends neither on Python's syntax nor on a target: `symgen.compile.native.read` makes these values,
`symgen.compile.native.llvm` prints them.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from symgen.base.vocabulary.elementary_functions import ELEMENTARY

Scalar = Literal["float", "int", "bool", "unsigned"]

#: Functions of ``math``: number of arguments, which are floats.
FUNCTIONS = {
    **dict.fromkeys((*ELEMENTARY, "fabs", "floor", "ceil"), 1),
    **dict.fromkeys(("atan2", "copysign", "pow"), 2),
}


class FunctionParameter(msgspec.Struct, frozen=True, gc=False):
    """An argument of a function: a number, an array of numbers, or, for loops, a function by its address."""

    name: str
    type: Scalar
    array: bool = False
    rank: int = 1
    address: bool = False


class Constant(msgspec.Struct, frozen=True, gc=False):
    """A number written in the source."""

    type: Scalar
    value: float | int | bool


class Variable(msgspec.Struct, frozen=True, gc=False):
    """A local variable, or an argument that is a number."""

    type: Scalar
    name: str


class ArrayElement(msgspec.Struct, frozen=True, gc=False):
    """An element of an array; indices count from 0 and are never negative."""

    type: Scalar
    array: str
    index: Expression


class ScalarOperation(msgspec.Struct, frozen=True, gc=False):
    """An operation on values: arithmetic, a comparison, a mathematical function or a conversion.

    Arithmetic: ``add sub mul div floordiv mod pow neg abs min max``; on booleans ``and or not``, without skipping the
    right operand; comparisons: ``lt le gt ge eq ne``; conversions: ``float``, ``int``, ``bool``, ``unsigned``;
    ``low`` is the lower 32 bits of an integer, ``bits`` the integer in the place of a float; functions are
    called ``math.sin`` and the like. Arguments of arithmetic and comparisons have one type.
    """

    type: Scalar
    name: str
    arguments: tuple[Expression, ...]


class Logic(msgspec.Struct, frozen=True, gc=False):
    """``and`` or ``or`` of two booleans, where the second is evaluated only if the first does not decide."""

    name: Literal["and", "or"]
    first: Expression
    second: Expression
    type: Scalar = "bool"


class Choice(msgspec.Struct, frozen=True, gc=False):
    """One of two values; the other one is not evaluated."""

    type: Scalar
    test: Expression
    chosen: Expression
    otherwise: Expression


class FunctionCall(msgspec.Struct, frozen=True, gc=False):
    """A call of another function; arrays are passed by name."""

    type: Scalar
    function: Function
    arguments: tuple[Expression | str, ...]


class ArrayLength(msgspec.Struct, frozen=True, gc=False):
    """The length of an array along one of its axes."""

    array: str
    axis: int = 0
    type: Scalar = "int"


class Invoke(msgspec.Struct, frozen=True, gc=False):
    """A call of a function by its address, a name or a number; arrays are passed by name."""

    type: Scalar
    function: Expression | str
    arguments: tuple[Expression | str, ...]


class Insert(msgspec.Struct, frozen=True, gc=False):
    """Result of a function in LLVM's language: a piece of a compiler, by its name in machine code.

    Attributes
    ----------
    type : {"float", "int", "bool"}
        Type of the result.
    symbol, text : str
        Name and definition of the function, which takes numbers, and arrays as addresses.
    nothing : bool
        Whether it has no result.
    """

    type: Scalar
    symbol: str
    text: str
    arguments: tuple[Expression | str, ...]
    nothing: bool = False


Expression = (
    Constant | Variable | ArrayElement | ScalarOperation | Logic | Choice | FunctionCall | ArrayLength | Invoke | Insert
)


class Assign(msgspec.Struct, frozen=True, gc=False):
    """Assignment to a variable."""

    name: str
    value: Expression


class Store(msgspec.Struct, frozen=True, gc=False):
    """Assignment to an element of an array."""

    array: str
    index: Expression
    value: Expression


class If(msgspec.Struct, frozen=True, gc=False):
    """Two lists of statements, one of which is executed."""

    test: Expression
    then: tuple[Statement, ...]
    otherwise: tuple[Statement, ...]


class While(msgspec.Struct, frozen=True, gc=False):
    """Statements repeated while a test holds."""

    test: Expression
    body: tuple[Statement, ...]


class For(msgspec.Struct, frozen=True, gc=False):
    """Statements repeated for ``range(start, stop, step)``; the step is a constant."""

    name: str
    start: Expression
    stop: Expression
    step: int
    body: tuple[Statement, ...]


class Leave(msgspec.Struct, frozen=True, gc=False):
    """``break`` or ``continue`` of the innermost loop, or the end of a block."""

    how: Literal["break", "continue", "block"]
    block: int = 0


class StatementBlock(msgspec.Struct, frozen=True, gc=False):
    """Statements that may be left before their end: the body of a function copied into its caller."""

    number: int
    body: tuple[Statement, ...]


class ArrayView(msgspec.Struct, frozen=True, gc=False):
    """A name for elements of an array from one on: some rows, or the subarray at some indices.

    Where the type is ``unsigned``, the elements are numbers of that kind.
    """

    name: str
    array: str
    first: Expression
    size: Expression | None
    indices: int = 0
    type: Scalar = "float"


class Pick(msgspec.Struct, frozen=True, gc=False):
    """A name for one of two arrays of one dimension."""

    name: str
    test: Expression
    chosen: str
    otherwise: str


class Return(msgspec.Struct, frozen=True, gc=False):
    """The end of the function."""

    value: Expression


class Evaluate(msgspec.Struct, frozen=True, gc=False):
    """A call whose result is not used."""

    call: FunctionCall | Invoke | Insert


Statement = Assign | Store | If | While | For | Leave | Return | Evaluate | StatementBlock | ArrayView | Pick


class Function(msgspec.Struct, frozen=True, gc=False):
    """A function with its types.

    Attributes
    ----------
    name : str
        As in the source.
    parameters : tuple of FunctionParameter
        Arguments.
    returned : {"float", "int"}
        Type of the result.
    body : tuple of Statement
        Statements.
    variables : dict of str to {"float", "int", "bool"}
        Local variables.
    fixed : frozenset of str
        Variables assigned once, by a statement of the body itself: names of values, which need no memory.
    tables : dict of str to tuple of float
        Constant arrays that the function reads.
    called : tuple of Function
        Functions that it calls, each once, in the order of their first call.
    source : object
        Origin.
    inlined : bool
        Whether callers have its statements instead of a call.
    """

    name: str
    parameters: tuple[FunctionParameter, ...]
    returned: Scalar
    body: tuple[Statement, ...]
    variables: dict[str, Scalar]
    fixed: frozenset[str]
    tables: dict[str, tuple[float, ...]]
    called: tuple[Function, ...]
    source: object
    inlined: bool = False

    @property
    def key(self) -> object:
        """Identity of the function without a comparison of bodies."""
        return self.source, self.parameters
