"""Several instances in the lanes of one right-hand side: a structure of arrays against as many separate calls.

The same program is printed with another access to its elements (``y[i*L + l]``) inside a loop over the lanes ``l``,
which LLVM may turn into vector instructions. Sines and cosines decide: without a vector library they are calls, one
for each lane. So three forms are timed: as they stand; in a loop of their own before, so that the rest is free of
calls; and by a polynomial that vectors can do, good to a few units in the last place for moderate angles.

    python -m benchmarks.lanes [MODEL ...]
"""

from __future__ import annotations

import linecache
import re
import statistics
import sys
import time
from dataclasses import dataclass
from typing import Any

import numba
import numpy as np
from numba import types
from rich.table import Table

from benchmarks.show import show
from symgen.api import load
from symgen.emit.printer import ElementAccess, print_block
from symgen.formulate.formulate import formulate
from symgen.ir.program import Block, Layout, Target
from symgen.lower.law import lower_law
from symgen.lower.model import lower_model
from symgen.pipeline import choose_method
from symgen.runtime import abi

LANES = (4, 8)
REPEATS = 15
_A, _I = types.float64[::1], types.int64[::1]
_ANGLE = re.compile(r"(s\d+) = math\.(sin|cos)\((\w+)\)")

#: Sine and cosine by reduction to [-pi/4, pi/4] in three parts and the polynomials of Cephes (Moshier, 1989). Adding
#: and taking away 1.5 * 2^52 rounds to whole numbers; ``quarter`` 1 gives the cosine.
SINE = """
def sine(x, quarter):
    n = (x*0.6366197723675814 + 6755399441055744.0) - 6755399441055744.0
    z = ((x - n*1.5707963267341256) - n*6.077100506303966e-11) - n*2.022266248795951e-21
    k = n + quarter
    k = k - 4.0*((0.25*k + 6755399441055744.0) - 6755399441055744.0)
    zz = z*z
    s = z + z*zz*(-1.66666666666666307295e-1 + zz*(8.33333333332211858878e-3 + zz*(-1.98412698295895385996e-4
        + zz*(2.75573136213857245213e-6 + zz*(-2.50507477628578072866e-8 + zz*1.58962301576546568060e-10)))))
    c = 1.0 - 0.5*zz + zz*zz*(4.16666666666665929218e-2 + zz*(-1.38888888888730564116e-3 + zz*(2.48015872888517045348e-5
        + zz*(-2.75573141792967388112e-7 + zz*(2.08757008419747316778e-9 - zz*1.13585365213876817300e-11)))))
    r = c if abs(k) == 1.0 else s
    return -r if abs(k - 0.5) > 1.0 else r
"""


@dataclass(frozen=True)
class LaneAccess(ElementAccess):
    """Elements of `lanes` instances side by side: element i of lane l stands at i*lanes + l."""

    lanes: int = 1

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""
        name, expression = super().read(space, index)
        return name, self._lane(expression)

    def write(self, target: Target) -> str:
        """Return the left-hand side of an output."""
        return self._lane(super().write(target))

    def _lane(self, expression: str) -> str:
        return re.sub(r"\[(\d+)\]", lambda m: f"[{int(m[1]) * self.lanes} + l]", expression)


def source(block: Block, layout: Layout, lanes: int, form: str) -> str:
    """Return ``rhs`` for `lanes` instances; `form` is ``calls``, ``apart`` or ``polynomial``."""
    lines = print_block(block, LaneAccess(layout, {}, lanes))
    inputs, first, terms = list(lines.inputs), list[str](), list[str]()
    for term in lines.terms:
        angle = _ANGLE.fullmatch(term)
        if angle is None or form == "calls":
            terms.append(term)
        elif form == "polynomial":
            terms.append(f"{angle[1]} = sine({angle[3]}, {'1.0' if angle[2] == 'cos' else '0.0'})")
        else:
            value = next(line.partition(" = ")[2] for line in inputs if line.startswith(f"{angle[3]} = "))
            at = len(first) * lanes
            first.append(f"trig[{at} + l] = math.{angle[2]}({value})")
            terms.append(f"{angle[1]} = trig[{at} + l]")
    body = [*inputs, *terms, *lines.outputs, f"bad = bad | ({lines.flag or 'False'})"]
    # a number of lanes that the compiler knows makes it unroll the loop instead
    text = ["def rhs(t, y, p, w, iw, ydot):", "    bad = False", f"    lanes = len(y) // {layout.nq + layout.nv + 1}"]
    if first:
        text += [
            f"    trig = w[{layout.nw * lanes}:]",
            "    for l in range(lanes):",
            *(f"        {x}" for x in first),
        ]
    text += ["    for l in range(lanes):", *(f"        {x}" for x in body), "    return int(bad)"]
    return "\n".join(text)


def compiled(text: str, name: str) -> Any:
    """Return ``rhs`` of a source, compiled as emitted modules are."""
    names: dict[str, Any] = {"math": __import__("math")}
    file = f"<{name}>"
    linecache.cache[file] = (len(text), None, text.splitlines(True), file)
    options: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}}
    exec(compile(SINE, "<sine>", "exec"), names)
    names["sine"] = numba.njit(inline="always", **options)(names["sine"])
    exec(compile(text, file, "exec"), names)
    return numba.njit(types.int64(types.float64, _A, _A, _A, _I, _A), **options)(names["rhs"])


@numba.njit(types.float64(abi.RHS, _A, _A, _A, _I, _A, types.int64), error_model="numpy")  # type: ignore[untyped-decorator]  # Numba is untyped
def _repeat(rhs: Any, y: Any, p: Any, w: Any, iw: Any, ydot: Any, count: int) -> float:
    for _ in range(count):
        rhs(0.0, y, p, w, iw, ydot)
        y[0] += 1e-300 * ydot[0]
    return float(ydot[0])


def spread(values: Any, lanes: int, extra: int = 0) -> Any:
    """Return the values of one instance for all lanes."""
    return np.concatenate([np.repeat(values, lanes), np.zeros(extra)])


def measure(name: str, table: Table) -> None:
    """Add the rows of one model."""
    model = load(name)
    equations = formulate(model.mechanism)
    program = lower_model(equations, digest="")
    choice = choose_method("direct-correction")
    law = lower_law(equations, program, choice.method, choice.options)
    block = next(b for b in law.blocks if b.name == "rhs")
    start = model.assemble(model.compile("direct-correction"))
    iw = np.zeros(abi.N_COUNTERS, dtype=np.int64)
    count = max(2000, int(2e6 / max(1, block.operations)))
    scalar = compiled(source(block, law.layout, 1, "calls"), "one")
    expected = np.zeros_like(start.y)
    scalar(0.0, start.y.copy(), start.p, start.w.copy(), iw, expected)
    for lanes in LANES:
        forms = {
            form: compiled(source(block, law.layout, lanes, form), form) for form in ("calls", "apart", "polynomial")
        }
        arrays = {"one": (scalar, 1), **{form: (rhs, lanes) for form, rhs in forms.items()}}
        seconds: dict[str, list[float]] = {form: [] for form in arrays}
        vectors = {}
        for form, (rhs, width) in arrays.items():
            y, p = spread(start.y, width), spread(start.p, width)
            w, ydot = spread(start.w, width, 1000 * width), np.zeros(len(start.y) * width)
            rhs(0.0, y, p, w, iw, ydot)
            found = ydot.reshape(-1, width)
            np.testing.assert_allclose(found, np.repeat(expected[:, None], width, 1), rtol=1e-9, atol=1e-9)
            code = "".join(rhs.inspect_asm(signature) for signature in rhs.signatures)
            wide = len(re.findall(r"\bv(?:mul|add|sub|fn?m(?:add|sub)\d*)pd\b", code))
            vectors[form] = wide / max(1, wide + len(re.findall(r"\bv(?:mul|add|sub|fn?m(?:add|sub)\d*)sd\b", code)))
        for _ in range(REPEATS):  # in turns, so that all meet the same disturbances
            for form, (rhs, width) in arrays.items():
                y, p = spread(start.y, width), spread(start.p, width)
                w, ydot = spread(start.w, width, 1000 * width), np.zeros(len(start.y) * width)
                began = time.perf_counter()
                _repeat(rhs, y, p, w, iw, ydot, count)
                seconds[form].append((time.perf_counter() - began) / count / width)
        one = min(seconds["one"])
        for form in arrays:
            times = seconds[form]
            table.add_row(
                *(name, "separate calls" if form == "one" else form, str(arrays[form][1]), f"{1e9 * min(times):.1f}"),
                *(f"{1e9 * statistics.median(times):.1f}", f"{one / min(times):.2f}", f"{100 * vectors[form]:.0f}"),
            )


def main(names: list[str]) -> None:
    """Measure and print."""
    table = Table(title="one right-hand side of one instance [ns]")
    for heading in ("mechanism", "sines and cosines", "lanes", "least", "median", "times as fast", "vector [%]"):
        table.add_column(heading, justify="left" if heading in ("mechanism", "sines and cosines") else "right")
    for name in names or ["four-bar"]:
        measure(name, table)
    show(table)


if __name__ == "__main__":
    main(sys.argv[1:])
