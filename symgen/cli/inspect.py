"""Show the equations of a mechanism, and what was left out."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import click

from symgen.cli import OK, write_json
from symgen.cli._options import examples, setting_options
from symgen.errors import InputError
from symgen.report.words import counted

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.describe.mechanism import Mechanism, Topology
    from symgen.formulate.equations import Equations
    from symgen.settings import Settings


#: A wider Jacobian is listed entry by entry only.
WIDEST = 150


@click.command(
    "inspect",
    epilog=examples(
        "symgen inspect pendulum", "symgen inspect slider-crank --method lagrange --format latex --select M,f,law"
    ),
)
@click.argument("model")
@click.option("--format", "form", type=click.Choice(["text", "latex", "json"]), show_default="text")
@click.option("--json", "as_json", is_flag=True, help="The same as --format json.")
@click.option("--document", is_flag=True, help="With --format latex: a document that compiles as it is.")
@click.option(
    "--select", metavar="NAME,NAME", help="With --format latex: sections (Phi, D, gamma, M, f, law, ...) and joints."
)
@click.option("--symbols", is_flag=True, help="With --format latex: symbols for lengths that are numbers in the file.")
@click.option("-o", "--output", metavar="FILE.html", help="Write a self-contained page with all sections.")
@click.option("--method", help="Also show the operation counts of this method's functions.")
@setting_options(
    *("options", "shape", "coordinates", "parameters"),
    text={"options": "Of the method: weight=mass.", "parameters": "Value of a parameter, for the start."},
)
def command(
    model: str,
    form: str | None,
    as_json: bool,
    document: bool,
    select: str | None,
    symbols: bool,
    output: str | None,
    method: str | None,
    options: dict[str, str],
    shape: str,
    coordinates: str,
    parameters: dict[str, float],
) -> int:
    """Show what symgen derives for MODEL: exactly what is compiled.

    Coordinates, constraints, Jacobian with its pattern, quadratic velocity terms, forces, mass matrix, sizes, degrees
    of freedom, redundant rows, operation counts before and after common subexpressions, and what was left out and why.
    """
    from symgen.cli._reading import latex_of, method_of, write_page
    from symgen.settings import Settings

    named = method or "direct-correction"
    own = {f"method.{key}": value for key, value in _own(options, named).items()}
    settings = Settings(named, options=own, shape=shape, coordinates=coordinates, parameters=parameters)
    method_of(settings)  # refuses options that are numbers of runs
    if as_json and form not in (None, "json"):
        raise InputError("--json", "the same as --format json", f"--format {form} as well")
    form = "json" if as_json else form or "text"
    if output is not None:
        if as_json or document or select is not None or symbols or form != "text":
            raise InputError("inspect: -o", "a page, which has everything", "options of text, LaTeX or JSON with it")
        write_page(model, settings, output)
        return OK
    if form == "latex":
        if document and shape == "looped":
            raise InputError("--shape", "straight code, as a document shows the equations of one mechanism", "looped")
        click.echo(latex_of(model, settings, select, symbols, document), nl=False)
        return OK
    if document or select is not None or symbols:
        expected = "--format latex, with which alone --document, --select and --symbols mean something"
        raise InputError("inspect", expected, f"--format {form}")
    facts = describe(model, settings, method is not None)
    if form == "json":
        write_json(facts)
    else:
        click.echo(as_text(facts), nl=False)
    return OK


def _own(options: dict[str, str], method: str) -> dict[str, str]:
    """Return options of a method by their own names; they are given with its name, with ``method``, or with none."""
    own = {}
    for key, value in options.items():
        owner, _, name = key.rpartition(".")
        if owner not in ("", "method", method):
            raise InputError(f"--option {key}", f"{method}.NAME, method.NAME or NAME", f"'{key}'")
        if name in own:
            raise InputError(f"--option {key}", "each option once", f"{name} twice")
        own[name] = value
    return own


def describe(name: str, settings: Settings, with_method: bool) -> dict[str, Any]:
    """Return everything that is shown, expressions as text."""
    from symgen.api import load
    from symgen.cli._reading import at_start
    from symgen.formulate.formulate import formulate
    from symgen.reading.typeset import texts

    model = load(name)
    run, mechanism, choice = at_start(model, settings)
    plan, start = run.plan, run.start
    of_tree: dict[str, Any] = {}
    if mechanism.topology is not None:
        links = mechanism.topology.links
        tree = [{"body": x.body, "joint": x.joint or None, "on": x.parent if x.joint else None} for x in links]
        of_tree = {"topology": _topology(mechanism.topology, mechanism), "tree": tree}
    equations = formulate(mechanism)
    show = texts(equations)
    values = model.parameters(settings.parameters)
    parameters = [{"name": p.name, "unit": p.unit, "value": values[p.name]} for p in equations.parameters]
    facts: dict[str, Any] = {
        "mechanism": model.name,
        "state": {"coordinates": plan.coordinates, "reason": plan.coordinates_reason},
        **of_tree,
        "title": model.mechanism.title,
        "sizes": _sizes(equations),
        "shape": {"shape": run.compiled.shape, "reason": plan.shape_reason, "kernels": _kernels(model)},
        "rank": start.rank,
        "degrees_of_freedom": equations.nv - start.rank,
        "redundant_rows": list(start.redundant_rows),
        "dropped_rows": list(equations.dropped_rows),
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
                "phi": None if row.phi is None else show(row.phi),
                "nu": show(row.nu),
                "gamma": show(row.gamma),
                "jacobian": {equations.velocities[i].name: show(node) for i, node in row.entries},
            }
            for row in equations.rows
        ],
        "pattern": pattern(equations),
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
        "operations": _operations(equations),
        "left_out": [{"what": o.what, "why": o.why} for o in equations.omissions],
    }
    if with_method:
        facts["method"] = _method(mechanism, equations, choice)
    return facts


def _topology(topology: Topology, mechanism: Mechanism) -> dict[str, list[str]]:
    """Return which joints carry bodies, which close loops, and which bodies are rigid with what carries them."""
    from symgen.describe.topology import state_names

    moving = {name.partition(".")[0] for name, _ in state_names(mechanism, topology)[1]}
    return {
        "tree": [link.joint for link in topology.links if link.joint],
        "cut": list(topology.cut),
        "merged": [link.body for link in topology.links if link.joint and not {link.joint, link.body} & moving],
        "prescribed": [x.driver for x in topology.prescribed],
    }


def _kernels(model: Model) -> dict[str, int]:
    """Return how many instances each kernel of the looped shape would have."""
    from symgen.compiling.looped import kernel_stems
    from symgen.lower.looped.instances import instances

    return dict(Counter(kernel_stems(instances(model.mechanism))))


def pattern(equations: Equations) -> list[str]:
    """Return the pattern of D, one text a row: ``1`` a constant of the scene, ``x`` a varying entry, ``.`` nothing."""
    lines = []
    for row in equations.rows:
        line = ["."] * equations.nv
        for column, node in row.entries:
            line[column] = "x" if equations.graph.value(node) is None else "1"
        lines.append("".join(line))
    return lines


def _sizes(equations: Equations) -> dict[str, int]:
    return {
        "coordinates": equations.nq,
        "velocities": equations.nv,
        "rows": equations.m,
        "parameters": len(equations.parameters),
        "jacobian_entries": sum(len(row.entries) for row in equations.rows),
        "jacobian_constants": sum(line.count("1") for line in pattern(equations)),
    }


def _operations(e: Equations) -> dict[str, dict[str, int]]:
    """Count operations by quantity, each with its own common subexpressions, and of all together."""
    parts = e.nodes() | {"energies": [e.kinetic, e.potential, e.power]}
    parts["together"] = [node for nodes in parts.values() for node in nodes]
    return {
        name: {"before": e.graph.tree_operations(nodes), "after": e.graph.operations(nodes)}
        for name, nodes in parts.items()
    }


def _method(mechanism: Mechanism, equations: Equations, choice: Any) -> dict[str, Any]:
    """Return the functions emitted for a method with their operation counts."""
    from symgen.describe.digest import digest
    from symgen.lower.law import lower_law
    from symgen.lower.model import lower_model

    program = lower_model(equations, digest(mechanism))
    law = lower_law(equations, program, choice.method, choice.options)
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


def as_text(facts: dict[str, Any]) -> str:
    """Return the text of ``symgen inspect``."""
    sizes, lines = facts["sizes"], list[str]()

    def section(title: str) -> None:
        lines.extend(["", title, "-" * len(title)])

    lines.append(f"{facts['mechanism']}: {facts['title']}")
    lines.append(
        f"{sizes['coordinates']} coordinates, {sizes['velocities']} velocities, "
        f"{counted(sizes['rows'], 'constraint row')} of rank {facts['rank']}, "
        f"{counted(facts['degrees_of_freedom'], 'degree')} of freedom at the start"
    )
    lines += [f"note: {note}" for note in facts["notes"]]
    shape = facts["shape"]
    kinds = Counter[str]()
    for name, count in shape["kernels"].items():  # a kind, and a digest of what the kernel computes
        kinds[name.rpartition("_")[0]] += count
    kernels = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
    lines.append(f"shape: {shape['shape']}, as {shape['reason']}")
    lines.append(f"as loops: {len(shape['kernels'])} kernels for {kernels}")
    if "tree" in facts:
        cut = ", ".join(facts["topology"]["cut"]) or "no joint: the mechanism is a tree"
        lines.append(f"joint coordinates: {facts['state']['reason']}; loops are closed by {cut}")
        lines += [
            f"  {x['body']} " + (f"on {x['on']} by {x['joint']}" if x["joint"] else "free") for x in facts["tree"]
        ]
    for label, rows in (("redundant at the start", facts["redundant_rows"]), ("repeated", facts["dropped_rows"])):
        lines.append(f"rows {label}: {', '.join(rows) or 'none'}")
    section("Coordinates q and velocities v")
    lines += [f"{q['name']} [{q['unit']}]" for q in facts["coordinates"]]
    lines += [f"{v['name']} [{v['unit']}]" for v in facts["velocities"]]
    if facts["parameters"]:
        section("Parameters")
        lines += [f"{p['name']} = {p['value']:g} [{p['unit']}]" for p in facts["parameters"]]
    section("Constraints Phi = 0")
    lines += [f"{r['name']} [{r['unit']}]: {r['phi'] or 'none (nonholonomic)'}" for r in facts["rows"]]
    section("Jacobian D: D v = nu")
    if sizes["velocities"] <= WIDEST:
        width = max((len(r["name"]) for r in facts["rows"]), default=0)
        lines += [f"{r['name']:<{width}}  {line}" for r, line in zip(facts["rows"], facts["pattern"], strict=True)]
        lines.append("x: varies; 1: constant, of any value; .: zero in every position")
    lines += [f"D[{r['name']}, {v}] = {entry}" for r in facts["rows"] for v, entry in r["jacobian"].items()]
    lines += [f"nu[{r['name']}] = {r['nu']}" for r in facts["rows"] if r["nu"] != "0"] or ["nu = 0"]
    section("Quadratic velocity terms gamma: D v' = gamma")
    lines += [f"gamma[{r['name']}] = {r['gamma']}" for r in facts["rows"]]
    section("Mass matrix M")
    lines += [f"M[{', '.join(b['velocities'])}] = {_matrix(b['matrix'])}" for b in facts["mass"]]
    section("Forces f: M v' + D^T lambda = f")
    lines += [f"f[{name}] = {force}" for name, force in facts["forces"].items()]
    section("Energies")
    lines += [f"{name} = {expression}" for name, expression in facts["energies"].items()]
    section("Operations: before common subexpressions -> after")
    lines += [f"{name}: {n['before']} -> {n['after']}" for name, n in facts["operations"].items()]
    if "method" in facts:
        method = facts["method"]
        section(f"Functions emitted for {method['name']}")
        lines += [f"{name}: {f['before']} -> {f['after']}  {f['purpose']}" for name, f in method["functions"].items()]
        lines.append(f"elimination order: {', '.join(method['elimination_order'])}; fill-ins: {method['fill']}")
    section("Left out")
    lines += [f"{o['what']}: {o['why']}" for o in facts["left_out"]]
    return "\n".join(lines) + "\n"


def _matrix(entries: list[list[str]]) -> str:
    return entries[0][0] if len(entries) == 1 else "[" + ", ".join("[" + ", ".join(r) + "]" for r in entries) + "]"
