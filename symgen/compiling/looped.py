"""From a mechanism to a compiled model in the looped shape.

    mechanism --instances--> kernels --tables--> compiled model

Kernels, laws and generic code stand in one folder of the cache that all mechanisms share; what belongs to a mechanism
alone are tables. SymPy and Jinja2 are imported only for kernels that no mechanism has used before.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import msgspec

from symgen.compiling.looped_model import LoopedModel, describe_model, diagonal, preparation
from symgen.describe.mechanism import Mechanism
from symgen.ir.program import FORMAT
from symgen.lower.looped.forms import FormInfo, form_key, form_stem, lower_form
from symgen.lower.looped.instances import Instance, instances
from symgen.lower.looped.kernels import KernelInfo, kernel_stem
from symgen.lower.looped.law import LoopedLawInfo, refuse_dense
from symgen.lower.looped.layout import STAGES
from symgen.lower.looped.shape import Shape
from symgen.lower.looped.tables import Forms, Tables, build_tables
from symgen.lower.record import record_form
from symgen.store.entries import Entries, FolderName
from symgen.store.modules import load_module

if TYPE_CHECKING:
    from symgen.methods._base import Method

#: Modules beside kernels and laws.
_MACHINE, _MODEL = "machine", "model"


def shared_folder(generator: str) -> str:
    """Return the name of the folder that all mechanisms share.

    Parameters
    ----------
    generator : str
        Digest of everything that shapes emitted code.
    """
    return str(FolderName("looped", generator, FORMAT))


def emit_missing(
    elements: Mapping[str, Instance],
    method: Method,
    options: Mapping[str, str],
    generator: str,
    known: Callable[[str], bool],
    forms: Mapping[str, str],
) -> dict[str, tuple[str, Mapping[str, Any]]]:
    """Derive and emit kernels, the law and the generic code, except those that are `known`.

    Parameters
    ----------
    elements : mapping of str to Instance
        An instance of each kernel, by the kernel's name.
    method, options : Method, mapping
        The law.
    generator : str
        Digest for the headers.
    known : callable
        Whether a module need not be emitted.
    forms : mapping of str to str
        Module of each kernel's part of the descriptor form; empty where no implicit integrator asks for it.
    """
    from symgen.emit.kernels import emit_form, emit_kernel
    from symgen.emit.looped import emit_looped_law, emit_machine, emit_shared_model
    from symgen.lower.looped.kernels import lower_kernel
    from symgen.lower.looped.law import lower_looped

    generator = generator[:16]
    modules: dict[str, tuple[str, Mapping[str, Any]]] = {}
    if not known(_MACHINE):
        modules[_MACHINE] = emit_machine(generator), {}
    if not known(_MODEL):
        modules[_MODEL] = emit_shared_model(generator), {}
    stem = law_stem(method, options)
    if not known(stem):
        law = lower_looped(method, options)
        sources = emit_looped_law(law, generator, method.summary, method.reference)
        *shared, _ = sources
        info = msgspec.structs.replace(law.info, modules=tuple(shared))
        modules |= {name: (sources[name], {}) for name in shared}
        modules[stem] = sources[stem], msgspec.to_builtins(info)
    for name, instance in elements.items():
        form = forms.get(name)
        if known(name) and (form is None or known(form)):
            continue
        from symgen.formulate.elements import derive_element

        element = derive_element(instance.abstract)
        kernel = lower_kernel(element, instance)
        if not known(name):
            modules[name] = emit_kernel(kernel, generator), msgspec.to_builtins(kernel.info)
        if form is not None and not known(form):
            part = lower_form(element, instance, method, options, form)
            modules[form] = emit_form(part, kernel.info, generator), msgspec.to_builtins(part.info)
    return modules


def form_stems(
    elements: Mapping[str, Instance], method: Method, options: Mapping[str, str], implicit: bool
) -> dict[str, str]:
    """Return the module of each kernel's part of a method's descriptor form; empty where it is not asked for."""
    if not implicit:
        return {}
    keys = {kind: form_key(method, options, kind) for kind in ("body", "joint", "force")}
    return {stem: form_stem(keys[instance.kind], stem) for stem, instance in elements.items()}


def law_stem(method: Method, options: Mapping[str, str]) -> str:
    """Return the file stem of a law; kernels begin with ``body``, ``joint`` or ``force``."""
    return f"law_{method.stem(options)}"


def compile_looped(
    mechanism: Mechanism,
    method: Method,
    options: Mapping[str, str],
    implicit: bool,
    generator: str,
) -> LoopedModel:
    """Return the compiled model of `mechanism` in the looped shape, what the cache has taken from there.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    method, options : Method, mapping
        The method with its structural options, complete.
    implicit : bool
        Whether an implicit integrator asks for it.
    generator : str
        Digest of everything that shapes emitted code.

    Raises
    ------
    InputError
        If the method needs dense algebra.
    """
    refuse_dense(method, options, implicit)
    began = time.perf_counter()
    store = Entries()
    folder, law = shared_folder(generator), law_stem(method, options)
    found = instances(mechanism)
    stems, elements = named(found)
    forms = form_stems(elements, method, options, implicit)
    wanted = (_MACHINE, _MODEL, law, *elements, *forms.values())
    metadata = _found(store, folder, law, wanted)
    emit_seconds = 0.0
    if any(data is None for data in metadata.values()):
        with store.building(folder):
            metadata = _found(store, folder, law, wanted)  # another process may have been faster
            emitting = time.perf_counter()
            modules = emit_missing(elements, method, options, generator, lambda stem: metadata[stem] is not None, forms)
            for stem, (source, data) in modules.items():
                store.put(folder, stem, source, data)
                metadata[stem] = dict(data)
            emit_seconds = time.perf_counter() - emitting
    infos = {stem: msgspec.convert(metadata[stem], KernelInfo) for stem in elements}
    info = msgspec.convert(metadata[law], LoopedLawInfo)
    shape = Shape(found, stems, infos, len(mechanism.parameters))
    parts = {stem: (form, msgspec.convert(metadata[form], FormInfo)) for stem, form in forms.items()}
    level = level_of(method, options, implicit)
    tables = law_tables(shape, info, parts, level)
    path = store.path(folder, _MODEL).parent
    kernels = {stem: load_module(path / f"{stem}.py") for stem in (*elements, *forms.values())}
    machine, model = load_module(path / f"{_MACHINE}.py"), load_module(path / f"{_MODEL}.py")
    model_info = describe_model(mechanism, shape, tables)
    functions = SimpleNamespace(
        **{name: getattr(model, name) for name in ("geometry", "spread", "measure", "observe", "move", "turn")}
    )
    law_module: Any = load_module(path / f"{law}.py")
    if implicit:
        names = [
            name for name in ("rhs", "confirm", "accept", "prepare", "geometry", "spread") if hasattr(law_module, name)
        ]
        found_functions = {name: getattr(law_module, name) for name in names}
        law_module = SimpleNamespace(**found_functions, residual=model.residual, tangent=model.tangent)
    functions.masses, functions.prepare = diagonal(shape, tables), preparation(mechanism, shape, tables, kernels)
    return LoopedModel(
        info=model_info,
        law=msgspec.structs.replace(
            info,
            parameter_offset=shape.parameters + shape.hoisted,
            nw=tables.nw,
            unknowns=tables.unknowns,
            level=level,
            tangent=tables.tangent,
            modules=(),
        ),
        model=functions,  # type: ignore[arg-type]  # functions by name, as a module has them
        law_module=law_module,
        derive_seconds=time.perf_counter() - began - emit_seconds,
        emit_seconds=emit_seconds,
        tables=tables,
        kernels=kernels,
        machine=machine,
    )


def _found(store: Entries, folder: str, law: str, wanted: Iterable[str]) -> dict[str, dict[str, Any] | None]:
    """Return the metadata of modules, None for those that are not there: a law without its parts is not."""
    metadata = {stem: store.get(folder, stem) for stem in wanted}
    own = metadata[law]
    if own is not None and any(store.get(folder, stem) is None for stem in own["modules"]):
        metadata[law] = None
    return metadata


def generate_looped(
    mechanism: Mechanism, methods: Sequence[tuple[Method, Mapping[str, str], bool]], generator: str
) -> dict[str, tuple[str, Mapping[str, Any]]]:
    """Return the source of everything that a mechanism and some methods need, with metadata, by file stem.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    methods : sequence of (Method, mapping, bool)
        Methods with their structural options, complete, and whether implicit integrators ask for them.
    generator : str
        Digest of everything that shapes emitted code.

    Returns
    -------
    dict
        Generic code, kernels and laws, which are the same for all mechanisms; ``mechanism`` says how often each kernel
        is used, and its metadata are the tables for every law.
    """
    from symgen.emit.looped import emit_mechanism

    found = instances(mechanism)
    stems, elements = named(found)
    modules: dict[str, tuple[str, Mapping[str, Any]]] = {}
    tables: dict[str, Any] = {}
    for method, options, implicit in methods:
        refuse_dense(method, options, implicit)
        forms = form_stems(elements, method, options, implicit)
        modules |= emit_missing(elements, method, options, generator, modules.__contains__, forms)
        law = law_stem(method, options)
        infos = {stem: msgspec.convert(modules[stem][1], KernelInfo) for stem in elements}
        shape = Shape(found, stems, infos, len(mechanism.parameters))
        parts = {stem: (form, msgspec.convert(modules[form][1], FormInfo)) for stem, form in forms.items()}
        info, level = msgspec.convert(modules[law][1], LoopedLawInfo), level_of(method, options, implicit)
        built = law_tables(shape, info, parts, level)
        functions = [f"{stem}.{name}" for stem, name in built.functions]
        tables[f"{law}_implicit" if implicit else law] = {
            "numbers": list(built.numbers),
            "functions": functions,
            "sections": dict(built.sections),
        }
    modules["mechanism"] = emit_mechanism(mechanism.name, {stem: stems.count(stem) for stem in elements}), tables
    return modules


def law_tables(shape: Shape, info: LoopedLawInfo, parts: Mapping[str, tuple[str, FormInfo]], level: str) -> Tables:
    """Return the tables of a mechanism for a law, with the parts of its descriptor form by kernel."""
    stages = [name for name in STAGES if name != "full" or info.positions]
    forms = Forms(level, parts) if parts else None
    return build_tables(shape, info.sections, info.vectors, info.augmented, stages, forms)


def level_of(method: Method, options: Mapping[str, str], implicit: bool) -> str:
    """Return the level of a method's descriptor form, empty where there is none."""
    return record_form(method, options).form if implicit else ""


def named(found: Sequence[Instance]) -> tuple[list[str], dict[str, Instance]]:
    """Return the name of each instance's kernel, and an instance of each kernel by its name."""
    names: dict[bytes, str] = {}
    elements: dict[str, Instance] = {}
    stems = []
    for instance in found:
        stem = names.get(instance.key)
        if stem is None:
            stem = names[instance.key] = kernel_stem(instance)
            elements.setdefault(stem, instance)
        stems.append(stem)
    return stems, elements
