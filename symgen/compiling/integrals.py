"""A compiled model whose state holds integrals of outputs behind the work.

The law's own module stays what it is: another one beside it calls its right-hand side and adds the rates of integrals.
"""

from __future__ import annotations

import inspect
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec

from symgen.compiling.pipeline import folder_of
from symgen.compiling.side import beside, stem_of
from symgen.describe.formula_text import to_text
from symgen.describe.mechanism import Mechanism
from symgen.describe.readings import integrals
from symgen.errors import InputError, finite_numbers
from symgen.runtime import abi
from symgen.runtime.compiled import CompiledModel
from symgen.store.entries import Entries
from symgen.store.modules import interpreted, load_module


def can_integrate(compiled: CompiledModel) -> bool:
    """Whether states of a compiled model can hold what outputs integrate: those of methods with momenta cannot."""
    return not hasattr(compiled.law_module, "rates")


def with_integrals(mechanism: Mechanism, compiled: CompiledModel) -> CompiledModel:
    """Return a compiled model whose state holds what outputs integrate; as it is where they integrate nothing.

    Raises
    ------
    InputError
        If the method integrates something else than velocities, or numbers that meet in a formula overflow.
    """
    found, info, law = integrals(mechanism), compiled.info, compiled.law_module
    if not found:
        return compiled
    if not can_integrate(compiled):
        expected = "a method that integrates velocities, as an output is an integral"
        raise InputError(f"method '{compiled.law.method}'", expected, "one that integrates momenta")
    auxiliary = compiled.law.nw, 1 + len(found)
    around = beside(mechanism, compiled)
    around = replace(around, sections={**around.sections, "auxiliary": auxiliary})
    files = _files(law)
    stems = {name: file.stem for name, file in sorted(files.items())}
    texts = [to_text(integral.of) for integral in found]
    store, folder = Entries(), next(iter(files.values())).parent.name
    stem = stem_of("integrals", folder_of(mechanism), around, stems, *texts)

    def make() -> tuple[str, dict[str, Any]]:
        from symgen.emit.side import emit_integrals
        from symgen.lower.side import lower_integrands

        with finite_numbers("integrals of outputs"):
            program = lower_integrands(mechanism, around)
        return emit_integrals(program, stems, abi.POWER), {}

    store.made(folder, stem, make)
    return replace(
        compiled,
        info=msgspec.structs.replace(info, integrals=len(found), sections=info.sections | {"auxiliary": auxiliary}),
        law=msgspec.structs.replace(  # the last element of w is looped code's own
            compiled.law, nw=sum(auxiliary) + 1, modules=tuple(dict.fromkeys((*stems.values(), *compiled.law.modules)))
        ),
        law_module=load_module(store.path(folder, stem)),
    )


def _files(law: Any) -> dict[str, Path]:
    """Return the file that each emitted function of a law is imported from, by the function's name.

    That is the law's own module; where functions were gathered from several modules, as looped code's for implicit
    integrators are, it is the one that defines the function.
    """
    file = getattr(law, "__file__", None)
    if file is None:
        return {name: Path(inspect.getfile(interpreted(value))) for name, value in vars(law).items()}
    package = law.__name__.rpartition(".")[0]
    return {name: Path(file) for name, value in vars(law).items() if _is_emitted(value, package)}


def _is_emitted(value: Any, package: str) -> bool:
    """Whether it is a function of a module of this package, compiled or not."""
    function = interpreted(value)
    return inspect.isfunction(function) and function.__module__.startswith(f"{package}.")
