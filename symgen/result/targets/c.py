"""C for programs and microcontrollers, and a run that prints CSV: a C99 compiler."""

from __future__ import annotations

from symgen.derive.emit.module import render_template
from symgen.result.targets._c_model import CModel, sources
from symgen.result.targets._target import Request, Target
from symgen.run.planning.package import Package, write_folder


def _write(request: Request) -> Package:
    model = CModel.of(request, "c")
    files = sources(model.values)
    files["main.c"] = render_template("c/main.c.j2", model.values)
    files["README.md"] = render_template("c/README.md.j2", model.values)
    compiled = model.compiled
    written = write_folder(request.path, files, beside=("README.md",))
    return Package(request.path, written, compiled.derive_seconds, compiled.emit_seconds, model.notes)


KIND = Target(_write, bounded=True, runs=True)
