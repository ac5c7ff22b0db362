"""The right-hand side of a law at all nodes of a step at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from symgen.compile.native.annotations import Array
from symgen.compile.native.compiler import is_by_numba
from symgen.compile.store.emitted import EmittedFunction, NodesFunction
from symgen.compile.store.jit import jit

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

#: Prefix of modules of right-hand sides in straight code.
STRAIGHT = "rhs_direct"
_functions: dict[Any, Any] = {}


@jit(entry=True)
def absent_function(t: Array, y: Array, p: Array, w: Array, rate: Array) -> int:
    """Replace a right-hand side at all nodes; it is never called."""
    return 0


def rates_at_nodes(compiled: CompiledModel) -> tuple[Any, int]:
    """Return the right-hand side of a law at all nodes, and 1; `absent_function` and 0 where its code is not straight.

    Laws that iterate, choose coordinates or factorise in loops are evaluated at one node after another, and so is
    looped code, and everything by Numba.
    """
    rhs = compiled.law_module.rhs
    if compiled.shape != "straight" or not isinstance(rhs, EmittedFunction) or is_by_numba():
        return absent_function, 0
    # integrals of outputs are added up by a function around that of the law
    own = rhs.py_func.__globals__.get("law_rhs", rhs)
    if not own.py_func.__module__.rpartition(".")[2].startswith(STRAIGHT):
        return absent_function, 0
    if rhs not in _functions:
        _functions[rhs] = NodesFunction(rhs)
    return _functions[rhs], 1
