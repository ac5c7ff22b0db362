"""Compiled models that stay at hand while mechanisms change in the values of their parameters alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

from symgen.base.latest import get_or_make

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.compiling.method_choice import MethodChoice
    from symgen.run.layout.compiled import CompiledModel

#: Models that stay: of a run, of its second one and of a start, each before and after a change of the file.
MOST = 6
#: What the code is of, which stays as long as it, so that no other object has its identity; and the code.
Kept = dict[tuple[object, ...], "tuple[Mechanism, CompiledModel]"]

_KEPT: ContextVar[Kept | None] = ContextVar("kept_code", default=None)


@contextmanager
def keeping_code(kept: Kept) -> Iterator[None]:
    """Keep compiled models in `kept`, and take them from there."""
    before = _KEPT.set(kept)
    try:
        yield
    finally:
        _KEPT.reset(before)


def code_at_hand(
    mechanism: Mechanism, choice: MethodChoice, target: str, compile_it: Callable[[], CompiledModel]
) -> CompiledModel:
    """Return the compiled model of a mechanism: one at hand where it is of the same parts, else a new one.

    Parts are the same where they are the same objects, which is told at once.
    """
    kept = _KEPT.get()
    if kept is None:
        return compile_it()
    parts = tuple(id(getattr(mechanism, name)) for name in mechanism.__struct_fields__ if name != "parameters")
    parameters = tuple((p.name, p.unit, p.formula is None, p.input) for p in mechanism.parameters)
    method = choice.method.name, *sorted(choice.options.items()), choice.implicit, choice.shape, choice.directed, target
    return get_or_make(kept, (parts, parameters, method), lambda: (mechanism, compile_it()), MOST)[1]
