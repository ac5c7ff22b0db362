"""An FMU of FMI 2.0 or 3.0, co-simulation and model exchange in one file: a C compiler at hand."""

from __future__ import annotations

import hashlib
import io
import platform
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import msgspec
import numpy as np

from symgen.emit.module import render
from symgen.errors import InputError
from symgen.files import check_path, write_all
from symgen.running.package import Package
from symgen.targets._base_units import base_unit
from symgen.targets._c_model import CModel, sources
from symgen.targets._target import Request, Target
from symgen.version import __version__

#: Value references: parameters begin at 0, time is below all others.
_COLUMN, _OUTPUT, _STATE, _RATE, _EVENT, _TIME = 10_000, 20_000, 30_000, 40_000, 50_000, 60_000
#: Platforms by system: the folder of FMI 2 and of FMI 3, what libraries end in.
_PLATFORMS = {
    "linux": ("linux64", "linux", ".so"),
    "win32": ("win64", "windows", ".dll"),
    "darwin": ("darwin64", "darwin", ".dylib"),
}
_CROSS = "x86_64-w64-mingw32-gcc"
_OPTIONS = ("-std=c99", "-O2", "-shared", "-s")
#: Smallest of the singular values, over the largest, that count for the rank of rows.
_RANK = 1e-9


@dataclass
class Variable:
    """A variable of the model description; texts are those of XML attributes."""

    name: str
    reference: int
    causality: str
    variability: str
    unit: str = ""
    initial: str = ""
    start: str | None = None
    description: str = ""
    derivative: Variable | None = None
    index: int = 0


def _write(request: Request) -> Package:
    if request.fmi not in (2, 3):
        raise InputError("fmi", "2 or 3", str(request.fmi))
    check_path("-o", request.path, {".fmu": ()}, "")
    # inputs with formulas are inputs of the FMU all the same: whoever imports it connects them
    mechanism = msgspec.structs.replace(request.mechanism, input_formulas=())
    model = CModel.of(replace(request, mechanism=mechanism), "fmu")
    files = _files(model, request.fmi)
    binaries = _binaries(model, files, request.fmi)
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in {**files, **binaries}.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    write_all({request.path: content.getvalue()})
    compiled = model.compiled
    return Package(request.path.parent, (request.path,), compiled.derive_seconds, compiled.emit_seconds)


def _files(model: CModel, fmi: int) -> dict[str, bytes]:
    """Return the texts of an FMU by their names in it."""
    values = model.values() | _partition(model)
    values |= {
        "fmi": fmi,
        "guid": "",
        "version": __version__,
        **{"at_column": _COLUMN, "at_output": _OUTPUT, "at_state": _STATE, "at_rate": _RATE, "at_event": _EVENT},
        "at_time": _TIME,
    }
    texts = sources(model)
    source = render("c/fmu.c.j2", values)
    digest = hashlib.sha256("".join([*texts.values(), source]).encode()).hexdigest()
    guid = f"{{{digest[:8]}-{digest[8:12]}-{digest[12:16]}-{digest[16:20]}-{digest[20:32]}}}"
    values["guid"] = guid
    texts["fmu.c"] = render("c/fmu.c.j2", values)
    if fmi == 3:
        texts["buildDescription.xml"] = render("c/buildDescription.xml.j2", values)
    description = render(f"c/modelDescription{fmi}.xml.j2", values | _variables(model, values, fmi))
    return {"modelDescription.xml": description.encode(), **{f"sources/{n}": t.encode() for n, t in texts.items()}}


def _partition(model: CModel) -> dict[str, Any]:
    """Return how many coordinates and velocities depend on others at the start, and rows and places for it."""
    compiled, start, info = model.compiled, model.run.start, model.compiled.info
    rows = compiled.jacobian(start.w)
    holonomic = [i for i, row in enumerate(info.rows) if row.holonomic]
    ranks = [_rank(rows[holonomic]), _rank(rows)]
    return {
        "holonomic": holonomic,
        "spins": [f"{{{first}, {turning}}}" for first, turning in info.spins],
        "rank_q": ranks[0] + len(info.spins),
        "rank_v": ranks[1],
        "rest": len(info.states) + info.integrals,
        "windings": info.windings,
    }


def _rank(rows: Any) -> int:
    sizes = np.linalg.svd(rows, compute_uv=False) if rows.size else np.zeros(0)
    return int(np.sum(sizes > _RANK * sizes.max(initial=0.0)))


def _variables(model: CModel, values: dict[str, Any], fmi: int) -> dict[str, Any]:
    """Return the variables of the model description, and those of its structure."""
    mechanism, info = model.mechanism, model.compiled.info
    formulas = {p.name for p in mechanism.parameters if p.formula is not None}
    variables = list[Variable]()
    for i, parameter in enumerate(values["parameters"]):
        name, follows = parameter["name"], parameter["name"] in formulas
        kind = ("input", "continuous") if parameter["input"] else ("parameter", "fixed")
        kind = ("calculatedParameter", "fixed") if follows and not parameter["input"] else kind
        start = None if follows and not parameter["input"] else parameter["value"]
        initial = {"input": "", "parameter": "exact"}.get(kind[0], "calculated")
        variables.append(Variable(name, i, *kind, unit=parameter["unit"], initial=initial, start=start))
    units = [_unit_of(name) for name in model.columns]
    outputs = [(name, _COLUMN + i, unit) for i, (name, unit) in enumerate(zip(model.columns, units, strict=True))]
    names = {v.name for v in variables} | set(model.columns)
    for i, output in enumerate(mechanism.outputs):
        outputs.append((f"output.{output.name}" if output.name in names else output.name, _OUTPUT + i, output.unit))
    outputs_at = [Variable(n, r, "output", "continuous", unit=u, initial="calculated") for n, r, u in outputs]
    count = info.nq - values["rank_q"] + info.nv - values["rank_v"] + values["rest"]
    what = "independent coordinate or velocity, state or integral"
    states = [
        Variable(f"state.{i + 1}", _STATE + i, "local", "continuous", initial="calculated", description=what)
        for i in range(count)
    ]
    rates = [
        Variable(f"der(state.{i + 1})", _RATE + i, "local", "continuous", initial="calculated", derivative=state)
        for i, state in enumerate(states)
    ]
    marks = [*(f"event.{event.name}" for event in mechanism.events), "event.choice_of_states"] if fmi == 3 else []
    indicators = [
        Variable(name, _EVENT + i, "local", "continuous", initial="calculated") for i, name in enumerate(marks)
    ]
    variables += [*outputs_at, *states, *rates, *indicators]
    for i, variable in enumerate(variables, 1):
        variable.index = i
        variable.unit = "" if variable.unit in ("", "1") else variable.unit
        variable.name, variable.unit = _escaped(variable.name), _escaped(variable.unit)
    used = sorted({v.unit for v in variables} - {""})
    following = [v for v in variables if v.causality == "calculatedParameter"]
    return {
        "title": _escaped(values["title"]),
        "variables": variables,
        "units": [{"name": unit, "base": _attributes(base_unit(unit))} for unit in used],
        "outputs_at": outputs_at,
        "rates_at": rates,
        "unknown_at": sorted([*following, *outputs_at, *states, *rates], key=lambda v: v.index),
        "indicators": indicators,
    }


def _unit_of(column: str) -> str:
    name = column.rpartition(".")[2]
    if name in ("theta", "omega", "wx", "wy", "wz"):
        return "rad" if name == "theta" else "rad/s"
    return {"e": "", "v": "m/s"}.get(name[0], "m")


def _escaped(text: str) -> str:
    return quoteattr(text)[1:-1].replace('"', "&quot;")


def _attributes(exponents: dict[str, int | float] | None) -> str:
    return " ".join(f'{name}="{value}"' for name, value in (exponents or {}).items())


def _binaries(model: CModel, files: dict[str, bytes], fmi: int) -> dict[str, bytes]:
    """Return shared libraries of an FMU, for the machine at hand and for those that a cross compiler is there for.

    Raises
    ------
    InputError
        If there is no compiler, or it fails.
    """
    compiler = next((c for c in ("cc", "gcc", "clang") if shutil.which(c)), None)
    if compiler is None:
        raise InputError(
            "--target fmu", "a C compiler (cc, gcc or clang)", "none", "--target c needs none to be written"
        )
    binaries = dict[str, bytes]()
    with tempfile.TemporaryDirectory() as folder:
        for name, data in files.items():
            if name.endswith((".c", ".h")):
                (Path(folder) / Path(name).name).write_bytes(data)
        own = "win32" if sys.platform in ("win32", "cygwin") else sys.platform
        commands = {own: [compiler, *_OPTIONS, *(() if own == "win32" else ("-fPIC", "-fvisibility=hidden"))]}
        if own != "win32" and shutil.which(_CROSS):
            commands["win32"] = [_CROSS, *_OPTIONS, "-static-libgcc"]
        for system, command in commands.items():
            two, three, ending = _PLATFORMS.get(system, _PLATFORMS["linux"])
            machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())
            target = two if fmi == 2 else f"{machine}-{three}"
            library = Path(folder) / f"library{ending}"
            result = subprocess.run(
                [*command, "fmu.c", "-o", library.name, "-lm"], cwd=folder, capture_output=True, text=True, check=False
            )
            if result.returncode:
                raise InputError(
                    "--target fmu", f"code that {command[0]} compiles", _first_error(result.stderr.split("\n"))
                )
            binaries[f"binaries/{target}/{model.prefix}{ending}"] = library.read_bytes()
    return binaries


def _first_error(lines: Iterable[str]) -> str:
    return next((line for line in lines if "error" in line), "an error")


KIND = Target(_write, ".fmu")
