"""The start of runs printed as JavaScript from the runtime's source: every bit is that of machine code.

Functions of the mechanism are recorded: their sines differ between languages.
"""

import pytest
from native import printed, printed_starts
from native.printed_starts import FEW, MANY

from symgen.layout import abi
from symgen.starts.starting import close_rows
from symgen.store.jit import RuntimeFunction
from tests.browser.chromium import Chromium

pytestmark = pytest.mark.browser

FUNCTIONS = {
    "geometry": abi.MEASURE, "measure": abi.MEASURE, "move": abi.MOVE, "spread": abi.MOVE, "solve": None,
    "turns": None, "rhs": abi.RHS, "observe": abi.OBSERVE,
}  # fmt: skip


@pytest.fixture(scope="module")
def functions():
    return printed_starts.functions()


@pytest.mark.parametrize("case", [*FEW, *MANY], ids=str)
def test_starts(case, functions, chromium: Chromium, monkeypatch: pytest.MonkeyPatch) -> None:
    def compare(arguments, done, after):
        (layout, *own), observe, joints = arguments[0]
        recorder, python, names = printed.Recorder(), [], []
        for (name, kind), function in zip(FUNCTIONS.items(), (*own, observe), strict=True):
            if isinstance(function, RuntimeFunction):
                python.append(printed.plain_of(function))
                names.append(function.__name__)
            else:
                python.append(recorder.of(name, function, kind))
                names.append(f"recorded('{name}')")
        first = (layout, *python[:-1]), python[-1], joints
        given = printed.copied((first, *arguments[1:]))
        assert close_rows.plain(*given) == done
        printed.assert_same_bits(printed.arrays(given), after)
        for_script = ((layout, *names[:-1]), names[-1], joints), *arguments[1:]
        kinds = close_rows.compiled.signature.arguments
        flat = [x for kind, value in zip(kinds, for_script, strict=True) for x in printed.leaves(kind, value)]
        text = printed.script(functions, "close_rows", flat, recorder.calls)
        result, found = printed.unpacked(chromium.run(text))
        assert result == done
        printed.assert_same_bits(found, after)

    printed_starts.starts(case, monkeypatch, compare)
