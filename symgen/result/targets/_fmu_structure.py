"""What outputs of an FMU with derivatives depend on: its states alone, where no input passes straight through."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from symgen.compile.native import language as lang
from symgen.compile.native.folding import walk_statements

if TYPE_CHECKING:
    from symgen.result.targets._c_model import CModel

#: An element of an array, by its number; None where that is not constant.
Element = tuple[str, int | None]


def outputs_of_states(model: CModel) -> tuple[bool, list[bool]]:
    """Return whether coordinates and velocities follow from states and time alone, and whether each output does.

    Where constraint rows read an input, nothing does; an output does not where it reads accelerations, efforts or
    an input.
    """
    functions, inputs = model.functions, model.compiled.info.inputs
    places = {i for i, q in enumerate(model.compiled.info.parameters) if q.name in inputs}
    first = len(model.compiled.info.parameters)
    hoists = any(name == "p" and i in places for name, i in _read_elements(functions["prepare_model"]))

    def is_from_outside(element: Element) -> bool:
        name, i = element
        return name == "p" and (i is None or i in places or (hoists and i >= first))

    if any(map(is_from_outside, _read_elements(functions["geometry"]))):
        return False, [False] * len(model.mechanism.outputs)
    if not model.mechanism.outputs:
        return True, []
    found = _elements_of_results(functions["formulas_of_outputs"])
    return True, [
        k in found and not any(is_from_outside(x) or x[0] in ("w", "ydot") for x in found[k])
        for k in range(len(model.mechanism.outputs))
    ]


def _read_elements(function: lang.Function) -> Iterator[Element]:
    """Yield the elements of arrays that a function or its callees read."""
    waiting, seen = [function], set[object]()
    while waiting:
        f = waiting.pop()
        if f.key in seen:
            continue
        seen.add(f.key)
        for x in walk_statements(f.body):
            if isinstance(x, lang.ArrayElement):
                yield _element(x)
        waiting += f.called


def _element(x: lang.ArrayElement) -> Element:
    return x.array, int(x.index.value) if isinstance(x.index, lang.Constant) else None


def _elements_of_results(function: lang.Function) -> dict[int, set[Element]]:
    """Return what each element of ``out`` is made of, where all statements are assignments to variables or ``out``."""
    made, results = dict[str, set[Element]](), dict[int, set[Element]]()
    for s in function.body:
        if isinstance(s, lang.Return):
            break
        if not isinstance(s, lang.Assign | lang.Store):
            return {}
        parts = set[Element]()
        for x in walk_statements(s.value):
            if isinstance(x, lang.Variable):
                parts |= made.get(x.name, set())
            elif isinstance(x, lang.ArrayElement):
                parts.add(_element(x))
            elif isinstance(x, lang.FunctionCall) and any(isinstance(a, str) for a in x.arguments):
                return {}
        if isinstance(s, lang.Assign):
            made[s.name] = made.get(s.name, set()) | parts
        elif isinstance(s.index, lang.Constant):
            results[int(s.index.value)] = parts
    return results
