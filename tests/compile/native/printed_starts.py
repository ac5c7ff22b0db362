"""Starts by the compiled `close_rows`, and the same by functions printed from its source."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.models import parallelogram
from support.random_closed import make

from compile.native import printed
from symgen import load
from symgen.compile.loopcode.exact import compiled_form
from symgen.compile.native import language as lang
from symgen.compile.store.jit import RuntimeFunction
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout import manifold
from symgen.run.starts import assembler, decisions, masses, start_solvers, starting
from symgen.run.starts.held import Held

DEFECTS = Path(__file__).resolve().parents[2] / "data" / "defects"
#: Functions of the runtime that a start calls by their address.
PASSED = (
    *(start_solvers.dense_change, start_solvers.choose_turns, start_solvers.choose_no_turns),
    *(masses.project_velocities, masses.project_nothing),
    *(manifold.turn_nothing, starting.follow_nothing, starting.observe_nothing, starting.set_no_rates),
)

#: A mechanism: its name, or what a random one is made of (seed, space, doubled joint, contradicting velocities); how
#: far coordinates are held from where the start has them, by index; values that are held, by name.
Case = tuple[Any, Mapping[int, float], Mapping[str, float]]
FEW: tuple[Case, ...] = (
    ("four-bar", {}, {}),
    ("four-bar", {2: 0.3}, {}),
    ("wiper", {}, {"A.angle": -0.8, "A.rate": 0.5}),
    ((4, "planar", True, True), {}, {}),
    ((1, "spatial", True, False), {}, {}),
)
MANY: tuple[Case, ...] = (
    ("slider-crank", {2: -0.4}, {}),
    ("andrews", {}, {}),
    ("bricard", {}, {}),
    ("pendulum", {}, {}),
    ("n-four-bar:3", {2: 0.2}, {}),
    ("flyball-governor", {}, {}),
    ("spatial-slider-crank", {}, {}),
    ("heavy-top", {}, {}),
    ("rolling-disc", {}, {}),
    ("spherical-double-pendulum", {}, {}),
    ("driven-four-bar", {}, {}),
    ("jansen-leg", {}, {}),
    ("parallelogram", {2: 0.4}, {}),
    ((3, "planar", False, True), {2: 0.2}, {}),
    ((7, "planar", True, False), {2: -0.1}, {}),
    ((2, "spatial", False, True), {2: 0.1}, {}),
    ((5, "spatial", True, True), {}, {}),
)


def raw(name: Any) -> dict[str, Any]:
    """The description of a mechanism that is not in the catalogue."""
    if name == "wiper":
        return tomllib.loads((DEFECTS / "wiper.toml").read_text(encoding="utf-8"))
    return parallelogram() if name == "parallelogram" else make(*name)


def functions() -> dict[str, lang.Function]:
    """The start and what it calls by address, in the checked language."""
    passed = {function.py_func.__name__: printed.source_of(function) for function in PASSED}
    return {"close_rows": printed.source_of(starting.close_rows), **passed}


def passed(library: printed.Library, function: Any) -> Any:
    """A function for a printed start: the printed one in place of one of the runtime."""
    return library.at(function.__name__) if isinstance(function, RuntimeFunction) else function


def starts(case: Case, monkeypatch: pytest.MonkeyPatch, other: Callable[..., None]) -> np.ndarray:
    """Make the starts of a case compiled; `other` has copies of the arguments, the result and the arrays afterwards.

    The summary of the last one is returned.
    """
    name, away, values = case
    listed = isinstance(name, str) and name not in ("wiper", "parallelogram")
    model = load(name if listed else mechanism_of(raw(name)))
    compiled = model.compile("lagrange", shape="straight")
    summaries = []

    def both(*arguments: Any) -> int:
        before = printed.copied(arguments)
        alone = printed.copied(arguments)
        done = compiled_form(starting.close_rows)(*arguments)
        assert compiled_form(starting.close_alone)(*alone) == done
        printed.assert_same_bits(printed.arrays(alone), printed.arrays(arguments))
        other(before, done, printed.arrays(arguments))
        summaries.append(arguments[2].summary.copy())
        return done

    monkeypatch.setattr(decisions, "LARGEST_INTERPRETED", -1)
    monkeypatch.setattr(assembler, "close_alone", both)
    y = model.assemble(compiled).y
    if away or values:
        model.assemble(compiled, held=dict(values) if values else Held({i: y[i] + x for i, x in away.items()}))
        assert len(summaries) > 1, "or what is held is not compared"
    assert all(summary[e.START] == e.ASSEMBLED for summary in summaries), "or nothing is compared"
    return summaries[-1]
