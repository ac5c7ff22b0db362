"""Columns that a page works out at each frame of its own motion: code, and where each column comes from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from symgen.base.vocabulary.expressions import Expr, readings_in
from symgen.base.vocabulary.measures import GROUND, Integral
from symgen.compile.native.javascript_code import ADDRESSED, HELPERS, INDEX_TABLES, javascript_functions
from symgen.compile.native.read import Foreign
from symgen.describe.facts.carriers import bodies_of_reactions, seats_on_carriers
from symgen.describe.formulas.reported_columns import TABLES as FORMULAS
from symgen.describe.formulas.results_read import integrals_of_outputs
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.event_sections import RESET
from symgen.result.signals import Signal, signals_of_run
from symgen.run.compiling.checked import checked_function
from symgen.run.compiling.side import READ, compile_side
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e

if TYPE_CHECKING:
    from symgen.compile.native.language import Function
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.starts.assembly import Start

#: Tables that need a state of bodies.
_OF_BODIES = ("lam", "reactions", "body_reactions", "magnitudes", "joint_coordinates", "violations")


def live_columns(
    mechanism: Mechanism,
    compiled: CompiledModel,
    start: Start,
    bodies: CompiledModel | None = None,
    acting: Mechanism | None = None,
) -> tuple[str, dict[str, Any]]:
    """Return an expression for the functions of columns, ``null`` where JavaScript has no form of one, and their data.

    Parameters
    ----------
    mechanism : Mechanism
        Of bodies.
    compiled : CompiledModel
        Code of the live part.
    start : Start
        Of the live part.
    bodies : CompiledModel, optional
        Code in coordinates of bodies, if the live part has those of joints: reactions are left out then.
    acting : Mechanism, optional
        The mechanism of the code, with its tree: modes and forces of rows with bounds are in its state.
    """
    own, tree = bodies or compiled, None
    if bodies is not None and acting is not None and acting.bounded:
        tree = acting, compiled
    tables = dict(signals_of_run(mechanism, own.info))
    if bodies is not None:
        tables = {table: signals for table, signals in tables.items() if table not in _OF_BODIES}
    if any(
        event.action == RESET for event in mechanism.events
    ):  # which change the energy that errors are measured from
        tables["energy"] = tuple(signal for signal in tables["energy"] if signal.source != e.ENERGY_ERROR)
    if integrals_of_outputs(mechanism) and not (own if tree is None else compiled).info.integrals:
        tables["outputs"] = tuple(s for s in tables["outputs"] if not _is_integral(mechanism, s))
    try:
        functions, places = _functions_by_table(mechanism, own, tables, bodies is None, tree)
    except Foreign:
        return "null", {}
    tables = {table: signals for table, signals in tables.items() if table not in FORMULAS or table in functions}
    looped = f"const {{ {INDEX_TABLES}, {ADDRESSED} }} = emitted;\n" if own.shape == "looped" else ""
    text = f"(() => {{\n{HELPERS}{looped}{javascript_functions(functions)}\nreturn {{ {', '.join(functions)} }};\n}})()"
    spec = _column_data(mechanism, compiled, start, own, tables, places)
    return text, spec if tree is None else {**spec, "of_state": ["outputs"]}


def _is_integral(mechanism: Mechanism, signal: Signal) -> bool:
    formula = {column.name: column.formula for column in FORMULAS["outputs"](mechanism)}[signal.key]
    return any(isinstance(reading.source, Integral) for reading in readings_in(formula))


def _functions_by_table(
    mechanism: Mechanism,
    compiled: CompiledModel,
    tables: Mapping[str, tuple[Signal, ...]],
    of_bodies: bool,
    tree: tuple[Mechanism, CompiledModel] | None,
) -> tuple[dict[str, Function], dict[str, tuple[int, int]]]:
    """Return functions by table, and the places of point and centre of each joint in ``seats``."""
    functions = dict[str, "Function"]()
    for table, columns in FORMULAS.items():
        keys = {signal.key for signal in tables[table]}
        formulas = [(c.name, c.formula) for c in columns(mechanism)]
        if not keys or len(keys) < len(formulas):
            continue
        at_state = tree is not None and table == "outputs"
        if tree is not None and at_state:
            formulas = [(c.name, c.formula) for c in columns(tree[0])]
        of = tree if tree is not None and at_state else (mechanism, compiled)
        side = compile_side(*of, table, f"the table {table} of results", formulas)
        if of_bodies or at_state or not side.reads & set(READ):
            functions[table] = checked_function(side.function, abi.OBSERVE)
    if not of_bodies:
        return functions, {}
    functions["observe"] = checked_function(compiled.model.observe, abi.OBSERVE)
    formulas, places = _seat_formulas(mechanism)
    if formulas:
        side = compile_side(mechanism, compiled, "seats", "Points of bodies at which reactions act", formulas)
        functions["seats"] = checked_function(side.function, abi.OBSERVE)
    return functions, places


def _seat_formulas(mechanism: Mechanism) -> tuple[list[tuple[str, Expr]], dict[str, tuple[int, int]]]:
    """Return formulas of the points at which reactions act, and the first places of point and centre by joint."""
    formulas, places = list[tuple[str, Expr]](), dict[str, tuple[int, int]]()
    seats = seats_on_carriers(mechanism)
    for joint, body in bodies_of_reactions(mechanism).items():
        seat = seats.get(joint)
        if seat is None:
            continue
        first = len(formulas)
        formulas += [(f"point of {joint} {axis}", x) for axis, x in zip("xyz", seat[0], strict=False)]
        places[joint] = first, -1
        if body != GROUND:
            places[joint] = first, len(formulas)
            formulas += [(f"centre for {joint} {axis}", x) for axis, x in zip("xyz", seat[1], strict=False)]
    return formulas, places


def _column_data(
    mechanism: Mechanism,
    compiled: CompiledModel,
    start: Start,
    own: CompiledModel,
    tables: Mapping[str, tuple[Signal, ...]],
    places: Mapping[str, tuple[int, int]],
) -> dict[str, Any]:
    info, names = own.info, [body.name for body in mechanism.bodies]
    bodies, q, v = list[list[int]](), 0, 0
    for body in mechanism.bodies:
        bodies.append([q, len(body.coordinates), v, len(body.speeds)])
        q, v = q + len(body.coordinates), v + len(body.speeds)
    joints = [
        [
            joint,
            names.index(body) if body != GROUND else -1,
            *places.get(joint, (-1, -1)),
        ]
        for joint, body in bodies_of_reactions(mechanism).items()
    ]
    order = {joint[0]: i for i, joint in enumerate(joints)}
    sections = compiled.info.sections
    return {
        "tables": {
            table: [[signal.name, signal.unit, signal.source, signal.column] for signal in signals]
            for table, signals in tables.items()
            if signals
        },
        "dimension": 3 if mechanism.space == "spatial" else 2,
        "bodies": bodies,
        "nq": q,
        "nv": v,
        "joints": joints,
        "joint_of_row": [order.get(row.joint, -1) for row in info.rows],
        "multipliers": sections["multipliers"][0] if "multipliers" in sections else -1,
        "work": compiled.info.work,
        "status": {"rank": abi.RANK, "kinetic": abi.KINETIC, "potential": abi.POTENTIAL, "length": abi.LENGTH},
        "observed": info.observed,
        "rank": -1 if compiled.law.unique_multipliers else start.rank,
        "redundant": not compiled.law.unique_multipliers and start.rank < compiled.in_force(start.w),
        "sources": {
            name: getattr(e, name)
            for name in "STATE STATUS ENERGY ENERGY_ERROR ACCELERATION MULTIPLIER JOINT SIDE REACTION".split()
        }
        | {"BODY": e.BODY_REACTION, "MAGNITUDE": e.MAGNITUDE},
    }
