"""Random mechanisms with friction, stops and ropes: runs beside an event-driven simulation that shares no code."""

from collections import Counter
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from benchmarks.bounded.chains import HARD, hard
from benchmarks.bounded.compare import ROWS, RUNS, Reference, Verdict, compared, examined, judged, reference
from benchmarks.bounded.draw import KINDS, drawn
from benchmarks.mechanisms.toml import text
from symgen.describe.files.validate import validate

#: Kinds of runs, and mechanisms that have them all.
ALL, SOME = (*RUNS, ROWS), ("dop853", ROWS)
FEW = [
    ("chain", 2, ("default", "joint", "lagrange")),
    ("loop", 2, SOME),
    ("spatial-chain", 2, SOME),
    ("spatial-loop", 2, SOME),
]


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "seed", "runs"), FEW)
def test_random_mechanisms(kind: str, seed: int, runs: tuple[str, ...]) -> None:
    against, verdicts = examined(drawn(kind, seed), runs, 0.3)
    assert isinstance(against, Reference)
    assert len(verdicts) == len(runs)
    assert [v for v in verdicts if v.outcome not in ("right", "coarse", "sentence")] == []
    assert "right" in {v.outcome for v in verdicts}


@pytest.mark.fast("chain-slip-at-a-stop-lagrange")
@pytest.mark.parametrize("run", ["dop853", "lagrange"])
@pytest.mark.parametrize("name", HARD)
def test_hard_chains(name: str, run: str) -> None:
    against = simulated(name)
    assert not isinstance(against, str)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "chain.toml"
        path.write_text(text(against.drawn.raw), encoding="utf-8")
        verdict = compared(RUNS[run], against, path)
    assert verdict.outcome in ("right", "coarse"), verdict


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "seed"), [("chain", 31), pytest.param("spatial-chain", 1, marks=pytest.mark.slow)])
def test_short_sticks_are_found_in_long_steps(kind: str, seed: int) -> None:
    """Rest of 40 ms between two slips lay inside one step of `picard`: off by 2e-3, and `ok`."""
    against, (verdict,) = examined(drawn(kind, seed), ("default",))
    assert isinstance(against, Reference)
    assert verdict.outcome == "right", verdict


@pytest.mark.slow
@pytest.mark.parametrize("seed", [25, 28])
def test_friction_goes_on_where_a_rate_passes_zero_beside_one_at_rest(seed: int) -> None:
    """A pin rests, and the angle of another, which follows from it, is at a dead centre: its friction was lost."""
    against, verdicts = examined(drawn("spatial-loop", seed), ("dop853", "lagrange", ROWS), 1.0)
    assert isinstance(against, Reference)
    assert [verdict for verdict in verdicts if verdict.outcome != "right"] == []
    assert len(verdicts) == 3


@cache
def simulated(name: str) -> Reference:
    return reference(hard(name), 0.8)


@pytest.mark.slow
@pytest.mark.parametrize("name", HARD)
def test_hard_chains_in_all_kinds_of_runs(name: str) -> None:
    """All kinds beside one reference, which takes most of the time."""
    verdicts = examined(hard(name), ALL, HARD[name])[1]
    assert [verdict for verdict in verdicts if verdict.outcome not in ("right", "coarse")] == []
    assert len(verdicts) == len(ALL)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_more_random_mechanisms(kind: str) -> None:
    """Of each kind a few; `python -m benchmarks.bounded` has as many as asked."""
    verdicts: list[Verdict] = []
    for seed in range(5, 8):
        verdicts += examined(drawn(kind, seed), ALL)[1]
    counts = Counter(verdict.outcome for verdict in verdicts)
    assert [v for v in verdicts if v.outcome in ("WRONG", "raised")] == []
    assert counts["failed"] + counts["unverified"] <= 1
    assert counts["right"] > 0.5 * len(verdicts)


@pytest.mark.parametrize("kind", KINDS)
def test_a_seed_is_a_mechanism(kind: str) -> None:
    """The same seed draws the same, another one something else, and the file is one of symgen's."""
    files = [text(drawn(kind, seed).raw) for seed in (5, 5, 6)]
    assert files[0] == files[1] != files[2]
    assert validate(drawn(kind, 5).raw, "drawn").bodies


def test_all_that_is_to_occur_is_drawn() -> None:
    found = {feature for kind in KINDS for seed in range(30) for feature in drawn(kind, seed).features}
    wanted = "friction,stop,both on one joint,rope,winch,floor,rising floor,light,pin,slide,cylinder,push,e = 0,e = 1"
    assert set(wanted.split(",")) | {"0 < e < 1", "starts at a stop", "closing pin", "closing rod"} <= found


def test_verdicts() -> None:
    assert judged("a", "ok", 1e-10, 1e-9, 1.0, "").outcome == "right"
    assert judged("a", "ok", 1e-8, 1e-9, 1.0, "").outcome == "coarse"
    assert judged("a", "ok", 1e-8, 1e-9, 20.0, "").outcome == "right"
    assert judged("a", "ok", 1e-4, 1e-9, 20.0, "").outcome == "WRONG"
    assert judged("a", "unverified", 0.0, 1e-9, 20.0, "").outcome == "unverified"
    assert judged("a", "failed", 0.0, 1e-9, 20.0, "").outcome == "failed"
