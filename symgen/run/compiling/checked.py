"""Emitted functions of a compiled model in the checked language, the input of printers for other targets."""

from __future__ import annotations

from collections.abc import Container
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from symgen.compile.native import types
from symgen.compile.native.language import Function, FunctionParameter
from symgen.compile.native.read import Foreign
from symgen.run.layout import abi
from symgen.run.layout.ensemble_abi import PREPARE

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

_LAW = {"rhs": abi.RHS, "accept": abi.ACCEPT, "geometry": abi.MEASURE, "confirm": abi.RHS}
_MODEL = {"masses": abi.MOVE, "move": abi.MOVE, "bodies": abi.OBSERVE, "measure": abi.MEASURE}
#: Functions of a law and its model that every run calls.
NAMES = (*_LAW, *_MODEL)


def check_kernels(compiled: CompiledModel, names: Container[str] = NAMES) -> dict[str, Function]:
    """Return those functions that a compiled model has, and both that fill the hoisted numbers.

    Parameters
    ----------
    compiled : CompiledModel
        Code of one method. What is interpreted once a run in the looped shape, ``masses`` and ``prepareModel``, has no
        body: printers write it. What is called through tables is left out.
    names : container of str
        Names of `NAMES`.

    Returns
    -------
    dict of str to Function
        By name; ``prepareModel`` and ``prepareLaw`` come last.

    Raises
    ------
    Foreign
        If one is not in the language, or was left to Python.
    """
    model, law, functions = compiled.model, compiled.law_module, dict[str, Function]()
    looped = compiled.shape == "looped"
    for module, table in ((law, _LAW), (model, _MODEL)):
        own = [name for name in table if name in names and hasattr(module, name)]
        if looped and "masses" in own:
            own.remove("masses")
            functions["masses"] = written_function("masses", "p", "w")
        functions |= {name: checked_function(getattr(module, name), table[name]) for name in own}
    functions["prepareModel"] = (
        written_function("prepareModel", "p") if looped else checked_function(model.prepare, PREPARE)
    )
    functions["prepareLaw"] = checked_function(law.prepare, PREPARE)
    if "geometry" in names and "geometry" not in functions:
        functions["geometry"] = checked_function(model.geometry, abi.MEASURE)
    return functions


def written_function(name: str, *arrays: str) -> Function:
    """Return a function of arrays whose text a printer has from elsewhere, for its callers."""
    parameters = tuple(FunctionParameter(array, "float", array=True) for array in arrays)
    return Function(name, parameters, "int", (), {}, frozenset(), {}, (), source=("written", name))


@lru_cache(maxsize=128)
def checked_function(function: Any, kind: types.FunctionType) -> Function:
    """Return an emitted function in the checked language, of the type that loops call; it is read once a process."""
    if not hasattr(function, "read"):
        raise Foreign("been left to Python, by NUMBA_DISABLE_JIT")
    result: Function = function.read(kind.signature.arguments)
    return result
