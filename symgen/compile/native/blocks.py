"""Long straight functions divided into blocks, after the optimiser and before machine code is made.

The time that compilers spend on one block grows faster than its length: they look at pairs of its instructions. A block
ends here where nothing is lost: inputs are read again in every block that uses them, which spares their way
through the stack, and a product used by one sum is put next to that sum, so that the two are contracted as before.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable
from typing import NamedTuple

#: Instructions of a block.
LENGTH = 1000
_NAME = re.compile(r'%(?:"[^"]*"|[-\w.$]+)')
_DEFINED = re.compile(r'\s+%(?:"[^"]*"|[-\w.$]+) = (\w+)')
_COMMUTATIVE = frozenset(("fadd", "fmul"))
_PURE = _COMMUTATIVE | {"fsub", "fdiv", "fneg"}
#: End of a block without an instruction: its jump target is never reached, which the compiler cannot know.
_END = 'callbr void asm sideeffect "", "!i"() memory(none) nounwind to label %{next} [label %.never]'


class Instruction(NamedTuple):
    """An instruction, or a label.

    Attributes
    ----------
    text : str
        Text in LLVM's language.
    own : str
        Name of its result, or empty.
    does : str
        Operation: ``fadd``, ``load``.
    names : tuple of str
        Operands and labels.
    """

    text: str
    own: str
    does: str
    names: tuple[str, ...]

    @classmethod
    def parse_line(cls, text: str) -> Instruction:
        """Parse a line of a function."""
        names = tuple(_NAME.findall(text))
        defined = _DEFINED.match(text)
        return cls(text, names[0], defined[1], names[1:]) if defined else cls(text, "", "", names)

    def rename_operands(self, new: Callable[[str], str]) -> Instruction:
        """Return the line with other names of operands."""
        names = tuple(map(new, self.names))
        if names == self.names:
            return self
        head, equals, rest = self.text.partition(" = ") if self.own else ("", "", self.text)
        instead = iter(names)
        return Instruction(head + equals + _NAME.sub(lambda match: next(instead), rest), self.own, self.does, names)

    def rename_result(self, name: str) -> Instruction:
        """Return the line with another name of its result."""
        return Instruction(f"  {name} = {self.text.partition(' = ')[2]}", name, self.does, self.names)


def split_into_blocks(module: str, symbol: str, longest: int) -> str | None:
    """Return a module with a function in blocks, None if it needs no blocks or is not straight.

    Parameters
    ----------
    module : str
        Text of an optimised module.
    symbol : str
        The function.
    longest : int
        Most instructions of a function that stays one block.
    """
    lines = module.splitlines()
    heads = f'"{symbol}"(', f"@{symbol}("  # LLVM leaves out quotes where a name needs none
    matches = (i for i, line in enumerate(lines) if line.startswith("define ") and any(head in line for head in heads))
    first = next(matches, None)
    if first is None:
        return None
    last = lines.index("}", first)
    body = lines[first + 1 : last]
    if len(body) <= longest or any(line and not line.startswith("  ") for line in body[1:]):
        return None
    body = [line.text for line in _Blocks(_without_repetitions(body), LENGTH).lines]
    return "\n".join([*lines[: first + 1], *body, *lines[last:], ""])


def _without_repetitions(body: list[str]) -> list[Instruction]:
    """Return instructions without those that repeat an earlier one, like compilers that see a whole block.

    It matters because a product used by two sums is not contracted with either.
    """
    instructions = list[Instruction]()
    first: dict[str, str] = {}  # operation -> its name
    instead: dict[str, str] = {}
    for text in body:
        line = Instruction.parse_line(text)
        if instead and not instead.keys().isdisjoint(line.names):
            line = line.rename_operands(lambda name: instead.get(name, name))
        if line.does in _PURE:
            operation = line.text.partition(" = ")[2]
            if line.does in _COMMUTATIVE:
                head, left, right = operation.replace(",", "").rsplit(" ", 2)
                operation = f"{head} {left} {right}" if left < right else f"{head} {right} {left}"
            if operation in first:
                instead[line.own] = first[operation]
                continue
            first[operation] = line.own
        instructions.append(line)
    return instructions


class _Blocks:
    """Moves reads and single-use products of one straight body to their uses, and ends blocks between.

    After the first store nothing is read again: it might read what the store wrote.
    """

    def __init__(self, lines: list[Instruction], longest: int) -> None:
        self.longest = longest
        self.lines: list[Instruction] = []
        self.held: dict[str, Instruction] = {}  # instructions that are printed at their use
        self.here: dict[str, str] = {}  # their names in this block
        self.loaded: dict[str, str] = {}  # names valid in all blocks from here on
        self.block = self.length = 0
        self.reads = {line.names[0] for line in lines if line.does == "load"}  # addresses
        uses = Counter(name for line in lines for name in line.names)
        stored = False
        for line in lines:
            if line.own and self._is_printed_at_use(line, uses[line.own] == 1, stored):
                self.held[line.own] = line
                continue
            if not stored and (line.text.startswith("  store ") or (" call " in line.text and not self._is_pure(line))):
                stored = True
                self._read_all()
            self._print_after_operands(line)
            if self.length >= self.longest and line is not lines[-1]:  # the last line leaves the function
                self._end_block()
        if self.block:
            self.lines += [Instruction.parse_line(".never:"), Instruction.parse_line("  unreachable")]

    @staticmethod
    def _is_pure(line: Instruction) -> bool:
        return "@llvm." in line.text or "double @" in line.text or "@symgen.sines" in line.text

    def _is_printed_at_use(self, line: Instruction, once: bool, stored: bool) -> bool:
        """Whether an instruction is printed at its use."""
        if line.does in ("fmul", "fneg"):
            return once
        return not stored and (line.does == "load" or (line.does == "getelementptr" and line.own in self.reads))

    def _print_after_operands(self, line: Instruction) -> None:
        """Print an instruction after its operands."""
        if not self.held.keys().isdisjoint(line.names):
            line = line.rename_operands(lambda name: self._name_in_block(name) if name in self.held else name)
        self.lines.append(line)
        self.length += 1

    def _name_in_block(self, name: str) -> str:
        """Return the name that a waiting instruction has in this block, printed if it was not."""
        if name not in self.here:
            self.here[name] = new = f"%.b{self.block}.{name[1:]}" if '"' not in name else f'%".b{self.block}.{name[2:]}'
            self._print_after_operands(self.held[name].rename_result(new))
        return self.here[name]

    def _read_all(self) -> None:
        """Print all reads, before the first store."""
        self.loaded = {name: self._name_in_block(name) for name, line in self.held.items() if line.does == "load"}

    def _end_block(self) -> None:
        """End the block."""
        self.block += 1
        self.length = 0
        self.here = dict(self.loaded)
        self.lines += [
            Instruction.parse_line(f"  {_END.format(next=f'.block{self.block}')}"),
            Instruction.parse_line(f".block{self.block}:"),
        ]
