"""Kernels of the looped shape as source text: functions over all instances of a kind of element."""

from __future__ import annotations

from dataclasses import dataclass, field

from symgen.base.ir.program import FORMAT, STATUS, Block, OutputSlot
from symgen.derive.emit.emit import table_codes
from symgen.derive.emit.module import ModulePiece, function_source, module_source
from symgen.derive.emit.printer import Access, Printer
from symgen.derive.formulate.elements import RECORD
from symgen.derive.lower.looped.forms import FormProgram
from symgen.derive.lower.looped.kernels import KernelInfo, KernelProgram
from symgen.derive.lower.looped.layout import HEAD

_SUMS = ("kinetic", "potential", "power")


def emit_kernel(kernel: KernelProgram, generator: str) -> str:
    """Return the source of a kernel."""
    info = kernel.info
    frames = f"{len(info.frames)} frame" + ("" if len(info.frames) == 1 else "s")
    numbers = f"{info.constants} constants, {info.hoisted} numbers computed once a run"
    about = f"A {info.kind} of kind {kernel.label} over {frames}, {numbers}."
    return _kernel_module(kernel, InstanceAccess(info), about, generator)


def emit_form(form: FormProgram, kernel: KernelInfo, generator: str, shifted: bool = False) -> str:
    """Return the source of the kernel of an element's part of a descriptor form; `shifted`: see `FormAccess`."""
    about = f"What a {kernel.kind} of kind {form.label} adds to a descriptor form."
    return _kernel_module(form, FormAccess(kernel, shifted=shifted), about, generator, slopes=True)


def _kernel_module(
    kernel: KernelProgram | FormProgram, access: InstanceAccess, about: str, generator: str, slopes: bool = False
) -> str:
    stride = len(access.table_reads())
    codes = [
        *table_codes(kernel.tables, slopes=slopes),
        *(_loop_over_instances(b, access, stride) for b in kernel.blocks),
    ]
    stands = f"Functions go through all instances, whose table begins at `at`: how many, then {stride} numbers each."
    header = [f"format {FORMAT}, generator {generator}", about, stands]
    origins = {name.upper(): ("machine", name.upper()) for name in HEAD}
    return module_source(f"Kernel `{kernel.stem}` of the looped shape.", header, codes, origins, {})


def _loop_over_instances(block: Block, access: InstanceAccess, stride: int) -> ModulePiece:
    """Return a block as a loop over instances."""
    access.used.clear()
    lines = Printer(block, access).lines()
    places = [(name, number) for name, number in access.table_reads() if name in access.used]
    heads = [n for n in HEAD if n in access.used or (n == "records" and any(name[0] == "f" for name, _ in places))]
    sums = [name for name in _SUMS if any(t.space == name for t, _ in block.outputs)]
    changed = [] if lines.flag is None else ["changed"]
    loop = [*(f"{name} = {number}" for name, number in places), *lines.inputs, *lines.terms, *lines.outputs]
    loop += [f"changed += {lines.flag}"] if changed else []
    body = [
        "here = np.uint32(at + 1)",
        *(f"{name} = np.int64(T[{name.upper()}])" for name in heads),
        *(f"{name} = 0.0" for name in (*sums, *changed)),
        "for _ in range(np.int64(T[at])):",
        *(f"    {line}" for line in (*loop, f"here = np.uint32(here + {stride})")),
        *(f"w[{STATUS.index(name)}] += {name}" for name in sums),
        *(f"w[np.int64(T[VECTORS])] += {name}" for name in changed),
        "return 0",
    ]
    calls = {*lines.functions, *map(str.upper, heads), *(["VECTORS"] if changed else []), "numpy"}
    purpose = f"{block.purpose}: {block.operations} operations an instance."
    return function_source(block.name, "t, y, p, w, T, at, out", purpose, body, calls=calls)


#: Array, and the summands of the index of its first element, for inputs and outputs of functions of kernels.
_READ = {"q": ("y", "q"), "v": ("y", "nq", "v"), "change": ("w", "change", "v")}
_READ |= {name: ("w", name, "row") for name in ("multipliers", "row_weight")}
_WRITTEN = {
    **{"record": ("w", "f0"), "ydot": ("out", "q"), "y": ("y", "q"), "force=": ("w", "force", "v")},
    **{"own": ("out", "own0"), "drag": ("w", "drag")},
    **{"jacobian": ("w", "jacobian", "entry"), "left": ("w", "left", "entry"), "report": ("out", "m", "coordinate")},
    **{"mass_diagonal": ("p", "mass_diagonal", "v"), "inverse_mass": ("p", "inverse_mass", "v")},
}


@dataclass(frozen=True)
class InstanceAccess(Access):
    """Elements of an instance as text: by numbers of its table, which are read into locals first.

    Attributes
    ----------
    used : set of str
        Names of places and of numbers at the head of the tables that the code reads.
    """

    info: KernelInfo
    used: set[str] = field(default_factory=set)

    def element(self, array: str, *names: str, plus: int | None = None) -> str:
        """Return an element of an array and note the names of its index."""
        self.used.update(name for name in names if name.isidentifier())
        return f"{array}[{' + '.join([*names, *([] if plus is None else [str(plus)])])}]"

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""
        if space == "t":
            return "t", "t"
        if space == "record":
            frame, place = divmod(index, RECORD)
            return f"r{frame}_{place}", self.element("w", f"f{frame}", plus=place)
        if space == "p":
            computed = index - self.info.constants
            if computed < 0:
                return f"k{index}", self.element("p", f"c{index}")
            return f"h{computed}", self.element("p", "computed", plus=computed)
        if space == "winding":
            return f"winding_{index}", self.element("w", str(len(STATUS)), f"u{index}")
        if space == "modes":
            return f"mode{index}", self.element("w", "modes", plus=index)
        if space == "z":
            return f"state_{index - 1}", self.element("y", f"own{index - 1}")
        return f"{space}_{index}", self.element(*_READ[space], plus=index)

    def sign_of_output(self, target: OutputSlot) -> str:
        """Return the sign between an output and its value."""
        return "+=" if target.space in (*_SUMS, "force+") else "="

    def write(self, target: OutputSlot) -> str:
        """Return the left-hand side of an output."""
        space, i = target.space, target.index
        if space in _SUMS:
            return space
        if space == "force+":
            frame, place = self.velocity(i)
            return self.element("w", "force", f"v{frame}", plus=place)
        if space == "p":
            return self.element("p", "computed", plus=i - self.info.constants)
        if space == "winding":
            return self.element("w", str(len(STATUS)), f"u{i}")
        return self.element(*_WRITTEN.get(space, ("w", space, "row")), plus=None if space == "own" else i)

    def velocity(self, index: int, which: int = 1) -> tuple[int, int]:
        """Return frame and place in the frame of a velocity of the element, or of a coordinate (`which` 0)."""
        for frame, sizes in enumerate(self.info.frames):
            if index < sizes[which]:
                return frame, index
            index -= sizes[which]
        raise AssertionError("every velocity belongs to a frame")

    def table_reads(self) -> list[tuple[str, str]]:
        """Return (local name, expression) of all numbers of an instance's table."""
        frames = range(len(self.info.frames))
        own: dict[str, list[str]] = {"body": ["q", "v"], "joint": ["row", "entry", "coordinate"], "state": []}
        own["bound"] = ["row", "entry", *(f"v{i}" for i in frames)]
        own |= {"rotor": own["bound"][1:], "drag": ["row", "drag"]}
        names = [*(f"f{i}" for i in frames), *own.get(self.info.kind, [f"v{i}" for i in frames])]
        return self.number_names([*names, *self.names_of_places(), "computed"])

    def names_of_places(self) -> list[str]:
        """Return the names of the places of counted turns, of states and of modes."""
        turns = [f"u{i}" for i in range(self.info.windings)]
        return [
            *turns,
            *(f"own{i}" for i in range(self.info.states)),
            *["modes"] * (self.info.kind in ("bound", "drag")),
        ]

    def number_names(self, names: list[str]) -> list[tuple[str, str]]:
        """Return the numbers of a table, constants last; records and coordinates are counted from 0."""
        result = []
        for i, name in enumerate([*names, *(f"c{i}" for i in range(self.info.constants))]):
            number = f"T[here + {i}]" if i else "T[here]"
            before = "2 * " if name == "coordinate" else "records + " if name[0] == "f" else ""
            result.append((name, before + number))
        return result


@dataclass(frozen=True)
class FormAccess(InstanceAccess):
    """Elements of a part of a descriptor form as text.

    Attributes
    ----------
    shifted : bool
        Whether equations of states of the file are between the others and the rows for projections.
    """

    shifted: bool = False

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""
        if space == "parameter":
            return f"option{index}", self.element("p", "method_parameters", plus=index)
        if space == "status":
            return f"status_{index}", f"w[{index}]"
        if space == "k_z":
            return "rate", self.element("w", "stage", "equation")
        if space.startswith("k_"):
            return f"{space}{index}", self.unknown("w", ("stage",), space.removeprefix("k_"), index)
        return super().read(space, index)

    def sign_of_output(self, target: OutputSlot) -> str:
        """Return the sign between an output and its value."""
        return "=" if target.space == "entry" else "+="

    def write(self, target: OutputSlot) -> str:
        """Return the left-hand side of an output."""
        if target.space == "power":
            return "power"
        if target.space == "entry":
            return self.element("out", "entry", plus=target.index)
        if target.space == "z":
            return self.element("out", "equation")
        return self.unknown("out", (), target.space, target.index)

    def unknown(self, array: str, first: tuple[str, ...], group: str, index: int) -> str:
        """Return the place of an equation or unknown within its stage."""
        if group in ("q", "v"):
            frame, place = self.velocity(index, int(group == "v"))
            return self.element(array, *first, *(("nq",) if group == "v" else ()), f"{group}{frame}", plus=place)
        further = {"first": (), "second": ("m",), "third": ("2 * m",)}[group]
        start = "nq", "nv", *further
        if self.shifted and further:
            start = ("unknowns",) if group == "second" else ("unknowns", "m")
        self.used.update("m" if further else ())
        return self.element(array, *first, *start, "row", plus=index)

    def table_reads(self) -> list[tuple[str, str]]:
        """Return (local name, expression) of all numbers of an instance's table."""
        names = [f"{letter}{i}" for letter in "fqv" for i in range(len(self.info.frames))]
        return self.number_names(
            [*names, "row", "entry", *self.names_of_places(), *["equation"] * (self.info.kind == "state")]
        )
