"""Functions with loops, printed from the templates that all shapes and targets share."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from types import SimpleNamespace
from typing import Any

from symgen.emit.module import PLATFORMS, Code, function, literal, render
from symgen.ir.numerics import NUMBERS
from symgen.ir.program import COUNTERS, STATUS, Correction


class PartsLayout:
    """How a shape or target writes sizes, sections and parameters in functions with loops; here, that it has none.

    Attributes
    ----------
    turning : str
        Arguments of ``normalise``, empty in the plane.
    decorator : str
        What precedes each function.
    parameters : sequence of str
        Parameters of the method.
    """

    turning: str = ""
    decorator: str = PLATFORMS["cpu"].decorator
    parameters: Sequence[str] = ()

    def size(self, name: str) -> Any:
        """Return ``nq``, ``nv``, ``m`` or ``degrees``: a number, or text that can be added."""
        raise KeyError(name)

    def at(self, name: str) -> str:
        """Return where a section of ``w`` begins."""
        raise KeyError(name)

    def given(self, place: int) -> str:
        """Return the method's parameter in a place among them."""
        raise KeyError(place)

    def parameter(self, name: str) -> str:
        """Return a parameter of the method, or what is taken where it has none."""
        if name in self.parameters:
            return self.given(self.parameters.index(name))
        return literal(0.0 if name == "penalty" else NUMBERS["tolerance"])

    def finished(self) -> tuple[list[str], set[str], set[str]]:
        """Return lines before a function's own, and the names and sections that were asked for since the last one."""
        return [], set(), set()


class _Names:
    """Names by which a template asks for what its layout gives another text: ``at.change``, ``size.nq``."""

    def __init__(self, text: Callable[[str], Any]) -> None:
        self._text = text

    def __getattr__(self, name: str) -> Any:
        return self._text(name)


class Parts:
    """Prints templates of ``templates/parts``; each of their functions says what it calls."""

    def __init__(self, layout: PartsLayout, correction: Correction) -> None:
        self.layout = layout
        self.pieces: list[tuple[str, Code]] = []
        self.values: dict[str, Any] = {
            "function": self._function,
            "size": _Names(layout.size),
            "at": _Names(layout.at),
            "parameter": _Names(layout.parameter),
            "status": SimpleNamespace(**{name: i for i, name in enumerate(STATUS)}),
            "counter": SimpleNamespace(**{name: i for i, name in enumerate(COUNTERS)}),
            "number": SimpleNamespace(**NUMBERS, newton=correction.position == "newton", rounds=correction.rounds),
            "turning": layout.turning,
        }

    def add(self, part: str, role: str = "", **roles: str) -> None:
        """Print the functions of a template; `roles` are those of single functions, where they have others."""
        first = len(self.pieces)
        render(f"parts/{part}.j2", self.values)
        self.pieces[first:] = [(roles.get(code.name, role), code) for _, code in self.pieces[first:]]

    @property
    def codes(self) -> list[Code]:
        """The functions without their roles."""
        return [code for _, code in self.pieces]

    def _function(
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
        before, names, named = self.layout.finished()
        called = {*calls.split(), *names, *(("math",) if math else ())}
        named |= set(sections.split())
        lines = [*before, *body]
        decorator = self.layout.decorator
        self.pieces.append(("", function(name, arguments, purpose, lines, decorator, calls=called, sections=named)))
        return ""


def accept_kind(correction: Correction) -> str:
    """Return how accepted states are treated: ``measured``, ``augmented`` or ``corrected``."""
    return "measured" if not correction.any else "augmented" if correction.metric == "augmented" else "corrected"


def law_loops(
    layout: PartsLayout, correction: Correction, form: str, names: Collection[str], flagged: bool, closed: bool = False
) -> list[tuple[str, Code]]:
    """Return the functions of a law that are no formulas, with their roles, in the order of their text.

    Parameters
    ----------
    form, names : str, collection of str
        How v' is found, and the law's functions that are formulas.
    flagged, closed : bool
        Whether one of these says that a pivot is suspicious; whether dependent coordinates are closed at every stage.
    """
    parts = Parts(layout, correction)
    if "refactor" in names:
        parts.add("metric", "metric")
    if form in ("iterated", "dense"):
        parts.add(form, "acceleration")
    if form == "tangent":
        parts.add("choose", "acceleration")
        parts.add("tangent", "acceleration")
    if closed:
        parts.add("choose", "correction")
        parts.add("closed", "closed", close="correction")
    if flagged:
        parts.add("confirm", "confirmation")
    by_metric = "partition" if correction.metric == "independent" else accept_kind(correction)
    parts.add(f"accept_{'tangent' if form == 'tangent' else by_metric}", "correction")
    return parts.pieces
