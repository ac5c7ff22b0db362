"""The program of a law in the looped shape: the same for all mechanisms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from symgen.base.errors import InputError
from symgen.base.ir.graph import ARITHMETIC
from symgen.base.ir.program import LawCode
from symgen.base.vocabulary.infos import LawInfo
from symgen.derive.lower.looped.law_loops import KINDS, Loops
from symgen.derive.lower.looped.layout import HEAD
from symgen.derive.lower.looped.statements import LoopedFunction
from symgen.derive.lower.record import record_law
from symgen.derive.lower.record_form import record_form
from symgen.derive.lower.recorded_law import RecordedLaw
from symgen.derive.methods._base import Method
from symgen.derive.methods._tape import needed_operations


class LoopedLawInfo(LawInfo, frozen=True, kw_only=True):
    """Facts about a looped law for the tables, besides the facts about every law.

    Parameters
    ----------
    sections : tuple of (name, size)
        Its own sections of ``w``.
    vectors : int
        Number of scratch vectors.
    augmented : bool
        Whether M + a D^T D is factorised.
    positions : bool
        Whether an evaluation needs Phi.
    """

    sections: tuple[tuple[str, str], ...]
    vectors: int
    augmented: bool
    positions: bool


@dataclass(frozen=True)
class LoopedLaw(LawCode):
    """Functions that a method adds in the looped shape.

    Parameters
    ----------
    functions : tuple of LoopedFunction
        ``rhs``, or its parts, and ``refactor`` and ``spread`` where the metric of the correction is
        not the identity.
    """

    info: LoopedLawInfo
    functions: tuple[LoopedFunction, ...]


def refuse_dense(method: Method, options: Mapping[str, str], implicit: bool) -> None:
    """Refuse a method without a looped shape.

    Raises
    ------
    InputError
        With the reason in one sentence.
    """
    if reason := _reason_of_density(method, tuple(options.items()), implicit):
        expected, why = reason
        raise InputError("shape 'looped'", expected, f"'{method.name}'{why}; the straight shape is for it")


@lru_cache(maxsize=128)
def _reason_of_density(method: Method, options: tuple[tuple[str, str], ...], implicit: bool) -> tuple[str, str] | None:
    """Return the condition of looped code that a method does not meet, and its property; None without any.

    Every run of a study asks, and formulas are recorded for the answer.
    """
    chosen, expected = dict(options), "a method whose cost grows linearly with the mechanism"
    if chosen.get("solver") == "dense":
        return expected, " with a dense factorisation of D"
    if method.dense:
        return expected, f", {method.dense}"
    if strange := _unknown_operation(record_law(method, chosen).choose_solution(schur=True), KINDS, _FUNCTIONS):
        return expected, f", whose formula asks for '{strange}'"
    if implicit and (strange := _unknown_operation(record_form(method, chosen, "joint"), _OF_A_JOINT, ("residual",))):
        return "constraints that each joint gives alone", f", whose constraints ask for '{strange}'"
    return None


#: Functions of laws that can be loops.
_FUNCTIONS = ("rhs", "begin", "iterate", "finish", "balance", "refactor", "spread")
#: Operations on one joint, besides arithmetic: no masses, no forces, nothing of other joints.
_OF_A_JOINT = frozenset(ARITHMETIC) | {"constant", "min", "dot", "constraints", "product", "holonomic_or", "parameter"}
_OF_A_JOINT |= {"status", "section", "zeros", "gamma", "nu", "phi", "v"}


def _unknown_operation(record: RecordedLaw, kinds: frozenset[str], functions: tuple[str, ...]) -> str:
    """Return an operation of a formula that is not among `kinds`, or a function that is not among `functions`."""
    operations = record.operations
    for part in record.parts:
        if part.name not in functions:
            return part.name
        ends = [i for place, i in part.outputs if place not in ("q", "v", "power")]
        for operation in (operations[i] for i in needed_operations(ends, lambda i: operations[i].operands)):
            name = str(operation.payload[0]) if operation.kind == "quantity" else operation.kind
            if operation.kind not in kinds and name not in kinds:
                return name
    return ""


def is_loopable(method: Method, options: Mapping[str, str], implicit: bool) -> bool:
    """Whether a method has a looped shape."""
    try:
        refuse_dense(method, options, implicit)
    except InputError:
        return False
    return True


def lower_looped(method: Method, options: Mapping[str, str]) -> LoopedLaw:
    """Lower one method to loops.

    Parameters
    ----------
    method, options : Method, mapping
        A method that `refuse_dense` lets pass, with its structural options, complete.
    """
    record = record_law(method, options).choose_solution(schur=True)
    names = tuple(p.name for p in method.parameters)
    parts = [Loops(record, part, names) for part in record.parts]
    phi = next(i for i, o in enumerate(record.operations) if o.payload == ("phi",))
    positions = any(phi in loops.needed for loops in parts)
    functions = tuple(loops.function(positions) for loops in parts)
    sizes = {name: size for f in functions for name, size in f.sections.items()}
    sizes |= {name: "one" for name, factors in record.sections if factors == ("one",)}
    sections = tuple((n, size) for n, size in sizes.items() if n not in HEAD and not n.removeprefix("x").isdigit())
    correction = method.correction(options)
    info = LoopedLawInfo(
        method=method.name,
        key=method.stem(options),
        options=dict(options),
        parameters=tuple((p.name, p.default) for p in method.parameters),
        sections=sections,
        vectors=max(f.vectors for f in functions),
        augmented=any(size == "augmented" for _, size in sections),
        positions=positions,
        position_correction=correction.position != "none",
        velocity_correction=correction.velocity,
        energy_correction=correction.energy,
    )
    return LoopedLaw(info, record.form, correction.stages, correction, functions)
