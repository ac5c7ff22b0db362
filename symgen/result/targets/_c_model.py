"""A mechanism as C99: emitted functions, numbers of its start, and values for the templates."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import InputError
from symgen.base.ir.program import COUNTERS, SETTLED
from symgen.compile.native.c99 import c_functions
from symgen.compile.native.c99_words import break_line, c_limit, c_number, macro_definitions
from symgen.compile.native.directed_functions import directed_function
from symgen.compile.native.formula_lines import C, NotInLines
from symgen.compile.native.read import Foreign
from symgen.derive.emit.module import render_template
from symgen.result.part_limits import remarks_without_limits
from symgen.result.targets._c_names import defined_names, prefix_of
from symgen.result.targets._c_reasons import c_text
from symgen.result.targets._c_runs import cells_of, check_integrator, places_of_scales, values_of_run
from symgen.result.targets._joint_outputs import with_joint_outputs
from symgen.run.compiling.checked import check_kernels, checked_function
from symgen.run.compiling.printed import WEIGHED, Printed, PrintedEvents
from symgen.run.compiling.printed_meanings import OF_TRANSITIONS
from symgen.run.compiling.printed_run import PrintedRun
from symgen.run.compiling.side import compile_side
from symgen.run.effects.locking import MOST_NAMED
from symgen.run.effects.stepping import FAILED
from symgen.run.layout import abi
from symgen.run.planning.dead_centre import DRIVER, moving_names
from symgen.run.planning.kept_runs import run_with_modes, whole_run
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import Prepared, prepare
from symgen.run.planning.start_lines import (
    derived_lines,
    exported_start,
    independent_places,
    is_described,
    written_start,
)
from symgen.run.printed.partition_tables import PartitionTables, tables_of
from symgen.run.single.contact_notes import NOT_SOUGHT

if TYPE_CHECKING:
    from symgen.base.vocabulary.quantities import Quantity
    from symgen.compile.native import language as lang
    from symgen.compile.native.binding import BoundFunctions
    from symgen.compile.native.language import Function
    from symgen.describe.mechanism import Mechanism
    from symgen.result.targets._target import Request
    from symgen.run.layout.compiled import CompiledModel

#: Functions of a law and of a model that exist in C.
_NAMES = ("rhs", "accept", "geometry", "confirm", "masses", "move", "bodies")
#: Functions that have directions in FMUs with derivatives.
_DIRECTED = ("prepare_model", "prepare_law", "masses", "geometry", "rhs", "confirm", "bodies", "formulas_of_outputs")
#: Memory that every mechanism has.
_OWN = ("y", "p", "w", "iw")
#: Maximum number of operations of a right-hand side: a compiler takes half a minute for it.
MOST_OPERATIONS = 40_000


@dataclass(frozen=True)
class CModel:
    """A mechanism in C99.

    Attributes
    ----------
    target : str
        The target, for messages.
    run : Prepared
        Its code and consistent start.
    named : bool
        Whether an integrator was named, whose run is printed as a whole.
    derivatives : bool
        Whether an FMU has directional derivatives.
    """

    target: str
    run: Prepared
    named: bool = False
    derivatives: bool = False

    @classmethod
    def of(cls, request: Request, target: str) -> CModel:
        """Derive, emit and assemble a request.

        Raises
        ------
        InputError
            If the code is looped, implicit or too large, or the integrator is not one that is printed.
        """
        check_integrator(request.integrator)
        run = prepare(request.mechanism, request.settings(target), Purpose.STATE)
        if run.tree is not None:  # outputs take no part in the code of a state
            run = prepare(with_joint_outputs(request.mechanism), request.settings(target), Purpose.STATE)
        model = cls(target, run, request.integrator is not None, request.derivatives)
        operations = model.compiled.law.operations.get("rhs", 0)
        if operations > MOST_OPERATIONS:
            expected = f"a right-hand side of at most {MOST_OPERATIONS} operations"
            raise InputError(f"--target {target}", expected, f"{operations} of {request.mechanism.name}")
        return model

    @property
    def compiled(self) -> CompiledModel:
        """Code in the coordinates of the state."""
        return self.run.compiled

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism, with its tree for a state in joint coordinates."""
        return self.run.mechanism

    @property
    def joint(self) -> bool:
        """Whether the state has joint coordinates."""
        return self.run.tree is not None

    @cached_property
    def prefix(self) -> str:
        """Prefix of the names of the C functions."""
        return prefix_of(self.mechanism.name, self.text)

    @property
    def notes(self) -> tuple[str, ...]:
        """Remarks on the model, another name of it in C, and what an FMU is not for, in words."""
        name = self.mechanism.name.replace("-", "_")
        words = f"in C, names of '{self.mechanism.name}' begin with {self.prefix}: {name} has another meaning there"
        alone = "the FMU is for co-simulation alone: an importer that integrates does not choose rows of joints anew"
        notes = [*remarks_without_limits(self.mechanism), *([words] if self.prefix != name else [])]
        return (*notes, alone) if self.mechanism.holding and self.target == "fmu" else tuple(notes)

    @cached_property
    def text(self) -> str:
        """Emitted functions in C."""
        own = {name: function for name, function in self.functions.items() if name != WEIGHED}  # where a start calls it
        return c_functions(own, self.bound, "mechanism", defined_names())

    @property
    def columns(self) -> tuple[Quantity, ...]:
        """Coordinates, then velocities, of all bodies."""
        info = self.run.assembled.of_bodies[0].info
        return (*info.coordinates, *info.velocities)

    @property
    def observed(self) -> int:
        """Number of coordinates, velocities and accelerations of all bodies."""
        of_bodies = self.run.assembled.of_bodies[0].info
        return of_bodies.nq + 2 * of_bodies.nv

    @cached_property
    def values(self) -> dict[str, Any]:
        """The values that the templates print.

        Raises
        ------
        InputError
            If an event, a function or a formula of the start has no form in C.
        """
        start, info, law = self.run.start, self.compiled.info, self.compiled.law
        mechanism, defaults = self.mechanism, self.mechanism.defaults
        scratch = np.zeros(len(start.w))
        for first, size in (info.sections[name] for name in SETTLED if name in info.sections):
            scratch[first : first + size] = start.w[first : first + size]
        scales = np.zeros(len(start.w))
        for first, behind in places_of_scales(self.compiled):
            scales[first:behind] = scratch[first:behind]
        parameters = {q.name: float(x) for q, x in zip(info.parameters, start.p, strict=False)}
        drivers = self.drivers
        return {
            "name": mechanism.name,
            "title": mechanism.title or mechanism.name,
            "remarks": [(sentence, c_text(sentence)) for sentence in remarks_without_limits(mechanism)],
            "method": law.method,
            "prefix": self.prefix,
            "upper": self.prefix.upper(),
            **{"nq": info.nq, "nv": info.nv, "ny": info.ny, "m": info.m, "np": len(start.p), "nw": len(start.w)},
            "ni": len(COUNTERS),
            "columns": self.columns,
            "outputs": mechanism.outputs,
            "state_names": [q.name for q in (*info.coordinates, *info.velocities)],
            "events": mechanism.events,
            "moded": bool(mechanism.bounded),
            "not_sought": f'"{NOT_SOUGHT.format("%d")}"' if "choice_unsought" in self._memory else "",
            "whole": self.printed_run is not None,
            "named": self.named,
            "adaptive": self.run.spec.adaptive,
            "failed": FAILED,
            "effects": self._resets,
            "foresees": self.foresees,
            "memory": [
                {"name": name, "is_real": kind == "float", "size": size, "latest": name in OF_TRANSITIONS}
                for name, (kind, size) in self._memory.items()
                if name not in _OWN
            ],
            "parameters": [
                {"name": q.name, "unit": q.unit, "value": c_number(x), "input": q.name in info.inputs}
                for q, x in zip(info.parameters, parameters.values(), strict=True)
            ],
            "inputs": _list(int(q.name in info.inputs) for q in info.parameters) or "0",
            "independent": independent_places(mechanism, parameters),
            "p0": self._defaults(),
            "macros": macro_definitions(f"{self.prefix.upper()}_SINGLE"),
            "y0": _list(map(c_number, start.y)),
            **{"w0": cells_of(scratch) or "{0, 0.0}", "scales": cells_of(scales)},
            "driven": self.has_driven_rows,
            "driver_of": _list(f'"{row.joint if row.joint in drivers else ""}"' for row in info.rows) or '""',
            "moving": _list(f'"{name}"' for name in moving_names(info)),
            "most_named": MOST_NAMED,
            "step_status": abi.STEP_STATUS,
            "functions": self.text,
            "confirm": "confirm" in self.functions,
            "move": "move" in self.functions,
            "joint": self.joint,
            "signs": _list(int(x) for x in self.run.tree.signs) if self.run.tree is not None else "",
            "observed": self.observed,
            "until": c_number(defaults.until),
            "step": c_number((defaults.first_step or 0.0) if self.run.spec.adaptive else defaults.step),
            "every": max(1, round((defaults.output_step or defaults.step) / defaults.step)),
            **self._start(),
            **(values_of_run(mechanism, self.printed_run, self._memory, _OWN) if self.printed_run else {}),
            "bytes": self._bytes,
        }

    @property
    def _memory(self) -> dict[str, tuple[lang.Scalar, int]]:
        """Type and length of each array of the memory; steps of whole runs have names of their own."""
        memory = dict(self.bound.memory)
        if self.printed_run is not None:
            # compilers follow loops that end after one number once more, and miss the second
            memory = {name: (kind, max(size, 2)) for name, (kind, size) in memory.items()}
            memory["step_first"] = memory["step_middle"] = "float", self.compiled.info.ny
            memory["kept_w"], memory["kept_iw"] = ("float", len(self.run.start.w)), ("int", len(COUNTERS))
        return memory

    @property
    def _bytes(self) -> int:
        """Number of bytes of the memory of a mechanism at most, where numbers have 64 bits and integers 32."""
        info, start = self.compiled.info, self.run.start
        others = {name: room for name, room in self._memory.items() if name not in _OWN}
        sizes: list[tuple[lang.Scalar, int]] = [("int", 1)]  # whether the motion has begun
        sizes += [("float", 1 + info.ny + len(start.p) + len(start.w)), ("int", len(COUNTERS)), *others.values()]
        numbers = sum(8 * size if kind == "float" else 8 * -(-size // 2) for kind, size in sizes)
        return numbers + 8 * (1 + len(info.parameters) // 8)

    @cached_property
    def functions(self) -> dict[str, Function]:
        """Checked functions by their names in C."""
        try:
            functions = check_kernels(self.compiled, _NAMES)
        except Foreign as error:
            raise InputError(f"--target {self.target}", "code that C has", f"{self.mechanism.name}: {error}") from None
        functions["prepare_model"] = functions.pop("prepareModel")
        functions["prepare_law"] = functions.pop("prepareLaw")
        if self.compiled.info.nq == self.compiled.info.nv:
            functions.pop("move", None)
        if outputs := [(output.name, output.value) for output in self.mechanism.outputs]:
            side = compile_side(self.mechanism, self.compiled, "outputs", "Outputs", outputs)
            functions["formulas_of_outputs"] = checked_function(side.function, abi.OBSERVE)
        functions |= self.printed_run.functions if self.printed_run else self.events.functions
        return functions | {f"directed_{name}": f for name, f in self.directed_of(functions).items()}

    def directed_of(self, functions: Mapping[str, Function]) -> dict[str, Function]:
        """Return functions with directions by the names of those without, where derivatives are wanted."""
        if not self.derivatives:
            return {}
        info, start = self.compiled.info, self.run.start
        ends = {"bodies": self.observed, "formulas_of_outputs": len(self.mechanism.outputs)}
        places = {"y": info.ny, "ydot": info.ny, "p": len(start.p), "w": len(start.w), "t": 2 * len(start.w)}
        own = {name: functions[name] for name in _DIRECTED if name in functions}
        try:
            return {name: directed_function(f, places | {"out": ends.get(name, 0)}) for name, f in own.items()}
        except Foreign as error:
            raise InputError("derivatives", "code that has them", f"{self.mechanism.name}: {error}") from None

    @cached_property
    def printed_run(self) -> PrintedRun | None:
        """The run, where an integrator was named or the mechanism has rows with bounds."""
        printed = whole_run if self.named else run_with_modes
        return printed(self.mechanism, self.run, self.compiled, self.run.start.datum or (), foresees=True)

    @property
    def foresees(self) -> bool:
        """Whether the run finds jumps whose times depend on parameters."""
        return self.printed_run is not None and self.printed_run.passages is not None

    @cached_property
    def events(self) -> PrintedEvents:
        """The events."""
        return PrintedEvents.of(self.mechanism, self.compiled)

    @property
    def _resets(self) -> bool:
        """Whether events of the file change a state."""
        if self.printed_run is None:
            return self.events.effects is not None
        return any(event.reset for event in self.mechanism.events)

    @property
    def exchanges(self) -> bool:
        """Whether an importer may integrate: in FMUs without a named integrator and joints that let go."""
        return self.target == "fmu" and not (self.named or self.mechanism.holding)

    @cached_property
    def partition(self) -> PartitionTables:
        """What is partitioned for model exchange, see `symgen.run.printed.partition`."""
        return tables_of(self.compiled, self.run.start.w, bool(self.mechanism.bounded))

    @property
    def has_driven_rows(self) -> bool:
        """Whether rows of drivers are among the rows; in joint coordinates drivers may need none."""
        return any(row.joint in self.drivers for row in self.compiled.info.rows)

    @cached_property
    def bound(self) -> BoundFunctions:
        """Functions of the runtime."""
        printed, start = Printed(self.functions), self.run.start
        turns = None if self._is_described else start.w[abi.WINDING :][: self.compiled.info.windings].tolist()
        printed.add_start(exported_start(self.mechanism, self.compiled, start.datum or (), turns))
        if self.printed_run is not None:
            printed.add_run(self.printed_run)
            if self.exchanges and self.mechanism.bounded:
                printed.add_exchange(self.printed_run)
            if self._resets:
                printed.add_reset(self.printed_run)
            if self.foresees:
                printed.add_foresight(self.printed_run)
            printed.add_steps(self.compiled, PrintedEvents(), ("find_rates",))
        else:
            further = ("apply_effects",) if self.events.effects else ()
            printed.add_steps(self.compiled, self.events, ("find_rates", "take_step", "take_steps", *further))
        if self.has_driven_rows:
            printed.add_lock(self.compiled, self.drivers, len(start.redundant_rows))
        if self.derivatives:
            directed = {name: f for n, f in self.functions.items() if (name := n.removeprefix("directed_")) != n}
            printed.add_directions(self.compiled, self.partition, directed)
        if self.exchanges:
            printed.add_partition(self.compiled, self.partition)
            if self.printed_run is None:
                printed.add_exchanged_steps(self.compiled, self.events, self.partition)
        return printed.bind_functions()

    @property
    def drivers(self) -> set[str]:
        """Joints that drive."""
        return {joint.name for joint in self.mechanism.joints if joint.kind == DRIVER}

    @property
    def _is_described(self) -> bool:
        """Whether a start is closed from the described one.

        One that specifies coordinates of joints, or is in joint coordinates, is closed from the exported one.
        """
        return not self.joint and is_described(self.mechanism)

    def _defaults(self) -> str:
        """Return the parameters; tolerances of the law have other limits for 32 bits."""
        law, numbers = self.compiled.law, list(map(c_number, self.run.start.p))
        for i, (name, _) in enumerate(law.parameters, law.parameter_offset):
            if name.endswith("tolerance"):
                numbers[i] = c_limit(float(self.run.start.p[i]))
        return _list(numbers)

    def _start(self) -> dict[str, str]:
        """Return lines for the derived parameters and for the start."""
        mechanism = self.mechanism
        following = list[str]()
        try:
            for place, texts in derived_lines(mechanism, C):
                following += [f"    if (!model->set[{place}]) {{", *(f"        {text}" for text in texts), "    }"]
            written = written_start(mechanism, C, self._is_described)
        except NotInLines as error:
            raise InputError(f"--target {self.target}", "a start by formulas that C has", str(error)) from None
        text = " ".join(written)
        unused = [f"(void){name};" for name in ("q", "v", "own") if f"{name}[" not in text]
        return {
            "derived": "\n".join(following),
            "described": "\n".join(f"    {line}" for line in (*unused, *written)),
        }


def _list(words: Iterable[object]) -> str:
    return break_line(", ".join(map(str, words)))


def sources(values: Mapping[str, Any]) -> dict[str, str]:
    """Return the header and the module of a mechanism, by file name."""
    return {f"{values['prefix']}.{kind}": render_template(f"c/model.{kind}.j2", values) for kind in "hc"}
