"""From formulas of a run to a compiled function: next to the model's modules, with its own digest and entry.

    mechanism, formulas --lower--> program --emit--> source --load--> function

The function serves compiled models of both shapes. SymPy and Jinja2 are imported only where the cache has no entry.
"""

from __future__ import annotations

import hashlib
import inspect
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, refuse_overflow
from symgen.base.ir.program import CARRYING, JAMMING
from symgen.base.vocabulary.expressions import Expr
from symgen.compile.store.entries import Entries
from symgen.compile.store.loaded_modules import load_module, plain_function
from symgen.derive.lower.windings import Beside, winding_order
from symgen.describe.formulas.results_read import integrals_of_outputs
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.folders import folder_of, generator_digest
from symgen.run.layout import abi
from symgen.run.layout.compiled import CompiledModel

if TYPE_CHECKING:
    from symgen.run.layout.probe import Few

Array = NDArray[np.float64]

#: Sections of ``w`` that formulas of a run may read, at the places of a model of either shape.
READ = ("status", "winding", "modes", "multipliers", JAMMING, CARRYING)


@dataclass(frozen=True)
class Side:
    """Formulas of a run, compiled.

    Parameters
    ----------
    function : compiled function
        ``(t, y, p, w, ydot, out)``, of type `symgen.run.layout.abi.OBSERVE`; nothing is compiled before a loop takes
        it.
    path : Path
        Its module.
    labels : tuple of str
        Names of the elements of ``out``.
    reads : frozenset of str
        Inputs: ``t``, ``q``, ``v``, ``p``, ``ydot`` and sections of ``w``.
    of_forces : frozenset of int
        Numbers of the elements that depend on accelerations or forces.
    """

    function: Any
    path: Path
    labels: tuple[str, ...]
    reads: frozenset[str]
    of_forces: frozenset[int] = frozenset()

    @cached_property
    def plain(self) -> Any:
        """The function as plain Python, cheaper for a few evaluations."""
        return plain_function(self.function)

    @cached_property
    def _few(self) -> Few:
        from symgen.run.layout.abi import OBSERVE  # which need Numba: code is written without it
        from symgen.run.layout.probe import Few

        return Few(self.function, OBSERVE)

    def __call__(self, t: float, y: Array, p: Array, w: Array, ydot: Array) -> Array:
        """Return the values at one state, by plain Python where that defines them."""
        out = np.zeros(len(self.labels))
        self._few(t, y, p, w, ydot, out)
        return out


def compile_beside(mechanism: Mechanism, compiled: CompiledModel) -> Beside:
    """Return the quantities of a compiled model that formulas may read."""
    info = compiled.info
    sections = {section: info.sections[section] for section in READ if section in info.sections}
    rows = {row.name: i for i, row in enumerate(info.rows)}
    return Beside(winding_order(mechanism, compiled.shape), sections, rows)


def stem_of(name: str, *identity: object) -> str:
    """Return the stem of a module from all that shapes it, including the sources that emit it."""
    text = "\n".join([*map(str, identity), generator_digest()])
    return f"{name}_{hashlib.sha256(text.encode()).hexdigest()[:16]}"


def side_module(
    mechanism: Mechanism, name: str, identity: Sequence[object], make: Callable[[], tuple[str, dict[str, Any]]]
) -> tuple[dict[str, Any], Path]:
    """Return the description of a module next to a model's, from all that shapes it, and its path; emit a new one."""
    store, folder, stem = Entries(), folder_of(mechanism), stem_of(name, *identity)
    return store.description(folder, stem, make), store.path(folder, stem)


def digest_of_formulas(formulas: Iterable[Expr]) -> str:
    """Return what tells formulas apart, with the measures that they read, which a mechanism's digest may lack."""
    return hashlib.sha256(msgspec.msgpack.encode(list(formulas))).hexdigest()


def compile_side(
    mechanism: Mechanism,
    compiled: CompiledModel,
    name: str,
    purpose: str,
    formulas: Sequence[tuple[str, Expr]],
    rates: int = 0,
    sizes: bool = False,
) -> Side:
    """Return a function that evaluates formulas of a run, generated only if the cache does not have it.

    Parameters
    ----------
    mechanism : Mechanism
        Their mechanism: names are t, parameters, and coordinates and velocities of bodies.
    compiled : CompiledModel
        The model whose ``p`` and ``w`` the function reads.
    name, purpose : str
        Of the function; the module has its name.
    formulas : sequence of (str, Expr)
        Readable name of each, and the formula.
    rates : int
        Number of derivatives of all formulas along the motion after their values; they take v' from ``ydot``,
        as constant, and q' from the velocities.
    sizes : bool
        Whether the size that rounding of each formula is relative to follows these.

    Raises
    ------
    InputError
        If numbers that meet in a formula overflow.
    """
    labels = ["rate of " * k + label for k in range(rates + 1) for label, _ in formulas]
    labels += ["size of " + label for label, _ in formulas if sizes]
    around = compile_beside(mechanism, compiled)

    def make() -> tuple[str, dict[str, Any]]:
        from symgen.derive.emit.emit import emit_side
        from symgen.derive.lower.side_program import lower_side

        with refuse_overflow(purpose):
            program = lower_side(mechanism, name, purpose, formulas, around, rates, sizes)
        return emit_side(program), {"reads": list(program.reads), "of_forces": list(program.of_forces)}

    written = digest_of_formulas(e for _, e in formulas)
    identity = purpose, rates, around, list(integrals_of_outputs(mechanism)), *labels, written
    metadata, path = side_module(mechanism, name, identity, make)
    reads, of_forces = frozenset(metadata["reads"]), frozenset(metadata["of_forces"])
    return Side(getattr(load_module(path), name), path, tuple(labels), reads, of_forces)


def can_integrate(compiled: CompiledModel) -> bool:
    """Whether states of a compiled model can hold integrals of outputs; in methods with momenta they cannot."""
    return not hasattr(compiled.law_module, "rates")


def add_integrals(mechanism: Mechanism, compiled: CompiledModel) -> CompiledModel:
    """Return a compiled model whose state holds integrals of outputs; unchanged where they integrate nothing.

    Raises
    ------
    InputError
        If the method does not integrate velocities, or numbers that meet in a formula overflow.
    """
    formulas, info, law = integrals_of_outputs(mechanism), compiled.info, compiled.law_module
    if not formulas:
        return compiled
    if not can_integrate(compiled):
        expected = "a method that integrates velocities, as an output is an integral"
        raise InputError(f"method '{compiled.law.method}'", expected, "one that integrates momenta")
    auxiliary = compiled.law.nw, 1 + len(formulas)
    around = compile_beside(mechanism, compiled)
    around = replace(around, sections={**around.sections, "auxiliary": auxiliary})
    files = _files_of_module(law)
    stems = {name: file.stem for name, file in sorted(files.items())}
    written = digest_of_formulas(integral.of for integral in formulas)
    store, folder = Entries(), next(iter(files.values())).parent.name
    stem = stem_of("integrals", folder_of(mechanism), around, stems, written)

    def make() -> tuple[str, dict[str, Any]]:
        from symgen.derive.emit.emit import emit_integrals
        from symgen.derive.lower.side_program import lower_integrands

        with refuse_overflow("integrals of outputs"):
            program = lower_integrands(mechanism, around)
        return emit_integrals(program, stems, abi.POWER), {}

    store.description(folder, stem, make)
    return replace(
        compiled,
        info=msgspec.structs.replace(info, integrals=len(formulas), sections=info.sections | {"auxiliary": auxiliary}),
        law=msgspec.structs.replace(  # the last element of w belongs to looped code
            compiled.law, nw=sum(auxiliary) + 1, modules=tuple(dict.fromkeys((*stems.values(), *compiled.law.modules)))
        ),
        law_module=load_module(store.path(folder, stem)),
    )


def _files_of_module(law: Any) -> dict[str, Path]:
    """Return the source file of each emitted function of a law, by the function's name.

    That is the law's own module; where functions were gathered from several modules, as looped code's for implicit
    integrators are, it is the one that defines the function.
    """
    file = getattr(law, "__file__", None)
    if file is None:
        return {name: Path(inspect.getfile(plain_function(value))) for name, value in vars(law).items()}
    package = law.__name__.rpartition(".")[0]
    return {name: Path(file) for name, value in vars(law).items() if _is_emitted(value, package)}


def _is_emitted(value: object, package: str) -> bool:
    """Whether it is a function of a module of this package, compiled or not."""
    function = plain_function(value)
    return inspect.isfunction(function) and function.__module__.startswith(f"{package}.")
