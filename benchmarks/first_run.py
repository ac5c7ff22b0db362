"""What a first run enters: the functions of ``symgen run four-bar`` with an empty cache, as a page to read along.

``python -m benchmarks.first_run`` runs it and writes ``docs/development/first-run.md``. Of each stage the page has the
functions below which most others are entered for the first time: they are the way through it.
"""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "development" / "first-run.md"
#: Functions of a stage that the page has, at most: a screen.
SCREEN = 24
#: Runs the command, and writes each function of symgen in the order in which it is first entered: file, name, lines,
#: the file of the function that enters it, and how many others are first entered below it; and the imported files.
_TRACED = """
import atexit, json, os, sys, threading
root, entered = os.environ["TRACED_ROOT"], {}
def is_own(code):
    return code.co_filename.startswith(root) and code.co_flags & 1 and code.co_name[0] != "<"
def see(frame, event, argument):
    code = frame.f_code
    if event != "call" or code in entered or not is_own(code):
        return
    callers, back = dict(), frame.f_back
    while back is not None:
        if is_own(back.f_code):
            callers[back.f_code] = True
        back = back.f_back
    lines = [line for _, _, line in code.co_lines() if line]
    entered[code] = [max(lines) - min(lines) + 1, next((c.co_filename for c in callers), ""), 0]
    for caller in callers:
        if caller is not code and caller in entered:
            entered[caller][2] += 1
threading.setprofile(see)
sys.setprofile(see)
def tell():
    sys.setprofile(None)
    rows = [[c.co_filename, c.co_qualname, *counts] for c, counts in entered.items()]
    files = {m.__file__ for m in list(sys.modules.values()) if (getattr(m, "__file__", "") or "").startswith(root)}
    with open(os.environ["TRACED_TO"], "w") as file:
        json.dump([len(files), rows], file)
atexit.register(tell)
from symgen.cli import main
sys.argv = ["symgen", "run", "four-bar"]
main()
"""
#: Stages by the beginnings of their files; functions of `base` belong to the stage that enters them first.
STAGES = {
    "The command": ("cli/", "analyses/", "api.py", "__init__.py", "extension.py"),
    "Describe": ("describe/",),
    "Derive": ("derive/", "base/ir/"),
    "Compile": ("compile/", "run/compiling/"),
    "Run": ("run/",),
    "Result": ("result/",),
}
#: Functions that the page has at any rate: the pipeline itself.
_PIPELINE = re.compile(r"compile_in_stages|StraightStages\.(formulate|lower|emit|compile)")
#: What happens in a stage.
_WORDS = {
    "The command": "The command reads its options, calls the stages below, and prints the result.",
    "Describe": "The file becomes a validated, frozen `Mechanism`.",
    "Derive": "The mechanism becomes equations, programs and source text.",
    "Compile": "The source becomes machine code, and so do the loops around it. `pipeline.py` calls this stage and\n"
    "the one before.",
    "Run": "Settings become a plan, the start is closed, and the compiled loop runs. Its own functions are not in the\n"
    "table: they run as machine code.",
    "Result": "The outcome gets labels, energies and a judgement.",
}
_HEAD = """# What a first run enters

`symgen run four-bar` with an empty cache enters {count:,} functions of symgen. This page is a way through them, made by
`python -m benchmarks.first_run`. Each stage has the functions below which most others are entered for the first time,
in the order in which they are entered; the last column says how many these are. A second run takes source and machine
code from the cache, and enters neither `derive` nor the printer of machine code.
[Architecture](architecture.md) says what each room is for.
"""


@dataclass(frozen=True)
class Entered:
    """A function at its first entry.

    Attributes
    ----------
    file, name : str
        Its file, relative to the package, and its qualified name.
    lines : int
        Number of its lines.
    caller : str
        File of the function that entered it, relative to the package; empty without one.
    below : int
        Number of functions that were first entered below it.
    """

    file: str
    name: str
    lines: int
    caller: str
    below: int


def trace(root: Path) -> tuple[int, list[Entered]]:
    """Return the number of modules that a first run of a checkout imports, and the functions that it enters."""
    package = f"{root / 'symgen'}{os.sep}"
    with tempfile.TemporaryDirectory() as folder:
        written = Path(folder) / "traced.json"
        environment = {**os.environ, "SYMGEN_CACHE_DIR": str(Path(folder) / "cache"), "PYTHONPATH": str(root)}
        environment |= {"TRACED_ROOT": package, "TRACED_TO": str(written)}
        command = [sys.executable, "-c", _TRACED]
        subprocess.run(command, capture_output=True, text=True, cwd=folder, env=environment, check=True)
        count, rows = json.loads(written.read_text(encoding="utf-8"))
    short = [
        (file.removeprefix(package), name, n, caller.removeprefix(package), k) for file, name, n, caller, k in rows
    ]
    return count, [Entered(*row) for row in short]


def by_stage(entered: Iterable[Entered]) -> dict[str, list[Entered]]:
    """Return the functions of each stage, in the order in which they are entered."""
    found: dict[str, list[Entered]] = {stage: [] for stage in STAGES}
    of_file = dict[str, str]()
    for function in entered:
        places = (stage for stage, begins in STAGES.items() if function.file.startswith(begins))
        stage = next(places, of_file.get(function.caller, "The command"))
        of_file.setdefault(function.file, stage)
        found[stage].append(function)
    return found


@cache
def docstrings(path: Path) -> dict[str, str]:
    """Return the first lines of the docstrings of a file's functions, by qualified names."""
    found = dict[str, str]()

    def visit(nodes: Iterable[ast.AST], prefix: str) -> None:
        for node in nodes:
            if isinstance(node, ast.ClassDef | ast.FunctionDef):
                name = f"{prefix}{node.name}"
                if isinstance(node, ast.FunctionDef) and (text := ast.get_docstring(node)):
                    found[name] = text.splitlines()[0]
                visit(node.body, f"{name}.<locals>." if isinstance(node, ast.FunctionDef) else f"{name}.")

    visit(ast.parse(path.read_text(encoding="utf-8")).body, "")
    return found


def table_text(text: str) -> str:
    """Return a line of a docstring as text of a table."""
    return re.sub(r"`+", "`", text).replace("|", r"\|")


def page(entered: list[Entered], package: Path = ROOT / "symgen") -> str:
    """Return the page of a run."""
    parts = [_HEAD.format(count=len(entered))]
    for stage, functions in by_stage(entered).items():
        said = {f: text for f in functions if (text := docstrings(package / f.file).get(f.name))}
        own = [f for f in said if not f.file.startswith("base/") and f.below]
        shown = set(sorted(own, key=lambda f: (not _PIPELINE.fullmatch(f.name), -f.below))[:SCREEN])
        rows = [f"| `{f.file}` | `{f.name}` | {table_text(said[f])} | {f.below} |" for f in functions if f in shown]
        rest = Counter(str(Path(f.file).parent) for f in functions if f not in shown)
        others = ", ".join(
            f"`{room}` {count}" if room != "." else f"beside rooms {count}" for room, count in rest.most_common()
        )
        parts += [
            f"\n## {stage}\n\n{_WORDS[stage]}\n\n",
            "\n".join(["| file | function | what it does | enters |", "| --- | --- | --- | --- |", *rows]) + "\n",
            f"\n{len(functions) - len(shown)} more: {others}.\n",
        ]
    return "".join(parts)


def named(text: str) -> Iterator[tuple[str, str, str]]:
    """Yield file, function and first line of the docstring of each row of a page."""
    yield from re.findall(r"^\| `([\w/.]+)` \| `([\w.]+)` \| (.*) \| \d+ \|$", text, re.MULTILINE)


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(trace(ROOT)[1]), encoding="utf-8")


if __name__ == "__main__":
    main()
