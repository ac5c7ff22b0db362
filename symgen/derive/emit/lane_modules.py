"""Emission for several runs at once: blocks in loops over lanes, which become vector instructions."""

from __future__ import annotations

import math
from collections.abc import Container
from dataclasses import replace

from symgen.base.errors import InputError
from symgen.base.ir.program import LANE_COUNTERS, LANES, STATUS, SUFFIXES, Block, Correction, LawProgram, ModelProgram
from symgen.base.ir.program import lane_bases as bases_of
from symgen.derive.emit.emit import LiteralLayout, law_header, table_codes, table_names, version_line
from symgen.derive.emit.law_parts import Parts, PartsLayout, kind_of_acceptance
from symgen.derive.emit.module import ModulePiece, function_source, module_source
from symgen.derive.emit.printer import LaneAccess, Printer
from symgen.derive.formulate.equations import Equations

#: Arguments of sines are watched where they may be larger [rad]: the reduction in `templates/parts/sine.j2` would
#: lose digits, and from 1e15 on it is of another angle.
FAR = 4e5
#: Angles of coordinates up to this need no watch: a run that turns farther is left to single runs.
TURNED = 1e5
_BLOCKS = ("normalise", "move", "geometry_of_model", "geometry", "refactor", "spread", "drift", "measure", "rhs")
#: Text on the one array, for a law's docstring.
_ABOUT = """
All that a run has stands in one array z, since the compiler would otherwise have to make sure of too many pairs of
arrays that they do not overlap: element i of a lane is z[{lanes}*i + lane], with y from i = 0 on, y' from {ydot}, p
from {p}, w from {w}, and counters of the lanes from {spare}. How many lanes there are is computed, since a loop of
known length would be unrolled before it could become vector instructions."""


class LaneLayout(LiteralLayout):
    """Places of lane ``lane`` in the one array of all lanes, as numbers."""

    def __init__(self, program: LawProgram, turning: str, access: LaneAccess) -> None:
        super().__init__(program, turning)
        self.access = access

    def constant_of_section(self, name: str) -> str:
        """Return the beginning of a section, or of a number of the status, of the first lane."""
        layout, first = self.program.layout, self.access.bases["w"]
        if name == "velocities":
            return str(layout.nq * self.access.lanes)
        place = layout.offset("status") + STATUS.index(name) if name in STATUS else layout.offset(name)
        return str((first + place) * self.access.lanes)

    def element(self, index: int) -> str:
        """Return an element of p."""
        return self.access.element("p", index)


class Inlined(PartsLayout):
    """Inlined functions that are the same for all mechanisms."""

    decorator = PartsLayout.decorator.replace(")", ', inline="always")')


def emit_lanes_model(program: ModelProgram) -> str:
    """Return the source of the module that all methods of a model share: inlined sines, and tables."""
    parts = Parts(Inlined(), Correction())
    parts.print_template("sine")
    title = f"Model `{program.name}` in lanes, for {LANES} runs at once: functions that are no calls."
    codes = [*parts.codes, *table_codes(program.tables, slopes=False)]
    return module_source(title, [version_line(program.digest)], codes, {}, {})


def emit_lanes_law(program: LawProgram, model: ModelProgram, equations: Equations, summary: str, reference: str) -> str:
    """Return the source of the module of one method.

    Raises
    ------
    InputError
        If the method is more than a formula with one correction.
    """
    layout, correction, info, made = program.layout, program.correction, program.info, version_line(model.digest)
    simple = correction.metric in ("identity", "scaled", "mass") and not correction.energy
    if program.form != "direct" or program.closed or not simple:
        expected = "a method that is a formula with at most one correction (target lanes)"
        got = "one that iterates, chooses coordinates, or scales velocities to the energy"
        raise InputError(f"method '{info.method}'", expected, got)
    n_p = info.parameter_offset + len(info.parameters) + info.hoisted
    bases = bases_of(layout.ny, n_p, layout.nw)
    access = LaneAccess(layout, {}, bases, LANES)
    blocks = {b.name: b for b in (*model.blocks, *program.blocks)}  # a law's own take the place of the model's
    if "refactor" in blocks:
        blocks["geometry_of_model"] = replace(blocks.pop("geometry"), name="geometry_of_model")
    names = [name for name in _BLOCKS if name in blocks and (correction.any or name not in ("move", "spread"))]
    parts = Parts(LaneLayout(program, "t, z, lanes" if equations.spins else "", access), correction)
    if "refactor" in blocks:
        parts.print_template("lanes_metric")
    parts.print_template(f"lanes_{kind_of_acceptance(correction)}")
    turning = frozenset(i for i, q in enumerate(equations.coordinates) if q.unit != "m")
    codes = [*(_loop_over_lanes(blocks[name], access, turning) for name in names), *parts.codes]
    constants = {name: (bases["spare"] + i) * LANES for i, name in enumerate(LANE_COUNTERS)}
    title = f"Method `{info.method}` for model `{model.name}` in lanes, for {LANES} runs at once."
    header = [*law_header(info, summary, reference, made), *_ABOUT.format(lanes=LANES, **bases).split("\n")]
    shared = ("sine", "cosine", *table_names(model.tables, slopes=False))
    imported = {name: (f"model{SUFFIXES['lanes']}", name) for name in shared}
    offsets = {name: (at, "places in z") for name, at in {"numbers": bases["numbers"], **constants}.items()}
    return module_source(title, header, codes, imported, offsets)


def _loop_over_lanes(block: Block, access: LaneAccess, turning: Container[int]) -> ModulePiece:
    """Return a block as a loop over lanes."""
    printer, alone = Printer(block, access), block.name == "rhs"
    lines = printer.lines()
    bad = [lines.flag] if lines.flag and alone else []
    bad += [f"(abs({printer.text[node][0]}) > {FAR})" for node in _arguments_to_watch(block, turning)]
    any_bad = bad[0] if len(bad) == 1 else f"({' | '.join(bad)})"
    counted = [f"z[SUSPECTS + lane] += 1.0*{any_bad}"] if bad else []
    loop = [f"    {line}" for line in (*lines.inputs, *lines.terms, *lines.outputs, *counted)]
    # a factorisation of parameters alone leaves no loop
    over = ["for lane in range(lanes):", *loop] if loop else []
    body = [*(["lanes = len(z) // NUMBERS"] if alone else []), *over, "return 0"]
    purpose = f"{block.purpose}: {block.operations} operations a lane."
    sections = [*(["numbers"] if alone else []), *(["suspects"] if counted else [])]
    arguments = "t, z" if alone else "t, z, lanes"
    return function_source(block.name, arguments, purpose, body, calls=lines.functions, sections=sections)


def _arguments_to_watch(block: Block, turning: Container[int]) -> list[int]:
    """Return the arguments of sines and cosines of a block that may be large: more than a few angles together.

    A frequency times the time, or times an angle, has no bound in advance.
    """
    bounds = dict[int, float]()
    for node in block.needed:
        op, args, payload = block.graph.nodes[node]
        of = [bounds[a] for a in args]
        if (value := block.graph.value(node)) is not None:
            bounds[node] = abs(value)
        elif op == "input":
            assert isinstance(payload, tuple), "an input's payload is its key"
            space, index = payload
            bounds[node] = TURNED if space == "q" and index in turning else math.inf
        elif op in ("add", "sub"):
            bounds[node] = sum(of)
        elif op == "mul":
            bounds[node] = of[0] * of[1] if 0.0 not in of else 0.0
        elif op in ("sin", "cos", "sign"):
            bounds[node] = 1.0
        else:
            bounds[node] = of[0] if op in ("neg", "abs") else math.inf
    operations = (block.graph.nodes[node] for node in block.needed)
    return list(dict.fromkeys(n.args[0] for n in operations if n.op in ("sin", "cos") and bounds[n.args[0]] > FAR))
