"""Starts that are only drawn: closed by sparse algebra early, where runs are closed by dense algebra."""

import numpy as np
import pytest

from benchmarks.editor import scissor_lift
from symgen import Settings, load
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from symgen.run.starts import decisions
from symgen.run.starts.assembler import close_for_drawing, layout_of_starts


def lift(bodies: int, aside: float) -> Mechanism:
    """Return a scissor lift whose second bar is described a little aside."""
    text = scissor_lift(bodies).replace("position = [0.0, ", f"position = [{aside!r}, ", 2)
    return validate(parse_toml(text, "lift.toml"), "lift.toml")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["lift", "n-four-bar:40"])
def test_what_is_drawn_is_closed_as_a_run_is(name: str) -> None:
    """Redundant rows and degrees of freedom are the same, positions but for rounding."""
    mechanism = lift(30, 0.003) if name == "lift" else load(name).mechanism
    run = prepare(mechanism, Settings(shape="looped"), Purpose.STATE)
    with close_for_drawing():
        drawn = prepare(mechanism, Settings(shape="looped"), Purpose.STATE)
        sparse = layout_of_starts(drawn.compiled).sparse
    assert sparse == 1 and layout_of_starts(run.compiled).sparse == 0
    assert run.compiled.info.m * run.compiled.info.nv > decisions.LARGEST_DRAWN
    assert np.abs(run.start.y - drawn.start.y).max() < 1e-9
    assert (run.start.rank, run.start.redundant_rows) == (drawn.start.rank, drawn.start.redundant_rows)
    assert run.start.warnings == drawn.start.warnings
