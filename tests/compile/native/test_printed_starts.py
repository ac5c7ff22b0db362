"""The start of runs printed as C from the runtime's source: every bit is that of machine code."""

import numpy as np
import pytest

from compile.native import printed, printed_starts
from compile.native.printed_starts import FEW, MANY
from symgen.compile.loopcode.exact import compiled_form
from symgen.compile.native import types
from symgen.run.layout import ensemble_abi as e
from symgen.run.starts.start_solvers import least_norm
from symgen.run.starts.starting import close_rows

LEAST_NORM = types.int64(
    types.float64[::1], types.int64, types.int64, *(types.float64[::1],) * 3, types.int64[::1]
)  # fmt: skip


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    functions = printed_starts.functions() | {"least_norm": printed.source_of(least_norm, LEAST_NORM)}
    return printed.Library(functions, tmp_path_factory.mktemp("printed"))


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(("m", "n", "rank"), [(8, 9, 8), (8, 9, 5), (9, 4, 2), (1, 6, 1), (30, 30, 29)])
def test_shortest_solutions(library, m, n, rank):
    own, solve = compiled_form(least_norm), library.function("least_norm", LEAST_NORM)
    for seed in range(5):
        random = np.random.default_rng(seed)
        a = random.normal(size=(m, rank)) @ random.normal(size=(rank, n))
        room, order = np.zeros(m * min(m, n) + m + n), np.zeros(m, dtype=np.int64)
        given = a.ravel(), m, n, random.normal(size=m), np.zeros(n), room, order
        other = printed.copied(given)
        assert own(*given) == solve(*other) == rank
        printed.assert_same_bits(printed.arrays(given), printed.arrays(other))


def closes_alike(library, case, monkeypatch):
    """Compare both starts of a case; return the summary."""
    close = library.function("close_rows", close_rows.compiled.signature)

    def compare(arguments, done, after):
        (layout, *functions), observe, joints = arguments[0]
        own = [printed_starts.passed(library, f) for f in (*functions, observe)]
        printed_arguments = ((layout, *own[:-1]), own[-1], joints), *arguments[1:]
        assert close(*printed_arguments) == done
        printed.assert_same_bits(printed.arrays(printed_arguments), after)

    return printed_starts.starts(case, monkeypatch, compare)


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "('four-bar', {}, {})",
    "((1, 'spatial', True, False), {}, {})",
    "('four-bar', {2: 0.3}, {})",
    "('wiper', {}, {'A.angle': -0.8, 'A.rate': 0.5})",
)
@pytest.mark.parametrize("case", FEW, ids=str)
def test_starts(library, case, monkeypatch):
    summary = closes_alike(library, case, monkeypatch)
    assert (summary[e.REDUNDANT_ROWS] > 0) == (isinstance(case[0], tuple) and case[0][2])


@pytest.mark.by_turns(4)
@pytest.mark.slow  # C compiled once, machine code of each mechanism
@pytest.mark.parametrize("case", MANY, ids=str)
def test_more_starts(library, case, monkeypatch):
    closes_alike(library, case, monkeypatch)
