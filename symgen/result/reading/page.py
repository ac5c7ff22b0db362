"""An offline page of a mechanism: derived equations, compiled code, and links between a joint and both."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from html import escape
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symgen.base.errors import InputError, plural, sizes_in_words
from symgen.base.escapes import script_json
from symgen.derive.emit.emit import emit_law, emit_model
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.model import lower_model
from symgen.describe.drawing import sketch
from symgen.describe.parts.own_units import as_written
from symgen.result.player.live import rates_part
from symgen.result.player.motion_page import rates_script
from symgen.result.reading.boxes import name_box, rate_box, row_box, sign_box, transposed_box
from symgen.result.reading.html import (
    attribute_text,
    equation_html,
    equations_html,
    folded_html,
    formula_html,
    html_table,
    pattern_of_factor,
    pattern_of_jacobian,
    pattern_svg,
    prose_html,
    section_html,
    shorten_code,
    small_html,
    vector_equation,
)
from symgen.result.reading.law_steps import law_as_steps
from symgen.result.reading.listing import Computed, code_listing, file_listing, lines_of_sections, lines_that_compute
from symgen.result.reading.row_words import row_words
from symgen.result.reading.sheet import Sheet
from symgen.run.compiling.free_by_loops import law_at_start

if TYPE_CHECKING:
    from symgen.describe.mechanism import Joint, Mechanism
    from symgen.run.compiling.method_choice import MethodChoice
    from symgen.run.planning.prepare import Prepared

#: Largest page [bytes]; emitted code is left out of a page that would be larger.
LARGEST = 2_000_000
#: Number of shared terms in one group.
_TOGETHER = 25
#: Matrices up to this size are shown whole.
_WHOLE = 12
#: Up to so many velocities all equations are open.
_SMALL = 9
_POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:"


@lru_cache(maxsize=4)
def _read_web_part(name: str) -> str:
    return (Path(__file__).parent / "web" / name).read_text(encoding="utf-8")


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
        self.steps = law_as_steps(method.name, options, self.e.driving is not None)
        self.law = law_at_start(self.mechanism, self.e, self.program, self.choice)
        self.source = emit_model(self.program, self.e)
        self.parts = emit_law(self.law, self.program, self.e, method.summary, method.reference)
        self.places = lines_of_sections(self.file)
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
        whole, why = self._rates_script()
        for script, listed in product(dict.fromkeys((whole, "")), (self.parts, {}, None)):
            if whole and not script:
                why = f"its {len(whole)} characters are more than this page has room for"
            text = self._page_text(listed, script, why)
            if len(text.encode()) <= LARGEST:
                return text
        expected, got = f"a mechanism whose page has at most {LARGEST} bytes", f"one with {len(text.encode())}"
        raise InputError("page", expected, f"{got} without its code", "text and JSON have no such limit")

    @cached_property
    def _computed(self) -> dict[str, list[Computed]]:
        by_row: dict[str, list[Computed]] = {}
        for line in lines_that_compute(self.program, self.e, self.source):
            by_row.setdefault(line.row, []).append(line)
        return by_row

    def _rates_script(self) -> tuple[str, str]:
        """Return the right-hand side as a script, or an empty text and the reason."""
        if self.run is None:
            return "", "the mechanism does not close"
        part, why = rates_part(self.run.compiled, self.run.start)
        return "" if part is None else rates_script(part), why

    def _page_text(self, listed: Mapping[str, str] | None, script: str, why: str) -> str:
        """Return the page with the module ``model`` and others, or without code, and a script of the rates if any."""
        e, method, joints = self.e, self.choice.method.name, self.mechanism.joints
        title = self.whole.title or self.whole.name
        kind = "bodies" if self.mechanism.topology is None else "the joints of a tree"
        sizes = f"{sizes_in_words(e)}, {plural(len(e.parameters), 'parameter')}"
        own = [self._joint_section(j, listed is not None) for j in joints]
        own += [
            self._section_beside(x, listed is not None) for x in self.sheet.joints if x not in {j.name for j in joints}
        ]
        rates = _OFFERED if script else f"This page offers no right-hand side to scripts: {why}."
        body = [
            f"<h1>{escape(title)}</h1>",
            f"<p>{escape(self.whole.name)}, in coordinates of {kind}: {sizes}. Method {escape(method)}.</p>",
            *(small_html(fact) for fact in self.facts),
            self._navigation_html(),
            section_html("motion", "Equations of motion", self._motion_section()),
            section_html("sketch", "Sketch", [f'<div class="scene">{self._sketch_svg()}</div>', small_html(_SKETCH)]),
            section_html("topology", "Topology", self._topology_section()),
            section_html("coordinates", "Coordinates", self._coordinates_section()),
            section_html("rows", "Joints and their rows", own),
            section_html("patterns", "Patterns", self._patterns_section()),
            section_html("law", f"The law of {method}, as solved", self._law_section()),
            section_html("operations", "Operations", self._operations_section()),
            section_html("left-out", "Left out", self._omissions_section()),
            section_html("file", "File", file_listing(self.file, self.places, {joint.name for joint in joints})),
            section_html("code", "Emitted code", [small_html(rates), *self._code_section(listed)]),
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
            f"<title>{escape(title)}: equations</title><style>{_read_web_part('style.css')}</style></head><body>"
        )
        code = f"const rates = {script or 'null'};\n{_read_web_part('script.js')}"
        tail = f'<script type="application/json" id="data">{script_json(data)}</script><script>{code}</script>'
        return "\n".join([head, *body, tail, "</body></html>\n"])

    # -- sections --------------------------------------------------------------------------------------------------

    def _navigation_html(self) -> str:
        names = "motion sketch topology coordinates rows patterns law operations left-out file code".split()
        return "<nav>" + " ".join(f'<a href="#{k}">{k.replace("-", " ")}</a>' for k in names) + "</nav>"

    def _sketch_svg(self) -> str:
        return sketch(self.whole, self.q, self.values)

    def _topology_section(self) -> list[str]:
        lines = [["joint", "kind", "between", "rows"]]
        for joint in self.mechanism.joints:
            between = " and ".join(dict.fromkeys(joint.bodies))
            link = f'<a href="#rows-{attribute_text(joint.name)}">{escape(joint.name)}</a>'
            lines.append([link, escape(joint.kind), escape(between), str(len(self.sheet.rows_of_joint(joint.name)))])
        parts = [folded_html(f"{plural(len(self.mechanism.joints), 'joint')}", html_table(lines), len(lines) <= 13)]
        if self.mechanism.topology is not None:
            tree = [["body", "carried by", "on"]]
            tree += [
                [escape(x.body), escape(x.joint or "nothing: free"), escape(x.parent)]
                for x in self.mechanism.topology.links
            ]
            cut = ", ".join(self.mechanism.topology.cut) or "no joint"
            parts.append(folded_html(f"the tree; loops are closed by {cut}", html_table(tree)))
        return parts

    def _coordinates_section(self) -> list[str]:
        parts = []
        for title, quantities in self.sheet.quantities():
            if quantities:
                numbers = title in ("Parameters", "Inputs")
                lines = [["symbol", "name", "unit", *(["value"] if numbers else [])]]
                for quantity in quantities:
                    letter = formula_html(self.sheet.writer.symbol(quantity.name))
                    number, unit = (
                        as_written(self.mechanism, quantity, self.values) if numbers else (0.0, quantity.unit)
                    )
                    value = [f"{number:.6g}"] if numbers else []
                    lines.append([letter, escape(quantity.name), escape(unit), *value])
                parts.append(folded_html(f"{len(quantities)} {title.lower()}", html_table(lines)))
        return parts

    def _joint_section(self, joint: Joint, code: bool) -> str:
        rows = self.sheet.rows_of_joint(joint.name)
        links = [f'<a href="#joint-{attribute_text(joint.name)}">in the sketch</a>']
        place = self.places.get(f"joints.{joint.name}")
        if place is not None:
            links.append(f'<a href="#file-{place}">in the file, line {place}</a>')
        parts = [f"<p>{' · '.join(links)}</p>"]
        if not rows:
            prescribed = self.sheet.sentences_on_drivers().get(joint.name)
            sentence = "It carries a body in the tree" if prescribed is None else f"It prescribes {prescribed}"
            parts.append(f"<p>{escape(sentence)}: it has no rows.</p>")
        names = f"{escape(joint.kind)} between {escape(' and '.join(dict.fromkeys(joint.bodies)))}"
        return self._rows_html(joint.name, names, parts, code)

    def _section_beside(self, name: str, code: bool) -> str:
        """Return the rows of a stop or a contact of its own section."""
        return self._rows_html(name, "in force while closed", [], code)

    def _rows_html(self, name: str, words: str, parts: list[str], code: bool) -> str:
        rows, g = self.sheet.rows_of_joint(name), self.e.graph
        phi = {line.key: line for line in self.sheet.phi(rows)}
        nu = {line.key: line for line in self.sheet.nu(rows)}
        gamma = {line.key: line for line in self.sheet.gamma(rows)}
        for r in rows:
            unit = f'<span class="small">{escape(r.unit)}</span>'
            parts.append(f'<div id="row-{attribute_text(r.name)}"><h3>row {escape(r.name)} {unit}</h3>')
            held = self._words[r.name]
            parts.append(f"<p>{escape(held.words)}</p>")
            scalar = equation_html(phi[r.name], " = 0") if r.name in phi else "<p>nonholonomic: it has no Phi</p>"
            if self.mechanism.space == "spatial" and held.vectors and r.name in phi:
                parts.append(f'<p class="vectors">{vector_equation(held.vectors)}</p>')
                scalar = folded_html(
                    "Phi in coordinates of bodies" if self.mechanism.topology is None else "Phi", scalar
                )
            parts.append(scalar)
            parts += [equation_html(nu[r.name])] if r.name in nu else []
            parts.append(equation_html(gamma[r.name]))
            parts.append(self._links_to_lines(r.name) if code else "")
            parts.append("</div>")
        parts.append(equations_html(self.sheet.jacobian(name)))
        nodes = [n for r in rows for n in (r.phi, r.nu, r.gamma, *(x for _, x in r.entries)) if n is not None]
        sizes = f"{plural(len(rows), 'row')}, {plural(g.count_operations(nodes), 'operation')}"
        head = f"<b>{escape(name)}</b>: {words}, {sizes}"
        return folded_html(head, "\n".join(parts), self.e.nv <= _SMALL, f"rows-{name}", marked=True)

    def _links_to_lines(self, name: str) -> str:
        links = [
            f'<a class="code" href="#line-{c.line}">{escape(c.what)}: <code>{escape(shorten_code(c.text))}</code></a>'
            for c in self._computed.get(name, ())
        ]
        return f'<p class="small">computed by {" · ".join(links)}</p>' if links else ""

    def _patterns_section(self) -> list[str]:
        e = self.e
        if not e.m:
            return ["<p>There are no rows.</p>"]
        rows, order = [r.name for r in e.rows], self.program.order
        entries = pattern_of_jacobian(e)
        first = pattern_svg(entries, rows, [v.name for v in e.velocities], "pattern of D", links=True)
        again = [rows[i] for i in order]
        second = pattern_svg(pattern_of_factor(e, order), again, again, "pattern of the factor of D G D^T")
        return [
            folded_html(
                f"D: {len(entries)} entries; dark ones vary, light ones are constants of the scene", first, e.m <= 40
            ),
            folded_html(
                f"factor of D G D^T in the order of elimination; {self.program.fill} entries are filled in", second
            ),
        ]

    def _motion_section(self) -> list[str]:
        sheet, is_small = self.sheet, self.e.nv <= _SMALL
        written = _MOTION if self.e.m else _FREE_MOTION
        folds = [
            f'<div class="equation">{formula_html(written)}</div>',
            small_html("Numbers are rounded to six digits."),
        ]
        if self.e.nv <= _WHOLE:
            folds.append(folded_html("M and D as matrices", equations_html(sheet.whole_matrices()), is_small))
        parts = [
            ("rates of the coordinates", equations_html(sheet.rates()) or "q' = v"),
            ("mass matrix M; what is not written is zero or symmetric", equations_html(sheet.mass())),
            ("forces f; those not written are zero", equations_html(sheet.forces()) or "f = 0"),
            (_POWER if self.e.driving else _POWER.partition(";")[0], equations_html(sheet.energies())),
        ]
        folds += [folded_html(title, text, is_small) for title, text in parts]
        shared = sheet.shared_equations(sheet.nodes(("Phi", "D", "nu", "gamma", "N", "M", "f", "energies")))
        for first in range(0, len(shared), _TOGETHER):
            some = shared[first : first + _TOGETHER]
            names = f"{formula_html(some[0].left)} to {formula_html(some[-1].left)}"
            folds.append(folded_html(f"shared terms {names}", equations_html(some)))
        return folds

    def _law_section(self) -> list[str]:
        if not self.e.m:
            alone = (
                "There are no constraint rows, and the accelerations follow from the forces alone, with every method."
            )
            return [f"<p>{alone}</p>", f'<div class="equation">{formula_html(_FREE_MOTION)}</div>']
        lines = [f"<p>{prose_html(self.steps.summary)}</p>"]
        for function, purpose, steps in self.steps.parts:
            lines.append(f"<h3>{escape(function)}: {prose_html(purpose)}</h3>")
            for step in steps:
                note = ' <span class="small">solved</span>' if step.solved else ""
                lines.append(f'<div class="equation">{formula_html(step.box)}{note}</div>')
        return [folded_html("steps", "\n".join(lines), True)]

    def _operations_section(self) -> list[str]:
        g, lines = self.e.graph, [["joint", "Phi", "D", "gamma", "together"]]
        for joint in self.sheet.joints:
            rows = self.sheet.rows_of_joint(joint)
            groups = [
                [r.phi for r in rows if r.phi is not None],
                [n for r in rows for _, n in r.entries],
                [r.gamma for r in rows],
            ]
            counts = [g.count_operations(nodes) for nodes in (*groups, [n for group in groups for n in group])]
            lines.append([f'<a href="#rows-{attribute_text(joint)}">{escape(joint)}</a>', *map(str, counts)])
        blocks = [["function", "what it computes", "operations"]]
        for block in (*self.program.blocks, *self.law.blocks):
            blocks.append([escape(block.name), prose_html(block.purpose), str(block.operations)])
        return [
            folded_html("by joint, each with what it shares within itself", html_table(lines, numbers=4)),
            folded_html("by emitted function", html_table(blocks, numbers=1), True),
        ]

    def _code_section(self, listed: Mapping[str, str] | None) -> list[str]:
        if listed is not None:
            back = {c.line: c for lines in self._computed.values() for c in lines}
            left_out = [] if listed else [small_html("Modules of the method are left out, for the size of this page.")]
            return [*code_listing(self.source, listed, back), *left_out]
        size = len(self.source) + sum(map(len, self.parts.values()))
        return [f"<p>It has {size} characters and is left out, as the page would be larger than {LARGEST} bytes.</p>"]

    def _omissions_section(self) -> list[str]:
        items = [f"<li>{prose_html(o.what)}: {prose_html(o.why)}</li>" for o in self.e.omissions]
        return (
            [folded_html(f"{len(items)} things", f"<ul>{''.join(items)}</ul>", len(items) <= 8)]
            if items
            else ["<p>Nothing.</p>"]
        )


_OFFERED = "Scripts find it at work: window.symgen.rates(t, y, p) returns the rates of a state; y0 is the start's."
_POWER = "energies, and the power of forces without potential; b v' + c is that of drivers without rows"
_SKETCH = "A joint in the picture leads to its rows; these lead to the file and to the lines that compute them."
_FREE_MOTION = row_box(name_box("M"), rate_box(name_box("v")), sign_box("="), name_box("f"))
_MOTION = row_box(
    *(
        name_box("M"),
        rate_box(name_box("v")),
        sign_box("+"),
        transposed_box(name_box("D")),
        name_box("lambda"),
        sign_box("="),
        name_box("f"),
        sign_box(","),
    ),
    *(name_box("D"), rate_box(name_box("v")), sign_box("="), name_box("gamma")),
)
