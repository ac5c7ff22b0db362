"""An FMU of FMI 2.0 or 3.0, co-simulation and model exchange in one file: a C compiler at hand."""

from __future__ import annotations

import io
import platform
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from uuid import NAMESPACE_OID, uuid5

import msgspec

from symgen.base.errors import InputError
from symgen.base.files import check_path, write_all
from symgen.base.version import __version__
from symgen.derive.emit.module import render_template
from symgen.result.targets._base_units import base_unit
from symgen.result.targets._c_model import CModel, sources
from symgen.result.targets._fmu_modes import indicator_names, values_of_exchange
from symgen.result.targets._fmu_structure import outputs_of_states
from symgen.result.targets._joint_outputs import names_of_states
from symgen.result.targets._target import Request, Target
from symgen.run.planning.package import Package

#: Value references: parameters begin at 0, time follows all others.
_COLUMN, _OUTPUT, _STATE, _RATE, _EVENT, _TIME = 10_000, 20_000, 30_000, 40_000, 50_000, 60_000
#: Platforms by system: the folders of FMI 2 and FMI 3, the suffix of libraries.
_PLATFORMS = {
    "linux": ("linux64", "linux", ".so"),
    "win32": ("win64", "windows", ".dll"),
    "darwin": ("darwin64", "darwin", ".dylib"),
}
_CROSS = "x86_64-w64-mingw32-gcc"
_OPTIONS = ("-std=c99", "-O2", "-shared", "-s")


@dataclass
class ModelVariable:
    """A variable of the model description."""

    name: str
    reference: int
    causality: str
    variability: str = "continuous"
    initial: str = "calculated"
    unit: str = ""
    start: str | None = None
    description: str = ""
    derivative: ModelVariable | None = None
    index: int = 0
    dependencies: str | None = None


def _write(request: Request) -> Package:
    if request.fmi not in (2, 3):
        raise InputError("fmi", "2 or 3", str(request.fmi))
    check_path("-o", request.path, {".fmu": ()}, "")
    # inputs with formulas remain inputs of the FMU: the importing tool connects them
    mechanism = msgspec.structs.replace(request.mechanism, input_formulas=())
    model = CModel.of(replace(request, mechanism=mechanism), "fmu")
    if request.derivatives and not model.exchanges:
        found = "joints that hold for a while, whose modes an importer cannot find"
        reason = f"the steps of '{request.integrator}'" if model.named else found
        raise InputError("derivatives", "an FMU for model exchange, of whose states derivatives are", reason)
    files = fmu_files(model, request.fmi)
    files |= _binaries(model.prefix, files, request.fmi)
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    write_all({request.path: content.getvalue()})
    compiled = model.compiled
    return Package(request.path.parent, (request.path,), compiled.derive_seconds, compiled.emit_seconds, model.notes)


def fmu_files(model: CModel, fmi: int) -> dict[str, bytes]:
    """Return the text files of an FMU of a version of the interface by their names in it."""
    texts = sources(model.values)
    values = model.values | values_of_exchange(model)
    values |= {
        "fmi": fmi,
        "derivatives": model.derivatives,
        "guid": f"{{{uuid5(NAMESPACE_OID, ' '.join([*texts.values(), str(fmi), __version__]))}}}",
        "version": __version__,
        **{"at_column": _COLUMN, "at_output": _OUTPUT, "at_state": _STATE, "at_rate": _RATE, "at_event": _EVENT},
        "at_time": _TIME,
    }
    texts["fmu.c"] = render_template("c/fmu.c.j2", values)
    if fmi == 3:
        texts["buildDescription.xml"] = render_template("c/buildDescription.xml.j2", values)
    description = render_template("c/modelDescription.xml.j2", values | _variables(model, values, fmi))
    return {"modelDescription.xml": description.encode(), **{f"sources/{n}": t.encode() for n, t in texts.items()}}


def _variables(model: CModel, values: Mapping[str, Any], fmi: int) -> dict[str, Any]:
    """Return the variables of the model description and of its structure."""
    mechanism = model.mechanism
    formulas = {p.name for p in mechanism.parameters if p.formula is not None}
    parameters, following = list[ModelVariable](), list[ModelVariable]()
    for i, parameter in enumerate(values["parameters"]):
        name, unit, value = parameter["name"], parameter["unit"], parameter["value"]
        if parameter["input"]:
            parameters.append(ModelVariable(name, i, "input", initial="", unit=unit, start=value))
        elif name in formulas:
            following.append(ModelVariable(name, i, "calculatedParameter", "fixed", unit=unit))
            parameters.append(following[-1])
        else:
            parameters.append(ModelVariable(name, i, "parameter", "fixed", "exact", unit, value))
    outputs = [ModelVariable(q.name, _COLUMN + i, "output", unit=q.unit) for i, q in enumerate(model.columns)]
    names = {v.name for v in (*parameters, *outputs)}
    modes = {f"{row.name}.mode" for row in mechanism.bounded}
    for i, output in enumerate(mechanism.outputs):
        name = f"output.{output.name}" if output.name in names else output.name
        variability = "discrete" if output.name in modes else "continuous"
        outputs.append(ModelVariable(name, _OUTPUT + i, "output", variability, unit=output.unit))
    count = values["states"]
    what, called = "independent coordinate or velocity, state or integral", names_of_states(model.compiled.info, count)
    states = [ModelVariable(f"state.{n}", _STATE + i, "local", description=what) for i, n in enumerate(called)]
    rates = [ModelVariable(f"der({s.name})", _RATE + i, "local", derivative=s) for i, s in enumerate(states)]
    marks = _named_apart([f"event.{name}" for name in indicator_names(model)]) if fmi == 3 else []
    indicators = [ModelVariable(name, _EVENT + i, "local") for i, name in enumerate(marks)]
    variables = [*parameters, *outputs, *states, *rates, *indicators]
    for i, variable in enumerate(variables, 1):
        variable.index = i
        variable.unit = "" if variable.unit == "1" else variable.unit
    if model.derivatives:
        columns, own = outputs_of_states(model)
        knowns = " ".join(str(s.index if fmi == 2 else s.reference) for s in states)
        knowns += f" {_TIME}" if fmi == 3 else ""
        for variable, is_known in zip(outputs, [columns] * len(model.columns) + own, strict=True):
            variable.dependencies = knowns if is_known and variable.variability == "continuous" else None
    units = sorted({v.unit for v in variables} - {""})
    return {
        "variables": variables,
        "units": [{"name": unit, "base": base_unit(unit) or {}} for unit in units],
        "outputs_at": outputs,
        "rates_at": rates,
        "unknown_at": [*following, *outputs, *states, *rates],
        "indicators": indicators,
    }


def _named_apart(names: Sequence[str]) -> list[str]:
    """Return names of which each stands once: an event with two sides, such as slip, has a number for the second."""
    seen, unique = Counter[str](), list[str]()
    for name in names:
        seen[name] += 1
        unique.append(name if seen[name] == 1 else f"{name}.{seen[name]}")
    return unique


def _binaries(prefix: str, files: Mapping[str, bytes], fmi: int) -> dict[str, bytes]:
    """Return shared libraries of an FMU for this machine, and for Windows if a cross compiler is installed.

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
                error = next((line for line in result.stderr.splitlines() if "error" in line), "an error")
                raise InputError("--target fmu", f"code that {command[0]} compiles", error)
            binaries[f"binaries/{target}/{prefix}{ending}"] = library.read_bytes()
    return binaries


KIND = Target(_write, ".fmu", bounded=True, runs=True, derivatives=True)
