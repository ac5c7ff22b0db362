"""The text of ``symgen inspect``: facts about derived equations as sections with titles."""

from __future__ import annotations

from collections import Counter
from typing import Any

from symgen.base.errors import plural
from symgen.describe.bounds.keys import inspection_lines
from symgen.result.reading.outline_facts import outline_lines

#: A wider Jacobian is listed entry by entry only.
WIDEST = 150


def inspection_as_text(facts: dict[str, Any]) -> str:
    """Return the text of ``symgen inspect``."""
    sizes, lines = facts["sizes"], list[str]()

    def text_section(title: str) -> None:
        lines.extend(["", title, "-" * len(title)])

    lines.append(f"{facts['mechanism']}: {facts['title']}")
    lines.append(
        f"{plural(sizes['coordinates'], 'coordinate')}, {plural(sizes['velocities'], 'velocity', 'velocities')}, "
        f"{plural(sizes['rows'], 'constraint row')} of rank {facts['rank']}, "
        f"{plural(facts['degrees_of_freedom'], 'degree')} of freedom at the start"
    )
    lines += [f"note: {note}" for note in facts["notes"]]
    shape = facts["shape"]
    kinds = Counter[str]()
    for name, count in shape["kernels"].items():  # a kind, and a digest of what the kernel computes
        kinds[name.rpartition("_")[0]] += count
    kernels = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
    lines.append(f"shape: {shape['shape']}, as {shape['reason']}")
    if kernels:
        lines.append(f"as loops: {plural(len(shape['kernels']), 'kernel')} for {kernels}")
    if "tree" in facts:
        cut = ", ".join(facts["topology"]["cut"]) or "no joint: the mechanism is a tree"
        lines.append(f"joint coordinates: {facts['state']['reason']}; loops are closed by {cut}")
        lines += [
            f"  {x['body']} " + (f"on {x['on']} by {x['joint']}" if x["joint"] else "free") for x in facts["tree"]
        ]
    for label, rows in (("redundant at the start", facts["redundant_rows"]), ("repeated", facts["dropped_rows"])):
        lines.append(f"rows {label}: {', '.join(rows) or 'none'}")
    if facts["pins"]:
        first = facts["pins"][0]
        lines.append(f"pins that symgen design can vary, as {first}.x and {first}.y: {', '.join(facts['pins'])}")
    lines += inspection_lines(facts)
    text_section("Coordinates q and velocities v")
    lines += [f"{q['name']} [{q['unit']}]" for q in facts["coordinates"]]
    lines += [f"{v['name']} [{v['unit']}]" for v in facts["velocities"]]
    for title in ("parameters", "inputs"):
        if facts[title]:
            text_section(title.capitalize())
            written = [(p["name"], p.get("as_written", p)) for p in facts[title]]
            lines += [f"{name} = {x['value']:g} [{x['unit']}]" for name, x in written]
    if facts["rows"]:
        space = facts["space"] == "spatial"  # there rows in Euler parameters show little
        text_section("Rows in words" + ", and by vectors of bodies" * space)
        for r in facts["rows"]:
            vectors = f"; {r['vectors']}" if space and r["vectors"] else ""
            lines.append(f"{r['name']}: {r['words']}{vectors}")
    if facts["outlines"]:
        text_section("Outlines")
        lines += outline_lines(facts["outlines"])
    text_section("Constraints Phi = 0")
    lines += [f"{r['name']} [{r['unit']}]: {r['phi'] or 'none (nonholonomic)'}" for r in facts["rows"]]
    text_section("Jacobian D: D v = nu")
    if sizes["velocities"] <= WIDEST:
        width = max((len(r["name"]) for r in facts["rows"]), default=0)
        lines += [f"{r['name']:<{width}}  {line}" for r, line in zip(facts["rows"], facts["pattern"], strict=True)]
        lines.append("x: varies; 1: constant, of any value; .: zero in every position")
    lines += [f"D[{r['name']}, {v}] = {entry}" for r in facts["rows"] for v, entry in r["jacobian"].items()]
    lines += [f"nu[{r['name']}] = {r['nu']}" for r in facts["rows"] if r["nu"] != "0"] or ["nu = 0"]
    text_section("Quadratic velocity terms gamma: D v' = gamma")
    lines += [f"gamma[{name}] = {gamma}" for name, gamma in facts["gamma_by_terms"].items()]
    text_section("Mass matrix M")
    lines += [f"M[{', '.join(b['velocities'])}] = {_matrix_text(b['matrix'])}" for b in facts["mass"]]
    text_section("Forces f: M v' + D^T lambda = f" if facts["rows"] else "Forces f: M v' = f")
    lines += [f"f[{name}] = {force}" for name, force in facts["forces_by_terms"].items()]
    if facts["terms"]:
        text_section("Shared terms of gamma and f")
        lines += [f"{name} = {term}" for name, term in facts["terms"].items()]
    if "states" in facts:
        text_section("States of the file")
        lines += [f"{name}' = {x['rate']} [{x['unit']}/s]" for name, x in facts["states"].items()]
    text_section("Energies")
    lines += [f"{name} = {expression}" for name, expression in facts["energies"].items()]
    text_section("Operations, each quantity with its common subexpressions")
    lines += [f"{name}: {n['after']}" for name, n in facts["operations"].items()]
    if "method" in facts:
        method = facts["method"]
        text_section(f"Functions emitted for {method['name']}")
        lines += [f"{name}: {f['after']}  {f['purpose']}" for name, f in method["functions"].items()]
        lines.append(f"elimination order: {', '.join(method['elimination_order'])}; fill-ins: {method['fill']}")
    text_section("Left out")
    lines += [f"{o['what']}: {o['why']}" for o in facts["left_out"]]
    return "\n".join(lines) + "\n"


def _matrix_text(entries: list[list[str]]) -> str:
    return entries[0][0] if len(entries) == 1 else "[" + ", ".join("[" + ", ".join(r) + "]" for r in entries) + "]"
