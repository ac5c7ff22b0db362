"""The start of runs printed as JavaScript from the runtime's source: every bit is that of machine code.

Functions of the mechanism are recorded: their sines differ between languages.
"""

import json
from pathlib import Path

import numpy as np
import pytest
from compile.native import printed, printed_starts
from compile.native.printed_starts import FEW, MANY

from symgen import Settings, load
from symgen.compile.store.jit import RuntimeFunction
from symgen.run.layout import abi
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from symgen.run.starts.starting import close_rows
from tests.browser.chromium import Chromium

pytestmark = pytest.mark.browser

FUNCTIONS = {
    "geometry": abi.MEASURE, "measure": abi.MEASURE, "move": abi.MOVE, "spread": abi.MOVE, "solve": None,
    "formulas": None, "project": None, "turns": None, "rhs": abi.RHS, "observe": abi.OBSERVE,
}  # fmt: skip


@pytest.fixture(scope="module")
def functions():
    return printed_starts.functions()


@pytest.mark.by_turns(2)
@pytest.mark.fast("('four-bar', {}, {})", "((1, 'spatial', True, False), {}, {})")
@pytest.mark.parametrize("case", [*FEW, *MANY], ids=str)
def test_starts(case, functions, chromium: Chromium, monkeypatch: pytest.MonkeyPatch) -> None:
    def compare(arguments, done, after):
        (layout, masses, *own), observe, joints = arguments[0]
        recorder, python, names = printed.Recorder(), [], []
        for (name, kind), function in zip(FUNCTIONS.items(), (*own, observe), strict=True):
            if isinstance(function, RuntimeFunction):
                python.append(printed.plain_of(function))
                names.append(function.__name__)
            else:
                python.append(recorder.of(name, function, kind))
                names.append(f"recorded('{name}')")
        first = (layout, masses, *python[:-1]), python[-1], joints
        given = printed.copied((first, *arguments[1:]))
        assert close_rows.plain(*given) == done
        printed.assert_same_bits(printed.arrays(given), after)
        for_script = ((layout, masses, *names[:-1]), names[-1], joints), *arguments[1:]
        kinds = close_rows.compiled.signature.arguments
        flat = [x for kind, value in zip(kinds, for_script, strict=True) for x in printed.leaves(kind, value)]
        text = printed.script(functions, "close_rows", flat, recorder.calls)
        result, found = printed.unpacked(chromium.run(text))
        assert result == done
        printed.assert_same_bits(found, after)

    printed_starts.starts(case, monkeypatch, compare)


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("driven-four-bar", {"crank_speed": 3.0, "crank_start": 1.2}),
        ("engine", {"rod_length": 0.15}),
        ("rolling-disc", {"radius": 0.25, "lean": 0.3}),
        ("spatial-slider-crank", {}),
        ("wiper", {"link_length": 0.31}),
    ],
)
def test_pages_start_as_runs_do(name: str, values: dict[str, float], chromium: Chromium, tmp_path: Path) -> None:
    model = load(name)
    chromium.open(model.simulate(integrator="rk4", until=0.01).view().save(tmp_path / "page.html"))
    found = np.array(chromium.run(f"window.symgen.run({json.dumps(values)}, 0)"))
    run = prepare(model.mechanism, Settings(shape="straight", parameters=values), Purpose.STATE)
    work = run.compiled.info.work
    np.testing.assert_allclose(found[:work], run.start.y[:work], rtol=0, atol=1e-12)


SPUN = """
[mechanism]
name = "spun"
gravity = [0.0, 0.0]
[parameters]
charge = 2.0
[bodies.disc]
mass = 1.0
inertia = 0.5
[joints.pin]
type = "revolute"
between = ["ground", "disc"]
at = [[0.0, 0.0], [0.0, 0.0]]
[joints.pin.start]
angle = 0.4
"angle.rate" = 3.0
[states.stored]
start = "3*charge"
rate = "-stored"
[run]
until = 1.0
step = 1e-3
"""


def test_states_of_a_file_start_by_their_formulas(chromium: Chromium, tmp_path: Path) -> None:
    """Such a state decays: 3 charge exp(-t)."""
    (tmp_path / "spun.toml").write_text(SPUN)
    result = load(tmp_path / "spun.toml").simulate(integrator="rk4")
    chromium.open(result.view().save(tmp_path / "page.html"))
    for charge in (2.0, 5.0):
        found = chromium.run(f"window.symgen.run({{charge: {charge}}}, 1.0)")
        assert found[-1] == pytest.approx(3.0 * charge * np.exp(-1.0), rel=1e-11)
        assert found[2] == pytest.approx(3.4, abs=1e-12)
