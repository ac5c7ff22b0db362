"""Loops of `symgen.native.loops` as text for LLVM: as `symgen.native.llvm`, with what emitted functions do not have."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from numba import types

from symgen.native import language as lang
from symgen.native.llvm import Printer, declarations
from symgen.native.llvm_values import ARRAY, DATA, LENGTH, TYPES

#: Parts of an array as Numba hands it on, before its lengths and its strides; of a function, which has an address in
#: C's convention and one in Numba's. Used are the address of the elements, the lengths, and the last.
_ARRAY = ARRAY[:LENGTH]
_ADDRESS = ("ptr", "ptr", "ptr")
_JIT = 2
#: What a function returns for which something in Python was not as it should be.
_FAILED = -1


def loop_module(function: lang.Function, symbol: str, kinds: tuple[Any, ...]) -> str:
    """Return the text of a module that defines a loop in Numba's convention, with the parts that it calls.

    Parameters
    ----------
    function : Function
        From `symgen.native.loops`.
    symbol : str
        Its name in machine code.
    kinds : tuple of Numba types
        Of its arguments.
    """
    names: dict[int, str] = {id(function): symbol}
    waiting, functions, inserted = [function], list[lang.Function](), dict[str, str]()
    while waiting:
        each = waiting.pop(0)
        functions.append(each)
        for called in each.called:
            if id(called) not in names:
                names[id(called)] = f"{symbol}.{len(names)}.{called.name}"
                waiting.append(called)
    texts = []
    for each in functions:
        printer = LoopPrinter(each, names, each is function)
        texts.append(printer.text())
        inserted |= printer.inserted
    known: dict[str, None] = {}
    for text in inserted.values():
        lines = text.splitlines()
        known |= dict.fromkeys(line for line in lines if line.startswith("declare "))
        texts.append("\n".join(line for line in lines if not line.startswith("declare ")))
    texts.append(_c_function(symbol, TYPES[function.returned], kinds))
    return "\n".join([*texts, *known, *declarations(texts), ""])


def _c_function(symbol: str, returned: str, kinds: tuple[Any, ...]) -> str:
    """Return the function in C's convention, which calls the other one with its arguments taken apart."""
    lines, parts = [f"  %.result = alloca {returned}", "  %.exception = alloca ptr"], list[str]()
    for i, kind in enumerate(kinds):
        for path, type_ in _leaves(kind):
            if path:
                name = f"%.{i}" + "".join(f".{k}" for k in path)
                lines.append(f"  {name} = extractvalue {_whole(kind)} %a{i}, {', '.join(map(str, path))}")
                parts.append(f"{type_} {name}")
            else:
                parts.append(f"{type_} %a{i}")
    head = ", ".join(f"{_whole(kind)} %a{i}" for i, kind in enumerate(kinds))
    call = ", ".join(("ptr %.result", "ptr %.exception", *parts))
    lines += [f'  %.status = call i32 @"{symbol}"({call})', f"  %.value = load {returned}, ptr %.result"]
    return "\n".join(
        [f'define {returned} @"cfunc.{symbol}"({head}) nounwind {{', *lines, f"  ret {returned} %.value", "}"]
    )


def _whole(kind: Any) -> str:
    """Return LLVM's type of an argument as one value."""
    if isinstance(kind, types.UniTuple | types.NamedUniTuple):
        return f"[{len(kind)} x {_whole(kind.dtype)}]"
    if isinstance(kind, types.BaseTuple):
        return "{" + ", ".join(_whole(part) for part in kind) + "}"
    if isinstance(kind, types.Array):
        return "{" + ", ".join((*_ARRAY, f"[{kind.ndim} x i64]", f"[{kind.ndim} x i64]")) + "}"
    if isinstance(kind, types.FunctionType):
        return "{" + ", ".join(_ADDRESS) + "}"
    return {types.float64: "double", types.int64: "i64"}[kind]


def _leaves(kind: Any) -> Iterator[tuple[tuple[int, ...], str]]:
    """Yield where parts of an argument stand in it, and their types."""
    if isinstance(kind, types.BaseTuple):
        for i, part in enumerate(kind):
            yield from (((i, *path), type_) for path, type_ in _leaves(part))
    elif isinstance(kind, types.Array):
        yield from (((i,), type_) for i, type_ in enumerate(_ARRAY))
        yield from (((len(_ARRAY) + i, axis), "i64") for i in range(2) for axis in range(kind.ndim))
    elif isinstance(kind, types.FunctionType):
        yield from (((i,), type_) for i, type_ in enumerate(_ADDRESS))
    else:
        yield (), _whole(kind)


class LoopPrinter(Printer):
    """Prints a loop or a part that is called."""

    def __init__(self, function: lang.Function, names: dict[int, str], outermost: bool) -> None:
        super().__init__(function, lambda f: names[id(f)], "" if outermost else "internal ", together=False)
        self.outermost = outermost
        source: Any = function.source
        self.flag = " contract" if source.targetoptions.get("fastmath") else ""
        self.blocks: dict[int, str] = {}  # labels behind blocks
        self.inserted: dict[str, str] = {}
        for p in function.parameters:
            if p.array:
                lengths = tuple(f'%"{p.name}.{LENGTH + i}"' for i in range(p.rank))
                self.views[p.name] = f'%"{p.name}.{DATA}"', lengths

    def head(self) -> str:
        """Return result, name and parameters."""
        parts = ["ptr noalias %.result", "ptr noalias %.exception"]
        for p in self.function.parameters:
            if p.array:
                kinds = (*_ARRAY, *("i64",) * (2 * p.rank))
                used = range(DATA, LENGTH + p.rank)
                parts += [f'{k} %"{p.name}.{i}"' for i, k in enumerate(kinds) if self.outermost or i in used]
            elif p.address:
                parts += [f'{k} %"{p.name}.{i}"' for i, k in enumerate(_ADDRESS)]
            else:
                parts.append(f'{TYPES[p.type]} %"{p.name}"')
        return f'i32 @"{self.symbol(self.function)}"({", ".join(parts)}) nounwind'

    def begun(self) -> None:
        """Print what stands before the statements: functions that have no address in Numba's convention are refused."""
        for p in self.function.parameters:
            if not p.array and not p.address:
                self.take(p.name, p.type, f'%"{p.name}"')
            elif p.address and self.outermost:
                yes, no = self.labels("none", "some")
                self.branch(self.put(f'icmp eq ptr %"{p.name}.{_JIT}", null'), yes, no)
                self.begin(yes)
                self.lines.append(f"  ret i32 {_FAILED}")
                self.begin(no)

    # -- statements

    def other(self, statement: lang.Statement) -> bool:
        """Print a statement that emitted functions do not have; return whether what follows it can be reached."""
        if isinstance(statement, lang.Block):
            (end,) = self.labels("end")
            self.blocks[statement.number] = end
            if self.statements(statement.body):
                self.jump(end)
            self.begin(end)
            return True
        assert isinstance(statement, lang.Pick), "all kinds of statements are known"
        test, (a, m), (b, n) = self.value(statement.test), self.views[statement.chosen], self.views[statement.otherwise]
        data = self.put(f"select i1 {test}, ptr {a}, ptr {b}")
        self.views[statement.name] = data, (self.put(f"select i1 {test}, i64 {m[0]}, i64 {n[0]}"),)
        return True

    def leave(self, statement: lang.Leave) -> None:
        """Print the end of a loop, of what it repeats, or of a block."""
        if statement.how == "block":
            self.jump(self.blocks[statement.block])
        else:
            super().leave(statement)

    # -- values

    def value(self, e: lang.Expression) -> str:
        """Print what an expression needs and return its value."""
        if isinstance(e, lang.Insert):
            return self.insert(e)
        return super().value(e)

    def insert(self, e: lang.Insert) -> str:
        """Print a call of what a piece of a compiler does."""
        self.inserted[e.symbol] = e.text
        parts = []
        for argument in e.arguments:
            if isinstance(argument, str):
                parts.append(f"ptr {self.views[argument][0]}")
            else:
                parts.append(f"{TYPES[argument.type]} {self.value(argument)}")
        text = f'@"{e.symbol}"({", ".join(parts)})'
        if e.nothing:
            self.lines.append(f"  call void {text}")
            return ""
        return self.put(f"call {TYPES[e.type]} {text}")

    def invoke(self, e: lang.Invoke) -> str:
        """Print a call of a function by its address."""
        parts = [part for argument in e.arguments for part in self.handed_on(argument)]
        return self.called(f'%"{e.function}.{_JIT}"', e.type, parts)

    def handed_on(self, argument: lang.Expression | str) -> list[str]:
        """Return an argument of a function that is known by its address."""
        if isinstance(argument, str) and argument not in self.views:
            return [f'{k} %"{argument}.{i}"' for i, k in enumerate(_ADDRESS)]
        return super().handed_on(argument)

    def call(self, e: lang.Call) -> str:
        """Print a call of a part."""
        parts = []
        for p, argument in zip(e.function.parameters, e.arguments, strict=True):
            if isinstance(argument, str) and p.array:
                data, lengths = self.views[argument]
                parts += [f"ptr {data}", *(f"i64 {n}" for n in lengths)]
            elif isinstance(argument, str):
                parts += [f'{k} %"{argument}.{i}"' for i, k in enumerate(_ADDRESS)]
            else:
                parts.append(f"{TYPES[p.type]} {self.value(argument)}")
        return self.called(f'@"{self.symbol(e.function)}"', e.function.returned, parts)

    def called(self, function: str, kind: lang.Scalar, parts: list[str]) -> str:
        """Print a call; where the function has failed, this one fails."""
        result = self.room(TYPES[kind])
        status = self.put(f"call i32 {function}({', '.join((f'ptr {result}', 'ptr %.exception', *parts))})")
        failed, done = self.labels("failed", "done")
        self.branch(self.put(f"icmp eq i32 {status}, 0"), done, failed)
        self.begin(failed)
        self.lines.append(f"  ret i32 {status}")
        self.begin(done)
        return self.put(f"load {TYPES[kind]}, ptr {result}")
