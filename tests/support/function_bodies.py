"""Which emitted functions differ between ``generated/`` of a commit and of this checkout, wherever they stand.

``python -m support.function_bodies COMMIT [FOLDER ...]``: for a change that may only move functions between modules.
Functions are compared as text, from their decorator to their end, folder by folder; a module's constants and imports
are put in their places first, so that a function that means another section counts as another one.
"""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def bodies(source: str) -> Iterator[str]:
    """Yield the text of each function of a module, with the numbers of the constants that it names."""
    tree, lines = ast.parse(source), source.split("\n")
    constants = {
        node.targets[0].id: ast.unparse(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name)
    }
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            first = min([node, *node.decorator_list], key=lambda n: n.lineno)
            text = "\n".join(lines[first.lineno - 1 : node.end_lineno])
            named = sorted({n.id for n in ast.walk(node) if isinstance(n, ast.Name) and n.id in constants})
            yield text + "\n# " + ", ".join(f"{name} = {constants[name]}" for name in named)


def of_commit(commit: str, folder: str) -> set[str]:
    """Return the functions of a folder of ``generated/`` at a commit."""

    def git(*arguments: str) -> str:
        return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True).stdout

    names = git("ls-tree", "--name-only", commit, f"generated/{folder}/").splitlines()
    return {body for name in names if name.endswith(".py") for body in bodies(git("show", f"{commit}:{name}"))}


def of_checkout(folder: str) -> set[str]:
    """Return the functions of a folder of ``generated/`` as it is."""
    paths = sorted((ROOT / "generated" / folder).glob("*.py"))
    return {body for path in paths for body in bodies(path.read_text(encoding="utf-8"))}


if __name__ == "__main__":
    commit, *folders = sys.argv[1:]
    changed = False
    for folder in folders or sorted(p.name for p in (ROOT / "generated").iterdir() if p.is_dir()):
        before, after = of_commit(commit, folder), of_checkout(folder)
        print(f"{folder}: {len(after)} functions, {len(before - after)} gone, {len(after - before)} new")
        for sign, found in (("-", before - after), ("+", after - before)):
            for body in sorted(found):
                changed = True
                print(f"  {sign} " + next(line for line in body.splitlines() if line.startswith("def ")))
    sys.exit(changed)
