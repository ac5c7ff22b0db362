"""Live simulation in a page: the emitted code and the start as JavaScript, and numbers."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Mapping
from contextlib import nullcontext
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.latest import get_or_make
from symgen.compile.native.formula_lines import JAVASCRIPT, NotInLines
from symgen.compile.native.javascript_code import HELPERS, LOOP_HELPERS, javascript_functions
from symgen.compile.native.read import Foreign
from symgen.describe.drawing.scene import Array
from symgen.describe.mechanism import Parameter
from symgen.result.player.looped_part import addressed_functions, text_of_tables, written_functions
from symgen.run.compiling.checked import check_kernels
from symgen.run.compiling.looped_model import LoopedModel
from symgen.run.compiling.printed import Printed, PrintedEvents
from symgen.run.compiling.printed_run import FINDER
from symgen.run.layout import abi
from symgen.run.layout.model_arrays import marks_of_lengths
from symgen.run.modes.transition_log import OF_LOG
from symgen.run.planning.dead_centre import DRIVER, moving_names
from symgen.run.planning.kept_runs import run_with_modes
from symgen.run.planning.start_lines import (
    derived_lines,
    exported_start,
    independent_places,
    is_described,
    written_start,
)
from symgen.run.single.turn_memory import words_of_run
from symgen.run.starts.assembler import close_for_drawing

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.compiling.printed_run import PrintedRun
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.prepare import Prepared
    from symgen.run.starts.assembler import Assembly
    from symgen.run.starts.assembly import Start

#: Largest number of characters of emitted code in a page, in the plane and in space, and the same in operations.
MOST = {False: 76_000, True: 270_000}
A_OPERATION = 24
#: The same with the tables of looped code, which grow with a mechanism, while its code does not.
MOST_LOOPED = 400_000

#: Texts of functions by what they follow from, and how many stay: another page of the same model has the same text.
_texts = dict[Hashable, tuple[str, int]]()
MOST_TEXTS = 8

#: Note of a page without live simulation.
NONE = "the page has no live part"

#: Sections of the scratch that a start finds and evaluations do not.
_SECTIONS = ("status", "mask", "gauge", "row_weight", "mass", "pivot")


@dataclass(frozen=True)
class Live:
    """The live part of a page.

    Attributes
    ----------
    code : str
        Emitted functions as JavaScript.
    spec : mapping
        Sizes, places and numbers, as JSON has them.
    columns : str
        Expression for the functions of columns that are worked out at each frame.
    """

    code: str
    spec: Mapping[str, Any]
    columns: str = "null"


def live_part(
    mechanism: Mechanism,
    compiled: CompiledModel,
    start: Start,
    step: float,
    initial: Array | None = None,
    still: Collection[str] = (),
    acting: Mechanism | None = None,
    run: Prepared | None = None,
    room: int = 0,
) -> tuple[Live | None, str]:
    """Return the live part of a page, or None and the reason.

    Parameters
    ----------
    mechanism : Mechanism
        As described; its joints give the start for other parameters.
    compiled : CompiledModel
        Its code for one method in coordinates of bodies or of joints.
    start : Start
        Where the motion begins.
    step : float
        Of the Runge-Kutta method [s].
    initial : Array, shape (nq + nv,), optional
        Initial coordinates and velocities of bodies, if other than the described ones.
    still : collection of str
        Parameters that keep their values: pages have no slider for them, nor for inputs that are formulas.
    acting : Mechanism, optional
        The mechanism of the code, with a tree in joint coordinates, whose events change the state.
    run : Prepared, optional
        The run by constant steps, where rows with bounds have modes.
    room : int
        Characters of emitted code that the page may have besides the most that it has otherwise.
    """
    spatial, law = mechanism.space == "spatial", compiled.law
    looped = compiled.shape == "looped"
    operations = 0 if looped else sum(law.operations.get(name, 0) for name in ("rhs", "refactor", "spread"))
    most = MOST_LOOPED if looped else MOST[spatial] + room
    limit = most // A_OPERATION
    if operations > limit:
        where = "in space" if spatial else "in the plane"
        fewer = "" if hasattr(compiled.model, "bodies") else "; in joint coordinates they may be a tenth"
        return None, f"{NONE}: {operations} operations are more than the {limit} that a page {where} may have{fewer}"
    joint = hasattr(compiled.model, "bodies")
    turns = start.w[abi.WINDING :][: compiled.info.windings].tolist()
    if initial is not None and not np.array_equal(initial, start.y[: len(initial)]):
        start, turns = replace(start, y=np.concatenate([initial, start.y[len(initial) :]])), []
        described = False
    else:
        described = not joint and is_described(mechanism)
    whole = None
    if run is not None:
        whole = run_with_modes(acting or mechanism, run, compiled, start.datum or (), foresees=True)
    try:
        script = _script_of_dependents(mechanism, described)
        with close_for_drawing() if looped else nullcontext():  # dense algebra takes half a second in a page
            code, size = _page_functions(
                acting or mechanism,
                compiled,
                whole,
                exported_start(mechanism, compiled, start.datum, None if described else turns),
                len(start.redundant_rows),
            )
    except NotInLines:
        return None, f"{NONE}: a formula of the start is not one that pages know"
    except Foreign as error:
        return None, f"{NONE}: its code has {error}"
    if size > most:
        return None, f"{NONE}: {size} characters are more than the {most} that a page may have"
    constants = {*still, *dict(mechanism.input_formulas)}
    spec = _page_data(mechanism, compiled, start, step, joint, constants)
    if whole is not None:
        spec["modes"] = modes_data(acting or mechanism, whole)
    return Live(f"{HELPERS}{code}\n{script}", spec), ""


def _page_functions(
    mechanism: Mechanism, compiled: CompiledModel, run: PrintedRun | None, assembly: Assembly, redundant: int
) -> tuple[str, int]:
    """Return emitted functions and functions of the runtime for starts and events.

    `redundant` is the number of rows that depend on others.

    Returns
    -------
    code : str
        The text.
    size : int
        Characters of the emitted functions.
    """
    events = PrintedEvents.of(mechanism, compiled) if run is None else None
    functions = check_kernels(compiled)
    if isinstance(compiled, LoopedModel):
        functions |= addressed_functions(compiled)
    if run is not None:
        functions |= run.functions
    elif events is not None:
        functions |= events.functions
    printed = Printed(functions)
    printed.add_start(assembly)
    if run is not None:
        printed.add_run(run)
        if run.passages is not None:
            printed.add_foresight(run)
    elif events is not None:
        printed.add_steps(compiled, events, ("take_steps",))
    if drivers := _driving_joints(mechanism):
        printed.add_lock(compiled, drivers, redundant)
    written, tables = dict[str, str](), ""
    if isinstance(compiled, LoopedModel):
        written, tables = written_functions(compiled), text_of_tables(compiled)
    key = printed.key, tuple(written.values())
    text, size = get_or_make(_texts, key, lambda: _text_of_functions(printed, written), MOST_TEXTS)
    return (f"{text}\n{tables}" if tables else text), size + len(tables)


def _text_of_functions(printed: Printed, written: Mapping[str, str]) -> tuple[str, int]:
    """Return the text of all functions, and the characters of the emitted ones."""
    own = {name: function for name, function in printed.emitted.items() if name != FINDER}
    return f"{LOOP_HELPERS}{javascript_functions(printed.emitted, printed.bind_functions(), written)}", len(
        javascript_functions(own, written=written)
    )


def modes_data(mechanism: Mechanism, run: PrintedRun) -> dict[str, Any]:
    """Return a page's data for modes: rows, words of transitions, and memory before a run; infinity is null."""
    initial = {
        name: [[int(i), float(array[i]) if np.isfinite(array[i]) else None] for i in np.flatnonzero(array)]
        for name, array in run.memory.items()
        if name not in ("y", "p", "w", "iw") and np.any(array)
    }
    rows, watched = [row.name for row in mechanism.bounded], run.watched
    words = list(words_of_run(() if watched is None else watched.turning))
    return {"rows": rows, "words": words, "kept": OF_LOG, "status": abi.N_STATUS, "initial": initial}


def rates_part(compiled: CompiledModel, start: Start) -> tuple[Live | None, str]:
    """Return the right-hand side alone, for pages without motion, or None and the reason.

    Parameters
    ----------
    compiled : CompiledModel
        Code for one method.
    start : Start
        Parameters, and scratch as a start leaves it.
    """
    if compiled.shape != "straight":
        return None, "the code of a run is looped"
    if not hasattr(compiled.law_module, "rhs"):
        return None, "the method has none"
    try:
        code = HELPERS + javascript_functions(check_kernels(compiled, ("rhs", "confirm", "masses")))
    except Foreign as error:
        return None, f"its code has {error}"
    return Live(code, _rates_spec(compiled, start)), ""


def _script_of_dependents(mechanism: Mechanism, described: bool) -> str:
    """Return the values that follow from parameters: derived ones, and the start as far as it is described."""
    formulas = [
        f"if (!independent.has({place})) {{ {' '.join(lines)} }}"
        for place, lines in derived_lines(mechanism, JAVASCRIPT)
    ]
    lines = written_start(mechanism, JAVASCRIPT, described)
    derive = ["function derive(p, independent) {", *formulas, "}"]
    return "\n".join([*derive, "function describe(p, q, v, own) {", *lines, "}", ""])


def _rates_spec(compiled: CompiledModel, start: Start) -> dict[str, Any]:
    """Return a page's data for the right-hand side."""
    info = compiled.info
    values = [float(start.p[i]) for i in range(len(info.parameters))]
    places = [i for name in _SECTIONS for i in range(info.sections[name][0], sum(info.sections[name]))]
    w, printed = start.w, compiled.printed_scratch()
    if "tables" in info.sections:  # places of functions are in the scratch, tables are not
        first, size = info.sections["tables"]
        w, places = w.copy(), [*places, *range(first, first + size)]
        w[first : first + size] = printed[first : first + size]
    return {
        "ny": info.ny,
        "nw": len(w),
        "p0": [float(x) for x in start.p],
        "w0": [[i, float(w[i])] for i in places if w[i] != 0.0 and np.isfinite(w[i])],
        "masked": [i for i in places if np.isinf(w[i])],
        "parameters": [
            {"name": q.name, "unit": q.unit, "value": value} for q, value in zip(info.parameters, values, strict=True)
        ],
        "method": compiled.law.method,
    }


def _unit_with_factor(parameter: Parameter) -> dict[str, Any]:
    """Return the unit of the file with its factor to SI units, where it is another."""
    unit = parameter.own_unit
    return {"shown": {"unit": unit.text, "factor": float(unit.factor)}} if parameter.shown else {}


def _driving_joints(mechanism: Mechanism) -> set[str]:
    """Return the joints that drive."""
    return {joint.name for joint in mechanism.joints if joint.kind == DRIVER}


def _page_data(
    mechanism: Mechanism,
    compiled: CompiledModel,
    start: Start,
    step: float,
    joint: bool,
    constants: Collection[str],
) -> dict[str, Any]:
    info, rates = compiled.info, _rates_spec(compiled, start)
    drivers = _driving_joints(mechanism)
    sections = {
        name: info.sections[name][0] for name in ("jacobian", "residual", "nu", "change", "gauge", "mass", "pivot")
    }
    return {
        **rates,
        "nq": info.nq,
        "nv": info.nv,
        "m": info.m,
        "np": len(start.p),
        "windings": info.windings,
        "joint": joint,
        "nb": mechanism.body_coordinates,
        "nbv": sum(len(b.speeds) for b in mechanism.bodies),
        "y0": [float(x) for x in start.y],
        "datum": list(start.datum) or [0.0] * info.nq,
        "lengths": [int(x) for x in marks_of_lengths(info)],
        "angular": [int(x.unit != "m/s") for x in info.velocities],
        "rows": [int(row.unit == "m") for row in info.rows],
        "drivers": [row.joint if row.joint in drivers else "" for row in info.rows],
        "moving": moving_names(info),
        "jacobian": [list(entry) for entry in info.jacobian],
        "at": sections,
        "status": {"length": abi.LENGTH, "step": abi.STEP_STATUS},
        "events": [event.name for event in mechanism.events],
        "parameters": [
            {
                **entry,
                "follows": bool(own.formula),
                **_unit_with_factor(own),
                **({"still": True} if own.name in constants else {}),
            }
            for entry, own in zip(rates["parameters"], mechanism.parameters, strict=False)
        ],
        "state": [q.name for q in (*info.coordinates, *info.velocities)],
        "independent": independent_places(mechanism, {p["name"]: p["value"] for p in rates["parameters"]}),
        "step": step,
    }
