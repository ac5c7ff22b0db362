"""Functions with loops, printed from the templates that all shapes and targets share."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Collection, Sequence
from types import SimpleNamespace
from typing import Any

from symgen.base.ir.graph import CARRIED
from symgen.base.ir.numerics import NUMBERS
from symgen.base.ir.program import (
    BY_PIVOTS,
    BY_RESIDUAL,
    COUNTERS,
    FREE_RHS,
    HELD_RHS,
    MODE_NUMBERS,
    SLOPES,
    STATUS,
    Correction,
    LawCode,
)
from symgen.derive.emit.module import (
    PLATFORMS,
    ModulePiece,
    Origins,
    function_source,
    module_source,
    python_number,
    render_template,
)
from symgen.derive.emit.whole import Places


class PartsLayout:
    """Text of sizes, sections and parameters in functions with loops, for a shape or target; the default has none.

    Attributes
    ----------
    turning : str
        Arguments of ``normalise``, empty in the plane.
    decorator : str
        Line before each function.
    parameters : sequence of str
        Parameters of the method.
    """

    turning: str = ""
    decorator: str = PLATFORMS["cpu"].decorator
    parameters: Sequence[str] = ()

    def size(self, name: str) -> Any:
        """Return ``nq``, ``nv``, ``m`` or ``degrees``: a number, or text that can be added."""
        raise KeyError(name)

    def constant_of_section(self, name: str) -> str:
        """Return the beginning of a section of ``w``."""
        raise KeyError(name)

    def own_parameter(self, place: int) -> str:
        """Return the method's parameter at a place."""
        raise KeyError(place)

    def parameter(self, name: str) -> str:
        """Return a parameter of the method, or the default."""
        if name in self.parameters:
            return self.own_parameter(self.parameters.index(name))
        return python_number(0.0 if name == "penalty" else NUMBERS["tolerance"])

    def own_lines_and_sections(self) -> tuple[list[str], set[str], set[str]]:
        """Return lines before a function's own, and the names and sections used since the last function."""
        return [], set(), set()


class _Names:
    """Names in a template whose text depends on the layout: ``at.change``, ``size.nq``."""

    def __init__(self, text: Callable[[str], Any]) -> None:
        self._text = text

    def __getattr__(self, name: str) -> Any:
        return self._text(name)


class Parts:
    """Prints templates of ``templates/parts``; each of their functions lists its calls."""

    def __init__(self, layout: PartsLayout, correction: Correction) -> None:
        self.layout, self.end = layout, ""  # the end of names of functions
        self.pieces: list[tuple[str, ModulePiece]] = []
        self.values: dict[str, Any] = {
            "function": self._note_function,
            "size": _Names(layout.size),
            "at": _Names(layout.constant_of_section),
            "parameter": _Names(layout.parameter),
            "status": SimpleNamespace(**{name: i for i, name in enumerate(STATUS)}),
            "counter": SimpleNamespace(**{name: i for i, name in enumerate(COUNTERS)}),
            "number": SimpleNamespace(
                **NUMBERS, newton=correction.position == "newton", rounds=correction.rounds, modes=MODE_NUMBERS
            ),
            "turning": layout.turning,
            "evaluation": "rhs",
            "kept": False,
        }

    def print_template(self, part: str, role: str = "", **roles: str) -> None:
        """Print the functions of a template; `roles` holds roles of single functions that differ."""
        first = len(self.pieces)
        render_template(f"parts/{part}.j2", self.values)
        self.pieces[first:] = [(roles.get(code.name, role), code) for _, code in self.pieces[first:]]

    @property
    def codes(self) -> list[ModulePiece]:
        """The functions without their roles."""
        return [code for _, code in self.pieces]

    def _note_function(
        self,
        name: str,
        arguments: str,
        purpose: str,
        calls: str = "",
        sections: str = "",
        math: bool = False,
        *,
        caller: Callable[[], str],
    ) -> str:
        body = caller().strip("\n").split("\n")
        before, names, named = self.layout.own_lines_and_sections()
        called = {*calls.split(), *names, *(("math",) if math else ())}
        named |= set(sections.split())
        lines = [*before, *body]
        decorator = self.layout.decorator
        self.pieces.append(
            ("", function_source(name + self.end, arguments, purpose, lines, decorator, calls=called, sections=named))
        )
        return ""


def kind_of_acceptance(correction: Correction) -> str:
    """Return the treatment of accepted states: ``measured``, ``augmented``, ``balanced`` or ``corrected``."""
    if not correction.any:
        return "measured"
    return "augmented" if correction.metric == "augmented" else "balanced" if correction.energy else "corrected"


#: Parts of laws, each a module that needs earlier ones only: the beginning of its stem, and its description.
ROLES = {
    "preparation": ("prepare", "Numbers that depend on parameters alone"),
    "iteration": ("iterate", "One iteration, and its end"),
    "acceleration": ("rhs", "Right-hand side"),
    "balance": ("balance", "What accelerations and multipliers leave of the forces"),
    "metric": ("metric", "Corrections in another metric"),
    "correction": ("accept", "Treatment of accepted states"),
    "closed": ("rhs_closed", "Right-hand side behind the closure of the state"),
    "confirmation": ("confirm", "Second evaluation without rows that come out doubtful"),
    "form": ("form", "Descriptor form"),
    "derivation": ("slopes", "Right-hand side for derivatives"),
}
#: Functions that a law's module exports.
_EXPORTS = "prepare", "rhs", "confirm", "rates", "accept", "balance", "geometry", "spread", "residual", "tangent"


def law_modules(
    law: LawCode,
    layout: PartsLayout,
    printed: Sequence[tuple[str, ModulePiece]],
    flagged: bool,
    what: str,
    versions: str,
    shared_names: Origins,
    title: str,
    header: Sequence[str],
    stem: str,
    suffix: str = "",
    places: Places | None = None,
    **keys: Any,
) -> dict[str, str]:
    """Return the modules of a law: one for each part, and last the law's own, which gathers their functions.

    A part is named by a digest of its content, so that equal parts of all laws are one module. With
    `places` there is one module, the law's own, which holds the same functions.

    Parameters
    ----------
    law : LawCode
        The law.
    layout : PartsLayout
        Text of sizes and sections in its functions with loops.
    printed : sequence of (str, Code)
        Its functions of formulas, each with its role, one of `ROLES`.
    flagged : bool
        Whether one of these flags suspicious pivots.
    what, versions : str
        Owner of the parts, and the versions they were made with, for docstrings.
    shared_names : mapping of str to (str, str)
        As for `module`: names of the modules that all laws share.
    title, header, stem : str, sequence of str, str
        Of the law's own module.
    suffix : str
        End of all stems.
    places : Places, optional
        Names of the elements of arrays, for readers.
    **keys
        As for `module`.
    """
    pieces = [*printed, *_functions_with_loops(law, layout, {code.name for _, code in printed}, flagged)]
    if places is not None:
        groups = [[code for each, code in pieces if each == role] for role in ROLES]
        return {stem + suffix: places.module(title, header, groups, shared_names, **keys)}
    metric = law.correction.metric if law.correction.any else "measured"
    kinds = {"acceleration": law.form, "metric": metric, "correction": metric, "form": law.info.level}
    modules: dict[str, str] = {}
    origins = dict(shared_names)
    exported: set[str] = set()
    for role, (label, about) in ROLES.items():
        codes = [code for each, code in pieces if each == role]
        if not codes:
            continue
        digest = hashlib.sha256(module_source("", [], codes, origins, **keys).encode()).hexdigest()[:16]
        name = "_".join((label, *([kinds[role]] if role in kinds else ()), digest)) + suffix
        modules[name] = module_source(f"{about}, {what}.", [versions], codes, origins, **keys)
        if role == "acceleration":  # the law's `rhs` closes dependent coordinates first
            origins["accelerate"] = (name, "rhs")
        origins |= {each: (name, each) for code in codes for each in code.names}
        exported |= {each for code in codes for each in code.names}
    own = (name + end for name in _EXPORTS for end in ("", SLOPES))
    modules[stem + suffix] = module_source(title, header, [], origins, {}, exports=exported.intersection(own))
    return modules


def _functions_with_loops(
    law: LawCode, layout: PartsLayout, names: Collection[str], flagged: bool
) -> list[tuple[str, ModulePiece]]:
    """Return the functions of a law with loops, with their roles, in the order of their text."""
    form, parts = law.form, Parts(layout, law.correction)
    if BY_RESIDUAL in names:
        parts.pieces += (
            ("derivation", _scalar_function(layout, name, arguments)) for name, arguments in CARRIED.items()
        )
    if "refactor" in names:
        parts.print_template("metric", "metric")
    if FREE_RHS in names:
        parts.pieces.append(("acceleration", _right_hand_side_by_modes(layout)))
    if form in ("iterated", "dense"):
        parts.print_template(form, "acceleration")
    if form == "tangent":
        parts.print_template("choose", "acceleration")
        parts.print_template("tangent", "acceleration")
    partitioned = law.correction.metric == "independent"
    if partitioned:
        parts.print_template("choose", "correction")
    if partitioned or law.closed:
        parts.values["kept"] = partitioned
        parts.print_template("close", "correction")
    if law.closed:
        parts.print_template("closed", "closed")
    if flagged:
        evaluation = next((name for name in (BY_PIVOTS, HELD_RHS) if name in names), "rhs")
        parts.values["evaluation"] = evaluation
        parts.print_template("confirm", "confirmation")
        if evaluation + SLOPES in names:
            parts.values["evaluation"], parts.end = evaluation + SLOPES, SLOPES
            parts.print_template("confirm", "derivation")
            parts.end = ""
    by_metric = "partition" if partitioned else kind_of_acceptance(law.correction)
    parts.print_template(f"accept_{'tangent' if form == 'tangent' else by_metric}", "correction")
    return parts.pieces


def _scalar_function(layout: PartsLayout, name: str, arguments: tuple[str, ...]) -> ModulePiece:
    """Return a function of a number whose derivatives are others."""
    purpose = "A without derivatives." if len(arguments) == 1 else "A with the derivatives of b."
    return function_source(name, ", ".join(arguments), purpose, ["return a"], layout.decorator)


def _right_hand_side_by_modes(layout: PartsLayout) -> ModulePiece:
    """Return the right-hand side that enters the one with rows with bounds, or the one without where all are off."""
    first, arguments = layout.size("switchable") - layout.size("bounded"), "t, y, p, w, iw, ydot"
    held = (
        f"w[{layout.constant_of_section('modes')} + {MODE_NUMBERS * row}]"
        for row in range(first, layout.size("switchable"))
    )
    body = [
        f"if {' and '.join(f'{number} == 0.0' for number in held)}:",
        f"    return {FREE_RHS}({arguments})",
        f"return {HELD_RHS}({arguments})",
    ]
    before, names, sections = layout.own_lines_and_sections()
    purpose = "Rates of the state, with rows with bounds where one of them is in force."
    calls = {FREE_RHS, HELD_RHS, *names}
    return function_source(
        "rhs", arguments, purpose, [*before, *body], layout.decorator, calls=calls, sections=sections
    )
