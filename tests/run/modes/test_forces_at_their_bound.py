"""Forces that are exactly at their bound at a start, behind a reset or `set`, or where an input jumps: closed forms."""

import pytest
from support.rotation import of_turn

from benchmarks.bounded.margins import RUNS, Case, cases, examined

CASES = list(cases())
#: All cases in all other kinds of runs, a fifth of them in a turn.
OTHERS = of_turn(((case, run) for run in RUNS if run != "dop853" for case in CASES), 15)


@pytest.mark.by_turns(6)
@pytest.mark.fast(
    "start/constant/linear",
    "start/constant/falling",
    "start/static/quadratic",
    "start/static/falling",
    "start/stop/quadratic",
)
@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_what_is_at_its_bound_moves_at_once_or_never(case: Case) -> None:
    outcome, error, reason = examined(case, RUNS["dop853"])
    assert (outcome, reason) == ("right", ""), error


@pytest.mark.slow
@pytest.mark.parametrize(("case", "run"), OTHERS, ids=[f"{case.name}-{run}" for case, run in OTHERS])
def test_what_is_at_its_bound_in_all_kinds_of_runs(case: Case, run: str) -> None:
    outcome, error, reason = examined(case, RUNS[run])
    assert (outcome, reason) == ("right", ""), error
