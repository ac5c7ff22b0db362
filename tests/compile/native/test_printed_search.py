"""The search for events printed as C: every bit is that of its plain Python, times are those of machine code."""

import numpy as np
import pytest

from compile.native import printed, printed_search
from symgen.run.layout import abi
from symgen.run.loops import searching


@pytest.mark.slow
def test_events_of_functions_of_time(tmp_path):
    function = searching.decide.read(printed_search.ARGUMENTS)
    decide = printed.Library({"decide": function}, tmp_path).function("decide", abi.DECIDE.signature)

    def compare(arguments, result, after):
        assert decide(*arguments) == result
        printed.assert_same_bits(printed.arrays(arguments), after)

    times = printed_search.compared(compare)
    assert any(abs(t - 0.7) < 1e-12 for t in times) and any(abs(t - 2.3) < 1e-12 for t in times)
    roots = (np.pi * np.arange(1, 3) - 0.2) / 3.0
    assert all(np.min(np.abs(np.array(times) - root)) < 1e-12 for root in roots)
    # operations are contracted in machine code, so that brackets differ by rounding
    np.testing.assert_allclose(printed_search.search(searching.decide), times, rtol=0, atol=1e-12)
