"""Functions of starts and events bound to one compiled model, for printers of other languages."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.compiling.checked import checked_function
from symgen.effects.applying import apply_effects
from symgen.effects.stepping import new_step_work, step_to_event
from symgen.layout import abi
from symgen.layout.ensemble_abi import N_SUMMARY
from symgen.layout.start_records import Instant, StartConditions
from symgen.loopcode.exact import compiled_form
from symgen.native import language as lang
from symgen.native import types
from symgen.native.binding import BoundFunctions, ConstantTable, Elements, Meaning, Room, bind
from symgen.native.loop_values import laid_out
from symgen.native.loops import read_loop
from symgen.native.read_values import Foreign
from symgen.starts.assembler import layout_of
from symgen.starts.starting import close_row

if TYPE_CHECKING:
    from symgen.effects.effects import Effects
    from symgen.layout.compiled import CompiledModel
    from symgen.starts.assembler import Assembly

#: Name of an array in the memory, by the parameter; None where it is constant, empty where it is passed.
Naming = Callable[[str], str | None]


def source_of(function: Any) -> lang.Function:
    """Return a function of the runtime, whose callees are functions of their own.

    Raises
    ------
    Foreign
        If nothing is compiled, so that no types are known.
    """
    signature = getattr(compiled_form(function), "signature", None)
    if signature is None:
        raise Foreign("been left to Python, by NUMBA_DISABLE_JIT")
    return read_loop(compiled_form(function), signature.arguments, None, apart=True)


def meanings_of(
    function: Any, arguments: tuple[Any, ...], emitted: Mapping[int, lang.Function], room: Naming
) -> dict[str, Meaning]:
    """Return the meanings of a function's parameters for the arguments of a call.

    Parameters
    ----------
    function : Exact
        The function, with a signature.
    arguments : tuple
        Records, numbers, arrays and functions, as it is called with them.
    emitted : mapping of int to Function
        Emitted functions by the identity of those in the arguments; others are functions of the runtime.
    room : callable
        See `Naming`.
    """
    compiled = compiled_form(function)
    assert compiled.signature is not None, "an entry has a signature"
    names = compiled.py_func.__code__.co_varnames
    meanings = dict[str, Meaning]()
    for name, kind, argument in zip(names, compiled.signature.arguments, arguments, strict=False):
        _, parameters = laid_out(name, kind)
        for parameter, value in zip(parameters, _items(kind, argument), strict=True):
            meanings[parameter.name] = _meaning(parameter, value, emitted, room)
    return meanings


def _items(kind: types.Kind, value: Any) -> Iterator[Any]:
    """Yield numbers, arrays and functions of an argument in the order of parameters."""
    if isinstance(kind, types.RecordType):
        for part, item in zip(kind, value, strict=True):
            yield from _items(part, item)
    else:
        yield value


def _meaning(
    parameter: lang.FunctionParameter, value: Any, emitted: Mapping[int, lang.Function], room: Naming
) -> Meaning:
    if parameter.address:
        return emitted[id(value)] if id(value) in emitted else source_of(value)
    if not parameter.array:
        if value is None:
            return None
        number = float(value) if parameter.type == "float" else int(value)
        return lang.Constant(parameter.type, number)
    name, values = room(parameter.name), np.ravel(value)
    if name is not None:
        return Room(name, len(values)) if name else Elements(len(values))
    table = tuple(values.tolist())
    return ConstantTable(parameter.name.rpartition(".")[2], parameter.type, table)


@dataclass(frozen=True)
class Printed:
    """Functions of the runtime for one compiled model in another language.

    Attributes
    ----------
    emitted : dict of str to Function
        Emitted functions by their names in the text; those that starts need further are added.
    entries : dict
        Functions of the runtime by their names in the text, with the meanings of their parameters.
    """

    emitted: dict[str, lang.Function]
    entries: dict[str, tuple[lang.Function, dict[str, Meaning]]] = field(default_factory=dict)

    def bound(self) -> BoundFunctions:
        """Return the functions bound to the model."""
        return bind(self.entries, frozenset(f.key for f in self.emitted.values()))

    def add_effects(self, effects: Effects, formulas: str) -> None:
        """Add ``apply_effects(t, y)``, which changes a state by the effects of the events in ``chosen``.

        Parameters
        ----------
        effects : Effects
            The effects.
        formulas : str
            Name of the function of their formulas in the text.
        """
        info, scratch = effects.compiled.info, effects.compiled.scratch()
        layout, geometry, of_formulas, of_bodies, changes = effects.model
        functions = {id(geometry): self.emitted["geometry"], id(of_formulas): self.emitted[formulas]}
        if effects.bodies:
            functions[id(of_bodies)] = self.emitted["bodies"]
        now = Instant(np.zeros(info.ny), np.zeros(1), scratch)
        work = effects.memory(info.ny, len(scratch))
        chosen = effects.chosen(())

        def room(name: str) -> str | None:
            if name.startswith("now."):
                return name.removeprefix("now.").replace("y", "")
            own = name.removeprefix("work.").replace(".", "_")
            return "chosen" if name == "chosen" else f"effect_{own}" if name.startswith("work.") else None

        model = layout, geometry, of_formulas, of_bodies, changes
        meanings = meanings_of(apply_effects, (model, None, now, chosen, work), functions, room)
        self.entries["apply_effects"] = source_of(apply_effects), meanings

    def add_steps(self, compiled: CompiledModel, functions: Any, switching: str, directions: Sequence[int]) -> None:
        """Add ``step_to_event(t, h, y)``; see `symgen.effects.stepping`.

        Parameters
        ----------
        compiled : CompiledModel
            Model and method.
        functions : emitted function
            Switching functions of all events.
        switching : str
            Name of their function in the text.
        directions : sequence of int
            Of each event, as in `symgen.effects.stepping.STEP_MODEL`.
        """
        law, scratch, ny = compiled.law_module, compiled.scratch(), compiled.info.ny
        confirm = getattr(law, "confirm", law.rhs)
        emitted = {id(law.rhs): "rhs", id(confirm): "confirm" if confirm is not law.rhs else "rhs"}
        emitted |= {id(law.accept): "accept", id(functions): switching}
        model = layout_of(compiled), law.rhs, confirm, law.accept, functions, np.array(directions, dtype=np.int64)
        now = Instant(np.zeros(ny), compiled.parameter_array(defaultdict(float), {}), scratch)
        work = new_step_work(ny, len(scratch), len(directions))

        def room(name: str) -> str | None:
            if name == "work.chosen" or name.startswith("now."):
                return name.partition(".")[2].replace("y", "")
            own = name.removeprefix("work.")
            return f"step_{own}" if name != own else "iw" if name == "iw" else None

        arguments = model, None, None, now, np.zeros(abi.N_COUNTERS, dtype=np.int64), work
        meanings = meanings_of(step_to_event, arguments, {k: self.emitted[n] for k, n in emitted.items()}, room)
        self.entries["step_to_event"] = source_of(step_to_event), meanings

    def add_start(self, assembly: Assembly) -> None:
        """Add ``close_row()``, which makes the start of the model consistent; see `symgen.starts.starting`.

        Parameters
        ----------
        assembly : Assembly
            The start, in which no joint coordinates are held.
        """
        joints, work = assembly.memory()
        *own, observe = map(compiled_form, assembly.own)
        compiled, functions = assembly.compiled, dict[int, lang.Function]()
        for name, kind, function in zip(_NAMES, _KINDS, own, strict=True):
            if kind is not None and getattr(compiled.model, name, None) is function:
                if name not in self.emitted:
                    self.emitted[name] = checked_function(function, kind)
                functions[id(function)] = self.emitted[name]
        functions[id(own[-1])] = self.emitted["rhs"]
        scratch = compiled.scratch()
        now = Instant(np.zeros(compiled.info.ny), compiled.parameter_array(defaultdict(float), {}), scratch)
        conditions = StartConditions(np.zeros(assembly.layout.nv), np.zeros(0), np.zeros(N_SUMMARY))

        def room(name: str) -> str | None:
            owner, _, own = name.partition(".")
            return own if owner == "now" else f"start_{own}" if owner in ("work", "conditions") else None

        model = (assembly.layout, *own), observe, joints
        meanings = meanings_of(close_row, (model, now, conditions, work), functions, room)
        self.entries["close_row"] = source_of(close_row), meanings


#: Functions that a start calls, by their names in models, and their types.
_NAMES = ("geometry", "measure", "move", "spread", "solve", "turns", "rhs")
_KINDS = (abi.MEASURE, abi.MEASURE, abi.MOVE, abi.MOVE, None, None, None)
