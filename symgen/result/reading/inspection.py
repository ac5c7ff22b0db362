"""Derived equations of a mechanism, counted and written as text: ``symgen inspect`` and `symgen.api.Model.inspect`."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import structs

from symgen.base.errors import AssemblyError, plural
from symgen.base.files import check_path, write_whole
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.looped.instances import instances_of_mechanism
from symgen.derive.lower.model import lower_model
from symgen.describe.bounds.bounded_modes import rows_by_family, unit_of_effort
from symgen.describe.facts.digest import digest
from symgen.describe.facts.pins import pins_that_vary
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Parameter
from symgen.describe.parts.topology import state_names
from symgen.result.player.motion_page import PAGES
from symgen.result.reading.contact_facts import contact_facts
from symgen.result.reading.inspection_text import inspection_as_text
from symgen.result.reading.jamming import jamming_numbers
from symgen.result.reading.outline_facts import outline_facts
from symgen.result.reading.page import EquationPage
from symgen.result.reading.page_size import MOST_STRAIGHT, check_size
from symgen.result.reading.quantity_names import input_names
from symgen.result.reading.row_words import row_words
from symgen.result.reading.structure import element_terms, nodes_with_names, shared_terms
from symgen.result.reading.typeset import LONGEST, text_writer, text_writers_by_terms
from symgen.run.compiling.free_by_loops import law_at_start
from symgen.run.compiling.looped import kernel_stems
from symgen.run.compiling.method_choice import MethodChoice, choose_method
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import Prepared, prepare

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.derive.formulate.equations import Equations
    from symgen.describe.bounded import BoundedRow
    from symgen.describe.mechanism import Mechanism
    from symgen.describe.spanning_tree import Topology


#: Characters of gamma and forces up to which they are written without shared terms.
SHORT = 110


@dataclass(frozen=True)
class Inspection:
    """Derived equations of a mechanism; printed, it is the text of ``symgen inspect``.

    Attributes
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        Method, options, shape, coordinates and parameters.
    facts : dict
        Everything by name, expressions as text: the JSON of ``symgen inspect --json``.
    """

    mechanism: Mechanism
    settings: Settings
    facts: dict[str, Any]

    def __str__(self) -> str:
        return inspection_as_text(self.facts)

    def __repr__(self) -> str:
        sizes = self.facts["sizes"]
        return (
            f"<Inspection of {self.mechanism.name}: {plural(sizes['coordinates'], 'coordinate')}, "
            f"{plural(sizes['rows'], 'row')}, {plural(self.facts['degrees_of_freedom'], 'degree')} of freedom>"
        )

    def _repr_html_(self) -> str:
        return f"<details><summary>{escape(repr(self)[1:-1])}</summary><pre>{escape(str(self))}</pre></details>"

    def save(self, path: str | Path) -> Path:
        """Write the page of equations, ``.html``.

        Raises
        ------
        InputError
            If the ending is another one, the mechanism is too large for a page, or the file cannot be written.
        """
        return write_page(self.mechanism, self.settings, Path(path), "save")


def method_of(settings: Settings) -> MethodChoice:
    """Return the method with its options, before anything is compiled."""
    own = {name.removeprefix("method."): str(value) for name, value in settings.options.items()}
    return choose_method(settings.method, own)


def write_page(mechanism: Mechanism, settings: Settings, path: Path, where: str, file: str = "") -> Path:
    """Write the page of a mechanism.

    Parameters
    ----------
    mechanism, settings : Mechanism, Settings
        Subject of the page.
    path : Path
        The page.
    where : str
        The option or argument that names it, for messages.
    file : str
        The text that describes the mechanism.

    Raises
    ------
    InputError
        If the mechanism is too large, or the file cannot be written.
    """
    path = check_path(where, path, PAGES, "plot")
    check_size(mechanism)
    speeds = sum(len(body.speeds) for body in mechanism.bodies)
    if settings.shape == "auto" and speeds <= MOST_STRAIGHT:  # whatever a run would take
        settings = replace(settings, shape="straight")
    derived, choice, run = mechanism, method_of(settings), None
    try:
        run, derived, choice = run_at_start(mechanism, settings)
        degrees = plural(run.compiled.info.nv - run.start.rank, "degree")
        facts = [f"At the start D has rank {run.start.rank}: {degrees} of freedom.", *run.start.notes]
        if run.start.redundant_rows:
            facts.append(f"Redundant at the start: {', '.join(run.start.redundant_rows)}.")
        if settings.coordinates == "auto":
            facts.append(f"Coordinates: {run.plan.coordinates_reason}.")
    except AssemblyError as error:
        facts = [f"It does not close, and is drawn as described: {error}"]
    values = parameter_values(mechanism, settings.parameters)
    return write_whole(path, EquationPage(mechanism, derived, choice, values, facts, file, run).html())


def run_at_start(mechanism: Mechanism, settings: Settings) -> tuple[Prepared, Mechanism, MethodChoice]:
    """Return a mechanism at the start of a run.

    Raises
    ------
    AssemblyError, InputError
        As `symgen.run.planning.prepare.prepare` does.

    Returns
    -------
    Prepared
        Without outputs, whose integrals are the runtime's.
    Mechanism
        With its tree where coordinates are those of joints.
    MethodChoice
        The method as compiled, with the solver that the start requires.
    """
    run = prepare(structs.replace(mechanism, outputs=()), settings, Purpose.STATE)
    choice, solver = run.plan.choice, str(run.compiled.law.options.get("solver", ""))
    if solver and solver != choice.options["solver"]:  # bodies are light
        choice = choice.with_options(solver=solver)
    return run, mechanism if run.tree is None else run.mechanism, choice


def equation_facts(whole: Mechanism, settings: Settings, with_method: bool) -> dict[str, Any]:
    """Return all facts, expressions as text.

    Parameters
    ----------
    whole : Mechanism
        The description.
    settings : Settings
        Of which ``method``, ``options``, ``shape``, ``coordinates``, ``parameters`` and ``start`` count.
    with_method : bool
        Whether the functions of the method are included.
    """
    run, mechanism, choice = run_at_start(whole, settings)
    plan, start = run.plan, run.start
    of_tree: dict[str, Any] = {}
    if mechanism.topology is not None:
        links = mechanism.topology.links
        tree = [{"body": x.body, "joint": x.joint or None, "on": x.parent if x.joint else None} for x in links]
        of_tree = {"topology": _topology_facts(mechanism.topology, mechanism), "tree": tree}
    equations = formulate(mechanism)
    show, words = text_writer(equations), row_words(mechanism)
    values = parameter_values(whole, settings.parameters)
    parameters = [_parameter_facts(p, values[p.name]) for p in mechanism.parameters]
    facts: dict[str, Any] = {
        "mechanism": whole.name,
        "space": whole.space,
        "state": {"coordinates": plan.coordinates, "reason": plan.coordinates_reason},
        **of_tree,
        "title": whole.title,
        "sizes": _size_facts(equations),
        "shape": {"shape": run.compiled.shape, "reason": plan.shape_reason, "kernels": _count_kernels(whole)},
        "rank": start.rank,
        "degrees_of_freedom": equations.nv - start.rank,
        "redundant_rows": list(start.redundant_rows),
        **_bounded_row_facts(run, mechanism),
        "dropped_rows": list(equations.dropped_rows),
        "pins": list(pins_that_vary(whole)),
        "notes": list(start.notes),
        "coordinates": [{"name": q.name, "unit": q.unit} for q in equations.coordinates],
        "velocities": [{"name": v.name, "unit": v.unit} for v in equations.velocities],
        "parameters": [p for p in parameters if p["name"] not in equations.inputs],
        "inputs": [p for p in parameters if p["name"] in equations.inputs],
        "rows": [
            {
                "name": row.name,
                "joint": row.joint,
                "unit": row.unit,
                "words": words[row.name].words,
                "vectors": words[row.name].vectors,
                "phi": None if row.phi is None else show(row.phi),
                "nu": show(row.nu),
                "gamma": show(row.gamma),
                "jacobian": {equations.velocities[i].name: show(node) for i, node in row.entries},
            }
            for row in equations.rows
        ],
        "pattern": pattern_of_constraints(equations),
        "mass": [
            {
                "velocities": [equations.velocities[i].name for i in block.columns],
                "matrix": [[show(node) for node in line] for line in block.entries],
            }
            for block in equations.mass
        ],
        "forces": {v.name: show(node) for v, node in zip(equations.velocities, equations.forces, strict=True)},
        "energies": {
            "kinetic": show(equations.kinetic),
            "potential": show(equations.potential),
            "power": show(equations.power),
        },
        "joint_coordinates": {
            c.name: {"unit": c.unit, "value": show(c.value), "rate": show(c.rate)} for c in equations.joint_coordinates
        },
        "operations": _operation_facts(equations),
        "outlines": outline_facts(mechanism, values),
        "left_out": [{"what": o.what, "why": o.why} for o in equations.omissions],
    }
    facts |= _texts_by_terms(mechanism, equations)
    if equations.states:
        rates = zip(equations.states, equations.state_rates, strict=True)
        facts["states"] = {x.name: {"unit": x.unit, "rate": show(node)} for x, node in rates}
    if with_method:
        facts["method"] = _method_facts(mechanism, equations, choice)
    return facts


def _parameter_facts(parameter: Parameter, value: float) -> dict[str, Any]:
    """Return a parameter with its value in SI units and, where the file has another unit, in that."""
    number, unit = parameter.as_written(value)
    written = {"as_written": {"value": number, "unit": unit}} if parameter.shown else {}
    return {"name": parameter.name, "unit": parameter.unit, "value": value, **written}


def _texts_by_terms(mechanism: Mechanism, equations: Equations) -> dict[str, Any]:
    """Return gamma and forces, long ones by shared terms, and the terms."""
    gammas, forces, show = [row.gamma for row in equations.rows], list(equations.forces), text_writer(equations)
    long = {
        n for n in (*gammas, *forces) if len(show(n)) > SHORT or equations.graph.count_tree_operations([n]) > LONGEST
    }
    named = nodes_with_names if mechanism.space == "spatial" else element_terms
    others = {*input_names(equations).values()}
    terms = shared_terms(equations.graph, sorted(long), named(mechanism, equations), others)
    by_terms, definition = text_writers_by_terms(equations, terms)

    def write_node(node: int) -> str:
        return by_terms(node) if node in long else show(node)

    return {
        "terms": {terms[node]: definition(node) for node in sorted(terms)},
        "gamma_by_terms": {row.name: write_node(row.gamma) for row in equations.rows},
        "forces_by_terms": {v.name: write_node(n) for v, n in zip(equations.velocities, forces, strict=True)},
    }


def _topology_facts(topology: Topology, mechanism: Mechanism) -> dict[str, list[str]]:
    """Return which joints carry bodies, which close loops, and which bodies are rigid with what carries them."""
    moving = {name.rpartition(".")[0] for name, _ in state_names(mechanism, topology)[1]}
    return {
        "tree": [link.joint for link in topology.links if link.joint],
        "cut": list(topology.cut),
        "merged": [link.body for link in topology.links if link.joint and not {link.joint, link.body} & moving],
        "prescribed": [x.driver for x in topology.prescribed],
    }


def _count_kernels(mechanism: Mechanism) -> dict[str, int]:
    """Return how many instances each kernel of the looped shape would have; none where contacts are straight code."""
    if any(row.signed for row in mechanism.bounded):
        return {}
    return dict(Counter(kernel_stems(instances_of_mechanism(mechanism))))


def pattern_of_constraints(equations: Equations) -> list[str]:
    """Return the pattern of D, one text a row: ``1`` a constant of the scene, ``x`` a varying entry, ``.`` nothing."""
    lines = []
    for row in equations.rows:
        line = ["."] * equations.nv
        for column, node in row.entries:
            line[column] = "x" if equations.graph.value(node) is None else "1"
        lines.append("".join(line))
    return lines


def _size_facts(equations: Equations) -> dict[str, int]:
    return {
        "coordinates": equations.nq,
        "velocities": equations.nv,
        "rows": equations.m,
        "parameters": len(equations.parameters),
        "jacobian_entries": sum(len(row.entries) for row in equations.rows),
        "jacobian_constants": sum(line.count("1") for line in pattern_of_constraints(equations)),
    }


def _operation_facts(e: Equations) -> dict[str, dict[str, int]]:
    """Count operations by quantity, each with its own common subexpressions, and of all together."""
    parts = e.nodes() | {"energies": [e.kinetic, e.potential, e.power]}
    parts |= {"states": list(e.state_rates)} if e.states else {}
    parts["together"] = [node for nodes in parts.values() for node in nodes]
    return {
        name: {"before": e.graph.count_tree_operations(nodes), "after": e.graph.count_operations(nodes)}
        for name, nodes in parts.items()
    }


def _method_facts(mechanism: Mechanism, equations: Equations, choice: Any) -> dict[str, Any]:
    """Return the functions emitted for a method with their operation counts."""
    program = lower_model(equations, digest(mechanism))
    law = law_at_start(mechanism, equations, program, choice)
    return {
        "name": choice.method.name,
        "summary": choice.method.summary,
        "options": dict(choice.options),
        "parameters": dict(law.info.parameters),
        "functions": {
            block.name: {"purpose": block.purpose, "before": block.tree_operations, "after": block.operations}
            for block in (*program.blocks, *law.blocks)
        },
        "elimination_order": [equations.rows[i].name for i in program.order],
        "fill": program.fill,
    }


def _bounded_row_facts(run: Prepared, mechanism: Mechanism) -> dict[str, list[dict[str, Any]]]:
    """Return the rows with bounds of a mechanism by their families."""
    jamming, contacts = jamming_numbers(run), contact_facts(run)
    return {
        family.fact: [
            _facts_of_bounded_row(row, jamming.get(row.name)) | (contacts.get(row.name, {}) if row.one_sided else {})
            for row in rows
        ]
        for family, rows in rows_by_family(mechanism).items()
    }


def _facts_of_bounded_row(row: BoundedRow, jamming: float | None) -> dict[str, Any]:
    """Return what is said of a row with bounds."""
    reaction = {} if row.one_sided else {"reaction": list(row.pressed), "jamming_number": jamming}
    return {"name": row.name, "row": row.row, "unit": unit_of_effort(row), **reaction, **row.facts()}
