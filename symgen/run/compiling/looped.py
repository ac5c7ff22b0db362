"""From a mechanism to a compiled model in the looped shape.

    mechanism --instances--> kernels --tables--> compiled model

Kernels, laws and generic code are in one folder of the cache that all mechanisms share; what belongs to a mechanism
alone are tables. SymPy and Jinja2 are imported only for kernels that no mechanism has used before.
"""

from __future__ import annotations

import itertools
import json
import re
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any

import msgspec

from symgen.base.ir.program import FORMAT
from symgen.base.vocabulary.infos import LawInfo
from symgen.compile.store.entries import Entries, Modules, folder_name
from symgen.compile.store.modules import load_module
from symgen.derive.lower.law import refuse_bounded_rows
from symgen.derive.lower.looped.forms import FormInfo, form_key, form_stem, lower_form
from symgen.derive.lower.looped.instances import Instance, instances
from symgen.derive.lower.looped.kernels import KernelInfo, kernel_stem
from symgen.derive.lower.looped.law import LoopedLawInfo, refuse_dense
from symgen.derive.lower.looped.layout import KINDS, PRESSED
from symgen.derive.lower.looped.shape import LoopedShape
from symgen.derive.lower.looped.tables import Builder, IndexTables
from symgen.derive.lower.record import BEHIND
from symgen.derive.lower.record_form import record_form
from symgen.describe.bounds.by_reaction import held_by_reactions
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.looped_model import LoopedModel, describe_model, diagonal, hoisting

if TYPE_CHECKING:
    from symgen.run.compiling.method_choice import MethodChoice

#: Modules other than kernels and laws.
_MACHINE, _MODEL, _ROTORS = "machine", "model", "rotors"


def shared_folder(generator: str) -> str:
    """Return the name of the folder that all mechanisms share.

    Parameters
    ----------
    generator : str
        Digest of everything that shapes emitted code.
    """
    return folder_name("looped", generator, FORMAT)


def kernel_stems(elements: Sequence[Instance]) -> list[str]:
    """Return the module of each instance's kernel."""
    names: dict[bytes, str] = {}
    return [names.get(i.key) or names.setdefault(i.key, kernel_stem(i)) for i in elements]


@dataclass(frozen=True)
class Needs:
    """Modules that a mechanism needs for a method, all shared with other mechanisms.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    choice : MethodChoice
        The method.
    instances : tuple of Instance
        Its bodies, joints, forces and states.
    """

    mechanism: Mechanism
    choice: MethodChoice
    instances: tuple[Instance, ...]

    @cached_property
    def stems(self) -> list[str]:
        """Module of each instance's kernel."""
        return kernel_stems(self.instances)

    @cached_property
    def elements(self) -> dict[str, Instance]:
        """The first instance of each kernel, by its module."""
        elements: dict[str, Instance] = {}
        for stem, instance in zip(self.stems, self.instances, strict=True):
            elements.setdefault(stem, instance)
        return elements

    @property
    def law(self) -> str:
        """Module of the law; kernels begin with the kind of element."""
        return f"law_{self.choice.method.stem(self.choice.options)}{PRESSED if self.has_drags else ''}"

    @cached_property
    def forms(self) -> dict[str, str]:
        """Module of each kernel's part of the descriptor form; empty without an implicit integrator."""
        choice = self.choice
        if not choice.implicit:
            return {}
        keys = {kind: form_key(choice.method, choice.options, kind, self.shifted) for kind in KINDS}
        return {stem: form_stem(keys[instance.kind], stem) for stem, instance in self.elements.items()}

    @property
    def shifted(self) -> bool:
        """Whether equations of states of the file stand between the others and rows for projections."""
        choice = self.choice
        return bool(self.mechanism.states) and record_form(choice.method, choice.options).form in BEHIND

    @property
    def modules(self) -> tuple[str, ...]:
        """All modules."""
        rotors = [_ROTORS] if self.has_rotors else []
        return (_MACHINE, _MODEL, *rotors, self.law, *self.elements, *self.forms.values())

    @property
    def has_drags(self) -> bool:
        """Whether efforts depend on reactions, which another right-hand side finds."""
        return any(instance.kind == "drag" for instance in self.instances)

    @property
    def has_rotors(self) -> bool:
        """Whether M couples bodies, which other generic code is for."""
        return any(instance.kind == "rotor" for instance in self.instances)

    def missing(self, exists: Callable[[str], bool], generator: str, whole: bool = False) -> Modules:
        """Derive and emit kernels, the law and the generic code, with metadata, except those that exist.

        Parameters
        ----------
        exists : callable
            Whether a module need not be emitted.
        generator : str
            Digest for the headers.
        whole : bool
            Whether the law is one module.
        """
        from symgen.derive.emit.kernel_modules import emit_form, emit_kernel
        from symgen.derive.emit.looped import emit_looped_law, emit_machine, emit_rotors, emit_shared_model
        from symgen.derive.lower.looped.kernels import lower_kernel
        from symgen.derive.lower.looped.law import lower_looped

        generator, method, options = generator[:16], self.choice.method, self.choice.options
        modules: dict[str, tuple[str, dict[str, Any]]] = {}
        if not exists(_MACHINE):
            modules[_MACHINE] = emit_machine(generator), {}
        if not exists(_MODEL):
            modules[_MODEL] = emit_shared_model(generator), {}
        if self.has_rotors and not exists(_ROTORS):
            modules[_ROTORS] = emit_rotors(generator), {}
        if not exists(self.law):
            law = lower_looped(method, options)
            sources = emit_looped_law(law, generator, method.summary, method.reference, whole, self.has_drags)
            *shared, _ = sources
            modules |= {name: (source, {}) for name, source in sources.items()}
            info = msgspec.structs.replace(law.info, modules=tuple(shared))
            modules[self.law] = sources[self.law], info.to_dict()
        for name, instance in self.elements.items():
            form = self.forms.get(name)
            if exists(name) and (form is None or exists(form)):
                continue
            from symgen.derive.formulate.elements import derive_element

            element = derive_element(instance.abstract)
            kernel = lower_kernel(element, instance)
            if not exists(name):
                modules[name] = emit_kernel(kernel, generator), msgspec.to_builtins(kernel.info)
            if form is not None and not exists(form):
                part = lower_form(element, instance, method, options, form)
                modules[form] = emit_form(part, kernel.info, generator, self.shifted), msgspec.to_builtins(part.info)
        return modules

    def laid_out(self, metadata: Mapping[str, Mapping[str, Any]]) -> tuple[LoopedShape, IndexTables, LawInfo]:
        """Return the mechanism's indices, its tables and the law's facts for these, from all metadata."""
        choice = self.choice
        infos = {stem: msgspec.convert(metadata[stem], KernelInfo) for stem in self.elements}
        law = msgspec.convert(metadata[self.law], LoopedLawInfo)
        shape = LoopedShape(self.instances, self.stems, infos, len(self.mechanism.parameters))
        parts = {stem: (form, msgspec.convert(metadata[form], FormInfo)) for stem, form in self.forms.items()}
        level = record_form(choice.method, choice.options).form if choice.implicit else ""
        tables = Builder(shape, law, level, parts).tables()
        sizes = {"nw": tables.nw, "unknowns": tables.unknowns, "level": level, "tangent": tables.tangent}
        first = shape.parameters + shape.hoisted
        return shape, tables, msgspec.structs.replace(law, parameter_offset=first, modules=(), **sizes)


def compile_looped(mechanism: Mechanism, choice: MethodChoice, generator: str) -> LoopedModel:
    """Return the compiled model of `mechanism` in the looped shape, from the cache as far as possible.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    choice : MethodChoice
        The method with its structural options, and whether it is for an implicit integrator.
    generator : str
        Digest of everything that shapes emitted code.

    Raises
    ------
    InputError
        If the method needs dense algebra, or finds no multipliers where efforts depend on reactions.
    """
    _refuse(mechanism, choice)
    began, took = time.perf_counter(), 0.0
    store, folder, needs = Entries(), shared_folder(generator), Needs(mechanism, choice, instances(mechanism))

    def make(exists: Callable[[str], bool]) -> Modules:
        nonlocal took
        emitting = time.perf_counter()
        modules = needs.missing(exists, generator)
        took = time.perf_counter() - emitting
        return modules

    metadata = store.descriptions(folder, needs.modules, make)
    shape, tables, law = needs.laid_out(metadata)
    path = store.path(folder, _MODEL).parent
    kernels = {stem: load_module(path / f"{stem}.py") for stem in (*needs.elements, *needs.forms.values())}
    machine, model = load_module(path / f"{_MACHINE}.py"), load_module(path / f"{_MODEL}.py")
    info, law_module = describe_model(mechanism, shape, tables), load_module(path / f"{needs.law}.py")
    functions = _gathered(model, "geometry", "spread", "measure", "observe", "move", "turn")
    functions.masses, functions.prepare = diagonal(shape, tables), hoisting(mechanism, shape, tables, kernels)
    if choice.implicit:
        law_module = _gathered(law_module, "rhs", "confirm", "accept", "prepare", "geometry", "spread")
        law_module.residual, law_module.tangent = model.residual, model.tangent
    return LoopedModel(
        info=info,
        law=law,
        model=functions,
        law_module=law_module,
        derive_seconds=time.perf_counter() - began - took,
        emit_seconds=took,
        tables=tables,
        kernels=kernels,
        machine=machine,
        generic=load_module(path / f"{_ROTORS}.py") if needs.has_rotors else machine,
    )


def _refuse(mechanism: Mechanism, choice: MethodChoice) -> None:
    """Refuse methods that loops, or efforts that depend on reactions, do not take."""
    refuse_dense(choice.method, choice.options, choice.implicit)
    for row in held_by_reactions(mechanism):
        refuse_bounded_rows(choice.method, choice.options, choice.implicit, row.family.noun)


def _gathered(module: ModuleType, *names: str) -> Any:
    """Return those functions that this module has, by name, as a module has them."""
    return SimpleNamespace(**{name: getattr(module, name) for name in names if hasattr(module, name)})


def generate_looped(
    mechanism: Mechanism, choices: Sequence[MethodChoice], generator: str, whole: bool = False
) -> Modules:
    """Return the source of everything that a mechanism and some methods need, with metadata, by file stem.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    choices : sequence of MethodChoice
        Methods with their structural options, and whether they are for implicit integrators.
    generator : str
        Digest of everything that shapes emitted code.
    whole : bool
        Whether each law is one module, and kernels have readable names; see `numbered`.

    Returns
    -------
    mapping
        Generic code, kernels and laws, which are the same for all mechanisms; the metadata of ``mechanism``, which has
        no source, are the tables for every law.
    """
    from symgen.derive.emit.whole import absolute

    modules: dict[str, tuple[str, Mapping[str, Any]]] = {}
    tables: dict[str, Any] = {}
    elements = instances(mechanism)
    for choice in choices:
        _refuse(mechanism, choice)
        needs = Needs(mechanism, choice, elements)
        modules |= needs.missing(modules.__contains__, generator, whole)
        _, built, _ = needs.laid_out({stem: modules[stem][1] for stem in needs.modules})
        tables[f"{needs.law}_implicit" if choice.implicit else needs.law] = {
            "numbers": list(built.numbers),
            "functions": [f"{stem}.{name}" for stem, name in built.functions],
            "sections": dict(built.sections),
        }
    modules["mechanism"] = "", tables
    if not whole:
        return modules
    names = numbered(modules)

    def named(text: str) -> str:
        return _STEM.sub(lambda match: names.get(match[0], match[0]), text)

    return {
        names.get(stem, stem): (absolute(named(source)), json.loads(named(json.dumps(metadata))))
        for stem, (source, metadata) in modules.items()
    }


#: Stem of a kernel, or of its part of a descriptor form, with the digest of its content.
_STEM = re.compile(
    r"\b(?:form_[0-9a-f]{8}_)?((?:body|joint|bound|drag|rotor|force|state)_\w+?)_[0-9a-f]{16}\b", re.ASCII
)


def numbered(stems: Iterable[str]) -> dict[str, str]:
    """Return names of kernels with numbers instead of digests: ``joint_revolute``, ``joint_revolute_2``."""
    names: dict[str, str] = {}
    for stem in stems:
        if match := _STEM.fullmatch(stem):
            first = name = f"{'form_' if stem.startswith('form_') else ''}{match[1]}"
            for count in itertools.count(2):
                if name not in names.values():
                    break
                name = f"{first}_{count}"
            names[stem] = name
    return names
