"""Counts of the sources: rooms, arrows between them, circles of imports, types, names, words of docs, a first run.

``python -m benchmarks.structure [CHECKOUT]`` prints the counts of this checkout, or of another one beside it;
``--first-run`` adds the functions that ``symgen run four-bar`` enters with an empty cache.
"""

from __future__ import annotations

import argparse
import ast
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path

from benchmarks.first_run import trace

ROOT = Path(__file__).resolve().parent.parent
#: Beginnings of the docstrings of functions that do nothing where a run has nothing of a kind.
_NOTHING = "Do nothing", "Mark the place"


def modules(package: Path) -> dict[str, ast.Module]:
    """Return the syntax trees of the modules of a package, by dotted names."""
    found = dict[str, ast.Module]()
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package.parent).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = ast.parse(path.read_text(encoding="utf-8"))
    return found


def imported(tree: ast.Module, known: set[str]) -> set[str]:
    """Return the modules that a module imports, at any place, for types as for values."""
    found = set[str]()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            found |= {
                f"{node.module}.{x.name}" if f"{node.module}.{x.name}" in known else node.module for x in node.names
            }
        elif isinstance(node, ast.Import):
            found |= {x.name for x in node.names}
    return found & known


def circles(arrows: dict[str, set[str]]) -> list[list[str]]:
    """Return the strongly connected parts of more than one module (Tarjan)."""
    index, low, stack, parts = dict[str, int](), dict[str, int](), list[str](), list[list[str]]()
    sys.setrecursionlimit(20000)

    def visit(name: str) -> None:
        index[name] = low[name] = len(index)
        stack.append(name)
        for other in sorted(arrows[name]):
            if other not in index:
                visit(other)
            if other in stack:
                low[name] = min(low[name], low[other])
        if low[name] == index[name]:
            part = list[str]()
            while not part or part[-1] != name:
                part.append(stack.pop())
            if len(part) > 1:
                parts.append(part)

    for name in arrows:
        if name not in index:
            visit(name)
    return parts


def _room(name: str) -> str:
    """Return the room of a module: at most two words behind the package."""
    return "/".join(name.split(".")[1:-1][:2]) or "."


def _parameters(trees: dict[str, ast.Module]) -> Iterator[str]:
    """Yield the annotations of all parameters."""
    for tree in trees.values():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                of = node.args
                for argument in (*of.posonlyargs, *of.args, *of.kwonlyargs, of.vararg, of.kwarg):
                    if argument is not None and argument.arg not in ("self", "cls"):
                        yield "" if argument.annotation is None else ast.unparse(argument.annotation)


def counts(root: Path) -> dict[str, object]:
    """Return the counts of a checkout."""
    trees = modules(root / "symgen")
    known = set(trees)
    arrows = {name: imported(tree, known) - {name} for name, tree in trees.items()}
    packages = {name for name in known if any(other.startswith(f"{name}.") for other in known)}
    rooms = Counter(_room(name) for name in known - packages)
    between = {(_room(a), _room(b)) for a, found in arrows.items() for b in found if _room(a) != _room(b)}
    parts = circles(arrows)
    files, functions, classes = (defaultdict[str, set[str]](set) for _ in range(3))
    nothing = Counter[str]()
    for name, tree in trees.items():
        if name not in packages:
            files[name.rpartition(".")[2]].add(_room(name))
        for node in tree.body:
            if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
                functions[node.name].add(name)
                if (ast.get_docstring(node) or "").startswith(_NOTHING):
                    nothing[name] += 1
            elif isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                classes[node.name].add(name)
    parameters = Counter(_parameters(trees))
    pages = [*sorted((root / "docs").rglob("*.md")), *sorted(root.glob("*.md"))]
    return {
        "modules": len(known - packages),
        "rooms": len(rooms),
        "modules of the largest rooms": rooms.most_common(6),
        "arrows between rooms": len(between),
        "circles of modules": len(parts),
        "modules of the largest circles": sorted(map(len, parts), reverse=True)[:5],
        "parameters": sum(parameters.values()),
        "parameters of any type": parameters["Any"],
        "functions that do nothing, files": (sum(nothing.values()), len(nothing)),
        "file names in two rooms": sum(len(where) > 1 for where in files.values()),
        "functions in two files": sum(len(where) > 1 for where in functions.values()),
        "classes in two files": sum(len(where) > 1 for where in classes.values()),
        "words of pages": sum(len(page.read_text(encoding="utf-8").split()) for page in pages),
        "lines of templates for C": sum(
            len(path.read_text(encoding="utf-8").splitlines()) for path in (root / "templates" / "c").iterdir()
        ),
    }


def first_run(root: Path) -> list[int]:
    """Return the modules that a first run imports, the functions that it enters, and their lines."""
    files, entered = trace(root)
    return [files, len(entered), sum(function.lines for function in entered)]


def main() -> None:
    """Print the counts."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("checkout", nargs="?", type=Path, default=ROOT)
    parser.add_argument("--first-run", action="store_true")
    arguments = parser.parse_args()
    for name, value in counts(arguments.checkout.resolve()).items():
        print(f"{name:36} {value}")
    if arguments.first_run:
        print(f"{'a first run: modules, functions, lines':36} {first_run(arguments.checkout.resolve())}")


if __name__ == "__main__":
    main()
