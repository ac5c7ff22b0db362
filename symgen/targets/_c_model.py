"""A mechanism as C99: emitted functions, numbers of its start, and what templates print around them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.compiling.checked import checked, read
from symgen.compiling.side import compile_side
from symgen.describe.evaluate import derived, independent_values
from symgen.describe.events import RESET, STOP
from symgen.describe.formula_text import to_text
from symgen.describe.holds import holds_of
from symgen.describe.start import described_start
from symgen.emit.module import render
from symgen.emit.printer import harmless
from symgen.errors import InputError
from symgen.ir.program import COUNTERS
from symgen.native.c99 import RESERVED, broken, c_functions, c_number
from symgen.native.formula_lines import C, FormulaLines, NotInLines
from symgen.native.read import Foreign
from symgen.running.plan import Purpose
from symgen.running.prepare import Prepared, prepare
from symgen.runtime import abi
from symgen.runtime.model_arrays import lengths_of

if TYPE_CHECKING:
    from symgen.describe.mechanism import Event, Mechanism
    from symgen.native.language import Function
    from symgen.targets._target import Request

#: Functions of a law and of a model that C has.
_NAMES = ("rhs", "accept", "geometry", "confirm", "masses", "move", "bodies")
#: Sections of ``w`` that a start settles; all others are written before they are read.
_SETTLED = ("status", "winding", "mask", "saved", "pivot", "gauge", "row_weight", "mass", "mass_entry")
#: Operations of a right-hand side at most: a compiler takes half a minute for as many.
MOST_OPERATIONS = 40_000
_DIRECTIONS = {"rising": 1, "falling": -1, "any": 0}


@dataclass(frozen=True)
class CModel:
    """A mechanism that is printed as C99.

    Attributes
    ----------
    target : str
        The target, for messages.
    run : Prepared
        Its code and consistent start.
    """

    target: str
    run: Prepared

    @classmethod
    def of(cls, request: Request, target: str) -> CModel:
        """Derive, emit and assemble what a request is about.

        Raises
        ------
        InputError
            If the code is looped, implicit or too large.
        """
        model = cls(target, prepare(request.mechanism, request.settings(target), Purpose.STATE))
        operations = model.compiled.law.operations.get("rhs", 0)
        if operations > MOST_OPERATIONS:
            expected = f"a right-hand side of at most {MOST_OPERATIONS} operations"
            raise InputError(f"--target {target}", expected, f"{operations} of {request.mechanism.name}")
        return model

    @property
    def compiled(self) -> Any:
        """Code in the coordinates of the state."""
        return self.run.compiled

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism, with its tree where the state is that of joints."""
        return self.run.mechanism

    @property
    def joint(self) -> bool:
        """Whether the state is that of joints."""
        return self.run.tree is not None

    @property
    def prefix(self) -> str:
        """What the names of the C functions begin with."""
        name = self.mechanism.name.replace("-", "_")
        return f"{name}_model" if name in RESERVED else name

    @cached_property
    def columns(self) -> tuple[str, ...]:
        """Coordinates, then velocities, of all bodies."""
        bodies = self.mechanism.bodies
        coordinates = [f"{b.name}.{c}" for b in bodies for c in b.coordinates]
        return (*coordinates, *(f"{b.name}.{c}" for b in bodies for c in b.speeds))

    @cached_property
    def functions(self) -> dict[str, Function]:
        """Checked functions by their names in C."""
        try:
            functions = checked(self.compiled, _NAMES)
        except Foreign as error:
            raise InputError(f"--target {self.target}", "code that C has", f"{self.mechanism.name}: {error}") from None
        names = {"prepareModel": "prepare_model", "prepareLaw": "prepare_law"}
        functions = {names.get(name, name): function for name, function in functions.items()}
        if "move" in functions and self.compiled.info.nq == self.compiled.info.nv:
            del functions["move"]
        if self.mechanism.outputs:
            formulas = [(output.name, output.value) for output in self.mechanism.outputs]
            functions["formulas_of_outputs"] = self._side("outputs", "Outputs", formulas)
        if self.mechanism.events:
            formulas = [(event.name, event.when) for event in self.mechanism.events]
            functions["formulas_of_events"] = self._side("events", "Switching functions", formulas)
        for reset in self.resets:
            event = self.mechanism.events[reset["event"]]
            formulas = [(to_text(name), name) for name, _ in event.reset]
            formulas += [(f"{to_text(name)} afterwards", value) for name, value in event.reset]
            functions[reset["function"]] = self._side("reset", "Velocities at an event", formulas)
        return functions

    def _side(self, name: str, purpose: str, formulas: Any) -> Function:
        return read(compile_side(self.mechanism, self.compiled, name, purpose, formulas).function, abi.OBSERVE)

    @cached_property
    def resets(self) -> list[dict[str, Any]]:
        """Events that change velocities: their numbers, functions and the columns that they change."""
        events = [(i, event) for i, event in enumerate(self.mechanism.events) if event.action == RESET]
        return [
            {"event": i, "function": f"velocities_at_{event.name}", "columns": self._reset_columns(event)}
            for i, event in events
        ]

    def _reset_columns(self, event: Event) -> list[int]:
        info = self.compiled.info
        where = f"--target {self.target}: events.{event.name}"
        if self.joint:
            raise InputError(where, "coordinates of bodies, as it changes velocities", "joint coordinates")
        if (
            info.massless
            or "mass_entry" in info.sections
            or any(not entry.is_zero for body in self.mechanism.bodies for entry in _products(body))
        ):
            raise InputError(where, "bodies with mass whose axes are principal, as it changes velocities", "others")
        names = [velocity.name for velocity in info.velocities]
        return [names.index(to_text(name)) for name, _ in event.reset]

    def values(self) -> dict[str, Any]:
        """Return the values that the templates print."""
        start, info = self.run.start, self.compiled.info
        functions, law = self.functions, self.compiled.law
        acting = [i for i, event in enumerate(self.mechanism.events) if event.action in (STOP, RESET)]
        at = {name: info.sections[name][0] for name in ("residual", "nu", "change", "gauge", "mass")}
        defaults = self.mechanism.defaults
        step = defaults.step
        scratch = np.zeros(len(start.w))
        for name in _SETTLED:
            if name in info.sections:
                first, size = info.sections[name]
                scratch[first : first + size] = start.w[first : first + size]
        own = independent_values(self.mechanism, self._parameters)
        entries = [
            f"{{{row}, {column}, {-1 if slot is None else info.sections['jacobian'][0] + slot}, "
            f"{c_number(constant or 0.0)}}}"
            for row, column, constant, slot in info.jacobian
        ]
        return {
            "name": self.mechanism.name,
            "title": harmless(self.mechanism.title or self.mechanism.name),
            "method": law.method,
            "prefix": self.prefix,
            "upper": self.prefix.upper(),
            **{"nq": info.nq, "nv": info.nv, "ny": info.ny, "m": info.m, "np": len(start.p), "nw": len(start.w)},
            "ni": len(COUNTERS),
            "k": info.m + max((len(reset["columns"]) for reset in self.resets), default=0),
            "columns": self.columns,
            "outputs": self.mechanism.outputs,
            "events": self.mechanism.events,
            "acting": acting,
            "directions": [_DIRECTIONS[self.mechanism.events[i].direction] for i in acting],
            "stopping": [i for i in acting if self.mechanism.events[i].action == STOP],
            "resets": self.resets,
            "parameters": [
                {"name": q.name, "unit": harmless(q.unit), "value": c_number(float(x)), "input": q.name in info.inputs}
                for q, x in zip(info.parameters, start.p, strict=False)
            ],
            "inputs": _list(str(int(q.name in info.inputs)) for q in info.parameters) or "0",
            "given": [i for i, p in enumerate(self.mechanism.parameters) if p.formula is not None and p.name in own],
            "tolerances": [
                law.parameter_offset + i for i, (name, _) in enumerate(law.parameters) if name.endswith("tolerance")
            ],
            "p0": _list(map(c_number, start.p)),
            "y0": _list(map(c_number, start.y)),
            "w0": _list(f"{{{i}, {c_number(scratch[i])}}}" for i in np.flatnonzero(scratch)) or "{-1, 0.0}",
            "jacobian": _list(entries),
            "row_lengths": _list(str(int(row.unit == "m")) for row in info.rows),
            "angular": _list(str(int(q.unit != "m/s")) for q in info.velocities),
            "lengths": _list(str(int(x)) for x in lengths_of(info)),
            "fixed": _list(str(int(j in self._fixed)) for j in range(info.nv)),
            "at": {**at, "length": abi.LENGTH, "step": abi.STEP_STATUS},
            "functions": c_functions(functions),
            "confirm": "confirm" in functions,
            "move": "move" in functions,
            "joint": self.joint,
            "signs": _list(str(int(x)) for x in self.run.tree.signs) if self.run.tree is not None else "",
            "observed": self.mechanism.body_coordinates + 2 * sum(len(b.speeds) for b in self.mechanism.bodies),
            "derived": self._derived(),
            "described": self._described(),
            "until": c_number(defaults.until),
            "step": c_number(step),
            "every": max(1, round((defaults.output_step or step) / step)),
        }

    @property
    def _parameters(self) -> dict[str, float]:
        info = self.compiled.info
        return {q.name: float(x) for q, x in zip(info.parameters, self.run.start.p, strict=False)}

    @cached_property
    def _places(self) -> dict[str, str]:
        return {p.name: f"p[{i}]" for i, p in enumerate(self.mechanism.parameters)}

    def _derived(self) -> str:
        """Return lines that work out parameters that follow from others."""
        lines = []
        for name, expression in derived(self.mechanism.parameters):
            place = self._places[name]
            index = place.removeprefix("p[").removesuffix("]")
            formula = FormulaLines(self._places, C)
            value = formula.result(self._value(formula, expression, name))
            lines += [f"    if (!model->set[{index}]) {{", *(f"        {line}" for line in formula.lines)]
            lines += [f"        {place} = {value};", "    }"]
        return "\n".join(lines)

    def _value(self, lines: FormulaLines, expression: Any, where: str) -> Any:
        try:
            return lines.value(expression, where)
        except NotInLines as error:
            raise InputError(f"--target {self.target}", "formulas that C has", f"{where}: {error}") from None

    @cached_property
    def _fixed(self) -> frozenset[int]:
        """Velocities whose coordinates a start keeps."""
        if not self._is_described:
            return frozenset()
        names = [q.name for q in self.compiled.info.velocities]
        pairs = {
            f"{b.name}.{c}": f"{b.name}.{s}"
            for b in self.mechanism.bodies
            for c, s in zip(b.coordinates, b.speeds, strict=False)
        }
        kept = set[int]()
        for hold in holds_of(self.mechanism):
            body, _, what = hold.name.rpartition(".")
            if what == "orientation":
                kept |= {names.index(f"{body}.{speed}") for speed in ("wx", "wy", "wz")}
            elif hold.name in pairs:
                kept.add(names.index(pairs[hold.name]))
        return frozenset(kept)

    @cached_property
    def _is_described(self) -> bool:
        """Whether a start is worked out from the description; else it is closed from the start that was exported."""
        columns = {*self.columns, *(f"{b.name}.orientation" for b in self.mechanism.bodies)}
        return not self.joint and all(hold.name in columns for hold in holds_of(self.mechanism))

    def _described(self) -> str:
        """Return lines that write the described coordinates, velocities and states."""
        info, lines, written = self.compiled.info, FormulaLines(self._places, C), list[str]()
        try:
            if self._is_described:
                q, v = described_start(self.mechanism, lines)
                kept = {h.name: h.value for h in holds_of(self.mechanism) if h.value is not None}
                for names, numbers in ((self.columns[: info.nq], q), (self.columns[info.nq :], v)):
                    for i, name in enumerate(names):
                        if name in kept:
                            numbers[i] = lines.value(kept[name], name)
                written += [f"q[{i}] = {lines.result(x)};" for i, x in enumerate(q)]
                for j, x in enumerate(v):
                    value = "0.0" if x is None else lines.result(x)
                    written += [f"v[{j}] = {value};", *([f"is_free[{j}] = 1;"] if x is None else [])]
            for i, state in enumerate(self.mechanism.states):
                written.append(f"own[{i}] = {lines.result(lines.value(state.start, f'states.{state.name}.start'))};")
        except NotInLines as error:
            raise InputError(f"--target {self.target}", "a start by formulas that C has", str(error)) from None
        text = " ".join(written)
        unused = [f"(void){name};" for name in ("q", "v", "own", "is_free") if f"{name}[" not in text]
        return "\n".join(f"    {line}" for line in (*unused, *lines.lines_of(written), *written))


def _products(body: Any) -> Iterable[Any]:
    inertia = getattr(body, "inertia", None)
    return inertia[3:] if isinstance(inertia, tuple) else ()


def _list(words: Iterable[str]) -> str:
    return broken(", ".join(words))


def sources(model: CModel) -> dict[str, str]:
    """Return the header and the module of a mechanism, by file name."""
    values: Mapping[str, Any] = model.values()
    return {
        f"{model.prefix}.h": render("c/model.h.j2", values),
        f"{model.prefix}.c": render("c/model.c.j2", values),
    }
