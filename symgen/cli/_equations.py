"""Derived equations laid out for reading: as text, and as LaTeX."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from symgen.report.words import counted

#: A wider Jacobian is listed entry by entry only.
WIDEST = 150


def _degrees(facts: Mapping[str, Any]) -> str:
    count = facts["degrees_of_freedom"]
    return f"{count} {'degree' if count == 1 else 'degrees'}"


def _cut(facts: dict[str, Any]) -> str:
    """Return the joints that close loops, in words."""
    return ", ".join(facts["topology"]["cut"]) or "no joint: the mechanism is a tree"


def as_text(facts: dict[str, Any]) -> str:
    """Return what ``symgen inspect`` shows as text."""
    sizes, lines = facts["sizes"], list[str]()

    def section(title: str) -> None:
        lines.extend(["", title, "-" * len(title)])

    lines.append(f"{facts['mechanism']}: {facts['title']}")
    lines.append(
        f"{sizes['coordinates']} coordinates, {sizes['velocities']} velocities, "
        f"{counted(sizes['rows'], 'constraint row')} of rank {facts['rank']}, {_degrees(facts)} of freedom at the start"
    )
    lines += [f"note: {note}" for note in facts["notes"]]
    shape = facts["shape"]
    kinds: dict[str, int] = {}
    for name, count in shape["kernels"].items():  # a kind, and a digest of what the kernel computes
        kind = name.rpartition("_")[0]
        kinds[kind] = kinds.get(kind, 0) + count
    kernels = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
    lines.append(f"shape: {shape['shape']}, as {shape['reason']}")
    lines.append(f"as loops: {len(shape['kernels'])} kernels for {kernels}")
    if "tree" in facts:
        lines.append(f"joint coordinates: {facts['state']['reason']}; loops are closed by {_cut(facts)}")
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


def as_latex(facts: dict[str, Any]) -> str:
    """Return what ``symgen inspect`` shows as LaTeX, to be put into a document with amsmath."""
    from symgen.formulate.display import latex_name

    def index(name: str) -> str:
        return rf"\mathrm{{{name.replace('_', chr(92) + '_')}}}"

    rows = facts["rows"]
    blocks = [
        ("Constraints", [rf"\Phi_{{{index(r['name'])}}} &= {r['phi']} = 0" for r in rows if r["phi"] is not None]),
        (
            "Jacobian, nonzero entries",
            [
                rf"D_{{{index(r['name'])},\,{latex_name(v)}}} &= {entry}"
                for r in rows
                for v, entry in r["jacobian"].items()
            ],
        ),
        ("Velocity constraints $D v = \\nu$", [rf"\nu_{{{index(r['name'])}}} &= {r['nu']}" for r in rows]),
        (
            "Quadratic velocity terms, $D \\dot v = \\gamma$",
            [rf"\gamma_{{{index(r['name'])}}} &= {r['gamma']}" for r in rows],
        ),
        (
            "Mass matrix",
            [
                "M_{" + r",\,".join(latex_name(v) for v in b["velocities"]) + "} &= " + _latex_matrix(b["matrix"])
                for b in facts["mass"]
            ],
        ),
        (
            "Forces, $M \\dot v + D^T \\lambda = f$",
            [rf"f_{{{latex_name(name)}}} &= {force}" for name, force in facts["forces"].items()],
        ),
        (
            "Energies",
            [
                f"T &= {facts['energies']['kinetic']}",
                f"V &= {facts['energies']['potential']}",
                rf"f_{{nc}}^T v &= {facts['energies']['power']}",
            ],
        ),
    ]
    sizes = facts["sizes"]
    head = [
        f"% {facts['mechanism']}: {sizes['coordinates']} coordinates, {sizes['rows']} rows of rank {facts['rank']}, "
        f"{_degrees(facts)} of freedom",
        *(
            f"% {name}: {n['before']} operations, {n['after']} with shared subexpressions"
            for name, n in facts["operations"].items()
        ),
        *(f"% left out: {o['what']}: {o['why']}" for o in facts["left_out"]),
    ]
    parts = [
        f"\\paragraph{{{title}}}\n\\begin{{align*}}\n" + " \\\\\n".join(lines) + "\n\\end{align*}"
        for title, lines in blocks
        if lines
    ]
    return "\n".join([*head, *parts]) + "\n"


def _latex_matrix(entries: list[list[str]]) -> str:
    if len(entries) == 1:
        return entries[0][0]
    return r"\begin{pmatrix} " + r" \\ ".join(" & ".join(row) for row in entries) + r" \end{pmatrix}"
