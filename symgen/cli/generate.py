"""Write the emitted code of a mechanism."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import click
import msgspec

from symgen.cli import OK, write_json
from symgen.cli._options import examples, json_option, setting_options
from symgen.cli._target import target_option
from symgen.errors import InputError
from symgen.files import check_name
from symgen.ir.program import PART


@click.command(
    "generate",
    epilog=examples("symgen generate four-bar --output code", "symgen generate pendulum --target cuda --output code"),
)
@click.argument("model")
@click.option("--method", "methods", multiple=True, help="Method to emit; may be repeated. All by default.")
@setting_options("options", "coordinates", text={"options": "Such as direct-correction.weight=mass."})
@click.option(
    "--shape",
    type=click.Choice(["straight", "looped"]),
    default="straight",
    show_default=True,
    help="Code for this mechanism alone, or loops over tables that all mechanisms share.",
)
@target_option("What the code is for: processors, or device functions for CUDA.")
@click.option("-o", "--output", metavar="DIR", help="Folder to write into; the mechanism's name by default.")
@json_option
def command(
    model: str,
    methods: tuple[str, ...],
    options: dict[str, str],
    coordinates: str,
    shape: str,
    target: str,
    output: str | None,
    as_json: bool,
) -> int:
    """Write the emitted modules of MODEL, and their metadata as JSON, into a folder, and list them.

    The modules need nothing but math, numpy and numba. The same mechanism always gives the same bytes. Straight code
    for processors is a package that runs: simulate.py starts where start.json says.
    """
    from symgen.compiling.choose_coordinates import choose_coordinates, weighed
    from symgen.compiling.choose_tree import on_tree
    from symgen.compiling.pipeline import MethodChoice, choose_method, for_coordinates, for_masses, generate
    from symgen.describe.load import load
    from symgen.lower.looped.law import is_loopable
    from symgen.methods import METHODS

    names = tuple(dict.fromkeys(METHODS.canonical(m, "--method") for m in methods)) or METHODS.names
    wanted: dict[str, dict[str, str]] = {name: {} for name in names}
    for key, value in options.items():
        owner, _, name = key.partition(".")
        if owner not in wanted and not (owner == "method" and len(names) == 1):
            raise InputError(f"--option {key}", f"METHOD.NAME with one of {', '.join(names)}", f"'{key}'")
        own = wanted[names[0] if owner == "method" else owner]
        if name in own:
            raise InputError(f"--option {key}", "each option once", f"{name} twice")
        own[name] = value
    choices: Sequence[MethodChoice] = [choose_method(name, given) for name, given in wanted.items()]
    free = [name for name, given in wanted.items() if "solver" not in given]
    # integrals of outputs belong to the runtime: on a tree they would keep the rows of drivers whose efforts they read
    mechanism = without = msgspec.structs.replace(load(model), outputs=())
    if not methods and mechanism.has_massless:
        choices = [c for c in choices if not c.method.needs_regular_mass(c.options)]
    choices = [for_masses(mechanism, c, c.method.name in free) for c in choices]
    chosen = choose_coordinates(mechanism, coordinates, shape if target == "cpu" else "looped")
    if chosen.name == "joint":
        mechanism = on_tree(mechanism)
        massless = mechanism.has_massless
        given = {name for name, asked in wanted.items() if "weight" in asked}
        choices = [c if c.method.name in given else weighed(c, massless) for c in choices]
    choices = [for_coordinates(mechanism, c) for c in choices]
    folder = Path(mechanism.name if output is None else output)
    check_name("-o", folder)
    if folder.exists() and not folder.is_dir():
        raise InputError("-o", "the name of a folder", f"the file '{folder}'")
    if shape == "looped" and not methods:
        choices = [c for c in choices if is_loopable(c.method, c.options, c.implicit)]
    if target == "cuda" and not methods:
        choices = [c for c in choices if not c.implicit]
    beside: dict[str, str] = {}
    if shape == "straight" and target == "cpu":
        from symgen.api import Model
        from symgen.cli._package import may_write, package

        choices, found = package(Model(without), choices, chosen.name, free)
        beside = {name: text for name, text in found.items() if may_write(folder / name)}
    generated = generate(mechanism, tuple(choices), shape, target)
    written = write_modules(folder, generated.modules, beside)
    if as_json:
        files = [{"path": str(path), "bytes": path.stat().st_size} for path in written]
        seconds = {"derive": generated.derive_seconds, "emit": generated.emit_seconds}
        write_json({"mechanism": mechanism.name, "folder": str(folder), "files": files, "seconds": seconds})
        return OK
    for path in written:
        click.echo(f"{path}  {path.stat().st_size} bytes")
    return OK


def write_modules(
    folder: Path, modules: Mapping[str, tuple[str, Mapping[str, Any]]], beside: Mapping[str, str] | None = None
) -> list[Path]:
    """Write modules and metadata, and files `beside` them, all of them or none; return the files in order.

    Parts of laws are named by what they hold: those that no law of the folder names any more are removed.

    Raises
    ------
    InputError
        If the folder cannot be made or written.
    """
    from symgen.files import Content, why, write_all

    files: dict[Path, Content] = {}
    for stem, (source, metadata) in modules.items():
        files[folder / f"{stem}.py"] = source
        files[folder / f"{stem}.json"] = json.dumps(metadata, allow_nan=False, indent=1, sort_keys=True) + "\n"
    files |= {folder / name: text for name, text in (beside or {}).items()}
    made = [f for f in (folder, *folder.parents) if not f.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        before = _parts(folder)
        write_all(files)
        for stem in before - _parts(folder):
            for extension in (".py", ".json"):
                (folder / f"{stem}{extension}").unlink(missing_ok=True)
    except OSError as error:
        raise InputError("-o", "a folder that can be written", f"'{folder}' ({why(error)})") from error
    finally:
        for f in made:  # where nothing could be written
            if f.is_dir() and not any(f.iterdir()):
                f.rmdir()
    return list(files)


def _parts(folder: Path) -> set[str]:
    """Return the stems of parts that the metadata of laws in a folder name."""
    found: set[str] = set()
    for path in folder.glob("*.json"):
        try:
            data = json.loads(path.read_text(encoding="utf-8"))
        except (ValueError, RecursionError):
            continue
        named = data.get("modules") if isinstance(data, dict) else None
        found |= {n for n in named if isinstance(n, str) and PART.fullmatch(n)} if isinstance(named, list) else set()
    return found
