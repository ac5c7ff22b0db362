"""The code that stored run times belong to: a digest of loops and of the emitted yardstick that all ratios count in.

    python -m benchmarks.code_of_times

A table with run times names the integrators that it runs (`PageTable.integrators`), and its digest is that of their
loops: a change of one makes the times of its tables older, and of no others. Tables have it in the line below them, or
say that an older code had these times. It does not change with docstrings, comments or annotations, nor with the
compiler behind both.
"""

from __future__ import annotations

import ast
import hashlib
import sys
from collections.abc import Callable, Iterable
from functools import cache

from benchmarks.page_tables import ROOT, PageTable, is_older


def without_docstrings(source: str) -> str:
    """Return a source as Python reads it, without docstrings."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.FunctionDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:]
    return ast.unparse(tree)


@cache
def text_of_loop(loop: Callable[..., int]) -> str:
    """Return the text of all functions that a loop enters."""
    from symgen.run.loops.frame import integrate
    from symgen.run.printed.scheme_text import functions_of_loop

    return "\n".join(functions_of_loop(loop, integrate).values())


def loops_of(integrator: str) -> Iterable[Callable[..., int]]:
    """Yield the loops of an integrator, with constant and with adaptive steps; with both forms where methods decide."""
    from symgen.run.integrators import INTEGRATORS
    from symgen.run.loops.schemes import implicit, projected

    for adaptive in (False, True):
        loop = INTEGRATORS.get(integrator).loop(adaptive)
        yield from (implicit.constant, projected.constant) if loop is None else (loop,)


@cache
def text_of_yardstick() -> str:
    """Return the emitted modules of the four-bar with `lagrange`."""
    from symgen.describe import load
    from symgen.run.compiling.method_choice import choose_method
    from symgen.run.compiling.pipeline import generate

    generated = generate(load("four-bar"), (choose_method("lagrange"),), "straight", whole=True)
    return "\n".join(without_docstrings(generated.modules[stem][0]) for stem in sorted(generated.modules))


def texts(integrators: Iterable[str]) -> Iterable[str]:
    """Yield the texts that run times of integrators depend on: of the yardstick, and of loops that it has not."""
    from symgen.run.loops.schemes import explicit, picard

    yardstick = explicit.constant, explicit.adaptive, picard.adaptive
    yield from map(text_of_loop, yardstick)
    yield text_of_yardstick()
    own = dict.fromkeys(loop for name in sorted(integrators) for loop in loops_of(name))
    yield from (text_of_loop(loop) for loop in own if loop not in (*yardstick, picard.constant))


def code_of_times(table: PageTable) -> str:
    """Return the digest of the present code of a table's times, eight digits."""
    return hashlib.sha256("\n".join(texts(table.integrators)).encode()).hexdigest()[:8]


def main() -> int:
    """Print the tables with times, their digests, and whose pages are older."""
    from benchmarks.findings import measured_tables

    for table in filter(lambda table: table.times, measured_tables(times=True)):
        code = code_of_times(table)
        older = is_older(table, (ROOT / table.page).read_text(encoding="utf-8"), code)
        sys.stdout.write(f"code {code}{', page older' if older else ''}: {table.command} in {table.page}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
