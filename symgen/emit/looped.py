"""The looped shape as source text: generic code, kernels, and laws that are the same for all mechanisms."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from symgen.emit.emit import render
from symgen.emit.printer import Printer
from symgen.ir.program import COUNTERS, FORMAT, STATUS, Block, Target
from symgen.lower.algebra import SKIP, SUSPICIOUS
from symgen.lower.looped.forms import FormProgram, form_stride
from symgen.lower.looped.kernels import KernelInfo, KernelProgram
from symgen.lower.looped.law import LoopedFunction, LoopedLaw
from symgen.lower.looped.layout import GENERIC, HEAD

#: Room for one frame's record in the numbering of inputs; as in `symgen.formulate.elements`.
RECORD = 64
_STATUS = {name: i for i, name in enumerate(STATUS)}
_COUNTERS = {name: i for i, name in enumerate(COUNTERS)}
_WINDING = len(STATUS)
_SUMS = ("kinetic", "potential", "power")


def emit_machine(generator: str) -> str:
    """Return the source of the generic code."""
    values = {"head": HEAD, "suspicious": SUSPICIOUS, "skip": SKIP, "status": _STATUS}
    values |= {"generic": _GENERIC, "codes": GENERIC}
    return render("looped/machine.py.j2", {"format": FORMAT, "generator": generator, **values})


#: Calls of generic code: name, arguments, which code with which arguments, and what it does.
_GENERIC = (
    ("rows_times", "T, p, w, x, result", ("rows_times", "x", "result", "0", "0.0"), "Section `result` = D times `x`."),
    ("columns_times", "T, p, w, x, result", ("columns_times", "x", "result", "0", "0.0"), "`result` = D^T times `x`."),
    ("mass_times", "T, p, w, x, result", ("blocks_times", "0", "x", "result", "0.0"), "`result` = M times `x`."),
    ("inverse_mass_times", "T, p, w, x, result", ("blocks_times", "1", "x", "result", "0.0"), "`result` = M^-1 `x`."),
    ("weigh", "T, p, w", ("weigh", "0", "0", "0", "0.0"), "Section `left` = D M^-1."),
    ("gram", "T, p, w, mass, result", ("gram", "mass", "result", "0", "0.0"), "`result` = D M^-1 D^T, or D D^T."),
    (
        "augment",
        "T, p, w, penalties, result",
        ("augment", "penalties", "result", "0", "0.0"),
        "`result` = M + D^T a D.",
    ),
    ("factorise", "T, p, w, table, lower, mode", ("factorise", "table", "lower", "mode", "0.0"), "L D L^T in place."),
    ("solve", "T, p, w, table, lower, x", ("solve", "table", "lower", "x", "0.0"), "Solve in place in section `x`."),
    (
        "factorise_forward",
        "T, p, w, table, lower, mode, x",
        ("factorise", "table", "lower", "mode", "float(x)"),
        "L D L^T in place, and the first half of `solve` for section `x`.",
    ),
    (
        "solve_rest",
        "T, p, w, table, lower, x",
        ("solve", "table", "lower", "x", "1.0"),
        "The second half of `solve` in section `x`.",
    ),
)


def emit_shared_model(generator: str) -> str:
    """Return the source of the functions that all methods share."""
    return render("looped/model.py.j2", {"format": FORMAT, "generator": generator, "status": _STATUS})


def emit_looped_law(law: LoopedLaw, generator: str, summary: str, reference: str) -> str:
    """Return the source of a law."""
    parameters = [name for name, _ in law.parameters]

    def place(name: str, otherwise: str) -> str:
        return f"p[method_parameters + {parameters.index(name)}]" if name in parameters else otherwise

    own = {name for name, _ in law.sections}
    functions = [_function(f, law, own) for f in law.functions]
    flagged = any(f.flagged for f in law.functions)
    text = " ".join(line for f in functions for part in ("bases", "begin", "iterate", "finish") for line in f[part])
    correction = law.correction
    machine = {"tables", "M", "MASK", "SAVED", "PIVOT"} if flagged else {"tables"}
    if correction.any:
        machine |= {"NQ", "NV", "CHANGE", "METHOD_PARAMETERS"}
    if correction.metric == "augmented":
        machine |= {"M", "RESIDUAL", "MASK"}
    machine |= {h for h in law.helpers if re.search(rf"\b{h}\b", text)}
    machine |= {name for name in _upper(text) if name.lower() in HEAD or name.endswith("_FACTOR")} - {
        name.upper() for name in own
    }
    shared = {"measure", "normalise"} | ({"geometry"} - {f.name for f in law.functions})
    if correction.any:
        shared |= {"move"} | ({"spread"} - {f.name for f in law.functions})
    if any(f.name == "geometry" for f in law.functions):
        shared |= {"constrain", "decide_rank"}
    return render(
        "looped/law.py.j2",
        {
            "law": law,
            "summary": summary,
            "reference": reference,
            "format": FORMAT,
            "generator": generator,
            "machine": sorted(machine),
            "shared": sorted(shared),
            "own": len(HEAD),
            "functions": functions,
            "flagged": flagged,
            "status": _STATUS,
            "counters": _COUNTERS,
            "skip": SKIP,
            "tolerance": place("tolerance", "1e-13"),
            "iteration_tolerance": place("iteration_tolerance", "1e-13"),
            "penalty": place("penalty", "0.0"),
        },
    )


_ARGUMENTS = {"rhs": "t, y, p, w, iw, ydot", "geometry": "t, y, p, w", "spread": "p, w"}


def _upper(text: str) -> set[str]:
    return set(re.findall(r"\b[A-Z][A-Z_0-9]+\b|\bM\b", text))


def _function(f: LoopedFunction, law: LoopedLaw, own: set[str]) -> dict[str, Any]:
    lines = [*f.begin, *f.iterate, *f.finish]
    if f.iterate and any(name == "iteration_tolerance" for name, _ in law.parameters):
        lines.append("method_parameters")
    text = " ".join(lines)
    bases = [
        f"{name} = np.int64(T[{name.upper()}])"
        for name in (*HEAD, *sorted(own))
        if name in (*law.names, "nq", "nv", "m", "method_parameters") and re.search(rf"(?<!\w){name}\b(?!\()", text)
    ]
    numbered = sorted({int(n) for n in re.findall(r"\bx(\d+)\b", text)})
    if numbered:
        bases.append("vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])")
        bases += [f"x{n} = vectors + {n} * vector_size" for n in numbered]
    return {
        "name": f.name,
        "arguments": _ARGUMENTS[f.name],
        "purpose": f.purpose,
        "bases": bases,
        "begin": f.begin,
        "iterate": f.iterate,
        "finish": f.finish,
        "flagged": f.flagged,
    }


# -- kernels -----------------------------------------------------------------------------------------------------------


def emit_kernel(kernel: KernelProgram, generator: str) -> str:
    """Return the source of a kernel."""
    info = kernel.info
    frames = f"{len(info.frames)} frame" + ("" if len(info.frames) == 1 else "s")
    numbers = f"{info.constants} constants, {info.hoisted} numbers computed once a run"
    about = f"A {info.kind} of kind {kernel.label} over {frames}, {numbers}."
    return _kernel_module(kernel, InstanceAccess(info), about, info.stride, generator)


def emit_form(form: FormProgram, kernel: KernelInfo, generator: str) -> str:
    """Return the source of the kernel of an element's part of a descriptor form."""
    about = f"What a {kernel.kind} of kind {form.label} adds to a descriptor form at {form.info.level} level."
    return _kernel_module(form, FormAccess(kernel), about, form_stride(kernel), generator, slopes=True)


def _kernel_module(
    kernel: KernelProgram | FormProgram,
    access: InstanceAccess,
    about: str,
    stride: int,
    generator: str,
    slopes: bool = False,
) -> str:
    functions = [_kernel_function(block, access) for block in kernel.blocks]
    text = " ".join(line for f in functions for line in f["bases"])
    text += " VECTORS" if any(f["changed"] for f in functions) else ""
    return render(
        "looped/kernel.py.j2",
        {
            "kernel": kernel,
            "about": about,
            "stride": stride,
            "slopes": slopes,
            "format": FORMAT,
            "generator": generator,
            "names": sorted(_upper(text) - {"T"}),
            "tables": kernel.tables,
            "functions": functions,
            "status": _STATUS,
        },
    )


@dataclass(frozen=True)
class InstanceAccess:
    """How an instance's elements are written: by numbers of its table, which are read into locals first."""

    info: KernelInfo

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""
        if space == "record":
            frame, place = divmod(index, RECORD)
            return f"r{frame}_{place}", f"w[f{frame} + {place}]"
        if space == "p":
            constants = self.info.constants
            if index < constants:
                return f"k{index}", f"p[c{index}]"
            return f"h{index - constants}", f"p[computed + {index - constants}]"
        if space == "t":
            return "t", "t"
        if space == "winding":
            return f"winding_{index}", f"w[{_WINDING} + u{index}]"
        forms = {"q": "y[q + {}]", "v": "y[nq + v + {}]", "change": "w[change + v + {}]"}
        return f"{space}_{index}", forms[space].format(index)

    def note(self, space: str, index: int) -> str:
        """Return nothing: an instance's numbers have no names."""
        return ""

    def write(self, target: Target) -> str:
        """Return the left-hand side of an output, with its operator."""
        space, i = target.space, target.index
        if space in _SUMS:
            return f"{space} +="
        if space == "force+":
            frame, place = self.velocity(i)
            return f"w[force + v{frame} + {place}] +="
        if space == "p":
            return f"p[computed + {i - self.info.constants}] ="
        forms = {
            "record": "w[f0 + {}] =",
            "ydot": "out[q + {}] =",
            "y": "y[q + {}] =",
            "winding": f"w[{_WINDING} + u{{}}] =",
            "force=": "w[force + v + {}] =",
            "jacobian": "w[jacobian + entry + {}] =",
            "report": "out[m + coordinate + {}] =",
            "mass_diagonal": "p[mass_diagonal + v + {}] =",
            "inverse_mass": "p[inverse_mass + v + {}] =",
        }
        return forms.get(space, f"w[{space} + row + {{}}] =").format(i)

    def function(self, name: str) -> str:
        """Return what a mathematical function is called."""
        return f"math.{name}"

    def velocity(self, index: int) -> tuple[int, int]:
        """Return frame and place in the frame of a velocity of the element."""
        for frame, (_, nv, _) in enumerate(self.info.frames):
            if index < nv:
                return frame, index
            index -= nv
        raise AssertionError("every velocity belongs to a frame")

    def places(self) -> list[tuple[str, str]]:
        """Return (local name, expression) of all numbers of an instance's table that are not constants."""
        frames = len(self.info.frames)
        names = [f"f{i}" for i in range(frames)]
        names += {"body": ["q", "v"], "joint": ["row", "entry", "coordinate"]}.get(
            self.info.kind, [f"v{i}" for i in range(frames)]
        )
        names += [*(f"u{i}" for i in range(self.info.windings)), "computed"]
        names += [f"c{i}" for i in range(self.info.constants)]
        result = []
        for i, name in enumerate(names):
            number = f"T[here + {i}]" if i else "T[here]"
            if name == "coordinate":
                number = f"2 * {number}"
            result.append((name, f"records + {number}" if name.startswith("f") else number))
        return result


@dataclass(frozen=True)
class FormAccess(InstanceAccess):
    """How the elements of a part of a descriptor form are written."""

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""
        if space == "p" and index >= self.info.constants:
            return f"option{index - self.info.constants}", f"p[method_parameters + {index - self.info.constants}]"
        if space == "status":
            return f"status_{index}", f"w[{index}]"
        if space.startswith("k_"):
            return f"{space}{index}", f"w[stage + {self.unknown(space.removeprefix('k_'), index)}]"
        return super().read(space, index)

    def write(self, target: Target) -> str:
        """Return the left-hand side of an output, with its operator."""
        if target.space == "power":
            return "power +="
        if target.space == "entry":
            return f"out[entry + {target.index}] ="
        return f"out[{self.unknown(target.space, target.index)}] +="

    def unknown(self, group: str, index: int) -> str:
        """Return the index of an equation or unknown among those of a stage."""
        if group in ("q", "v"):
            sizes = [frame[group == "v"] for frame in self.info.frames]
            frame = 0
            while index >= sizes[frame]:
                index -= sizes[frame]
                frame += 1
            return f"q{frame} + {index}" if group == "q" else f"nq + v{frame} + {index}"
        behind = {"first": "", "second": " + m", "third": " + 2 * m"}[group]
        return f"nq + nv{behind} + row + {index}"

    def places(self) -> list[tuple[str, str]]:
        """Return (local name, expression) of all numbers of an instance's table."""
        frames = range(len(self.info.frames))
        names = [f"{letter}{i}" for letter in "fqv" for i in frames] + ["row", "entry"]
        names += [f"u{i}" for i in range(self.info.windings)] + [f"c{i}" for i in range(self.info.constants)]
        numbers = [(name, f"T[here + {i}]" if i else "T[here]") for i, name in enumerate(names)]
        return [(name, f"records + {number}" if name.startswith("f") else number) for name, number in numbers]


def _kernel_function(block: Block, access: InstanceAccess) -> dict[str, Any]:
    printer = Printer(block, access)
    lines = printer.lines()
    outputs = [f"{access.write(target)} {printer.text[n][0]}" for target, n in block.outputs]
    if lines.flag is not None:
        outputs.append(f"changed += {lines.flag}")
    body = " ".join([*lines.inputs, *lines.terms, *outputs])

    def used(name: str, text: str) -> bool:
        return re.search(rf"\b{name}\b", text) is not None

    places = [f"{name} = {number}" for name, number in access.places() if used(name, body)]
    bases = [f"{name} = np.int64(T[{name.upper()}])" for name in HEAD if used(name, " ".join([body, *places]))]
    sums = [name for name in _SUMS if any(t.space == name for t, _ in block.outputs)]
    return {
        "name": block.name,
        "purpose": block.purpose,
        "operations": block.operations,
        "bases": bases,
        "lines": [*places, *lines.inputs, *lines.terms, *outputs],
        "sums": sums,
        "changed": lines.flag is not None,
    }
