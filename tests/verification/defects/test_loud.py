"""What ended in an error or without an end, and should not have: defects C11 to C17."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import symgen
from benchmarks.mechanisms.toml import text
from verification.running import DEFECTS, off, reference


def run(name: str, **settings):
    return symgen.load(DEFECTS / f"{name}.toml").simulate(**settings)


# -- C11: work by momenta ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("step", [1e-2, 1e-3])
def test_momenta_keep_the_balance_of_work(step: float) -> None:
    """The work of a plain force is that of v, not of M^-1 p: the balance is lost by the scheme's order only."""
    result = run("ah_work", method="augmented-hamiltonian", step=step, until=1.0)
    assert result.ok, result.reason
    assert result.energy_drift_max < 1e-3 * step


# -- C13: runs without an end ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["sign_chatter", "damping_1e9"])
@pytest.mark.parametrize("integrator", ["dopri5", "dop853"])
def test_a_run_that_gets_nowhere_ends_by_itself(name: str, integrator: str) -> None:
    """Steps of 1e-9 s and less would take hours; the run stops and says so."""
    result = run(name, method="lagrange", integrator=integrator, until=1.0)
    assert result.status == "failed" and result.reason
    assert "step" in result.reason
    assert result.t[-1] < 1.0


# -- C16: which rows repeat others -------------------------------------------------------------------------------------

SPELLINGS = {
    "the same": ["p", "q"],
    "times one": ["1*p", "q"],
    "in brackets": ["(p)", "q + 0"],
    "another sum": ["p + q - q", "q"],
    "negated twice": ["-(-p)", "q"],
}


@pytest.mark.slow_cases("another sum")
@pytest.mark.parametrize("spelling", SPELLINGS.values(), ids=SPELLINGS)
def test_both_shapes_have_the_same_rows(spelling: list[str], tmp_path: Path) -> None:
    """Two pins at one place, the second in other words: as many rows, multipliers and dropped rows in either shape."""
    made = {
        "mechanism": {"name": "twice", "gravity": [0.0, -9.81]},
        "parameters": {"p": 0.3, "q": 0.2},
        "bodies": {"b": {"mass": 1.0, "inertia": 0.1, "position": ["-p", "-q"]}},
        "joints": {
            "A": {"type": "revolute", "between": ["ground", "b"], "at": [[0.0, 0.0], ["p", "q"]]},
            "B": {"type": "revolute", "between": ["ground", "b"], "at": [[0.0, 0.0], spelling]},
        },
    }
    file = tmp_path / "twice.toml"
    file.write_text(text(made), encoding="utf-8")
    found = []
    for shape in ("straight", "looped"):
        result = symgen.load(file).simulate(shape=shape, until=0.05, step=1e-3)
        assert result.ok, result.reason
        found.append((result.rank.rows, result.rank.rank, result.rank.identical_rows_dropped, result.lam.names))
    assert found[0] == found[1]


# -- C17: known failures of pairs --------------------------------------------------------------------------------------


def catalogue(name: str) -> dict:
    path = Path(symgen.__file__).parent / "describe" / "catalogue" / f"{name}.toml"
    return tomllib.loads(path.read_text(encoding="utf-8"))


def test_index3_holds_a_rolling_disc() -> None:
    """Rows without Phi have multipliers of their own."""
    times = [0.0, 0.2]
    system, q, _ = reference(catalogue("rolling-disc"), times)
    result = symgen.load("rolling-disc").simulate(
        method="index3-augmented-lagrangian", until=0.2, times=times, step=1e-3
    )
    assert result.ok and off(result, system, q) < 1e-6


@pytest.mark.slow
def test_stabilised_index_2_with_a_redundant_bar(tmp_path: Path) -> None:
    """A parallelogram with a second coupler, by `ggl`."""
    bars = {"A": (0.0, 0.0), "B": (2.0, 0.0)}
    bodies, joints, angle = {}, {}, -1.0
    for name, (x, y) in bars.items():
        bodies[name] = {"mass": 1.0, "inertia": 0.1, "position": [x, y], "angle": angle}
        bodies[name]["centre_of_mass"] = [0.5, 0.0]
        joints[f"{name}0"] = {"type": "revolute", "between": ["ground", name], "at": [[x, y], [0.0, 0.0]]}
    for name, share in (("top", 1.0), ("middle", 0.5)):
        place = [share * float(np.cos(angle)), share * float(np.sin(angle))]
        bodies[name] = {"mass": 1.5, "inertia": 0.4, "position": place, "centre_of_mass": [1.0, 0.0]}
        for k, crank in enumerate(bars):
            at = [[share, 0.0], [2.0 * k, 0.0]]
            joints[f"{name}{crank}"] = {"type": "revolute", "between": [crank, name], "at": at}
    made = {"mechanism": {"name": "parallel", "gravity": [0.0, -9.81]}, "bodies": bodies, "joints": joints}
    file = tmp_path / "parallel.toml"
    file.write_text(text(made), encoding="utf-8")
    times = [0.0, 0.2, 0.4]
    system, q, _ = reference(made, times)
    result = symgen.load(file).simulate(method="ggl", until=0.4, times=times, rtol=1e-8, atol=1e-10)
    assert result.ok, result.reason
    assert off(result, system, q) < 1e-5


@pytest.mark.slow
def test_auto_is_honest_about_a_damper_of_1e10(tmp_path: Path) -> None:
    made = catalogue("driven-four-bar")
    body = next(iter(made["bodies"]))
    made.setdefault("forces", {})["stiff"] = {
        "type": "spring-damper",
        "between": ["ground", body],
        "at": [[5.0, 5.0], "centre"],
        "damping": 1e10,
    }
    file = tmp_path / "stiff.toml"
    file.write_text(text(made), encoding="utf-8")
    result = symgen.load(file).simulate(method="auto", integrator="auto", until=0.02, times=[0.0, 0.01, 0.02])
    if result.ok:
        # all coordinates are driven: no force changes the motion
        system, q, _ = reference(catalogue("driven-four-bar"), [0.0, 0.01, 0.02])
        assert off(result, system, q) < 1e-3
    else:
        assert result.reason


def test_violations_of_angles_of_many_turns_stay_at_rounding() -> None:
    """Angles of 16 rad in `andrews`: closed joints are closed, however far bodies have turned."""
    result = symgen.load("andrews").simulate(until=0.03, integrator="dop853", rtol=1e-9, atol=1e-11)
    assert result.ok, result.reason
    assert result.position_violation_max < 1e-13
