"""An offline page of a mechanism: derived equations, compiled code, and links between a joint and both."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from html import escape
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symgen.base.errors import InputError, counted, sizes_of
from symgen.base.escapes import script_json
from symgen.derive.emit.emit import emit_law, emit_model
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.model import lower_model
from symgen.describe.drawing import sketch
from symgen.describe.parts.own_units import as_written
from symgen.result.player.live import rates_part
from symgen.result.player.motion_page import rates_script
from symgen.result.reading.boxes import dotted, name, row, sign, transposed_matrix
from symgen.result.reading.html import (
    attribute,
    equation,
    equations,
    fold,
    html_table,
    math,
    of_factor,
    of_jacobian,
    picture,
    prose,
    section,
    shortened,
    small,
    vector_equation,
)
from symgen.result.reading.law import law
from symgen.result.reading.listing import Computed, code_listing, computed, file_listing, sections
from symgen.result.reading.row_words import row_words
from symgen.result.reading.sheet import Sheet
from symgen.run.compiling.closing import law_at_start

if TYPE_CHECKING:
    from symgen.describe.mechanism import Joint, Mechanism
    from symgen.run.compiling.method_choice import MethodChoice
    from symgen.run.planning.prepare import Prepared

#: Largest page [bytes]; emitted code is left out of a page that would be larger.
LARGEST = 2_000_000
#: Mechanisms with more rows and velocities have no page.
MOST_ROWS = 1500
#: Up to so many velocities of bodies a page has the code of a run in straight lines, unless the shape is set.
MOST_STRAIGHT = 150
#: Number of shared terms in one group.
_TOGETHER = 25
#: Matrices up to this size are shown whole.
_WHOLE = 12
_POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:"


@lru_cache(maxsize=4)
def _web(name: str) -> str:
    return (Path(__file__).parent / "web" / name).read_text(encoding="utf-8")


def check_size(mechanism: Mechanism) -> None:
    """Refuse a mechanism too large for a readable page, before anything is derived.

    Raises
    ------
    InputError
        If it has too many rows or velocities.
    """
    rows = sum(len(joint.rows) for joint in mechanism.joints)
    speeds = sum(len(body.speeds) for body in mechanism.bodies)
    if max(rows, speeds) > MOST_ROWS:
        expected = f"at most {MOST_ROWS} constraint rows and velocities for a page"
        raise InputError("page", expected, f"{rows} rows and {speeds} velocities", "text and JSON have no such limit")


@dataclass(eq=False)
class EquationPage:
    """A page of derived equations.

    Attributes
    ----------
    whole, mechanism : Mechanism
        As described, and as it was derived: with its tree where coordinates are those of joints.
    choice : MethodChoice
        The method.
    values : mapping
        Values of the parameters.
    facts : sequence of str
        Sentences about the start, and choices.
    file : str
        The file, where there is one.
    run : Prepared or None
        The run whose start is drawn, and from whose code the page has its right-hand side; None: it does not close.
    """

    whole: Mechanism
    mechanism: Mechanism
    choice: MethodChoice
    values: Mapping[str, float]
    facts: Sequence[str]
    file: str
    run: Prepared | None

    def __post_init__(self) -> None:
        self.e = formulate(self.mechanism)
        self.sheet = Sheet(self.mechanism, self.e)
        self.program = lower_model(self.e, digest="")
        method, options = self.choice.method, self.choice.options
        self.steps = law(method.name, options, self.e.driving is not None)
        self.law = law_at_start(self.mechanism, self.e, self.program, self.choice)
        self.source = emit_model(self.program, self.e)
        self.parts = emit_law(self.law, self.program, self.e, method.summary, method.reference)
        self.places = sections(self.file)
        self._words = row_words(self.mechanism)
        self.q: list[float] | None = None  # as described
        if self.run is not None:
            compiled, start = self.run.assembled.of_bodies
            self.q = [float(x) for x in start.y[: compiled.info.nq]]

    def html(self) -> str:
        """Return the page, without some listings of emitted code where it would be larger than `LARGEST`.

        What room is left holds the right-hand side as a script calls it.

        Raises
        ------
        InputError
            If it is larger even without the code.
        """
        whole, why = self._rates()
        for script, listed in product(dict.fromkeys((whole, "")), (self.parts, {}, None)):
            if whole and not script:
                why = f"its {len(whole)} characters are more than this page has room for"
            text = self._text(listed, script, why)
            if len(text.encode()) <= LARGEST:
                return text
        expected, got = f"a mechanism whose page has at most {LARGEST} bytes", f"one with {len(text.encode())}"
        raise InputError("page", expected, f"{got} without its code", "text and JSON have no such limit")

    @cached_property
    def _computed(self) -> dict[str, list[Computed]]:
        by_row: dict[str, list[Computed]] = {}
        for line in computed(self.program, self.e, self.source):
            by_row.setdefault(line.row, []).append(line)
        return by_row

    def _rates(self) -> tuple[str, str]:
        """Return the right-hand side as a script, or an empty text and the reason."""
        if self.run is None:
            return "", "the mechanism does not close"
        part, why = rates_part(self.run.compiled, self.run.start)
        return "" if part is None else rates_script(part), why

    def _text(self, listed: Mapping[str, str] | None, script: str, why: str) -> str:
        """Return the page with the module ``model`` and others, or without code, and a script of the rates if any."""
        e, method, joints = self.e, self.choice.method.name, self.mechanism.joints
        title = self.whole.title or self.whole.name
        kind = "bodies" if self.mechanism.topology is None else "the joints of a tree"
        sizes = f"{sizes_of(e)}, {counted(len(e.parameters), 'parameter')}"
        rates = _OFFERED if script else f"This page offers no right-hand side to scripts: {why}."
        body = [
            f"<h1>{escape(title)}</h1>",
            f"<p>{escape(self.whole.name)}, in coordinates of {kind}: {sizes}. Method {escape(method)}.</p>",
            *(small(fact) for fact in self.facts),
            self._navigation(),
            section("motion", "Equations of motion", self._motion()),
            section("sketch", "Sketch", [f'<div class="scene">{self._sketch()}</div>', small(_SKETCH)]),
            section("topology", "Topology", self._topology()),
            section("coordinates", "Coordinates", self._coordinates()),
            section("rows", "Joints and their rows", [self._joint(j, listed is not None) for j in joints]),
            section("patterns", "Patterns", self._patterns()),
            section("law", f"The law of {method}, as solved", self._law()),
            section("operations", "Operations", self._operations()),
            section("left-out", "Left out", self._left_out()),
            section("file", "File", file_listing(self.file, self.places, {joint.name for joint in joints})),
            section("code", "Emitted code", [small(rates), *self._code(listed)]),
        ]
        data: dict[str, Any] = {
            "t": 0.0,
            "q": self.q,
            "names": [f"{b.name}.{c}" for b in self.whole.bodies for c in b.coordinates],
            "y0": None if self.run is None else [float(x) for x in self.run.start.y],
            "state": [x.name for x in (*e.coordinates, *e.velocities)],
            "rows": [r.name for r in e.rows],
        }
        head = (
            '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">'
            '<meta name="viewport" content="width=device-width, initial-scale=1"><link rel="icon" href="data:,">'
            f"<title>{escape(title)}: equations</title><style>{_web('style.css')}</style></head><body>"
        )
        code = f"const rates = {script or 'null'};\n{_web('script.js')}"
        tail = f'<script type="application/json" id="data">{script_json(data)}</script><script>{code}</script>'
        return "\n".join([head, *body, tail, "</body></html>\n"])

    # -- sections --------------------------------------------------------------------------------------------------

    def _navigation(self) -> str:
        names = "motion sketch topology coordinates rows patterns law operations left-out file code".split()
        return "<nav>" + " ".join(f'<a href="#{k}">{k.replace("-", " ")}</a>' for k in names) + "</nav>"

    def _sketch(self) -> str:
        return sketch(self.whole, self.q, self.values)

    def _topology(self) -> list[str]:
        lines = [["joint", "kind", "between", "rows"]]
        for joint in self.mechanism.joints:
            between = " and ".join(dict.fromkeys(joint.bodies))
            link = f'<a href="#rows-{attribute(joint.name)}">{escape(joint.name)}</a>'
            lines.append([link, escape(joint.kind), escape(between), str(len(self.sheet.of(joint.name)))])
        parts = [fold(f"{counted(len(self.mechanism.joints), 'joint')}", html_table(lines), len(lines) <= 13)]
        if self.mechanism.topology is not None:
            tree = [["body", "carried by", "on"]]
            tree += [
                [escape(x.body), escape(x.joint or "nothing: free"), escape(x.parent)]
                for x in self.mechanism.topology.links
            ]
            cut = ", ".join(self.mechanism.topology.cut) or "no joint"
            parts.append(fold(f"the tree; loops are closed by {cut}", html_table(tree)))
        return parts

    def _coordinates(self) -> list[str]:
        parts = []
        for title, quantities in self.sheet.quantities():
            if quantities:
                numbers = title in ("Parameters", "Inputs")
                lines = [["symbol", "name", "unit", *(["value"] if numbers else [])]]
                for quantity in quantities:
                    letter = math(self.sheet.writer.symbol(quantity.name))
                    number, unit = (
                        as_written(self.mechanism, quantity, self.values) if numbers else (0.0, quantity.unit)
                    )
                    value = [f"{number:.6g}"] if numbers else []
                    lines.append([letter, escape(quantity.name), escape(unit), *value])
                parts.append(fold(f"{len(quantities)} {title.lower()}", html_table(lines)))
        return parts

    def _joint(self, joint: Joint, code: bool) -> str:
        rows, g = self.sheet.of(joint.name), self.e.graph
        links = [f'<a href="#joint-{attribute(joint.name)}">in the sketch</a>']
        place = self.places.get(f"joints.{joint.name}")
        if place is not None:
            links.append(f'<a href="#file-{place}">in the file, line {place}</a>')
        parts = [f"<p>{' · '.join(links)}</p>"]
        if not rows:
            prescribed = self.sheet.prescribed().get(joint.name)
            sentence = "It carries a body in the tree" if prescribed is None else f"It prescribes {prescribed}"
            parts.append(f"<p>{escape(sentence)}: it has no rows.</p>")
        phi = {line.key: line for line in self.sheet.phi(rows)}
        nu = {line.key: line for line in self.sheet.nu(rows)}
        gamma = {line.key: line for line in self.sheet.gamma(rows)}
        for r in rows:
            unit = f'<span class="small">{escape(r.unit)}</span>'
            parts.append(f'<div id="row-{attribute(r.name)}"><h3>row {escape(r.name)} {unit}</h3>')
            held = self._words[r.name]
            parts.append(f"<p>{escape(held.words)}</p>")
            scalar = equation(phi[r.name], " = 0") if r.name in phi else "<p>nonholonomic: it has no Phi</p>"
            if self.mechanism.space == "spatial" and held.vectors and r.name in phi:
                parts.append(f'<p class="vectors">{vector_equation(held.vectors)}</p>')
                scalar = fold("Phi in coordinates of bodies" if self.mechanism.topology is None else "Phi", scalar)
            parts.append(scalar)
            parts += [equation(nu[r.name])] if r.name in nu else []
            parts.append(equation(gamma[r.name]))
            parts.append(self._lines_of(r.name) if code else "")
            parts.append("</div>")
        parts.append(equations(self.sheet.jacobian(joint.name)))
        nodes = [n for r in rows for n in (r.phi, r.nu, r.gamma, *(x for _, x in r.entries)) if n is not None]
        names = f"{escape(joint.kind)} between {escape(' and '.join(dict.fromkeys(joint.bodies)))}"
        sizes = f"{counted(len(rows), 'row')}, {counted(g.operations(nodes), 'operation')}"
        head = f"<b>{escape(joint.name)}</b>: {names}, {sizes}"
        return fold(head, "\n".join(parts), ident=f"rows-{joint.name}", marked=True)

    def _lines_of(self, name: str) -> str:
        links = [
            f'<a class="code" href="#line-{c.line}">{escape(c.what)}: <code>{escape(shortened(c.text))}</code></a>'
            for c in self._computed.get(name, ())
        ]
        return f'<p class="small">computed by {" · ".join(links)}</p>' if links else ""

    def _patterns(self) -> list[str]:
        e = self.e
        if not e.m:
            return ["<p>There are no rows.</p>"]
        rows, order = [r.name for r in e.rows], self.program.order
        entries = of_jacobian(e)
        first = picture(entries, rows, [v.name for v in e.velocities], "pattern of D", links=True)
        again = [rows[i] for i in order]
        second = picture(of_factor(e, order), again, again, "pattern of the factor of D G D^T")
        return [
            fold(f"D: {len(entries)} entries; dark ones vary, light ones are constants of the scene", first, e.m <= 40),
            fold(f"factor of D G D^T in the order of elimination; {self.program.fill} entries are filled in", second),
        ]

    def _motion(self) -> list[str]:
        sheet = self.sheet
        written = _MOTION if self.e.m else _FREE_MOTION
        folds = [f'<div class="equation">{math(written)}</div>', small("Numbers are rounded to six digits.")]
        if self.e.nv <= _WHOLE:
            folds.append(fold("M and D as matrices", equations(sheet.whole())))
        parts = [
            ("rates of the coordinates", equations(sheet.rates()) or "q' = v"),
            ("mass matrix M; what is not written is zero or symmetric", equations(sheet.mass())),
            ("forces f; those not written are zero", equations(sheet.forces()) or "f = 0"),
            (_POWER if self.e.driving else _POWER.partition(";")[0], equations(sheet.energies())),
        ]
        folds += [fold(title, text) for title, text in parts]
        shared = sheet.shared(sheet.nodes(("Phi", "D", "nu", "gamma", "N", "M", "f", "energies")))
        for first in range(0, len(shared), _TOGETHER):
            some = shared[first : first + _TOGETHER]
            names = f"{math(some[0].left)} to {math(some[-1].left)}"
            folds.append(fold(f"shared terms {names}", equations(some)))
        return folds

    def _law(self) -> list[str]:
        if not self.e.m:
            alone = (
                "There are no constraint rows, and the accelerations follow from the forces alone, with every method."
            )
            return [f"<p>{alone}</p>", f'<div class="equation">{math(_FREE_MOTION)}</div>']
        lines = [f"<p>{prose(self.steps.summary)}</p>"]
        for function, purpose, steps in self.steps.parts:
            lines.append(f"<h3>{escape(function)}: {prose(purpose)}</h3>")
            for step in steps:
                note = ' <span class="small">solved</span>' if step.solved else ""
                lines.append(f'<div class="equation">{math(step.box)}{note}</div>')
        return [fold("steps", "\n".join(lines), True)]

    def _operations(self) -> list[str]:
        g, lines = self.e.graph, [["joint", "Phi", "D", "gamma", "together"]]
        for joint in self.sheet.joints:
            rows = self.sheet.of(joint)
            groups = [
                [r.phi for r in rows if r.phi is not None],
                [n for r in rows for _, n in r.entries],
                [r.gamma for r in rows],
            ]
            counts = [g.operations(nodes) for nodes in (*groups, [n for group in groups for n in group])]
            lines.append([f'<a href="#rows-{attribute(joint)}">{escape(joint)}</a>', *map(str, counts)])
        blocks = [["function", "what it computes", "operations"]]
        for block in (*self.program.blocks, *self.law.blocks):
            blocks.append([escape(block.name), prose(block.purpose), str(block.operations)])
        return [
            fold("by joint, each with what it shares within itself", html_table(lines, numbers=4)),
            fold("by emitted function", html_table(blocks, numbers=1), True),
        ]

    def _code(self, listed: Mapping[str, str] | None) -> list[str]:
        if listed is not None:
            back = {c.line: c for lines in self._computed.values() for c in lines}
            left_out = [] if listed else [small("Modules of the method are left out, for the size of this page.")]
            return [*code_listing(self.source, listed, back), *left_out]
        size = len(self.source) + sum(map(len, self.parts.values()))
        return [f"<p>It has {size} characters and is left out, as the page would be larger than {LARGEST} bytes.</p>"]

    def _left_out(self) -> list[str]:
        items = [f"<li>{prose(o.what)}: {prose(o.why)}</li>" for o in self.e.omissions]
        return (
            [fold(f"{len(items)} things", f"<ul>{''.join(items)}</ul>", len(items) <= 8)]
            if items
            else ["<p>Nothing.</p>"]
        )


_OFFERED = "Scripts find it at work: window.symgen.rates(t, y, p) returns the rates of a state; y0 is the start's."
_POWER = "energies, and the power of forces without potential; b v' + c is that of drivers without rows"
_SKETCH = "A joint in the picture leads to its rows; these lead to the file and to the lines that compute them."
_FREE_MOTION = row(name("M"), dotted(name("v")), sign("="), name("f"))
_MOTION = row(
    *(
        name("M"),
        dotted(name("v")),
        sign("+"),
        transposed_matrix(name("D")),
        name("lambda"),
        sign("="),
        name("f"),
        sign(","),
    ),
    *(name("D"), dotted(name("v")), sign("="), name("gamma")),
)
