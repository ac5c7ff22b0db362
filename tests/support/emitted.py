"""Emitted modules of a mechanism, evaluated as plain Python or compiled, in numbers that tests can compare."""

import builtins
import itertools
import re
import sys
import types
from dataclasses import dataclass
from typing import Any

import msgspec
import numpy as np

from symgen.base.ir.program import COUNTERS, SCALES, STATUS
from symgen.base.vocabulary.infos import LawInfo
from symgen.compile.store.emitted import CodeOrigin, EmittedFunction, import_library
from symgen.compile.store.identity import combined_digest
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.method_choice import choice_for_coordinates, choose_method
from symgen.run.compiling.pipeline import generate
from symgen.run.layout.compiled import ModelInfo

_counter = itertools.count()


def mechanism_of(raw: dict) -> Mechanism:
    """The validated mechanism of a raw description."""
    return validate(listed(raw), "test")


def listed(value: Any) -> Any:
    """Tuples as the lists that a file would give."""
    if isinstance(value, dict):
        return {k: listed(v) for k, v in value.items()}
    return [listed(v) for v in value] if isinstance(value, list | tuple) else value


@dataclass
class Numbers:
    """Everything that one state gives."""

    phi: np.ndarray
    nu: np.ndarray
    d: np.ndarray
    gamma: np.ndarray
    drift: np.ndarray
    coordinates: np.ndarray
    pivots: np.ndarray
    status: dict[str, float]
    masses: np.ndarray
    rates: np.ndarray | None = None
    acceleration: np.ndarray | None = None
    multipliers: np.ndarray | None = None
    power: float = 0.0


class Interpreted:
    """An emitted function as the plain Python it is written in."""

    def __init__(self, function: Any) -> None:
        self.py_func = function

    def __call__(self, *arguments: Any) -> Any:
        return self.py_func(*arguments)


def law_source(modules, stem: str, *roles: str) -> str:
    """The source of those parts of a law whose stems begin with `roles`, without what they import of siblings."""
    parts = [modules[part][0] for part in modules[stem][1]["modules"] if part.split("_")[0] in roles]
    return "\n".join(re.sub(r"(?m)^from \..*$", "", part) for part in parts)


class Emitted:
    """The emitted modules of one mechanism in a package of their own, in memory only.

    Parameters
    ----------
    mechanism : Mechanism
        What to generate.
    method, options
        The law.
    compiled : bool
        Whether functions run as runs compile them, or as the plain Python they are written in.
    """

    def __init__(self, mechanism: Mechanism, method: str = "lagrange", options=None, compiled: bool = False) -> None:
        choice = choice_for_coordinates(mechanism, choose_method(method, options))
        self.generated, self.compiled = generate(mechanism, (choice,)), compiled
        package = types.ModuleType(f"emitted_{next(_counter)}")
        package.__path__ = []
        sys.modules[package.__name__] = package
        self.modules = {}
        for stem, (source, _) in self.generated.modules.items():
            module = types.ModuleType(f"{package.__name__}.{stem}")
            module.__package__ = package.__name__
            sys.modules[module.__name__] = module
            module.__dict__["__builtins__"] = {**vars(builtins), "__import__": import_library}
            exec(compile(source, f"<{stem}>", "exec"), module.__dict__)
            self.modules[stem] = module
        if compiled:
            stamp = combined_digest(*(source for source, _ in self.generated.modules.values()))
            for stem, module in self.modules.items():
                origin = CodeOrigin(f"{stem} {stamp}", self.generated.modules[stem][0].encode())
                for function in vars(module).values():
                    if isinstance(function, EmittedFunction) and function.__module__ == module.__name__:
                        function.origin = origin
        model, law = (self.generated.modules[s][1] for s in ("model", choice.stem))
        self.info, self.law_info = msgspec.convert(model, ModelInfo), msgspec.convert(law, LawInfo)
        self.model, self.law = self.modules["model"], self.modules[choice.stem]
        if not compiled:  # functions that call others find them in their module: there, too, as plain Python
            for module in self.modules.values():
                for name, function in list(vars(module).items()):
                    if hasattr(function, "py_func"):
                        setattr(module, name, Interpreted(function.py_func))
        for name in [package.__name__, *(f"{package.__name__}.{stem}" for stem in self.modules)]:
            del sys.modules[name]

    def call(self, module, name: str, *arguments) -> int:
        """Call an emitted function; plain Python gets lists, so that it computes with Python's floats."""
        function = getattr(module, name)
        if self.compiled:
            return function(*arguments)
        lists = [a.tolist() if isinstance(a, np.ndarray) else a for a in arguments]
        result = function.py_func(*lists)
        for array, changed in zip(arguments, lists, strict=True):
            if isinstance(array, np.ndarray):
                array[:] = changed
        return result

    def section(self, w: np.ndarray, name: str) -> np.ndarray:
        offset, size = self.info.sections[name]
        return w[offset : offset + size]

    def parameters(self, values: dict[str, float], method_values: dict[str, float] | None = None) -> np.ndarray:
        """The prepared array p."""
        law = self.law_info
        p = np.zeros(law.parameter_offset + len(law.parameters) + law.hoisted)
        p[: len(self.info.parameters)] = [values[q.name] for q in self.info.parameters]
        for i, (name, default) in enumerate(law.parameters):
            p[law.parameter_offset + i] = (method_values or {}).get(name, default)
        self.call(self.model, "prepare", p)
        self.call(self.law, "prepare", p)
        return p

    def scratch(self) -> np.ndarray:
        w = np.zeros(self.law_info.nw)
        for name in ("pivot", "gauge", "row_weight"):
            self.section(w, name)[:] = 1.0
        w[[STATUS.index(name) for name in SCALES]] = 1.0
        return w

    def dense(self, w: np.ndarray) -> np.ndarray:
        """D from what `geometry` left."""
        d, values = np.zeros((self.info.m, self.info.nv)), self.section(w, "jacobian")
        for row, column, constant, slot in self.info.jacobian:
            d[row, column] = constant if slot is None else values[slot]
        return d

    def at(self, t: float, q, v, p: np.ndarray, law: bool = True, modes=()) -> Numbers:
        """Evaluate every function at one state, in modes of rows that may be off."""
        info, w, iw = self.info, self.scratch(), np.zeros(len(COUNTERS), dtype=np.int64)
        if len(modes):
            self.section(w, "modes")[:] = modes
        y = np.concatenate([q, v, np.zeros(info.ny - info.nq - info.nv)])
        rate, out = np.zeros(len(y)), np.zeros(max(1, info.m + 2 * len(info.joint_coordinates)))
        self.call(self.model, "geometry", t, y, p, w)
        kept = {n: self.section(w, n).copy() for n in ("residual", "nu", "pivot")}
        d = self.dense(w)
        self.call(self.model, "measure", t, y, p, w)
        self.call(self.model, "masses", p, w)
        self.call(self.model, "observe", t, y, p, w, rate, out)
        status = dict(zip(STATUS, self.section(w, "status"), strict=True))
        found = Numbers(
            phi=kept["residual"],
            nu=kept["nu"],
            d=d,
            gamma=-out[: info.m],
            drift=self.section(w, "residual").copy(),
            coordinates=out[info.m :],
            pivots=kept["pivot"],
            status=status,
            masses=self.section(w, "mass").copy(),
        )
        if law:
            self.call(self.law, "rhs", t, y, p, w, iw, rate)
            found.rates = rate[: info.nq].copy()
            found.acceleration = rate[info.nq : info.nq + info.nv].copy()
            found.multipliers = self.section(w, "multipliers").copy()
            found.power = float(rate[info.nq + info.nv])
        return found
