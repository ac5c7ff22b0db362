"""The law of a method as the steps that are solved, read from the tape that all code is made from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from symgen.base.escapes import latex_text
from symgen.derive.lower.record import record_law
from symgen.derive.lower.recorded_law import Part, RecordedLaw
from symgen.derive.methods import METHODS
from symgen.derive.methods._tape import FormulaStep, needed_operations
from symgen.result.reading.boxes import (
    TextBox,
    bracket_box,
    fraction_box,
    function_box,
    literal_box,
    name_box,
    power_box,
    rate_box,
    row_box,
    sign_box,
    transposed_box,
)
from symgen.result.reading.notations import latex, plain

_QUANTITIES = {"gamma": "gamma", "nu": "nu", "phi": "Phi", "f": "f", "v": "v"}
_SIGNS = {"add": "+", "sub": "-"}
#: Names of results of functions.
_PLACES = {
    "rates.q": rate_box(name_box("q")),
    "rates.v": rate_box(name_box("v")),
    "rates.work": rate_box(name_box("W")),
    "multipliers": name_box("lambda"),
    "residual": name_box("r"),
    "change": name_box("delta"),
    "v": rate_box(name_box("v")),
    "q": name_box("Q"),
    "law_": name_box("S"),
    "dense": name_box("D"),
}


@dataclass(frozen=True)
class Step:
    """An equation of a law.

    Attributes
    ----------
    function, purpose : str
        The emitted function that it belongs to, and the purpose of that.
    left, right : Box
        Its sides.
    solved : bool
        Whether it is solved for the last factor of the left side.
    """

    function: str
    purpose: str
    left: TextBox
    right: TextBox
    solved: bool = False

    @property
    def box(self) -> TextBox:
        """The whole equation."""
        return row_box(self.left, sign_box("="), self.right)

    @property
    def latex(self) -> str:
        """The equation as a line of an environment such as ``aligned``."""
        return rf"{latex(self.left)} &= {latex(self.right)}" + (r" && \text{(solved)}" if self.solved else "")

    def __str__(self) -> str:
        return ("solve " if self.solved else "") + plain(self.box)


@dataclass(frozen=True)
class Law:
    """The steps of a method's law, in the order in which they are computed.

    Attributes
    ----------
    method, summary, form : str
        Name, description, and the way v' is computed: ``direct``, ``iterated``, ``dense`` or ``tangent``.
    options : mapping
        Structural options.
    steps : tuple of Step
        Equations, function by function; those of the correction are last.
    """

    method: str
    summary: str
    form: str
    options: Mapping[str, str]
    steps: tuple[Step, ...]

    @property
    def parts(self) -> list[tuple[str, str, list[Step]]]:
        """Emitted functions with their purposes and steps."""
        groups: dict[tuple[str, str], list[Step]] = {}
        for step in self.steps:
            groups.setdefault((step.function, step.purpose), []).append(step)
        return [(function, purpose, steps) for (function, purpose), steps in groups.items()]

    def latex(self) -> str:
        """Return the steps as lines of LaTeX, for an environment such as ``aligned``."""
        lines = list[str]()
        for function, _, steps in self.parts:
            lines += [rf"&\text{{{latex_text(function)}}}", *(step.latex for step in steps)]
        return " \\\\\n".join(lines)

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle \begin{{aligned}} {self.latex()} \end{{aligned}}$"

    def __str__(self) -> str:
        lines = [f"{self.method}: {self.summary}"]
        for function, purpose, steps in self.parts:
            lines += [f"{function}: {purpose}", *(f"  {step}" for step in steps)]
        return "\n".join(lines)


def law_as_steps(method: str, options: Mapping[str, str] | None = None, driven: bool = False) -> Law:
    """Return the law of a method as steps.

    Parameters
    ----------
    method : str
        Name of the method.
    options : mapping, optional
        Its structural options; defaults are filled in.
    driven : bool
        Whether drivers prescribe coordinates, so that they work where there is no row: b v' + c.

    Raises
    ------
    InputError
        If there is no such method or option.
    """
    chosen = METHODS.get(method, "law")
    complete = chosen.complete_options(options or {})
    record = record_law(chosen, complete, driven).choose_solution(schur=True)
    steps = [step for part in record.parts for step in _LawReader(record, part).read_steps()]
    return Law(chosen.name, chosen.summary, record.form, complete, tuple(steps))


class _LawReader:
    """Reads one function of a law; what is used more than once, and what is solved for, has a step of its own."""

    def __init__(self, record: RecordedLaw, part: Part) -> None:
        self.operations, self.part = record.operations, part
        self.result: list[Step] = []
        self.boxes: dict[int, TextBox] = {}

    def read_steps(self) -> list[Step]:
        ends = [index for _, index in self.part.outputs]
        order = needed_operations(ends, lambda i: self.operations[i].operands)
        uses: dict[int, int] = {}
        for index in order:
            for operand in self.operations[index].operands:
                uses[operand] = uses.get(operand, 0) + 1
        places = {index: _box_of_place(place) for place, index in self.part.outputs}
        ends_as: dict[int, TextBox] = {}
        letters = iter("xyzadeghijklnoprsu")
        for index in order:
            operation = self.operations[index]
            if operation.kind == "driving":  # works with the rate as it is called, not as it is computed
                self.boxes |= {i: places[i] for i in operation.operands if i in places}
            box = self._box_of_operation(operation)
            if operation.kind == "solve":
                unknown = places.get(index) or (
                    name_box("lambda") if operation.size == "m" else name_box(next(letters))
                )
                matrix, right = (self.boxes[i] for i in operation.operands)
                self._add_step(row_box(_factor_box(matrix), unknown), right, solved=True)
                box = unknown
            elif uses.get(index, 0) > 1 and box.kind in ("row", "over") and index not in places:
                short = name_box(next(letters))
                self._add_step(short, box)
                box = short
            self.boxes[index] = ends_as[index] = box
        for place, index in self.part.outputs:
            if self.operations[index].kind != "solve":
                self._add_step(_box_of_place(place), ends_as[index])
        return self.result

    def _add_step(self, left: TextBox, right: TextBox, solved: bool = False) -> None:
        self.result.append(Step(self.part.name, self.part.purpose, left, right, solved))

    def _box_of_operation(self, operation: FormulaStep) -> TextBox:
        kind, parts = operation.kind, [self.boxes[i] for i in operation.operands]
        if kind in _SIGNS:
            left, right = parts
            return row_box(left, sign_box(_SIGNS[kind]), _factor_box(right) if kind == "sub" else right)
        if kind in _FORMS:
            return _FORMS[kind](*parts)
        payload = str(operation.payload[0]) if operation.payload else ""
        if kind == "constant":
            return literal_box(float(operation.payload[0]))
        if kind == "quantity":
            return row_box(name_box("N"), name_box("v")) if payload == "q_rates" else name_box(_QUANTITIES[payload])
        if kind in ("keep", "keep_constraints", "keep_factor", "stored_factor"):
            return parts[0]
        return _box_of_name(payload or kind)


def _box_of_name(text: str) -> TextBox:
    box = _PLACES.get(text)
    return box if box is not None else name_box(text)


def _box_of_place(place: str) -> TextBox:
    return _box_of_name(place.removeprefix("status.") or "factor")


def _factor_box(box: TextBox) -> TextBox:
    """Return a box as a factor: a sum in brackets."""
    signs = box.kind == "row" and any(p.kind == "sign" for p in box.parts)
    return bracket_box(box) if signs else box


def _inverse_box(box: TextBox) -> TextBox:
    return power_box(box, literal_box(-1.0))


def _product_box(*boxes: TextBox) -> TextBox:
    return row_box(*map(_factor_box, boxes))


_D, _M, _G = name_box("D"), name_box("M"), name_box("G")
#: The identity of bodies' velocities u = B v + b, pulled back to those of the state.
_BODIES = row_box(transposed_box(name_box("B")), name_box("B"))
_FORMS: dict[str, Callable[..., TextBox]] = {
    "neg": lambda x: row_box(sign_box("-"), _factor_box(x)),
    "mul": lambda a, b: _product_box(a, b),
    "div": lambda a, b: fraction_box(a, b),
    "pow": lambda a, b: power_box(_factor_box(a), b),
    "sqrt": lambda a: function_box("sqrt", [a]),
    "min": lambda a, b: function_box("min", [a, b]),
    "dot": lambda a, b: row_box(transposed_box(_factor_box(a)), _factor_box(b)),
    "product": lambda a, x: _product_box(a, x),
    "transposed": lambda a, y: row_box(transposed_box(a), _factor_box(y)),
    "times_transposed": lambda a, b: row_box(a, transposed_box(b)),
    "constraints": lambda: _D,
    "stored_constraints": lambda: _D,
    "mass": lambda x: _product_box(_M, x),
    "minv": lambda x: _product_box(_inverse_box(_M), x),
    "free_acceleration": lambda x: _product_box(_inverse_box(_M), x),
    "inverse_mass_root": lambda: power_box(_M, name_box("-1/2")),
    "schur": lambda: row_box(_D, _inverse_box(_M), transposed_box(_D)),
    "compliant": lambda e: row_box(_D, _inverse_box(_M), transposed_box(_D), sign_box("+"), e),
    "pseudoinverse": lambda b: row_box(_factor_box(b), transposed_box(_factor_box(b))),
    "augmented": lambda a: row_box(_M, sign_box("+"), transposed_box(_D), a, _D),
    "augmented_metric": lambda a: row_box(_M, sign_box("+"), transposed_box(_D), a, _D),
    "penalties": lambda a: a,
    "row_stiffness": lambda k: name_box("K"),
    "rank": lambda: row_box(_D, _G, transposed_box(_D)),
    "weighted_mass": lambda r: row_box(_D, _inverse_box(_M), transposed_box(_D)),
    "weighted_identity": lambda r: row_box(_D, transposed_box(_D)),
    "weighted_body": lambda r: row_box(_D, _inverse_box(bracket_box(_BODIES)), transposed_box(_D)),
    "body_entries": lambda: _BODIES,
    "body_inverse": lambda x: _product_box(_inverse_box(bracket_box(_BODIES)), x),
    "weighted_dependent": lambda r: row_box(_D, name_box("P"), _G, transposed_box(_D)),
    "geometry": lambda r: row_box(name_box("Phi"), sign_box(","), name_box("nu"), sign_box(","), _D),
    "gauged": lambda x: _product_box(_G, x),
    "partition_quality": lambda a, b: fraction_box(function_box("det", [b]), function_box("det", [a])),
    "zeros": lambda: literal_box(0.0),
    "power": lambda: name_box("P"),
    "driving": lambda a: row_box(name_box("b"), _factor_box(a), sign_box("+"), name_box("c")),
    "at_velocity": lambda x, v: row_box(_factor_box(x), sign_box("|"), v),
    "mass_rate": lambda x, v: row_box(rate_box(_M), _factor_box(x)),
    "constraint_rate_transposed": lambda y, v: row_box(transposed_box(rate_box(_D)), _factor_box(y)),
    "flag": lambda: name_box("flag"),
    "holonomic_or": lambda x: name_box("Phi"),
}
