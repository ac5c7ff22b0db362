"""What programs rely on stays: flags, keys of JSON, columns of files, keys of mechanism files, Python names.

``tests/data/contract.json`` lists them; a test takes the list of this tree and asks that nothing is missing. Additions
are free; ``SYMGEN_UPDATE_CONTRACT=1`` puts them into the file in the slow run.
"""

import csv
import inspect
import json
import os
from collections.abc import Iterable
from dataclasses import fields
from pathlib import Path
from typing import Any

import click
import h5py
import pytest

import symgen
from symgen.base.settings import Settings
from symgen.cli import COMMANDS, group, main
from symgen.describe.files.json_schema import file_schema
from symgen.result.labelled import Labelled
from symgen.result.result import Result
from symgen.study.ensemble.parameter_sweep import sweep

KEPT = Path(__file__).resolve().parents[1] / "data" / "contract.json"

#: Tables whose keys are not fixed: which functions and kernels there are is the generator's business.
OPEN = ("shape.kernels", "method.functions")
#: Functions that every method has.
FIXED = ("rhs",)
#: Steps of a run that stand in the class for the package's own use.
STEPS = {"compiled", "ready", "initial_state"}

SHORT = ("--methods", "lagrange", "--integrators", "rk4", "--steps", "0.01", "--until", "0.2", "--repeat", "1")
#: Commands that write JSON, by a name for the file; the last words of some have them write a file as well.
WRITES_JSON = {
    "run": ("run", "four-bar", "--until", "0.05", "--save", "run.csv"),
    "run, singular": ("run", "n-four-bar:1", "--until", "1.2", "--step", "2e-3"),
    "run, spatial": ("run", "spherical-double-pendulum", "--until", "0.01", "--save", "space.csv"),
    "compare": ("compare", "pendulum", *SHORT, "--csv", "compare.csv"),
    "compare, several": ("compare", "pendulum", "four-bar", *SHORT),
    "kinematics": ("kinematics", "driven-four-bar", "--times", "0,0.1", "--transmission", "C"),
    "inverse": ("inverse", "driven-four-bar", "--times", "0,0.1"),
    "check": ("check", "four-bar"),
    "list": ("list",),
    "inspect": ("inspect", "four-bar", "--method", "direct-correction"),
    "sweep": ("sweep", "pendulum", "--vary", "bob.vy=lin(0,1,2)", "--until", "0.02", "-o", "sweep.nc"),
    "stress": (
        *("stress", "pendulum", "--cases", "gravity", "--methods", "lagrange,auto", "--quick"),
        *("--csv", "stress.csv"),
    ),
    "cache info": ("cache", "info"),
    "generate": ("generate", "pendulum", "--method", "lagrange", "-o", "emitted"),
}


def keys(value: Any, path: str = "") -> set[str]:
    """Return the paths of all keys; ``[]`` is any entry of a list, ``*`` any key of an open table."""
    found: set[str] = set()
    if isinstance(value, dict):
        for key, item in value.items():
            name = "*" if path in OPEN and key not in FIXED else key
            inner = f"{path}.{name}" if path else name
            found |= {inner} | keys(item, inner)
    elif isinstance(value, list):
        for item in value:
            found |= keys(item, f"{path}[]")
    return found


def flags(command: click.Command, name: str) -> dict[str, set[str]]:
    """Return the arguments and every spelling of every option of a command and those below it."""
    found = {name: {o for p in command.params for o in (*p.opts, *p.secondary_opts)}}
    for option in command.params:
        if isinstance(option.type, click.Choice):
            found[name] |= {f"{option.opts[0]}={choice}" for choice in option.type.choices}
    if isinstance(command, click.Group):
        context = click.Context(command)
        for below in command.list_commands(context):
            inner = command.get_command(context, below)
            assert inner is not None, below
            found |= flags(inner, f"{name} {below}".strip())
    return found


def public(kind: type) -> set[str]:
    """Return the public attributes and methods of a class."""
    found = {name for name in (*dir(kind), *getattr(kind, "__dataclass_fields__", ())) if not name.startswith("_")}
    return found - STEPS


def file_keys() -> dict[str, set[str]]:
    """Return the keys of every section, and of every joint and force by its type."""
    found: dict[str, set[str]] = {}
    for section, table in file_schema()["properties"].items():
        entry = table.get("additionalProperties") or table
        for kind in entry.get("oneOf") or entry.get("anyOf") or [entry]:
            own = kind.get("properties", {})
            types = own.get("type", {}).get("enum", [""]) if "oneOf" in entry else [""]
            for name in types:
                found.setdefault(f"{section} {name}".strip(), set()).update(own)
    return found


def columns(path: Path) -> set[str]:
    with path.open(newline="") as file:
        return set(next(csv.reader(file)))


def netcdf(path: Path) -> set[str]:
    """Return variables and attributes of a NetCDF file."""
    with h5py.File(path) as file:
        variables = {f"variable {name}" for name in file}
        units = {f"units of {name}" for name in file if "units" in file[name].attrs}
        return variables | units | {f"attribute {name}" for name in file.attrs if not name.startswith("_")}


def python_names() -> dict[str, set[str]]:
    signatures = {
        "simulate": symgen.simulate,
        "load": symgen.load,
        "compare": symgen.compare,
        "sweep": sweep,
        "Model.simulate": symgen.Model.simulate,
        "Model.compile": symgen.Model.compile,
        "Result.plot": Result.plot,
    }
    found = {f"arguments of {name}": set(inspect.signature(f).parameters) for name, f in signatures.items()}
    classes = (symgen.Model, symgen.MechanismBuilder, symgen.Study, symgen.Sweep, Result, Labelled)
    found |= {f"class {kind.__name__}": public(kind) for kind in classes}
    found["symgen"] = set(symgen.__all__)
    found["settings"] = {f.name for f in fields(Settings)}
    return found


def files(folder: Path) -> dict[str, set[str]]:
    """Return columns and variables of all files that commands have written."""
    assert main(["run", "four-bar", "--until", "0.05", "--save", "run.nc"]) == 0
    read = {".csv": columns, ".nc": netcdf}
    return {path.name: read[path.suffix](path) for path in sorted(folder.iterdir()) if path.suffix in read}


#: Commands of a moment; with the others come the files that all have written.
QUICK = ("run", "check", "list", "inspect", "cache info", "generate")


def current(folder: Path, capsys: pytest.CaptureFixture[str], commands: Iterable[str]) -> dict[str, dict[str, Any]]:
    """Return everything that is promised, as this tree has it."""
    written = {}
    for name in commands:
        assert main([*WRITES_JSON[name], "--json"]) == 0, name
        written[name] = keys(json.loads(capsys.readouterr().out))
    found = {
        "flags": flags(group, ""),
        "commands": {"all": set(COMMANDS)},
        "json": written,
        "files": files(folder),
        "mechanism files": file_keys(),
        "python": python_names(),
    }
    return {part: {name: sorted(values) for name, values in names.items()} for part, names in found.items()}


@pytest.mark.parametrize(
    "commands", [pytest.param(QUICK, id="quick"), pytest.param(tuple(WRITES_JSON), id="all", marks=pytest.mark.slow)]
)
def test_what_was_promised_is_there(commands, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    found = current(tmp_path, capsys, commands)
    if os.environ.get("SYMGEN_UPDATE_CONTRACT") and commands != QUICK:
        KEPT.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    promised = json.loads(KEPT.read_text(encoding="utf-8"))
    missing = {
        f"{part}: {name or 'symgen'}": sorted(set(values) - set(found.get(part, {}).get(name, ())))
        for part, names in promised.items()
        for name, values in names.items()
        if commands != QUICK or part not in ("json", "files") or name in found[part]
    }
    assert {name: values for name, values in missing.items() if values} == {}
