"""The stages of looped code: kernels of elements, laws and generic code, and tables for one mechanism.

    mechanism --formulate--> elements --lower--> kernels and laws --emit--> source --compile--> code with tables

Kernels, laws and generic code are in one folder of the cache that all mechanisms share; what belongs to a mechanism
alone are tables. Elements are derived only for kernels that no mechanism has used before.
"""

from __future__ import annotations

import itertools
import json
import re
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any, NamedTuple, final

import msgspec

from symgen.base.vocabulary.infos import LawInfo
from symgen.compile.store.entries import Modules
from symgen.compile.store.loaded_modules import load_module
from symgen.derive.lower.law import refuse_bounded_rows
from symgen.derive.lower.looped.forms import FormInfo, form_key, form_stem, lower_form
from symgen.derive.lower.looped.index_tables import Builder, IndexTables
from symgen.derive.lower.looped.instances import Instance, instances_of_mechanism
from symgen.derive.lower.looped.kernels import KernelInfo, kernel_stem
from symgen.derive.lower.looped.layout import BOTH, KINDS, PRESSED, TOUCHED
from symgen.derive.lower.looped.looped_law import LoopedLawInfo, refuse_dense
from symgen.derive.lower.looped.shape import LoopedShape
from symgen.derive.lower.record_form import record_form
from symgen.derive.lower.recorded_law import BEHIND
from symgen.describe.bounds.by_reaction import pressed_rows
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.folders import generator_digest, shared_folder
from symgen.run.compiling.looped_model import LoopedModel, describe_model, filler_of_hoisted, mass_diagonal_of
from symgen.run.compiling.method_choice import MethodChoice
from symgen.run.compiling.stages import Generated, PipelineStages

if TYPE_CHECKING:
    from symgen.derive.formulate.elements import Element
    from symgen.derive.lower.looped.forms import FormProgram
    from symgen.derive.lower.looped.kernels import KernelProgram
    from symgen.derive.lower.looped.looped_law import LoopedLaw

#: Modules other than kernels and laws.
_MACHINE, _MODEL, _ROTORS = "machine", "model", "rotors"


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
        return f"law_{self.choice.method.stem(self.choice.options)}{self.drags}"

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
        """Whether equations of the file's states are between the others and rows for projections."""
        choice = self.choice
        return bool(self.mechanism.states) and record_form(choice.method, choice.options).form in BEHIND

    @property
    def modules(self) -> tuple[str, ...]:
        """All modules."""
        rotors = [_ROTORS] if self.has_rotors else []
        return (_MACHINE, _MODEL, *rotors, self.law, *self.elements, *self.forms.values())

    @property
    def drags(self) -> str:
        """The kind of efforts that depend on reactions, which another right-hand side finds, else empty."""
        kinds = {row.signed for row in pressed_rows(self.mechanism)}
        return "" if not kinds else BOTH if len(kinds) > 1 else TOUCHED if True in kinds else PRESSED

    @property
    def has_rotors(self) -> bool:
        """Whether M couples bodies, which other generic code is for."""
        return any(instance.kind == "rotor" for instance in self.instances)

    def lay_out(self, metadata: Mapping[str, Mapping[str, Any]]) -> tuple[LoopedShape, IndexTables, LawInfo]:
        """Return the mechanism's indices, its tables and the law's facts for these, from all metadata."""
        choice = self.choice
        infos = {stem: msgspec.convert(metadata[stem], KernelInfo) for stem in self.elements}
        law = msgspec.convert(metadata[self.law], LoopedLawInfo)
        shape = LoopedShape(self.instances, self.stems, infos, len(self.mechanism.parameters))
        parts = {stem: (form, msgspec.convert(metadata[form], FormInfo)) for stem, form in self.forms.items()}
        level = record_form(choice.method, choice.options).form if choice.implicit else ""
        tables = Builder(shape, law, level, parts).finished_tables()
        sizes = {"nw": tables.nw, "unknowns": tables.unknowns, "level": level, "tangent": tables.tangent}
        first = shape.parameters + shape.hoisted
        return shape, tables, msgspec.structs.replace(law, parameter_offset=first, modules=(), **sizes)


class LoopedPrograms(NamedTuple):
    """Kernels of elements with the parts of descriptor forms, and laws, by their modules."""

    kernels: Mapping[str, KernelProgram]
    forms: Mapping[str, FormProgram]
    laws: Mapping[str, LoopedLaw]


@final
class LoopedStages(PipelineStages[Mapping[str, "Element"], LoopedPrograms]):
    """The stages of looped code.

    Parameters
    ----------
    mechanism, choices, whole
        As of `symgen.run.compiling.pipeline.generate`.
    heading : str, optional
        What headers say instead of the digest of everything that shapes emitted code.

    Raises
    ------
    InputError
        If a method needs dense algebra, or finds no multipliers where efforts depend on reactions.
    """

    def __init__(
        self, mechanism: Mechanism, choices: tuple[MethodChoice, ...], whole: bool = False, heading: str = ""
    ) -> None:
        self.began, self.heading = time.perf_counter(), (heading or generator_digest())[:16]
        super().__init__(mechanism, choices, shared_folder(), whole)
        for choice in choices:
            _refuse_loops(mechanism, choice)
        elements = instances_of_mechanism(mechanism)
        self.needs = tuple(Needs(mechanism, choice, elements) for choice in choices)

    @property
    def stems(self) -> tuple[str, ...]:
        """Generic code, laws, kernels and their parts of descriptor forms."""
        return tuple(dict.fromkeys(stem for needs in self.needs for stem in needs.modules))

    def formulate(self) -> Mapping[str, Element]:
        """Return the derived elements of those kernels that do not exist, or not with all their forms."""
        missing = {
            stem: instance
            for needs in self.needs
            for stem, instance in needs.elements.items()
            if {stem, needs.forms.get(stem, stem)} - self.described.keys()
        }
        if not missing:
            return {}
        from symgen.derive.formulate.elements import derive_element

        with self.emitting():
            return {stem: derive_element(instance.abstract) for stem, instance in missing.items()}

    def lower(self, equations: Mapping[str, Element]) -> LoopedPrograms:
        """Return the programs of these elements, and of those laws that do not exist."""
        from symgen.derive.lower.looped.kernels import lower_kernel
        from symgen.derive.lower.looped.looped_law import lower_looped

        kernels: dict[str, KernelProgram] = {}
        forms: dict[str, FormProgram] = {}
        laws: dict[str, LoopedLaw] = {}
        with self.emitting():
            for needs in self.needs:
                method, options = needs.choice.method, needs.choice.options
                if needs.law not in self.described and needs.law not in laws:
                    laws[needs.law] = lower_looped(method, options)
                for stem, element in equations.items():
                    instance, form = needs.elements[stem], needs.forms.get(stem)
                    if stem not in kernels:
                        kernels[stem] = lower_kernel(element, instance)
                    if form is not None and form not in self.described and form not in forms:
                        forms[form] = lower_form(element, instance, method, options, form)
        return LoopedPrograms(kernels, forms, laws)

    def emit(self, programs: LoopedPrograms) -> Modules:
        """Return the sources of those modules that do not exist."""
        from symgen.derive.emit.looped_modules import emit_machine, emit_rotors, emit_shared_model

        modules = dict[str, tuple[str, Mapping[str, Any]]]()
        rotors = any(needs.has_rotors for needs in self.needs)
        generic = {_MACHINE: emit_machine, _MODEL: emit_shared_model} | ({_ROTORS: emit_rotors} if rotors else {})
        with self.emitting():
            for stem, emit in generic.items():
                if stem not in self.described:
                    modules[stem] = emit(self.heading), {}
            for needs in self.needs:
                if needs.law in programs.laws and needs.law not in modules:
                    modules |= self._law(needs, programs.laws[needs.law])
                for stem, kernel in programs.kernels.items():
                    modules |= self._kernel(needs, stem, kernel, programs, modules)
        return modules

    def _law(self, needs: Needs, law: LoopedLaw) -> Modules:
        """Return the sources of a law, those that other laws share first."""
        from symgen.derive.emit.looped_modules import emit_looped_law

        method = needs.choice.method
        words = method.summary, method.reference
        sources = emit_looped_law(law, self.heading, *words, self.whole, needs.drags)
        *shared, _ = sources
        info = msgspec.structs.replace(law.info, modules=tuple(shared))
        return {stem: (source, {}) for stem, source in sources.items()} | {
            needs.law: (sources[needs.law], info.to_dict())
        }

    def _kernel(
        self, needs: Needs, stem: str, kernel: KernelProgram, programs: LoopedPrograms, emitted: Modules
    ) -> Modules:
        """Return the sources of a kernel and of its form for one method, without those that exist."""
        from symgen.derive.emit.kernel_modules import emit_form, emit_kernel

        modules: dict[str, tuple[str, Mapping[str, Any]]] = {}
        form = needs.forms.get(stem)
        if stem not in self.described and stem not in emitted:
            modules[stem] = emit_kernel(kernel, self.heading), msgspec.to_builtins(kernel.info)
        if form is not None and form in programs.forms and form not in emitted:
            part = programs.forms[form]
            source = emit_form(part, kernel.info, self.heading, needs.shifted)
            modules[form] = source, msgspec.to_builtins(part.info)
        return modules

    def compile(self, sources: Modules) -> LoopedModel:
        """Return the compiled model with the one law of `choices`, and with the tables of the mechanism."""
        self.keep(sources)
        (needs,), mechanism = self.needs, self.mechanism
        shape, tables, law = needs.lay_out(self.described)
        path = self.store.path(self.folder, _MODEL).parent
        kernels = {stem: load_module(path / f"{stem}.py") for stem in (*needs.elements, *needs.forms.values())}
        machine, model = load_module(path / f"{_MACHINE}.py"), load_module(path / f"{_MODEL}.py")
        info, law_module = describe_model(mechanism, shape, tables), load_module(path / f"{needs.law}.py")
        functions = _gather_functions(model, "geometry", "spread", "measure", "observe", "move", "turn")
        functions.masses, functions.prepare = (
            mass_diagonal_of(shape, tables),
            filler_of_hoisted(mechanism, shape, tables, kernels),
        )
        if needs.choice.implicit:
            law_module = _gather_functions(
                law_module, "rhs", "confirm", "accept", "prepare", "geometry", "spread", "balance"
            )
            law_module.residual, law_module.tangent = model.residual, model.tangent
        return LoopedModel(
            info=info,
            law=law,
            model=functions,
            law_module=law_module,
            derive_seconds=time.perf_counter() - self.began - self.emit_seconds,
            emit_seconds=self.emit_seconds,
            tables=tables,
            kernels=kernels,
            machine=machine,
            generic=load_module(path / f"{_ROTORS}.py") if needs.has_rotors else machine,
        )

    def collect(self, sources: Modules) -> Generated:
        """Return the sources, and as ``mechanism``, which has no source, the tables for every law.

        As whole modules, kernels have readable names; see `number_kernels`.
        """
        modules, tables = dict(sources), dict[str, Any]()
        for needs in self.needs:
            _, built, _ = needs.lay_out({stem: modules[stem][1] for stem in needs.modules})
            tables[f"{needs.law}_implicit" if needs.choice.implicit else needs.law] = {
                "numbers": list(built.numbers),
                "functions": [f"{stem}.{name}" for stem, name in built.functions],
                "sections": dict(built.sections),
            }
        modules["mechanism"] = "", tables
        named = _readable_modules(modules) if self.whole else modules
        return Generated(self.folder, named, 0.0, time.perf_counter() - self.began)


def _refuse_loops(mechanism: Mechanism, choice: MethodChoice) -> None:
    """Refuse methods that loops, rows that may be off, or efforts that depend on reactions, do not take."""
    refuse_dense(choice.method, choice.options, choice.implicit)
    if mechanism.has_modes:
        pressed = next((row.family.noun for row in pressed_rows(mechanism)), "")
        refuse_bounded_rows(choice.method, choice.options, choice.implicit, pressed)


def _gather_functions(module: ModuleType, *names: str) -> Any:
    """Return those functions that this module has, by name, as a module has them."""
    return SimpleNamespace(**{name: getattr(module, name) for name in names if hasattr(module, name)})


#: Stem of a kernel, or of its part of a descriptor form, with the digest of its content.
_STEM = re.compile(
    r"\b(?:form_[0-9a-f]{8}_)?((?:body|joint|bound|drag|rotor|force|state)_\w+?)_[0-9a-f]{16}\b", re.ASCII
)


def _readable_modules(modules: Modules) -> Modules:
    """Return modules under readable names, which import each other from one folder."""
    from symgen.derive.emit.whole import import_siblings_by_name

    names = number_kernels(modules)

    def name_of_part(text: str) -> str:
        return _STEM.sub(lambda match: names.get(match[0], match[0]), text)

    return {
        names.get(stem, stem): (
            import_siblings_by_name(name_of_part(source)),
            json.loads(name_of_part(json.dumps(metadata))),
        )
        for stem, (source, metadata) in modules.items()
    }


def number_kernels(stems: Iterable[str]) -> dict[str, str]:
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
