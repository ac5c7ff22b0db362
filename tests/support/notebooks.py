"""Notebooks without a kernel: cells run one after the other, and what the last line of each shows is kept."""

import ast
import base64
import contextlib
import io
import json
from pathlib import Path
from typing import Any

#: Method of an object -> what notebooks call its form.
FORMS = {
    "_repr_html_": "text/html",
    "_repr_svg_": "image/svg+xml",
    "_repr_png_": "image/png",
    "_repr_latex_": "text/latex",
}


def shown(value: Any) -> dict[str, Any]:
    """Return the forms of an object that a notebook keeps."""
    forms: dict[str, Any] = {"text/plain": repr(value)}
    for method, kind in FORMS.items():
        form = getattr(value, method)() if hasattr(value, method) else None
        if form is not None:
            forms[kind] = base64.b64encode(form).decode() if isinstance(form, bytes) else form
    return forms


def outputs(cells: list[str]) -> list[list[dict[str, Any]]]:
    """Return what each cell shows, as notebooks have it; a semicolon at the end of a cell keeps its last line back."""
    names: dict[str, Any] = {"__name__": "__main__"}
    kept = []
    for number, text in enumerate(cells, 1):
        body, found = ast.parse(text).body, list[dict[str, Any]]()
        last = body.pop() if isinstance(body[-1], ast.Expr) and not text.rstrip().endswith(";") else None
        with contextlib.redirect_stdout(io.StringIO()) as stream:
            exec(compile(ast.Module(body, []), f"<cell {number}>", "exec"), names)
            value = None
            if isinstance(last, ast.Expr):
                value = eval(compile(ast.Expression(last.value), f"<cell {number}>", "eval"), names)
        if stream.getvalue():
            found.append({"name": "stdout", "output_type": "stream", "text": stream.getvalue().splitlines(True)})
        if value is not None:
            result = {"data": shown(value), "execution_count": number, "metadata": {}}
            found.append({**result, "output_type": "execute_result"})
        kept.append(found)
    return kept


def kinds(kept: list[dict[str, Any]]) -> list[str]:
    """Return the kinds of what a cell shows."""
    return [kind for output in kept for kind in output.get("data", {"stream": ""})]


def store(path: Path) -> None:
    """Run a notebook and keep what its cells show."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    for number, (cell, found) in enumerate(zip(code, outputs(["".join(c["source"]) for c in code]), strict=True), 1):
        cell["outputs"], cell["execution_count"] = found, number
    path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
