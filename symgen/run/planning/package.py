"""Packages of emitted code: modules that people read and that run with NumPy and Numba alone."""

from __future__ import annotations

import json
import math
import os
import re
import shlex
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np

from symgen.base.errors import AssemblyError, InputError
from symgen.base.escapes import markdown_text
from symgen.base.files import Content, check_file_name, system_message, templates_folder, write_all
from symgen.base.ir.program import COUNTERS, SETTLED, STATUS, SUFFIXES
from symgen.base.settings import Settings
from symgen.derive.emit.module import render_template
from symgen.derive.lower.looped.looped_law import is_loopable
from symgen.derive.methods import METHODS
from symgen.describe.bounds.keys import nouns_of_families
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.parts.event_sections import DOES
from symgen.run.breaks.refused_motions import refuse_jumps
from symgen.run.compiling.choices import choose_coordinates, mechanism_on_tree
from symgen.run.compiling.free_by_loops import choice_at_start
from symgen.run.compiling.method_choice import (
    MethodChoice,
    choice_for_coordinates,
    choose_method,
    takes_bounded_rows,
)
from symgen.run.compiling.pipeline import generate
from symgen.run.planning.package_schemes import PackageScheme, scheme_of_package
from symgen.run.planning.plan import Plan, Purpose
from symgen.run.planning.prepare import code_and_start, make_plan, prepared_run

if TYPE_CHECKING:
    from symgen.compile.store.entries import Modules
    from symgen.describe.mechanism import Mechanism

#: What the first lines of all written files say, and the number of characters that these have at most.
_MARK, _HEAD = re.compile(r"\b(written|emitted) by symgen\b", re.IGNORECASE), 1000
#: Keys of the metadata of looped code.
_KEYS = {"kernels", "methods"}


@dataclass(frozen=True)
class Package:
    """Files of a package.

    Attributes
    ----------
    folder : Path
        The folder they are in.
    files : tuple of Path
        All that were written.
    derive_seconds, emit_seconds : float
        Time that deriving the equations and emitting the code took.
    notes : tuple of str
        What else there is to know of them.
    """

    folder: Path
    files: tuple[Path, ...]
    derive_seconds: float
    emit_seconds: float
    notes: tuple[str, ...] = ()


def write_package(
    mechanism: Mechanism,
    folder: Path,
    methods: Sequence[str] | None,
    options: Mapping[str, str],
    coordinates: str,
    shape: str,
    target: str,
) -> Package:
    """Write the emitted code of a mechanism for people, with what simulates it.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    folder : Path
        The folder to write into, which is made if need be.
    methods : sequence of str, optional
        Names of methods; without any, all that suit the mechanism, the shape and the target.
    options, coordinates, shape, target
        As for `symgen.api.Model.generate`.

    Raises
    ------
    InputError
        If an argument is wrong, or the folder cannot be written.
    """
    # outputs belong to the runtime: on a tree, integrals would keep the rows of drivers whose efforts they read
    mechanism = msgspec.structs.replace(mechanism, outputs=())
    names = tuple(dict.fromkeys(METHODS.resolve_alias(name, "method") for name in methods or METHODS.names))
    own = _options_of(names, options)
    chosen = [choose_method(name, values) for name, values in own.items()]
    if not methods and mechanism.has_massless:
        chosen = [choice for choice in chosen if not choice.method.needs_regular_mass(choice.options)]
    coordinates = choose_coordinates(mechanism, coordinates, shape if target == "cpu" else "looped").name
    plans = [_plan_of_package(mechanism, c.method.name, own[c.method.name], coordinates) for c in chosen]
    if not methods:
        plans = [
            p for p in plans if _suits_target(choice_for_coordinates(mechanism, p.choice), mechanism, shape, target)
        ]
    check_file_name("-o", folder)
    if folder.exists() and not folder.is_dir():
        raise InputError("-o", "the name of a folder", f"the file '{folder}'")
    run, reason = None, "this code is for other programs to call"
    if shape == "straight" and target == "cpu":
        plans, run, reason = _plans_at_start(plans)
    derived = mechanism_on_tree(plans[0].mechanism) if coordinates == "joint" else plans[0].mechanism
    choices = tuple(choice_for_coordinates(derived, plan.choice) for plan in plans)
    if shape == "straight":
        choices = tuple(choice_at_start(derived, choice) for choice in choices)
    generated = generate(derived, choices, shape, target, whole=True, lean=run is not None)
    modules, laws = _modules_by_method(generated.modules, choices, SUFFIXES[target])
    files: dict[str, Content] = {f"{stem}.py": source for stem, (source, _) in modules.items()}
    schemes: dict[str, PackageScheme] = {}
    if run is not None:
        own_schemes = ((_stem(plan.choice), scheme_of_package(plan)) for plan in plans)
        schemes = {law: scheme for law, scheme in own_schemes if scheme is not None}
    files |= {f"{scheme.stem}.py": scheme.text for scheme in schemes.values() if scheme.text}
    files["model.json"] = _metadata(modules, laws, run, schemes)
    asked = {"--method": methods or (), "--option": [f"{key}={value}" for key, value in options.items()]}
    further = {"--coordinates": coordinates, "--shape": shape, "--target": target}
    asked |= {flag: [value] for flag, value in further.items() if value not in ("absolute", "straight", "cpu")}
    command = _command(mechanism, asked, every=not methods)
    files["README.md"] = _readme(mechanism, modules, reason, schemes, command)
    script = folder / "simulate.py"
    if run is not None:
        files[script.name] = (templates_folder() / "package" / script.name).read_text(encoding="utf-8")
    written = write_folder(folder, files, beside=("README.md", script.name))
    if run is None and script.exists() and is_own(script):  # of another package
        script.unlink()
    return Package(folder, written, generated.derive_seconds, generated.emit_seconds)


def _options_of(names: Sequence[str], options: Mapping[str, str]) -> dict[str, dict[str, str]]:
    """Return the options of each method; their names are ``METHOD.NAME``, or ``method.NAME`` for a method alone."""
    own: dict[str, dict[str, str]] = {name: {} for name in names}
    for key, value in options.items():
        owner, _, name = key.partition(".")
        if owner not in own and not (owner == "method" and len(own) == 1):
            raise InputError(f"option {key}", f"METHOD.NAME with one of {', '.join(own)}", f"'{key}'")
        of_owner = own[names[0] if owner == "method" else owner]
        if name in of_owner:
            raise InputError(f"option {key}", "each option once", f"{name} twice")
        of_owner[name] = value
    return own


def _plan_of_package(mechanism: Mechanism, name: str, options: Mapping[str, str], coordinates: str) -> Plan:
    """Return a run by a method as it would be at its start."""
    texts = {f"method.{key}": value for key, value in options.items()}
    settings = Settings(name, options=texts, shape="straight", coordinates=coordinates)
    return make_plan(mechanism, settings, Purpose.STATE)


def _modules_by_method(modules: Modules, choices: Sequence[MethodChoice], suffix: str) -> tuple[Modules, list[str]]:
    """Return modules, laws named by their method alone, and these names."""
    result, laws = dict(modules), [f"{_stem(choice)}{suffix}" for choice in choices]
    _, tables = result.pop("mechanism", ("", {}))
    for choice, law in zip(choices, laws, strict=True):
        looped = f"law_{choice.method.stem(choice.options)}"
        source, info = result.pop(looped if tables else f"{choice.stem}{suffix}")
        of_law = tables.get(f"{looped}_implicit" if choice.implicit else looped, {})
        result[law] = source, {**info, **({"tables": of_law} if of_law else {})}
    return result, laws


def _stem(choice: MethodChoice) -> str:
    """Return the name of a method as a name of a module."""
    return choice.method.name.replace("-", "_")


def _suits_target(choice: MethodChoice, mechanism: Mechanism, shape: str, target: str) -> bool:
    """Whether a method can be emitted for a mechanism in a shape and for a target."""
    if not takes_bounded_rows(choice, mechanism):
        return False
    if shape == "looped":
        return is_loopable(choice.method, choice.options, choice.implicit)
    return target != "cuda" or not choice.implicit


def _plans_at_start(plans: Sequence[Plan]) -> tuple[list[Plan], dict[str, Any] | None, str]:
    """Return plans with the solver that their start asks for, numbers of that start, and why there are none.

    Where light bodies make a run take another solver, the package does too.
    """
    ordered = sorted(plans, key=lambda plan: (plan.choice.implicit, not plan.solver_is_free))
    usual = next((plan for plan in ordered if plan.choice.method.name == "direct-correction"), ordered[0])
    try:
        assembled = code_and_start(usual)
    except AssemblyError as error:
        return list(plans), None, markdown_text(str(error))
    solver = assembled.compiled.law.options.get("solver", "")
    if usual.solver_is_free and solver != usual.choice.options["solver"]:
        plans = [replace(p, choice=p.choice.with_options(solver=solver)) if p.solver_is_free else p for p in plans]
    if usual.mechanism.bounded:
        return list(plans), None, f"modes of {nouns_of_families()} are chosen by who calls this code"
    if usual.mechanism.holding:
        return list(plans), None, "joints that hold for a while change at events, which who calls this code looks for"
    try:
        refuse_jumps(usual.mechanism, {}, usual.spec.until)
    except InputError as error:
        return list(plans), None, markdown_text(str(error))
    simulation = prepared_run(usual, assembled).simulation()
    simulation.enter(simulation.outputs(np.zeros(0)), until=0.0)
    state, info, defaults = simulation.state, assembled.compiled.info, usual.mechanism.defaults
    sections = {name: info.sections[name] for name in SETTLED if name in info.sections}
    run = {
        "method": _stem(usual.choice),
        "until": defaults.until,
        "step": defaults.step,
        "parameters": parameter_values(usual.mechanism),
        "names": [q.name for q in (*info.coordinates, *info.velocities)] + ["work"] + [x.name for x in info.states],
        "y": state.y[: info.ny].tolist(),
        "counters": len(COUNTERS),
        "step_at": info.sections["status"][0] + STATUS.index("step"),
        "w": {name: list(map(_finite_or_none, state.w[at : at + size])) for name, (at, size) in sections.items()},
    }
    return list(plans), run, ""


def _finite_or_none(number: float) -> float | str:
    """Return a number as JSON has it: the mask of a row that depends on others is ``inf``."""
    return float(number) if math.isfinite(number) else str(float(number))


def _metadata(
    modules: Modules, laws: Sequence[str], run: Mapping[str, Any] | None, schemes: Mapping[str, PackageScheme]
) -> str:
    """Return the facts of modules that programs need, and the start of a run, as JSON with short lists in one line."""
    others = {stem: info for stem, (_, info) in modules.items() if stem not in laws and info}
    model = next((others.pop(stem) for stem in list(others) if stem.startswith("model")), {"kernels": others})
    numbers = {law: {"scheme": scheme.numbers} for law, scheme in schemes.items()}
    methods = {stem: {**modules[stem][1], **numbers.get(stem, {})} for stem in laws}
    content = {**model, "methods": methods, **({"run": run} if run else {})}
    text = json.dumps(content, allow_nan=False, indent=1)
    for innermost in (r"\{[^\[\]{}]*\}", r"\[[^\[\]{}]*\]"):
        text = re.sub(innermost, lambda match: re.sub(r"\s*\n\s*", " ", match[0]), text)
    return text + "\n"


def _command(mechanism: Mechanism, asked: Mapping[str, Sequence[str]], every: bool) -> str:
    """Return the command that writes a package."""
    from symgen.describe.catalogue import all_names

    name = mechanism.name if mechanism.name in all_names() else "FILE"
    flags = [shlex.join((flag, value)) for flag, values in asked.items() for value in values]
    return " ".join(["symgen generate", name, *(["--all"] if every else []), *flags, "--output FOLDER"])


def _readme(
    mechanism: Mechanism, modules: Modules, reason: str, schemes: Mapping[str, PackageScheme], command: str
) -> str:
    """Return the page of a package; `reason` says why nothing simulates it, `command` writes it."""
    files = {f"{stem}.py": source.split('"""')[1].split(" Emitted by")[0] for stem, (source, _) in modules.items()}
    files |= {f"{s.stem}.py": s.text.split("\n")[0].strip('"').rstrip(".") for s in schemes.values() if s.text}
    files["model.json"] = "The same for programs: names, units, places in arrays"
    if not reason:
        files["model.json"] += "; parameters and a consistent start"
        files["simulate.py"] = "A run from that start"
    events = ", ".join(f"`{e.name}` {DOES[e.action]}" for e in mechanism.events if e.action in DOES)
    title = markdown_text(mechanism.title or mechanism.name)
    values = {"name": markdown_text(mechanism.name), "title": title, "files": list(files.items()), "reason": reason}
    values["command"] = command
    return render_template("package/README.md.j2", values | {"events": events})


def is_own(path: Path) -> bool:
    """Whether symgen wrote a file: the first lines say so, or, in JSON, all keys are of its metadata.

    Parameters
    ----------
    path : Path
        A file that exists.
    """
    try:
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".json":
            keys = set(json.loads(text))
            return keys == _KEYS or keys - {"run"} >= {"name", "digest", "parameters", "coordinates", "methods"}
    except (OSError, ValueError, TypeError, RecursionError):
        return False
    return _MARK.search(text[:_HEAD]) is not None


def write_folder(folder: Path, files: Mapping[str, Content], beside: Collection[str] = ()) -> tuple[Path, ...]:
    """Write files, all of them or none, and return them in order.

    Parameters
    ----------
    folder : Path
        The folder, which is made if need be.
    files : mapping of str to Content
        Content by the name of the file.
    beside : collection of str
        Names of files that are left out where the folder has others of these names.

    Raises
    ------
    InputError
        If the folder cannot be written, or has a file of one of the names that symgen did not write.
    """
    paths = dict[Path, Content]()
    for name, content in files.items():
        path = folder / name
        if not os.path.lexists(path) or is_own(path):
            paths[path] = content
        elif name not in beside:
            hint = "nothing was written; name another folder, or move the file"
            raise InputError("-o", f"a folder whose {name}, if any, is of symgen", f"another '{path}'", hint)
    absent = [f for f in (folder, *folder.parents) if not f.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_all(paths)
    except OSError as error:
        raise InputError("-o", "a folder that can be written", f"'{folder}' ({system_message(error)})") from error
    finally:
        for each in absent:  # where nothing could be written
            if each.is_dir() and not any(each.iterdir()):
                each.rmdir()
    return tuple(paths)
