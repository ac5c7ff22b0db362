"""Long straight functions divided into blocks, after the optimiser and before machine code is made.

The time that compilers spend on one block grows faster than its length: they look at pairs of its instructions. A block
ends here where nothing is lost by it: inputs are read again in every block that wants them, which spares their way
through the stack, and a product that one sum wants stands beside that sum, so that the two are contracted as before.
"""

from __future__ import annotations

import re
from collections import Counter

#: Instructions of a block.
LENGTH = 1000
_NAME = re.compile(r'%(?:"[^"]*"|[-\w.$]+)')
_DEFINED = re.compile(r'\s+(%(?:"[^"]*"|[-\w.$]+)) = (\w+)')
_COMMUTATIVE = frozenset(("fadd", "fmul"))
_PURE = _COMMUTATIVE | {"fsub", "fdiv", "fneg"}
#: Ends a block without an instruction: what it jumps to is never reached, which the compiler cannot know.
_END = 'callbr void asm sideeffect "", "!i"() memory(none) nounwind to label %{next} [label %.never]'


def split(module: str, symbol: str, longest: int) -> str | None:
    """Return a module with a function in blocks, None if it needs none or is not straight.

    Parameters
    ----------
    module : str
        Text of an optimised module.
    symbol : str
        The function.
    longest : int
        Number of instructions up to which the function stays one block.
    """
    lines = module.splitlines()
    first = next((i for i, line in enumerate(lines) if line.startswith("define ") and f'"{symbol}"(' in line), None)
    first = first if first is not None else _unquoted(lines, symbol)
    if first is None:
        return None
    last = lines.index("}", first)
    body = lines[first + 1 : last]
    if len(body) <= longest or any(line and not line.startswith("  ") for line in body[1:]):
        return None
    return "\n".join([*lines[: first + 1], *_Blocks(body).lines, *lines[last:], ""])


def _unquoted(lines: list[str], symbol: str) -> int | None:
    return next((i for i, line in enumerate(lines) if line.startswith("define ") and f"@{symbol}(" in line), None)


def _without_repetitions(body: list[str]) -> list[str]:
    """Return instructions without those that repeat an earlier one, as compilers see it that look at a whole block.

    It matters because a product that two sums want is not contracted with either.
    """
    kept: list[str] = []
    first: dict[str, str] = {}  # operation -> its name
    instead: dict[str, str] = {}
    for line in body:
        if instead:
            line = _NAME.sub(lambda found: instead.get(found[0], found[0]), line)
        defined = _DEFINED.match(line)
        if defined and defined[2] in _PURE:
            operation = line.partition(" = ")[2]
            if defined[2] in _COMMUTATIVE:
                head, left, right = operation.replace(",", "").rsplit(" ", 2)
                operation = " ".join((head, *sorted((left, right))))
            if operation in first:
                instead[defined[1]] = first[operation]
                continue
            first[operation] = defined[1]
        kept.append(line)
    return kept


class _Blocks:
    """Moves reads and single-use products of one straight body to where they are wanted, and ends blocks between.

    After the first store nothing is read again: what it wrote might be what is read.
    """

    def __init__(self, body: list[str]) -> None:
        self.lines: list[str] = []
        self.held: dict[str, str] = {}  # instructions that are printed where they are wanted
        self.here: dict[str, str] = {}  # their names in this block
        self.kept: dict[str, str] = {}  # those that hold for all blocks from here on
        self.block = self.length = 0
        body = _without_repetitions(body)
        self.reads = self._reads(body)
        uses = Counter(name for line in body for name in _NAME.findall(line))
        stored = False
        for line in body:
            defined = _DEFINED.match(line)
            if defined and self._waits(defined[1], defined[2], uses[defined[1]] == 2, stored):
                self.held[defined[1]] = line
                continue
            if not stored and (line.startswith("  store ") or (" call " in line and not self._is_pure(line))):
                stored = True
                self._read_all()
            self._put(line)
            if self.length >= LENGTH:
                self._end()
        if self.block:
            self.lines += [".never:", "  ret i32 1"]

    @staticmethod
    def _reads(body: list[str]) -> set[str]:
        """Return the addresses from which something is read."""
        return {line.split(", ptr ")[1].split(",")[0] for line in body if " = load " in line}

    @staticmethod
    def _is_pure(line: str) -> bool:
        return "@llvm." in line or "double @" in line or "@symgen.sines" in line

    def _waits(self, name: str, instruction: str, once: bool, stored: bool) -> bool:
        """Whether an instruction is printed where it is wanted."""
        if instruction in ("fmul", "fneg"):
            return once
        return not stored and (instruction == "load" or (instruction == "getelementptr" and name in self.reads))

    def _put(self, line: str) -> None:
        """Print an instruction behind those it waits for."""
        names = dict.fromkeys(name for name in _NAME.findall(line) if name in self.held)
        renamed = {name: self._name(name) for name in names}
        if renamed:
            line = _NAME.sub(lambda found: renamed.get(found[0], found[0]), line)
        self.lines.append(line)
        self.length += 1

    def _name(self, name: str) -> str:
        """Return the name that a waiting instruction has in this block, printed if it was not."""
        if name not in self.here:
            line = self.held[name]
            self.here[name] = new = f"%.b{self.block}.{name[1:]}" if '"' not in name else f'%".b{self.block}.{name[2:]}'
            self._put(f"  {new} = {line.partition(' = ')[2]}")
        return self.here[name]

    def _read_all(self) -> None:
        """Print all reads, before the first store."""
        self.kept = {name: self._name(name) for name, line in self.held.items() if " = load " in line}

    def _end(self) -> None:
        """End the block."""
        self.block += 1
        self.length = 0
        self.here = dict(self.kept)
        self.lines += [f"  {_END.format(next=f'.block{self.block}')}", f".block{self.block}:"]
