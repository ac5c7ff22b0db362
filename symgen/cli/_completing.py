"""Completion of values by the shell: models, kinds and the names of the mechanism on the line.

Nothing here imports NumPy: a key press has to be answered in a tenth of a second. The mechanism is read, not validated;
what is no name is left out, so that text of a file never reaches the shell.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem

from symgen.base.errors import SymgenError
from symgen.base.settings import COORDINATES, SHAPES
from symgen.describe import catalogue
from symgen.describe.files.origins import Source
from symgen.describe.modal.modal_file import ModalFile, read_modal_file, with_whole_paths
from symgen.describe.modal_body import COORDINATE, PREFIXES, SPEED, names_of_modes
from symgen.describe.parts.bodies import is_modal

#: Files above this size in bytes are not read at a key press.
LARGEST = 1_000_000
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_PATH = re.compile(r"[A-Za-z0-9_./+-]+")
#: Coordinates and velocities of a body in the plane and in space.
_PLANAR = ("x", "y", "theta", "vx", "vy", "omega")
_SPATIAL = ("x", "y", "z", "vx", "vy", "vz", "wx", "wy", "wz")
#: What results have of a body besides, of a point of it, and of a joint.
_ACCELERATIONS = (("ax", "ay", "alpha"), ("e0", "e1", "e2", "e3", "ax", "ay", "az", "alphax", "alphay", "alphaz"))
_POINT = (("x", "y", "vx", "vy", "ax", "ay"), ("x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"))
_REACTION = (("F", "Fx", "Fy", "M"), ("F", "T", "Fx", "Fy", "Fz", "Mx", "My", "Mz"))
#: Type of a joint or force -> its own columns; types with columns that depend on further keys have few or none here.
_OWN = {
    "revolute": ("angle", "angle.rate"),
    **dict.fromkeys(("translational", "prismatic"), ("displacement", "displacement.rate")),
    "driver": ("effort", "power", "rate"),
    "spring-damper": ("length", "rate", "force", "power"),
    "torque": ("torque", "power"),
    "force": ("power",),
}

Candidates = Callable[[click.Context], Iterable[str]]
Answer = Callable[[click.Context, str], list[CompletionItem[Any]]]


def complete_with(parameter: click.Parameter) -> None:
    """Let a parameter of a command complete its values.

    Parameters
    ----------
    parameter : click.Parameter
        An option or argument; one without names of its own stays as it is.
    """
    answer: Answer
    name = parameter.name or ""
    metavar = getattr(parameter, "metavar", None) or ""
    if isinstance(parameter.type, click.Choice):  # it completes itself
        return
    if name in _MODELS:
        answer = _complete_models
    elif name == "over" and "=" in metavar:  # of modes
        answer = _complete_last_word(_wait_for_value(_complete_parameters))
    elif name == "states" and metavar == "A,B":  # of compare
        answer = _complete_last_word(lambda context: COORDINATES)
    elif name in ("quantities", "over"):
        answer = _complete_last_word(_CANDIDATES[name], nested=True)
    elif name in _CANDIDATES:
        answer = _complete_last_word(_CANDIDATES[name])
    elif "FILE" in metavar or "RESULT" in metavar:
        answer = _complete_by_shell
    else:
        return
    # the method that click calls for the parameter at the cursor; its argument `shell_complete` is for decorators
    parameter.shell_complete = answer  # type: ignore[method-assign, assignment]


def _complete_models(context: click.Context, typed: str) -> list[CompletionItem[Any]]:
    """Return entries of the catalogue, folders and mechanism files."""
    names = [name for name in catalogue.all_names() if name.startswith(typed)]
    return [CompletionItem(x) for x in (*names, *_complete_files(typed, (".toml", ".nc")))]


def _complete_files(typed: str, endings: Sequence[str]) -> Iterator[str]:
    folder, slash, first = typed.rpartition("/")
    with suppress(OSError):
        for path in sorted(Path(folder + slash or ".").iterdir()):
            text = folder + slash + path.name
            hidden = path.name.startswith(".") and not first
            if hidden or not path.name.startswith(first) or not _PATH.fullmatch(text):
                continue
            if path.is_dir():
                yield text + "/"
            elif path.name.endswith(tuple(endings)):
                yield text


def _complete_by_shell(context: click.Context, typed: str) -> list[CompletionItem[Any]]:
    """Leave the word to the shell's own completion of files."""
    return [CompletionItem(typed, type="file")]


def _complete_last_word(candidates: Candidates, nested: bool = False) -> Answer:
    """Return the completion of the last word of a comma-separated list; nested names up to the next dot."""

    def complete_word(context: click.Context, typed: str) -> list[CompletionItem[Any]]:
        before, comma, last = typed.rpartition(",")
        found = [x for x in candidates(context) if x.startswith(last)]
        return [CompletionItem(before + comma + x) for x in found if not (nested and "." in x[len(last) :])]

    return complete_word


def _description_on_line(context: click.Context) -> Mapping[str, Any]:
    """Return the description of the mechanism on the line, empty where there is none that can be read."""
    values = context.params.get("model") or context.params.get("models") or context.params.get("what") or context.args
    word = values if isinstance(values, str) else values[0] if values else ""
    with suppress(SymgenError, OSError, ValueError, RecursionError):
        name, colon, size = word.partition(":")
        if name in catalogue.all_names():
            return catalogue.raw(name, int(size) if colon else None)
        path = Path(word)
        if path.suffix == ".toml" and path.is_file() and path.stat().st_size < LARGEST:
            raw = tomllib.loads(path.read_text(encoding="utf-8"))
            return with_whole_paths(raw, Source.of_file(path))
    return {}


def _names_of_section(raw: Mapping[str, Any], name: str) -> list[str]:
    """Return the names of a section of a mechanism."""
    section = raw.get(name)
    return sorted(x for x in section if _NAME.fullmatch(x)) if isinstance(section, dict) else []


def _complete_parameters(context: click.Context) -> list[str]:
    return _names_of_section(_description_on_line(context), "parameters")


def _complete_inputs(context: click.Context) -> list[str]:
    return _names_of_section(_description_on_line(context), "inputs")


def _complete_quantities(context: click.Context) -> Iterator[str]:
    """Yield names of bodies, joints, forces and outputs, and of their columns."""
    raw = _description_on_line(context)
    spatial = _is_spatial(raw)
    for section in ("bodies", "joints", "forces", "outputs", "states", "points"):
        for name in _names_of_section(raw, section):
            yield name
            table = raw[section][name]
            if not isinstance(table, dict):
                continue
            if section == "bodies":
                yield from (f"{name}.{x}" for x in _columns_of_body(table, spatial))
            elif section in ("joints", "forces"):
                own = _OWN.get(str(table.get("type")), ())
                yield from (f"{name}.{x}" for x in (*(_REACTION[spatial] if section == "joints" else ()), *own))


def _columns_of_body(table: Mapping[str, Any], spatial: bool) -> Iterator[str]:
    """Yield columns of a body and of its points."""
    turns, modal = table.get("type") != "point", _modal_file(table)
    columns = (*(_SPATIAL if spatial else _PLANAR), *_ACCELERATIONS[spatial])
    yield from (x for x in columns if turns or x in _POINT[spatial])
    for point in _names_of_section(table, "points"):
        yield from (point, *(f"{point}.{x}" for x in _POINT[spatial]))
    if modal is not None:
        yield from (name for x in PREFIXES for name in names_of_modes(x, len(modal.stiffness)))
        yield from (row.label for row in modal.rows)
        for interface in modal.interfaces:
            yield from (interface, *(f"{interface}.{x}" for x in _POINT[spatial]))


def _modal_file(table: object) -> ModalFile | None:
    """Return the content of the file of a modal body; None for another body, or where it cannot be read."""
    if is_modal(table) and isinstance(table, dict):
        with suppress(SymgenError):
            return read_modal_file("file", str(table.get("file")))
    return None


def _is_spatial(raw: Mapping[str, Any]) -> bool:
    head = raw.get("mechanism")
    return isinstance(head, dict) and head.get("space") == "spatial"


def _complete_start(context: click.Context) -> list[str]:
    raw = _description_on_line(context)
    own, names = _SPATIAL if _is_spatial(raw) else _PLANAR, list[str]()
    for body in _names_of_section(raw, "bodies"):
        modal = _modal_file(raw["bodies"][body])
        count = 0 if modal is None else len(modal.stiffness)
        names += [f"{body}.{x}" for x in (*own, *names_of_modes(COORDINATE, count), *names_of_modes(SPEED, count))]
    return names


def _wait_for_value(candidates: Callable[[click.Context], list[str]]) -> Candidates:
    """Return candidates that wait for a value: ``mass=``."""
    return lambda context: [f"{name}=" for name in candidates(context)]


def _complete_methods(context: click.Context) -> tuple[str, ...]:
    from symgen.derive.methods import METHODS

    return METHODS.names


def _complete_integrators(context: click.Context) -> tuple[str, ...]:
    from symgen.run.integrators import INTEGRATORS

    return INTEGRATORS.names


#: Arguments that are models.
_MODELS = ("model", "models", "what", "described")
#: Name of a command's argument -> the names that it takes.
_CANDIDATES: Mapping[str, Candidates] = {
    "method": lambda context: ("auto", *_complete_methods(context)),
    "methods": lambda context: ("all", *_complete_methods(context)),
    "integrator": lambda context: ("auto", *_complete_integrators(context)),
    "integrators": _complete_integrators,
    "coordinates": lambda context: COORDINATES,
    "shape": lambda context: SHAPES,
    "parameters": _wait_for_value(_complete_parameters),
    "inputs": _wait_for_value(_complete_inputs),
    "start": _wait_for_value(_complete_start),
    "varied": lambda context: (
        *_wait_for_value(_complete_parameters)(context),
        *_wait_for_value(_complete_start)(context),
    ),
    "quantities": _complete_quantities,
    "over": lambda context: ("t", *_complete_quantities(context)),
}
