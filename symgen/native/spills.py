"""Values of long straight functions that wait in memory, decided before machine code is made.

A compiler tries registers for every value, in every way it knows, before it gives one up; with hundreds of values that
wait for use thousands of instructions later, the time for that grows faster than the function. Here one pass knows what
is wanted next: where more values are held than there are registers, the one that is wanted last goes to memory and
comes back when it is wanted (Belady). What the compiler then sees are short lives, of which few overlap.
"""

from __future__ import annotations

import heapq
import re
from collections.abc import Callable, Sequence
from typing import NamedTuple

#: Values that are held at a time: of the 16 registers that every processor of x86-64 has, one is left for moving.
REGISTERS = 15
_NAME = re.compile(r'%(?:"[^"]*"|[-\w.$]+)')
_DEFINED = re.compile(r'\s+%(?:"[^"]*"|[-\w.$]+) = (\w+)')
_ARITHMETIC = frozenset(("fadd", "fsub", "fmul", "fdiv", "fneg", "frem"))
_FLOATS = {"load": " = load double, ", "extractelement": " x double> ", "call": "double @", "select": ", double "}
#: Calls that leave registers as they are, because a few instructions stand for them.
_PLAIN = re.compile(r"@llvm\.(?:sqrt|fabs|copysign|fma|fmuladd|minnum|maxnum)\.f64")


class Line(NamedTuple):
    """An instruction, or a label.

    Attributes
    ----------
    text : str
        As LLVM writes it.
    own : str
        The name of its result, empty if it has none.
    does : str
        What gives the result: ``fadd``, ``load``.
    names : tuple of str
        What it wants, and labels.
    """

    text: str
    own: str
    does: str
    names: tuple[str, ...]

    @classmethod
    def of(cls, text: str) -> Line:
        """Take a line of a function apart."""
        names = tuple(_NAME.findall(text))
        defined = _DEFINED.match(text)
        return cls(text, names[0], defined[1], names[1:]) if defined else cls(text, "", "", names)

    def renamed(self, new: Callable[[str], str]) -> Line:
        """Return the line with other names for what it wants."""
        names = tuple(map(new, self.names))
        if names == self.names:
            return self
        head, equals, rest = self.text.partition(" = ") if self.own else ("", "", self.text)
        instead = iter(names)
        return Line(head + equals + _NAME.sub(lambda found: next(instead), rest), self.own, self.does, names)

    def called(self, name: str) -> Line:
        """Return the line with another name for its result."""
        return Line(f"  {name} = {self.text.partition(' = ')[2]}", name, self.does, self.names)

    def is_float(self) -> bool:
        """Whether the result is a float."""
        if self.does in _ARITHMETIC:
            return " double " in self.text
        return _FLOATS.get(self.does, "\n") in self.text or self.text.endswith(" to double")


def most_alive(lines: Sequence[Line]) -> int:
    """Return how many floats of a straight body are wanted later, where most are."""
    last = {name: i for i, line in enumerate(lines) for name in line.names}
    ends = [0] * len(lines)
    alive = most = 0
    for i, line in enumerate(lines):
        if line.own in last and line.is_float() and line.does != "load":  # inputs can be read again
            alive += 1
            ends[last[line.own]] += 1
        most = max(most, alive)
        alive -= ends[i]
    return most


def through_memory(lines: Sequence[Line]) -> list[str]:
    """Return a straight body in which few values are held at a time.

    Parameters
    ----------
    lines : sequence of Line
        Instructions and labels, in the order in which they run.

    Returns
    -------
    list of str
        The same instructions in the same order, with stores and loads between them.
    """
    body = _Body(lines)
    for i, line in enumerate(lines):
        body.step(i, line)
    return body.text()


class _Body:
    """Follows a body and notes what is held, what waits in memory, and since when."""

    def __init__(self, lines: Sequence[Line]) -> None:
        self.uses: dict[str, list[int]] = {}  # by value: lines that want it, the first one last, as they become past
        for i, line in enumerate(lines):
            for name in dict.fromkeys(line.names):
                if name in self.uses:
                    self.uses[name].append(i)
            if line.own and line.is_float():
                self.uses[line.own] = []
        self.last = {name: uses[-1] for name, uses in self.uses.items() if uses}
        for uses in self.uses.values():
            uses.reverse()
        self.held: dict[str, int] = {}  # values in registers, and where each is wanted next
        self.order: list[tuple[int, str]] = []  # the same, last wanted first, with what holds no longer
        self.now: dict[str, str] = {}  # names of values that came back
        self.out: list[tuple[str, str]] = []  # lines, and what comes back by them
        self.defined: dict[str, tuple[int, int]] = {}  # by value: its line, and what is printed behind that
        self.waiting: dict[str, None] = {}  # values that have to be in memory
        self.count = 0

    def step(self, i: int, line: Line) -> None:
        """Print a line, behind what comes back for it."""
        for name in dict.fromkeys(line.names):
            if name in self.uses:
                if name not in self.held:
                    self.come_back(name)
                self.uses[name].pop()
                self.hold(name)
        if " call " in line.text and not _PLAIN.search(line.text):
            self.held.clear()
        self.out.append((line.renamed(lambda name: self.now.get(name, name)).text, ""))
        if line.own in self.uses:
            self.defined[line.own] = i, len(self.out)
            self.hold(line.own)

    def hold(self, name: str) -> None:
        """Keep a value in a register until it is wanted next; what is wanted last gives way."""
        uses = self.uses[name]
        if not uses:
            self.held.pop(name, None)
            return
        self.held[name] = uses[-1]
        heapq.heappush(self.order, (-uses[-1], name))
        while len(self.held) > REGISTERS:
            at, last = heapq.heappop(self.order)
            if self.held.get(last) == -at:
                del self.held[last]

    def come_back(self, name: str) -> None:
        """Print what reads a value from memory."""
        self.count += 1
        self.now[name] = new = f"%.again.{self.count}"
        self.waiting[name] = None
        self.out.append((f"  {new} = load double, ptr ", name))

    def text(self) -> list[str]:
        """Return the lines; a place in memory is used again when what stood there is past."""
        places, count = self.places()
        stores = {self.defined[name][1]: name for name in self.waiting}
        lines = list[str]()
        for at, (line, back) in enumerate(self.out):
            if at in stores:
                lines.append(f"  store double {stores[at]}, ptr %.kept.{places[stores[at]]}")
            lines.append(f"{line}%.kept.{places[back]}" if back else line)
        begin = 0 if lines[0].startswith("  ") else 1
        memory = [f"  %.kept = alloca [{count} x double]"] if count else []
        memory += [f"  %.kept.{k} = getelementptr inbounds double, ptr %.kept, i64 {k}" for k in range(count)]
        return [*lines[:begin], *memory, *lines[begin:]]

    def places(self) -> tuple[dict[str, int], int]:
        """Return the place of each value that waits in memory, and how many places there are."""
        found = dict[str, int]()
        free = list[int]()
        taken = list[tuple[int, int]]()  # until which line, and which
        for name in sorted(self.waiting, key=lambda name: self.defined[name][0]):
            while taken and taken[0][0] <= self.defined[name][0]:
                heapq.heappush(free, heapq.heappop(taken)[1])
            found[name] = heapq.heappop(free) if free else len(taken)
            heapq.heappush(taken, (self.last[name], found[name]))
        return found, 1 + max(found.values(), default=-1)
