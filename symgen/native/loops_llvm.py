"""Loops of `symgen.native.loops` as text for LLVM: as `symgen.native.llvm`, with what emitted functions do not have."""

from __future__ import annotations

from typing import Any

from symgen.native import language as lang
from symgen.native.llvm import FunctionPrinter, declarations
from symgen.native.llvm_values import TYPES


def loop_module(function: lang.Function, symbol: str) -> str:
    """Return the text of a module that defines a loop, with the parts that it calls.

    Parameters
    ----------
    function : Function
        From `symgen.native.loops`.
    symbol : str
        Its name in machine code.
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
    return "\n".join([*texts, *known, *declarations(texts), ""])


class LoopPrinter(FunctionPrinter):
    """Prints a loop or a part that is called."""

    def __init__(self, function: lang.Function, names: dict[int, str], outermost: bool) -> None:
        super().__init__(function, lambda f: names[id(f)], "" if outermost else "internal ", together=False)
        source: Any = function.source
        self.flag = " contract" if source.contracted else ""
        self.blocks: dict[int, str] = {}  # labels behind blocks
        self.inserted: dict[str, str] = {}

    # -- statements

    def other(self, statement: lang.Statement) -> bool:
        """Print a statement that emitted functions do not have; return whether what follows it can be reached."""
        if isinstance(statement, lang.StatementBlock):
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
