"""Programs of one mechanism as source text: formulas as straight lines, all else as loops."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from symgen.base.errors import InputError, plural
from symgen.base.ir.interpolation import Interpolation
from symgen.base.ir.program import DERIVATIVES, FORMAT, SLOPES, SUFFIXES, Block, LawProgram, ModelLayout, ModelProgram
from symgen.base.vocabulary.infos import LawInfo
from symgen.derive.emit.carried_lines import carried_lines
from symgen.derive.emit.law_parts import PartsLayout, law_modules
from symgen.derive.emit.module import (
    PLATFORMS,
    ModulePiece,
    capitalise,
    function_source,
    module_source,
    render_template,
    templates_digest,
)
from symgen.derive.emit.printer import (
    ElementAccess,
    Names,
    Printer,
    formulas_of_hoisted,
    names_in_model,
    names_of_observed,
    table_name,
)
from symgen.derive.emit.whole import Places, name_in_model
from symgen.derive.formulate.equations import Equations

if TYPE_CHECKING:
    from symgen.derive.lower.carrying import CarriedSums
    from symgen.derive.lower.side_program import SideProgram

#: Most numbers of tables in the 64 KiB of a CUDA device's constant memory, with room left for others.
MOST_CONSTANTS = 8000
#: Longest array that is not written as one text.
_MANY_NUMBERS = 4096


def emit_model(
    program: ModelProgram,
    equations: Equations,
    target: str = "cpu",
    whole: bool = False,
    called: Collection[str] | None = None,
) -> str:
    """Return the source of the module that all methods of a model share, for a target of `TARGETS`.

    Parameters
    ----------
    program, equations, target
        Program, equations and target.
    whole : bool
        Whether the source is for readers, with names of the places in arrays.
    called : collection of str, optional
        Functions that methods call; others are left out then.

    Raises
    ------
    InputError
        If tables are too long for the constant memory of CUDA devices.
    """
    layout = program.layout
    numbers = sum(table.numbers for table in program.tables)
    if target == "cuda" and numbers > MOST_CONSTANTS:
        room = f"at most {MOST_CONSTANTS // 2} points in all (target cuda)"
        raise InputError("tables", room, f"what takes the room of {numbers // 2}")
    header = [
        version_line(program.digest),
        f"{layout.nq} coordinates, {layout.nv} velocities, {layout.m} constraint rows, {layout.parameters} parameters,",
        _line_on_elimination(program),
        "",
        "Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.",
        "",
        *_symbol_lines(equations, {"`prepare`": (layout.parameters, layout.parameters + program.hoisted)}),
        "",
        *Places(layout.sections).header,
        "",
        "Left out:",
        *(f"- {omission.what}: {omission.why}" for omission in equations.omissions),
        *(f"- repeated row: {row}" for row in equations.dropped_rows),
    ]
    codes = [
        *table_codes(program.tables, target),
        *straight_functions(program.blocks, layout, equations, target, names_in_model(equations, program.jacobian)),
    ]
    platform = PLATFORMS[target]
    title = f"Model `{program.name}`: what every method of it shares{platform.words}."
    if called is not None:
        codes = _called_pieces(codes, called)
    if whole:
        return Places(layout.sections).module(title, header, [codes], {}, numba=platform.numba)
    return module_source(title, header, codes, {}, {}, platform.numba)


def _called_pieces(codes: Sequence[ModulePiece], called: Collection[str]) -> list[ModulePiece]:
    """Return the pieces that define what is called, and what these call."""
    wanted, count = set(called), -1
    while count != len(wanted):
        count = len(wanted)
        wanted |= {name for code in codes if wanted & {*code.names} for name in code.calls}
    return [code for code in codes if wanted & {*code.names}]


def _line_on_elimination(program: ModelProgram) -> str:
    """Return the line on the elimination of rows."""
    closed = f"; {plural(len(program.plan.loops), 'loop')} in closed form" if program.plan.loops else ""
    if not program.plan.fixed:
        return f"{program.fill} fill-ins in the factor of D D^T{closed}"
    divisions = sum(len(each.rows) > 1 for each in program.plan.fixed)
    how = "without a division" if not divisions else f"with {plural(divisions, 'division')}"
    rows = f"{len(program.plan.rows)} of {program.layout.m} rows"
    return f"{rows} eliminated {how}, together with velocities that they fix{closed}"


def emit_law(
    program: LawProgram,
    model: ModelProgram,
    equations: Equations,
    summary: str,
    reference: str,
    target: str = "cpu",
    whole: bool = False,
) -> dict[str, str]:
    """Return the source of the modules that one method adds to the shared one, for a target of `TARGETS`.

    The last one is the method's own, see `law_modules`; a `whole` one is for people, and complete but for the model.
    """
    blocks, info, platform = program.blocks, program.info, PLATFORMS[target]
    own = {name: info.parameter_offset + i for i, (name, _) in enumerate(info.parameters)}
    names = names_in_model(equations, model.jacobian) | {("p", at): name for name, at in own.items()}
    printed = straight_functions(blocks, program.layout, equations, target, names)
    layout = LiteralLayout(program, "y" if equations.spins else "", platform.decorator)
    model_stem, sections = f"model{SUFFIXES[target]}", program.layout.sections
    defined = *(block.name for block in model.blocks), *table_names(model.tables)
    places, header = Places(sections, own), law_header(info, summary, reference, version_line(model.digest))
    if whole:
        header += [*_header_for_readers(program, model, equations), "", *places.header]
    return law_modules(
        program,
        layout,
        list(zip((b.role for b in blocks), printed, strict=True)),
        any(b.flag is not None for b in blocks),
        f"for model `{model.name}`{platform.words}",
        version_line(model.digest),
        {name: (model_stem, name) for name in defined} | {name_in_model("geometry"): (model_stem, "geometry")},
        f"Method `{info.method}` for model `{model.name}`{platform.words}.",
        header,
        info.key,
        offsets={name: (first, "sections of w") for name, (first, _) in sections.items()},
        numba=platform.numba,
        suffix=SUFFIXES[target],
        places=places if whole else None,
    )


#: Notation and use of the functions of a law, for headers of readable modules.
_USE = """
Constraints Phi(q, t) = 0, their rates D v = nu and D v' = gamma; M v' = f - D^T lambda; S = D M^-1 D^T.

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and counters iw. Once: `prepare` of the
model, `prepare`, and `accept` with the start. Then `rhs` gives the rate of a state, `confirm` where `rhs` returns 1,
and `accept` corrects and measures the state at the end of each step.
"""
_IMPLICIT = "Implicit integrators solve `residual` = 0 for k = (q', v', multipliers); `tangent` is its derivatives.\n"


def _header_for_readers(program: LawProgram, model: ModelProgram, equations: Equations) -> list[str]:
    """Return the header of a law for readers: notation, use, and the meaning of elements of y and p."""
    info, first = program.info, model.layout.parameters
    own, behind = first + model.hoisted, info.parameter_offset + len(info.parameters)
    computed = {"the model's `prepare`": (first, own), "`prepare`": (own, info.parameter_offset)}
    computed["`prepare` too"] = behind, behind + info.hoisted
    return [*(_USE + _IMPLICIT * bool(info.level)).split("\n"), *_symbol_lines(equations, computed)]


def version_line(digest: str) -> str:
    """Return the line on the versions that a module was made with."""
    return f"digest {digest}, format {FORMAT}, templates {templates_digest()}"


def law_header(info: LawInfo, summary: str, reference: str, source: str, place: str = "p[{}]") -> list[str]:
    """Return the lines of a law's docstring; `source` names the origin, `place` locates the method's parameters."""
    parameters = enumerate(info.parameters, info.parameter_offset)
    return [
        *(f"{capitalise(summary)}.", *reference.split("; "), source),
        *(f"option {option} = {value}" for option, value in sorted(info.options.items())),
        *(f"{place.format(i)} {name} (default {default})" for i, (name, default) in parameters),
    ]


class LiteralLayout(PartsLayout):
    """Sizes and places as numbers of one mechanism; sections are constants of the module."""

    def __init__(self, program: LawProgram, turning: str, decorator: str = PLATFORMS["cpu"].decorator) -> None:
        self.program, self.turning, self.decorator = program, turning, decorator
        self.parameters = [name for name, _ in program.info.parameters]
        self.sections: set[str] = set()

    def size(self, name: str) -> int:
        """Return a size."""
        return self.program.degrees if name == "degrees" else int(getattr(self.program.layout, name))

    def constant_of_section(self, name: str) -> str:
        """Return the constant of the beginning of a section."""
        self.sections.add(name)
        return name.upper()

    def element(self, index: int) -> str:
        """Return an element of p."""
        return f"p[{index}]"

    def own_parameter(self, place: int) -> str:
        """Return the method's parameter at a place as an element of p."""
        return self.element(self.program.info.parameter_offset + place)

    def own_lines_and_sections(self) -> tuple[list[str], set[str], set[str]]:
        """Return no lines before a function's own, and the sections in use."""
        sections, self.sections = self.sections, set()
        return [], set(), sections


def table_names(tables: Sequence[Interpolation], slopes: bool = True) -> list[str]:
    """Return the names of functions of tables; piecewise linear tables have a slope where it is used."""
    return [table_name(t.name, what) for t in tables for what in DERIVATIVES[: None if t.pieces else 1 + slopes]]


def table_codes(tables: Sequence[Interpolation], target: str = "cpu", slopes: bool = True) -> list[ModulePiece]:
    """Return arrays of tables with the functions that interpolate, and their slopes; see `table_names`."""
    codes = []
    for curve in tables:
        x, y = (curve.starts, sum(curve.pieces, ())) if curve.pieces else (curve.x, curve.y)
        table: dict[str, Any] = {"name": curve.name, "abscissae": list(x), "ordinates": list(y)}
        table |= {"points": array_text(x), "numbers": array_text(y)}
        table |= {what: table_name(curve.name, what) for what in ("value", "slope", "x", "y")}
        values: dict[str, Any] = {"table": table, "cuda": target == "cuda", "decorator": PLATFORMS[target].decorator}
        if curve.pieces:
            table |= {what: table_name(curve.name, what) for what in DERIVATIVES[2:]} | {"period": curve.period}
            text = render_template("curves/pieces.j2", values).strip("\n")
        else:
            text = render_template("parts/table.j2", values | {"slope": slopes}).strip("\n")
        also = tuple(table_name(curve.name, what) for what in (*DERIVATIVES[1:], "x", "y"))
        libraries = frozenset(("numpy", "math") if curve.period else ("numpy",))
        codes.append(ModulePiece(table["value"], text, libraries=libraries, also=also))
    return codes


def array_text(values: Sequence[float]) -> str:
    """Return the array of some numbers as Python; very many as one text, since Python takes a kilobyte to read each."""
    if len(values) <= _MANY_NUMBERS:
        return f"np.array({list(values)})"
    return f'np.array("{" ".join(map(repr, values))}".split(), dtype=float)'


def straight_functions(
    blocks: Sequence[Block],
    layout: ModelLayout,
    equations: Equations | SideProgram,
    target: str = "cpu",
    further: Names | None = None,
    carried: CarriedSums | None = None,
) -> list[ModulePiece]:
    """Return blocks as straight-line functions; `further` names are added to the names of q, v and p of `equations`.

    The first function begins with what it reads of `carried` sums.
    """
    names = {("q", i): f"{q.name} [{q.unit}]" for i, q in enumerate(equations.coordinates)}
    names |= {("v", i): f"{v.name} [{v.unit}]" for i, v in enumerate(equations.velocities)}
    names |= {("p", i): f"{p.name} [{p.unit}]" for i, p in enumerate(equations.parameters)}
    names = (further or {}) | names
    names |= formulas_of_hoisted(blocks, ElementAccess(layout, names))
    observed: Names = {}
    if isinstance(equations, Equations):
        observed = names_of_observed(equations)
        names |= {("z", i): f"{x.name} [{x.unit}]" for i, x in enumerate(equations.states, 1)}
    codes = []
    for block in blocks:
        access = ElementAccess(layout, names | observed if block.name == "observe" else names)
        lines, body, called = Printer(block, access).lines(), list[str](), frozenset[str]()
        if carried is not None and block is blocks[0]:
            body, called = carried_lines(carried, layout, names)
        for title, part in (("inputs", lines.inputs), ("intermediate terms", lines.terms), ("outputs", lines.outputs)):
            body += [f"# {title}", *part] if part else []
        body.append(f"return int({lines.flag})" if lines.flag else "return 0")
        purpose = f"{block.purpose}: {plural(block.operations, 'operation')}."
        arguments = ", ".join(block.arguments)
        codes.append(
            function_source(
                block.name, arguments, purpose, body, PLATFORMS[target].decorator, calls=lines.functions | called
            )
        )
    return codes


def _symbol_lines(equations: Equations, computed: Mapping[str, tuple[int, int]]) -> list[str]:
    """Return a line with element, name and unit for each index, and one on numbers kept in p."""
    nq = equations.nq
    table = [(f"y[{i}]", q.name, q.unit) for i, q in enumerate(equations.coordinates)]
    table += [(f"y[{nq + i}]", v.name, v.unit) for i, v in enumerate(equations.velocities)]
    table.append((f"y[{nq + equations.nv}]", "work of forces without potential and of drivers", "J"))
    table += [(f"y[{nq + equations.nv + i}]", x.name, x.unit) for i, x in enumerate(equations.states, 1)]
    table += [(f"p[{i}]", p.name, p.unit) for i, p in enumerate(equations.parameters)]
    table += [(f"p[{i}:{j}]", f"numbers computed by {function}", "") for function, (i, j) in computed.items() if i < j]
    table += [(f"row {i}", r.name, r.unit) for i, r in enumerate(equations.rows)]
    return [f"{element:<8} {name}{f' [{unit}]' if unit else ''}" for element, name, unit in table]


def emit_side(program: SideProgram) -> str:
    """Return the source of a module with one function, straight code for either shape of the model."""
    codes, header = _print_functions(program, "out[{}]")
    return module_source(f"{program.blocks[0].purpose}, for model `{program.mechanism}`.", header, codes, {}, {})


def _print_functions(program: SideProgram, place: str, first: int = 0) -> tuple[list[ModulePiece], list[str]]:
    """Return the functions, and lines with the meaning of each place, from the `first` on."""
    codes = [
        *table_codes(program.tables),
        *straight_functions(program.blocks, program.layout, program, carried=program.carried),
    ]
    formulas = [f"{place.format(i)} {formula}" for i, formula in enumerate(program.formulas, first)]
    return codes, [f"format {FORMAT}, templates {templates_digest()}", "", *formulas]


#: Functions that a law with integrals replaces: arguments, and the call after the law's own.
_FOLLOWED = {
    **dict.fromkeys(
        (name + end for name in ("rhs", "confirm") for end in ("", SLOPES)),
        ("t, y, p, w, iw, ydot", "integrands(t, y, p, w, ydot)"),
    ),
    "residual": ("t, y, k, p, w, r", "accumulate(t, y, k, p, w)"),
}


def emit_integrals(program: SideProgram, law: Mapping[str, str], power: int) -> str:
    """Return the source of a law's module whose right-hand side has rates of integrals after the rate of the work.

    Parameters
    ----------
    program : SideProgram
        From `symgen.derive.lower.side_program.lower_integrands`.
    law : mapping of str to str
        Functions of the law, each with the stem of the module in the same folder that it is imported from.
    power : int
        Index in ``w`` where a residual leaves the rate of the work.
    """
    codes, header = _print_functions(program, "z[{}]' =", 1)
    exports = [name for name in law if name not in _FOLLOWED]
    origins = {name: (law[name], name) for name in exports}
    for name, (arguments, more) in _FOLLOWED.items():
        if name not in law:
            continue
        origins[f"law_{name}"] = (law[name], name)
        body = [f"flag = law_{name}({arguments})", more, "return flag"]
        if name == "residual":
            body.insert(1, f"w[{program.layout.offset('auxiliary')}] = w[{power}]")
        calls = f"law_{name}", more.partition("(")[0]
        codes.append(function_source(name, arguments, "As the law's, with integrals.", body, calls=calls))
    return module_source(
        f"A law of model `{program.mechanism}`, with integrals.", header, codes, origins, {}, exports=exports
    )
