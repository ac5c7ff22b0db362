"""Random mechanisms with friction, stops and ropes: runs beside an event-driven simulation that shares no code."""

from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from support.rotation import of_turn

from benchmarks.bounded.chains import HARD, hard
from benchmarks.bounded.compare import ROWS, RUNS, Reference, Verdict, compared, examined, judged, reference
from benchmarks.bounded.draw import KINDS, drawn
from benchmarks.mechanisms.toml import text
from symgen.describe.files.validate import validate

#: All kinds of runs.
ALL = (*RUNS, ROWS)


@pytest.mark.slow
def test_a_hard_chain() -> None:
    against = reference(hard("chain-slip-at-a-stop"), 0.8)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "chain.toml"
        path.write_text(text(against.drawn.raw), encoding="utf-8")
        verdict = compared(RUNS["lagrange"], against, path)
    assert verdict.outcome in ("right", "coarse"), verdict


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_short_sticks_are_found_in_long_steps() -> None:
    """Rest of 40 ms between two slips lay inside one step of `picard`: off by 2e-3, and `ok`."""
    against, (verdict,) = examined(drawn("chain", 31), ("default",))
    assert isinstance(against, Reference)
    assert verdict.outcome == "right", verdict


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_friction_goes_on_where_a_rate_passes_zero_beside_one_at_rest() -> None:
    """A pin rests, and the angle of another, which follows from it, is at a dead centre: its friction was lost."""
    against, verdicts = examined(drawn("spatial-loop", 28), ("dop853", "lagrange", ROWS), 1.0)
    assert isinstance(against, Reference)
    assert [verdict for verdict in verdicts if verdict.outcome != "right"] == []
    assert len(verdicts) == 3


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", of_turn(HARD, 5))
def test_hard_chains_in_all_kinds_of_runs(name: str) -> None:
    """All kinds beside one reference, which takes most of the time."""
    verdicts = examined(hard(name), ALL, HARD[name])[1]
    assert [verdict for verdict in verdicts if verdict.outcome not in ("right", "coarse")] == []
    assert len(verdicts) == len(ALL)


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_random_mechanisms(kind: str) -> None:
    """Of each kind two; `python -m benchmarks.bounded` has as many as asked."""
    verdicts: list[Verdict] = []
    for seed in (5, 6):
        against, found = examined(drawn(kind, seed), ALL, 1.0)
        assert isinstance(against, Reference) and len(found) == len(ALL)
        verdicts += found
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
