"""The looped shape as source text: generic code, and laws that are the same for all mechanisms."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.ir.graph import Graph
from symgen.base.ir.numerics import NUMBERS, SKIP, SUSPICIOUS
from symgen.base.ir.program import FORMAT, MODES, STATUS, Block, OutputSlot
from symgen.derive.emit.emit import law_header
from symgen.derive.emit.law_parts import PartsLayout, law_modules
from symgen.derive.emit.module import ModulePiece, function_source, render_template
from symgen.derive.emit.printer import Access, Printer
from symgen.derive.emit.whole import Places
from symgen.derive.lower.looped import statements as data
from symgen.derive.lower.looped.layout import BESIDE, GENERIC, HEAD, PRESSED, ROTORS, TOUCHED
from symgen.derive.lower.looped.looped_law import LoopedLaw
from symgen.derive.lower.recorded_law import ARGUMENTS

_STATUS = {name: i for i, name in enumerate(STATUS)}
#: Treatment of pivots by a factorisation; see ``templates/looped/factorisation.j2``.
_MODES = ("RANK_FACTOR", "MASKED_FACTOR", "KEPT_FACTOR", "PLAIN_FACTOR")


def emit_machine(generator: str) -> str:
    """Return the source of the generic code."""
    values = {"head": HEAD, "suspicious": SUSPICIOUS, "skip": SKIP, "status": _STATUS}
    values |= {"generic": _GENERIC, "codes": GENERIC}
    return render_template("looped/machine.py.j2", {"format": FORMAT, "generator": generator, **values})


def emit_rotors(generator: str) -> str:
    """Return the source of the generic code for mechanisms with rotors on joints."""
    values = {"format": FORMAT, "generator": generator, "rotors": ROTORS, "status": _STATUS}
    return render_template("looped/rotors.py.j2", values)


#: Calls of generic code: name, arguments after T, p and w, the code with its arguments, and its purpose.
_GENERIC = (
    ("rows_times", "x, result", ("rows_times", "x", "result", "0", "0.0"), "Section `result` = D times `x`."),
    ("columns_times", "x, result", ("columns_times", "x", "result", "0", "0.0"), "`result` = D^T times `x`."),
    ("mass_times", "x, result", ("blocks_times", "0", "x", "result", "0.0"), "`result` = M times `x`."),
    ("inverse_mass_times", "x, result", ("blocks_times", "1", "x", "result", "0.0"), "`result` = M^-1 `x`."),
    ("weigh", "", ("weigh", "0", "0", "0", "0.0"), "Section `left` = D M^-1."),
    ("gauge", "", ("gauge", "0", "0", "0", "0.0"), "Section `left` = D G."),
    ("gram", "weight, result", ("gram", "weight", "result", "0", "0.0"), "`result` = D W D^T."),
    ("augment", "penalties, result", ("augment", "penalties", "result", "0", "0.0"), "`result` = M + D^T a D."),
    ("factorise", "table, lower, mode", ("factorise", "table", "lower", "mode", "0.0"), "L D L^T in place."),
    ("solve", "table, lower, x", ("solve", "table", "lower", "x", "0.0"), "Solve in place in section `x`."),
    (
        "factorise_forward",
        "table, lower, mode, x",
        ("factorise", "table", "lower", "mode", "float(x)"),
        "L D L^T in place, and the first half of `solve` for section `x`.",
    ),
    (
        "solve_rest",
        "table, lower, x",
        ("solve", "table", "lower", "x", "1.0"),
        "The second half of `solve` in section `x`.",
    ),
)


#: Functions at given efforts that depend on reactions: the right-hand side, and what is left of the forces.
PUSHED = {"rhs": "rhs_pushed", "balance": "balance_pushed"}
_PURPOSES = {
    "rhs": "Rates of the state with efforts that depend on reactions; 1 where a pivot of S is suspicious.",
    "balance": "What accelerations and multipliers leave of the forces, with efforts that depend on reactions.",
}

#: Names that the modules ``machine`` and ``model`` define.
_MACHINE = (*(name for name, *_ in _GENERIC), "run", "tables", *_MODES)
_SHARED = ("geometry", "spread", "drift", "measure", "observe", "move", "turn", "normalise")


def emit_shared_model(generator: str) -> str:
    """Return the source of the functions that all methods share."""
    return render_template("looped/model.py.j2", {"format": FORMAT, "generator": generator, "status": _STATUS})


def function_with_reactions(name: str, drags: str) -> ModulePiece:
    """Return a function around one at given efforts that depend on reactions, see `emit_looped_law`."""
    arguments = ", ".join(ARGUMENTS[name])
    pushed = {"pushed": f"{PUSHED[name]}({arguments})", "sought": name == "rhs"}
    signed = {PRESSED: "none", TOUCHED: "all"}.get(drags, "each")
    places = {"effort": MODES.index("effort"), **{name: i for i, name in enumerate(BESIDE)}}
    body = (
        render_template("looped/pressed.j2", {"drag": places, "number": NUMBERS, "signed": signed, **pushed})
        .strip("\n")
        .split("\n")
    )
    calls = {"GRAM_FACTOR", PUSHED[name], "run", "tables", "numpy", "math"}
    return function_source(name, arguments, _PURPOSES[name], body, calls=calls)


def emit_looped_law(
    law: LoopedLaw, generator: str, summary: str, reference: str, whole: bool = False, drags: str = ""
) -> dict[str, str]:
    """Return the source of the modules of a law; the last one is its own, as for `symgen.derive.emit.emit.emit_law`.

    `drags`: for mechanisms with efforts that depend on reactions, `PRESSED`, on forces of gaps, `TOUCHED`, or `BOTH`.
    """
    info = law.info
    layout = TableLayout([name for name, _ in info.parameters])
    names = PUSHED if drags else {}
    printed = [(f.part.role, print_function(f, names.get(f.part.name, f.part.name))) for f in law.functions]
    if drags:
        around = ((f.part.role, f.part.name) for f in law.functions if f.part.name in PUSHED)
        printed += [(role, function_with_reactions(name, drags)) for role, name in around]
    nothing = function_source("prepare", "p", "Nothing depends on parameters of the method alone.", ["return 0"])
    versions = f"format {FORMAT}, generator {generator}"
    origins = {name: ("machine", name) for name in (*map(str.upper, HEAD), *_MACHINE)}
    places = {name: len(HEAD) + i for i, (name, _) in enumerate(info.sections)}
    return law_modules(
        law,
        layout,
        [*printed, ("preparation", nothing)],
        any(f.flagged for f in law.functions),
        "for any mechanism, in the looped shape",
        versions,
        origins | {name: ("model", name) for name in _SHARED} | {"geometry_of_model": ("model", "geometry")},
        f"Method `{info.method}`, for any mechanism, in the looped shape.",
        law_header(info, summary, reference, versions, "parameter {}:"),
        f"law_{info.key}{drags}",
        offsets={name: (at, "places in w and T") for name, at in {**_STATUS, **places}.items()},
        places=Places() if whole else None,
    )


class _Size(str):
    """The name of a size; sizes can be added."""

    def __add__(self, other: str) -> _Size:
        return _Size(f"{self} + {other}")


class TableLayout(PartsLayout):
    """Sizes, and places where sections and scratch vectors begin, read from the head of the tables into locals."""

    turning = "y, w"

    def __init__(self, parameters: Sequence[str] = ()) -> None:
        self.parameters, self.names = parameters, set[str]()

    def size(self, name: str) -> _Size:
        """Return the local that holds a size."""
        return _Size(self.constant_of_section(name))

    def constant_of_section(self, name: str) -> str:
        """Return the name of a size, or of the beginning of a section, and note the latter."""
        if name.islower() and name not in ("t", "y", "p", "w", "ydot"):
            self.names.add(name)
        return name

    def own_parameter(self, place: int) -> str:
        """Return the method's parameter at a place."""
        return f"p[{self.constant_of_section('method_parameters')} + {place}]"

    def own_lines_and_sections(self) -> tuple[list[str], set[str], set[str]]:
        """Return the lines that read the noted names, their calls, and the law's own sections among the names."""
        return self.read() if self.names else ([], set(), set())

    def read(self) -> tuple[list[str], set[str], set[str]]:
        """Return the same, and read the tables in any case."""
        scratch = sorted((n for n in self.names if n[0] == "x" and n[1:].isdigit()), key=lambda name: int(name[1:]))
        named = sorted(self.names.difference(scratch), key=lambda n: (HEAD.index(n) if n in HEAD else len(HEAD), n))
        lines = [f"{name} = np.int64(T[{name.upper()}])" for name in named]
        own = {name for name in named if name not in HEAD}
        calls = {"tables", *(name.upper() for name in named if name not in own), *(("numpy",) if self.names else ())}
        if scratch:
            lines.append("vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])")
            lines += [f"{name} = vectors + {name[1:]} * vector_size" for name in scratch]
            calls |= {"VECTORS", "VECTOR_SIZE"}
        self.names.clear()
        return ["T = tables(w)", *lines], calls, own


def print_function(f: data.LoopedFunction, called_as: str) -> ModulePiece:
    """Print statements as a function of some name: loops over elements j, sums, numbers and calls."""
    access, lines = LoopAccess(), list[str]()
    called: set[str] = set()
    for statement in f.statements:
        if isinstance(statement, data.KernelCall):
            result = f"{statement.result} = " if statement.result else ""
            lines.append(f"{result}{statement.function}({', '.join(statement.arguments)})")
            called |= {statement.function, *(n for n in statement.arguments if n.isupper() and n != "T")}
            for name in statement.arguments:
                access.layout.constant_of_section(name)
        else:
            lines += _print_assignments(f.graph, statement, access)
    flagged = f.flagged and f.part.flag is not None
    lines.append("return int(suspicious)" if flagged else "return 0")
    before, names, own = access.layout.read()
    called |= names | access.functions
    purpose = f.part.purpose + ("; 1 where a pivot of S is suspicious." if flagged else ".")
    sections = own | access.status
    arguments = ", ".join(ARGUMENTS[f.part.name])
    return function_source(called_as, arguments, purpose, [*before, *lines], calls=called, sections=sections)


def _print_assignments(graph: Graph, statement: data.Assignment, access: LoopAccess) -> list[str]:
    """Print values that are assigned or added up, in a loop where they are general elements."""
    outputs = tuple((OutputSlot(space, index), node) for space, index, node in statement.outputs)
    body = Printer(Block("", "", graph, outputs, ()), access).lines()
    lines = [*body.terms, *body.outputs]
    access.functions |= body.functions
    if statement.size:
        lines = [
            f"for j in range({access.layout.constant_of_section(statement.size)}):",
            *(f"    {line}" for line in lines),
        ]
    if statement.driven:
        access.functions.add("DRIVEN")
        lines = ["if T[DRIVEN] != 0:", *(f"    {line}" for line in lines)]
    return [*(f"{access.write(target)} = 0.0" for target, _ in outputs if target.space == data.SUM), *lines]


class LoopAccess(Access):
    """The general element of a section, and numbers, as text; notes the names in use."""

    def __init__(self) -> None:
        self.layout = TableLayout()
        self.status: set[str] = set()
        self.functions: set[str] = set()  # called functions

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input: the expression twice, as it is written at its use."""
        text = self.write(OutputSlot(space, index))
        return text, text

    def sign_of_output(self, target: OutputSlot) -> str:
        """Return the sign between an output and its value."""
        return "+=" if target.space == data.SUM else "="

    def write(self, target: OutputSlot) -> str:
        """Return an element or a number."""
        space, index = target.space, target.index
        if space in (data.LOCAL, data.SUM):
            return f"a{index}"
        if space == data.PARAMETER:
            return self.layout.own_parameter(index)
        if space == data.STATE:
            self.status.add(STATUS[index])
            return f"w[{STATUS[index].upper()}]"
        if space == data.WORK:
            return f"ydot[{self.layout.constant_of_section('nq')} + {self.layout.constant_of_section('nv')}]"
        if space in (data.VELOCITIES, data.RATES):
            return f"{'y' if space == data.VELOCITIES else 'ydot'}[{self.layout.constant_of_section('nq')} + j]"
        return f"w[{self.layout.constant_of_section(space)} + j]"
