"""The code that stored run times belong to: a digest of the loops and the emitted yardstick that all ratios count in.

    python -m benchmarks.code_of_times

Tables with run times have it in the line below them, or say that an older code had these times. It does not change with
docstrings, comments or annotations, nor with the compiler behind both.
"""

from __future__ import annotations

import ast
import hashlib
import sys
from collections.abc import Iterable
from functools import cache

from benchmarks.page_tables import ROOT, is_older


def without_docstrings(source: str) -> str:
    """Return a source as Python reads it, without docstrings."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.FunctionDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:]
    return ast.unparse(tree)


def texts() -> Iterable[str]:
    """Yield the texts that run times depend on."""
    from symgen.describe import load
    from symgen.run.compiling.method_choice import choose_method
    from symgen.run.compiling.pipeline import generate
    from symgen.run.loops.frame import integrate
    from symgen.run.loops.schemes import explicit, picard
    from symgen.run.printed.scheme_text import functions_of_loop

    for loop in (explicit.constant, explicit.adaptive, picard.adaptive):
        yield from functions_of_loop(loop, integrate).values()
    generated = generate(load("four-bar"), (choose_method("lagrange"),), "straight", whole=True)
    for stem in sorted(generated.modules):
        yield without_docstrings(generated.modules[stem][0])


@cache
def code_of_times() -> str:
    """Return the digest of the present code, eight digits."""
    return hashlib.sha256("\n".join(texts()).encode()).hexdigest()[:8]


def main() -> int:
    """Print the digest, and the tables whose times are older."""
    from benchmarks.findings import measured_tables

    code = code_of_times()
    sys.stdout.write(f"code {code}\n")
    for table in measured_tables(times=True):
        if is_older(table, (ROOT / table.page).read_text(encoding="utf-8"), code):
            sys.stdout.write(f"older: {table.command} in {table.page}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
