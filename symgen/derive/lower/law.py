"""The program of a law for one mechanism: the part that one method adds to its model's program."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from symgen.base.errors import InputError
from symgen.base.ir.program import (
    BY_PIVOTS,
    BY_RESIDUAL,
    FREE_RHS,
    HELD_RHS,
    JAMMING,
    Block,
    Correction,
    EliminationPlan,
    LawProgram,
    ModelLayout,
    ModelProgram,
    OutputSlot,
)
from symgen.base.vocabulary.infos import LawInfo
from symgen.derive.formulate.equations import Equations
from symgen.derive.lower.descriptor_blocks import blocks_of_form, unknowns_of_form
from symgen.derive.lower.factor import FactorNodes
from symgen.derive.lower.hoist import Hoister
from symgen.derive.lower.modes_of_states import nodes_with_stored_modes
from symgen.derive.lower.plans import closing_plan
from symgen.derive.lower.record import record_law
from symgen.derive.lower.record_form import record_form
from symgen.derive.lower.recorded_law import ARGUMENTS, BEHIND, Part, RecordedLaw
from symgen.derive.lower.replay import Nodes
from symgen.derive.lower.residual import outputs_by_residual
from symgen.derive.lower.scalar import ScalarNodes
from symgen.derive.lower.scalar_values import Outputs, to_status
from symgen.derive.methods._base import Method

#: Room for columns of a tangent basis beyond nv - m: dependent rows add to the degrees of freedom.
_SPARE_DEGREES = 6
#: Functions that leave M in w for later ones.
_KEEPS_MASS = frozenset(("begin", "aim", "geometry"))


def lower_law(
    equations: Equations,
    model: ModelProgram,
    method: Method,
    options: Mapping[str, str],
    implicit: bool = False,
    closing: EliminationPlan | None = None,
    suffix: str = "",
    directed: bool = False,
) -> LawProgram:
    """Lower one method: its acceleration law, and its correction where it differs from the model's.

    Parameters
    ----------
    equations : Equations
        The derived equations.
    model : ModelProgram
        The program of the model.
    method : Method
        The method.
    options : mapping
        Its structural options, complete.
    implicit : bool
        Whether the descriptor form for implicit integrators is added.
    closing : EliminationPlan, optional
        Plan with loops in closed form, as velocities chosen at the start allow; see `closing_plan`.
    suffix : str
        Of the file stem, which says the choice.
    directed : bool
        Whether a right-hand side for derivatives is added, where these take fewer operations by it.

    Raises
    ------
    InputError
        If velocities shall be scaled to the energy where drivers prescribe coordinates of a tree.
    """
    correction = _correction_of_rows(equations, method.correction(options))
    _refuse_method(equations, method, options, implicit)
    recorded = record_law(method, options, equations.driving is not None, correction)
    _refuse_momenta(equations, method, recorded)
    names = [p.name for p in method.parameters]
    eliminates = _uses_elimination(recorded)
    apart = frozenset(("constrained",) if equations.drags and eliminates else ())
    record = recorded.choose_solution(model.plan.schur, apart)
    loose_rows = sum(row.held is not None for row in equations.rows)
    if loose_rows and (record.form == "tangent" or correction.metric == "independent"):
        record = replace(record, sections=(*record.sections, ("chosen_modes", ("switchable",))))
    scalars = ScalarNodes(equations, record.operations, names, plan=model.plan)
    scalars.pushing = bool(equations.drags) and not eliminates
    _compute_parts(scalars, record.parts[0], record.output_operations)
    for index in (i for part in record.parts if part.role == "balance" for _, i in part.outputs if scalars.pushing):
        scalars.put_drags(index)
    hoister = Hoister(scalars.graph, model.layout.parameters + model.hoisted, len(names))
    accelerations = [(scalars, part) for part in record.parts if part.role == "acceleration"]
    closing = closing or closing_plan(equations, model.plan, ())
    closed = record.form == "direct" and method.integrates != "independent" and not correction.stages
    loose: tuple[ScalarNodes, Part] | None = None
    if record.form == "direct" and any(row.bounded for row in equations.rows):
        loose = _rates_without_bounded_rows(scalars, recorded, apart, closing, closed)
        accelerations.append(loose)
    _reserve_hoisted(hoister, accelerations)
    degrees = 0
    if record.form == "tangent":
        degrees = min(equations.nv, max(1, equations.nv - equations.m + loose_rows) + _SPARE_DEGREES)
    blocks = [law_block(hoister, scalars, part) for part in record.parts]
    if loose is not None:
        blocks = [*_choose_by_rows_in_force(hoister, equations, blocks[0], loose), *blocks[1:]]
    elif closed:
        blocks = _has_closed_form(hoister, scalars, recorded, closing, directed, blocks)
    unknowns, level, pattern = 0, "", tuple[tuple[int, int], ...]()
    if implicit:
        form = record_form(method, options, driven=equations.driving is not None)
        unknowns, level = unknowns_of_form(equations, form), form.form
        form_blocks, pattern = blocks_of_form(hoister, scalars, form, unknowns)
        blocks += form_blocks
    if (correction.any and correction.metric != "augmented") or record.form == "tangent":
        blocks.append(_drift_block(hoister, scalars))
    blocks.insert(0, replace(hoister.prepare_block(), role="preparation"))
    layout = replace(model.layout, sections=_sections_of_law(model.layout, record, blocks, degrees))
    operations = {b.name: b.operations for b in blocks}
    info = LawInfo(
        method=method.name,
        key=method.stem(options, implicit) + suffix,
        options=dict(options),
        parameters=tuple((p.name, p.default) for p in method.parameters),
        parameter_offset=hoister.first_parameter,
        hoisted=len(hoister.slots) - hoister.reserved,
        position_correction=correction.position != "none",
        velocity_correction=correction.velocity,
        energy_correction=correction.energy,
        nw=layout.nw,
        unknowns=unknowns,
        level=level,
        tangent=pattern,
        operations=operations | ({} if loose is None else {"rhs": operations[FREE_RHS]}),
        unique_multipliers=method.unique_multipliers,
    )
    return LawProgram(info, record.form, correction.stages, correction, layout, tuple(blocks), degrees)


def _correction_of_rows(equations: Equations, correction: Correction) -> Correction:
    """Return the correction of a method; none where no row could be violated, as on a tree or of a free body."""
    closes = correction.any and not correction.energy and correction.metric != "independent"
    return Correction() if closes and not equations.m else correction


def _drift_block(hoister: Hoister, scalars: ScalarNodes) -> Block:
    """Return the block of what a correction of velocities reads: `measure` without norms and energies."""
    outputs = [(OutputSlot("residual", i), node) for i, node in enumerate(scalars.velocity_residuals())]
    purpose = "D v - nu with the D and nu that `geometry` left"
    return replace(hoister.block_with_hoisted("drift", purpose, outputs, ARGUMENTS["geometry"]), role="correction")


def _reserve_hoisted(hoister: Hoister, accelerations: Iterable[tuple[ScalarNodes, Part]]) -> None:
    """Reserve places for the numbers that laws hoist, before any block is made."""
    for values, part in accelerations:
        flag = None if part.flag is None else values.values[part.flag]
        hoister.reserve([*(node for _, node in part_outputs(values, part)), *([] if flag is None else [flag])])


def _has_closed_form(
    hoister: Hoister,
    scalars: ScalarNodes,
    recorded: RecordedLaw,
    closing: EliminationPlan,
    directed: bool,
    blocks: list[Block],
) -> list[Block]:
    """Return the blocks of a law whose loops are in closed form where the plan has any, with slopes if `directed`."""
    solver = scalars
    if closing.loops:
        solver, own = _rates_with_closed_loops(hoister, scalars, recorded.choose_solution(False), closing, blocks[0])
        blocks = [*own, *blocks[1:]]
    if directed and not scalars.equations.drags:
        blocks = [
            *blocks,
            *_rates_by_residual(hoister, solver, recorded, recorded.choose_solution(solver.plan.schur).parts[0]),
        ]
    return blocks


def _choose_by_rows_in_force(
    hoister: Hoister, equations: Equations, law: Block, loose: tuple[ScalarNodes, Part]
) -> tuple[Block, Block]:
    """Return the blocks of a law with rows with bounds in force, and of motions without any."""
    held = replace(law, name=HELD_RHS, purpose=f"{law.purpose}; with rows with bounds in force")
    free = replace(law_block(hoister, *loose), name=FREE_RHS)
    converged = f", or {equations.drags[0].noun} not found" if len(equations.drags) > 1 else ""
    return held, replace(free, purpose=f"{free.purpose}{converged}; no row with bounds in force")


def _refuse_method(equations: Equations, method: Method, options: Mapping[str, str], implicit: bool) -> None:
    """Refuse equations that a method has no law for."""
    if method.correction(options).energy and equations.driving is not None:  # T is not quadratic in v then
        expected = f"coordinates in which no driver prescribes one of the state, for '{method.name}'"
        raise InputError("--coordinates", expected, "those of joints that are driven", "--coordinates absolute")
    if any(row.held is not None for row in equations.rows):
        refuse_bounded_rows(method, options, implicit, next((drag.noun for drag in equations.drags), ""))


def _refuse_momenta(equations: Equations, method: Method, law: RecordedLaw) -> None:
    """Refuse states that read results where a method integrates momenta: it has no v'."""
    if any(part.velocities is not None for part in law.parts) and equations.reads_results:
        expected = "one that integrates velocities, as a state reads accelerations or forces"
        raise InputError(f"method '{method.name}'", expected, "one that integrates momenta", "--method lagrange")


def refuse_bounded_rows(method: Method, options: Mapping[str, str], implicit: bool, pressed: str) -> None:
    """Refuse methods that do not take rows with bounds: those that project onto all rows after their equations.

    Parameters
    ----------
    method : Method
        The method.
    options : mapping
        Its structural options, complete.
    implicit : bool
        Whether a descriptor form is wanted.
    pressed : str
        What depends on reactions, which is for methods that find multipliers at once; empty where nothing does.

    Raises
    ------
    InputError
        With the method.
    """
    law = record_law(method, options)
    if implicit and record_form(method, options).form in BEHIND:
        expected = "one that eliminates multipliers or solves for them, where rows may be off"
        raise InputError(f"method '{method.name}'", expected, "one that reads D of all rows", "--method lagrange")
    if pressed and law.form != "direct":
        expected = f"one that finds multipliers at once, where {pressed} depends on reactions"
        raise InputError(f"method '{method.name}'", expected, "one that iterates", "--method lagrange")


def _rates_without_bounded_rows(
    scalars: ScalarNodes, record: RecordedLaw, apart: frozenset[str], plan: EliminationPlan, closed: bool
) -> tuple[ScalarNodes, Part]:
    """Return the right-hand side of motions with no row with bounds in force, by a plan for them."""
    record = record.choose_solution(plan.schur, apart)
    loose, part = scalars.without_bounded_rows(record.operations, plan, closed), record.parts[0]
    _compute_parts(loose, part, [*(index for _, index in part.outputs), *(() if part.flag is None else (part.flag,))])
    return loose, part


def _compute_parts(scalars: ScalarNodes, part: Part, ends: Sequence[int]) -> None:
    """Evaluate operations, and drags in a right-hand side that eliminates no multipliers."""
    scalars.compute(ends)
    if scalars.pushing:
        scalars.settle_drags(dict(part.outputs)["multipliers"], (index for _, index in part.outputs))


def _uses_elimination(record: RecordedLaw) -> bool:
    """Whether a right-hand side eliminates multipliers."""
    outputs = [output for part in record.parts for output in part.outputs]
    return {record.operations[index].kind for place, index in outputs if place == "rates.v"} == {"constrained"}


def _rates_with_closed_loops(
    hoister: Hoister, scalars: ScalarNodes, record: RecordedLaw, plan: EliminationPlan, block: Block
) -> tuple[ScalarNodes, list[Block]]:
    """Return the right-hand side with loops in closed form, then the one that `confirm` evaluates."""
    if not any(operation.kind == "constrained" for operation in record.operations):
        return scalars, [block]
    part, closing = record.parts[0], scalars.with_closed_loops(record.operations, plan)
    closing.compute([*(index for _, index in part.outputs), *(() if part.flag is None else (part.flag,))])
    behind = replace(block, name=BY_PIVOTS, purpose=f"the same with a pivot for each row of a loop, {block.purpose}")
    closed = law_block(hoister, closing, part)
    return closing, [replace(closed, purpose=f"{part.purpose}; 1 where a loop or a pivot of S is suspicious"), behind]


def _rates_by_residual(hoister: Hoister, scalars: ScalarNodes, record: RecordedLaw, part: Part) -> list[Block]:
    """Return the right-hand side for derivatives, if there is one."""
    outputs = outputs_by_residual(scalars, record, part_outputs(scalars, part))
    if outputs is None:
        return []
    purpose = "q', v', power and multipliers, with the derivatives of the residual"
    flag = None if part.flag is None else scalars.values[part.flag]
    return [
        replace(hoister.block_with_hoisted(BY_RESIDUAL, purpose, outputs, ARGUMENTS["rhs"], flag), role="derivation")
    ]


def law_block(
    hoister: Hoister, scalars: ScalarNodes, part: Part, further: Sequence[tuple[OutputSlot, int]] = ()
) -> Block:
    """Return a function of a law as a block, with further outputs."""
    flag = None if part.flag is None else scalars.values[part.flag]
    if flag is not None and "y" not in ARGUMENTS[part.name]:
        (flag,) = nodes_with_stored_modes(scalars.equations, scalars.graph, [flag])
    purpose = part.purpose + ("" if flag is None else "; 1 where a pivot of S is suspicious")
    outputs = [*part_outputs(scalars, part), *further]
    block = hoister.block_with_hoisted(part.name, purpose, outputs, ARGUMENTS[part.name], flag)
    return replace(block, role=part.role)


def part_outputs(scalars: ScalarNodes, part: Part) -> Outputs:
    """Return the outputs of a function of a law; an M that changes is read by those without the state."""
    if scalars.mass_entries and "y" not in ARGUMENTS[part.name]:
        scalars = scalars.with_stored_mass
    outputs = [output for place, index in part.outputs for output in _outputs_of_parts(scalars, place, index)]
    if any(place == "rates.work" for place, _ in part.outputs):
        space, work = scalars.places["rates.work"]
        rates = _rates_over_results(scalars, part)
        if part.velocities is not None:
            rates = scalars.with_velocities(rates, scalars.values[part.velocities])
        outputs += [(OutputSlot(space, work + i), node) for i, node in enumerate(rates, 1)]
        outputs += [(OutputSlot(JAMMING, i), node) for i, node in enumerate(scalars.jamming)]
    if part.name in _KEEPS_MASS:
        outputs += [(OutputSlot("mass_entry", k), node) for k, node in enumerate(scalars.mass_entries)]
    if "y" not in ARGUMENTS[part.name]:
        nodes = nodes_with_stored_modes(scalars.equations, scalars.graph, [node for _, node in outputs])
        outputs = [(slot, node) for (slot, _), node in zip(outputs, nodes, strict=True)]
    return outputs


def _rates_over_results(scalars: ScalarNodes, part: Part) -> Nodes:
    """Return the rates of states, with v' and multipliers of this part where they read results."""
    g, e, outputs = scalars.graph, scalars.equations, dict(part.outputs)
    if not e.reads_results:
        return e.state_rates
    known = dict[tuple[str, int], int]()
    if "rates.v" in outputs:  # else an earlier part has left them in ydot, and an iteration multipliers in w
        known |= {("ydot", e.nq + i): n for i, n in enumerate(scalars.values[outputs["rates.v"]])}
    if "multipliers" in outputs:
        found = scalars.values[outputs["multipliers"]]
        keys = [key for key in g.inputs_of(e.state_rates) if key[0] == "multipliers"]
        known |= {key: found[key[1]] if key[1] < len(found) else g.zero for key in keys}  # no row with bounds in force
    return tuple(g.replace_inputs(e.state_rates, known))


def _outputs_of_parts(scalars: ScalarNodes, place: str, index: int) -> Outputs:
    """Return the targets of the nodes of a value."""
    e, value = scalars.equations, scalars.values[index]
    if scalars.operations[index].kind.startswith("keep"):
        return scalars.stored[place]
    if isinstance(value, FactorNodes):
        return scalars.stored[f"{place}lower"] + scalars.stored[f"{place}reciprocal"]
    if place == "geometry":
        return list(value)
    if place == "dense":
        return [
            (OutputSlot(place, i * e.nv + j), scalars.node_in_force(i, node))
            for i, row in enumerate(value)
            for j, node in row
        ]
    section, _, name = place.partition(".")
    if section == "status":
        return [to_status(name, value)]
    if place == "rates.work":
        value = scalars.graph.add(value, scalars.drag_power)
    space, first = scalars.places.get(place, (place, 0))
    nodes = value if isinstance(value, tuple) else (value,)
    return [(OutputSlot(space, first + i), node) for i, node in enumerate(nodes)]


def _sections_of_law(
    layout: ModelLayout, record: RecordedLaw, blocks: list[Block], degrees: int
) -> dict[str, tuple[int, int]]:
    """Return the sections of ``w``: the model's, then the law's own."""
    sizes = {"one": 1, "nv": layout.nv, "m": layout.m, "degrees": degrees, "switchable": layout.switchable}
    sections, offset = dict(layout.sections), layout.nw
    for name, factors in record.sections:
        size = 1
        for factor in factors:
            size *= sizes[factor]
        if not factors:  # the number of its outputs
            size = sum(target.space == name for block in blocks for target, _ in block.outputs)
        sections[name] = (offset, size)
        offset += size
    return sections
