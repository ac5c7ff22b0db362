"""From programs to source text: the only stage that knows Jinja2."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import jinja2
from jinja2 import meta

from symgen.emit.printer import ElementAccess, Lines, print_block
from symgen.errors import InputError
from symgen.formulate.equations import Equations
from symgen.ir.program import COUNTERS, FORMAT, STATUS, SUFFIXES, Block, LawProgram, Layout, ModelProgram
from symgen.lower.algebra import SKIP, WARN

#: What precedes every emitted function. On CUDA, Numba's defaults are what is asked for elsewhere: divisions by 0 give
#: infinity, multiply-add may be contracted, nothing else is fast or inexact.
_DECORATORS = {"cpu": '@njit(error_model="numpy", fastmath={"contract"})', "cuda": "@cuda.jit(device=True)"}
#: Numbers of tables that fit into the 64 KiB of a CUDA device's constant memory, some of it left for others.
MOST_CONSTANTS = 8000


def templates_folder() -> Path:
    """Return the folder of the templates: inside the installed package, else beside it in a checkout.

    Raises
    ------
    FileNotFoundError
        If neither exists.
    """
    package = Path(__file__).resolve().parent.parent
    inside, beside = package / "templates", package.parent / "templates"
    for folder in (inside, beside):
        if (folder / "numba").is_dir():
            return folder
    raise FileNotFoundError(f"templates found neither in {inside} nor in {beside}")


@dataclass(frozen=True)
class Function:
    """A printed block: what the function template needs."""

    name: str
    purpose: str
    arguments: tuple[str, ...]
    lines: Lines
    operations: int
    tree_operations: int


@lru_cache(maxsize=1)
def _environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(templates_folder()),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )


def render(template: str, values: Mapping[str, Any], parts: Sequence[str] = ()) -> str:
    """Render a template; the keys given must be exactly those that it and its parts ask for.

    Raises
    ------
    KeyError
        Naming the keys that are missing or superfluous.
    """
    environment = _environment()
    wanted: set[str] = set()
    for name in (template, *parts):
        source = (templates_folder() / name).read_text(encoding="utf-8")
        wanted |= meta.find_undeclared_variables(environment.parse(source))
    wanted -= {"nq", "nv", "m"} if parts else set()  # set by the parent for its parts
    if parts:
        # what a part could ask for belongs to the interface even if the parts at hand do not
        wanted |= {
            *("skip", "warn", "spatial", "counters", "status"),
            *("tolerance", "iteration_tolerance", "penalty", "decorator"),
        }
    if wanted != set(values):
        missing, extra = sorted(wanted - set(values)), sorted(set(values) - wanted)
        raise KeyError(f"template {template}: missing keys {missing}, keys it does not use {extra}")
    return environment.get_template(template).render(values)


@lru_cache(maxsize=1)
def templates_digest() -> str:
    """Return the digest of all templates, for the emitted header and the cache key."""
    digest = hashlib.sha256()
    for path in sorted(path for folder in ("numba", "lanes") for path in (templates_folder() / folder).glob("*.j2")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def emit_model(program: ModelProgram, equations: Equations, target: str = "cpu") -> str:
    """Return the source of the module that all methods of a model share, for a target of `TARGETS`.

    Raises
    ------
    InputError
        If tables are too long for the constant memory of CUDA devices.
    """
    layout = program.layout
    numbers = sum(len(x) + len(y) for _, x, y in program.tables)
    if target == "cuda" and numbers > MOST_CONSTANTS:
        raise InputError("tables", f"at most {MOST_CONSTANTS // 2} points in all (--target cuda)", f"{numbers // 2}")
    return render(
        "numba/model.py.j2",
        {
            "name": program.name,
            "digest": program.digest,
            "format": FORMAT,
            "templates_digest": templates_digest(),
            "layout": layout,
            "symbols": _symbols(equations),
            "omissions": equations.omissions,
            "dropped_rows": equations.dropped_rows,
            "fill": program.fill,
            "tables": program.tables,
            **_target(target),
            "functions": _functions(program.blocks, layout, equations),
        },
    )


def emit_law(
    program: LawProgram,
    model: ModelProgram,
    equations: Equations,
    summary: str,
    reference: str,
    target: str = "cpu",
) -> str:
    """Return the source of the module that one method adds beside the shared one, for a target of `TARGETS`."""
    layout, correction = program.layout, program.correction
    own = {b.name for b in program.blocks}
    shared = {"geometry", "measure"} | {f"table_{name}" for name, _, _ in model.tables}
    if program.unknowns:  # exact Jacobians need the slopes of tables
        shared |= {f"table_{name}_slope" for name, _, _ in model.tables}
    spatial = bool(equations.spins)
    if spatial:
        shared |= {"normalise", "move"} if correction.any else {"normalise"}
    if correction.any:
        shared.add("spread")
    parts = _parts(program)
    text = "".join((templates_folder() / part).read_text(encoding="utf-8") for part in (*parts, _CLOSING))
    place = {name: f"p[{program.parameter_offset + i}]" for i, (name, _) in enumerate(program.parameters)}
    return render(
        "numba/law.py.j2",
        {
            "name": model.name,
            "digest": model.digest,
            "format": FORMAT,
            "templates_digest": templates_digest(),
            "layout": layout,
            "program": program,
            "spatial": spatial,
            "summary": summary,
            "reference": reference,
            "shared": sorted(shared - own),
            "used_sections": [s for s in layout.sections if re.search(rf"\b{s.upper()}\b", text)],
            "parts": parts,
            "model": f"model{SUFFIXES[target]}",
            **_target(target),
            "status": {name: layout.offset("status") + i for i, name in enumerate(STATUS)},
            "counters": {name: i for i, name in enumerate(COUNTERS)},
            "tolerance": place.get("tolerance", "1e-13"),
            "iteration_tolerance": place.get("iteration_tolerance", "1e-13"),
            "penalty": place.get("penalty", "0.0"),
            "skip": SKIP,
            "warn": WARN,
            "functions": _functions(program.blocks, layout, equations),
        },
        (*parts, _CLOSING),
    )


def _target(target: str) -> dict[str, Any]:
    """Return what distinguishes a target in the templates."""
    return {"cuda": target == "cuda", "decorator": _DECORATORS[target]}


#: Macros that some parts of a law import.
_CLOSING = "numba/closing.j2"


def _parts(program: LawProgram) -> list[str]:
    """Return the templates of the functions of a law that are not straight-line code, in the order of their text."""
    correction, parts = program.correction, list[str]()
    if program.form == "iterated":
        parts.append("rhs_iterated")
    if program.form == "dense":
        parts.append("rhs_dense")
    if program.closed:
        parts += ["choose", "rhs_closed"]
    if program.form == "tangent":
        parts += ["choose", "rhs_tangent"]
    if any(b.flag is not None for b in program.blocks):
        parts.append("confirm")
    if program.form == "tangent":
        parts.append("accept_tangent")
    elif not correction.any:
        parts.append("accept_measured")
    elif correction.metric == "augmented":
        parts.append("accept_augmented")
    elif correction.metric == "independent":
        parts.append("accept_partition")
    else:
        parts.append("accept_corrected")
    return [f"numba/{part}.j2" for part in parts]


def _functions(blocks: Sequence[Block], layout: Layout, equations: Equations) -> list[Function]:
    names = {("q", i): f"{q.name} [{q.unit}]" for i, q in enumerate(equations.coordinates)}
    names |= {("v", i): f"{v.name} [{v.unit}]" for i, v in enumerate(equations.velocities)}
    names |= {("p", i): f"{p.name} [{p.unit}]" for i, p in enumerate(equations.parameters)}
    access = ElementAccess(layout, names)
    return [
        Function(b.name, b.purpose, b.arguments, print_block(b, access), b.operations, b.tree_operations)
        for b in blocks
    ]


def _symbols(equations: Equations) -> list[tuple[str, str, str]]:
    """Return (element, name, unit) of everything that has an index."""
    nq = equations.nq
    table = [(f"y[{i}]", q.name, q.unit) for i, q in enumerate(equations.coordinates)]
    table += [(f"y[{nq + i}]", v.name, v.unit) for i, v in enumerate(equations.velocities)]
    table.append((f"y[{nq + equations.nv}]", "work of forces without potential and of drivers", "J"))
    table += [(f"p[{i}]", p.name, p.unit) for i, p in enumerate(equations.parameters)]
    table += [(f"row {i}", r.name, r.unit) for i, r in enumerate(equations.rows)]
    return table
