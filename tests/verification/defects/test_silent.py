"""Runs that ended `ok` with a motion that is not the mechanism's: defects B4 to B10."""

import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

import symgen
from benchmarks.mechanisms.toml import text
from benchmarks.rescale import Units, rescaled
from benchmarks.units import FOUR_BAR, SIZES
from verification.running import DEFECTS, off, raw, reference
from verification.running import symgen as command

ADAPTIVE = {"integrator": "dop853", "rtol": 1e-10, "atol": 1e-12}
SHAPES = ("straight", "looped")


def run(name: str, **settings):
    return symgen.load(DEFECTS / f"{name}.toml").simulate(**settings)


# -- B4: turns of angles in space --------------------------------------------------------------------------------------


@pytest.mark.fast("looped_turns_screw-straight")
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("name", ["looped_turns_torsion", "looped_turns_screw"])
def test_angles_in_space_start_on_the_turn_that_is_described(name: str, shape: str) -> None:
    times = [0.0, 0.25, 0.5]
    system, q, _ = reference(raw(name), times)
    result = run(name, method="lagrange", shape=shape, until=0.5, times=times, **ADAPTIVE)
    assert result.ok, result.reason
    assert off(result, system, q) < 1e-7
    assert not [note for note in result.notes if "closed" in note], "the start is consistent as it is described"


def test_check_and_run_agree_on_a_start_in_space(tmp_path: Path) -> None:
    file = DEFECTS / "looped_turns_screw.toml"
    run_words = ["run", file, "--strict", "--until", "0.01", "--step", "1e-3", "--method", "lagrange"]
    codes = [command(["check", "--strict", file], tmp_path).code]
    codes += [command([*run_words, "--shape", shape], tmp_path).code for shape in SHAPES]
    assert codes == [0, 0, 0]


# -- B5: units ---------------------------------------------------------------------------------------------------------


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in SIZES if name != "1 m"])
@pytest.mark.parametrize("integrator", ["dop853", "dopri5"])
def test_a_four_bar_of_any_size_is_the_same_mechanism(name: str, integrator: str, tmp_path: Path) -> None:
    """Rank, events, status and the crank's angle, at a few ends; all four are regular."""
    size = SIZES[name]
    units = Units(size, 1.0, float(np.sqrt(size)))
    file = tmp_path / "sized.toml"
    file.write_text(rescaled(FOUR_BAR, units), encoding="utf-8")
    model, ends = symgen.load(file), np.array([0.0, 0.8, 2.1, 3.6])
    _, q, _ = reference(tomllib.loads(FOUR_BAR), list(ends))
    for k, end in enumerate(ends[1:], 1):
        at = {"until": end * units.time, "times": [0.0, end * units.time]}
        result = model.simulate(integrator=integrator, rtol=1e-10, atol=1e-12 * min(size, 1.0), **at)
        assert result.ok, result.reason
        assert (result.rank.rank, result.rank_event_count) == (8, 0)
        assert abs(result.q["crank.theta"][-1] - q[k, 2]) < 1e-8


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["direct-correction", "lagrange", "auto"])
def test_a_four_bar_of_a_micrometre_keeps_its_rows(method: str) -> None:
    tables = raw("micrometre_four_bar")
    until = 0.005
    system, q, _ = reference(tables, [0.0, until])
    result = run("micrometre_four_bar", method=method, until=until, times=[0.0, until], step=5e-7)
    assert result.ok, result.reason
    assert result.rank.rank == result.rank.rows == 8
    assert result.q["c1.theta"][-1] == pytest.approx(q[-1, system.names_q.index("c1.theta")], abs=1e-4)


# -- B6: rows whose gradient vanishes ----------------------------------------------------------------------------------


@pytest.mark.parametrize("settings", [{"step": 1e-3}, {"step": 1e-3, "verify": True}, ADAPTIVE, {"method": "auto"}])
def test_a_homokinetic_joint_that_leans_through_180_degrees_is_no_quiet_success(settings: dict) -> None:
    """Its row has no gradient there, so that nothing says how the motion goes on."""
    result = run("cv_through_180", until=2.0, **settings)
    assert result.status != "ok"
    assert result.reason


# -- B7: names that collide in emitted code ----------------------------------------------------------------------------


@pytest.mark.slow_cases("straight")
@pytest.mark.parametrize("shape", SHAPES)
def test_any_names_that_a_file_may_have_keep_apart(shape: str, tmp_path: Path) -> None:
    """Parameters, tables, bodies, joints and forces under names that emitted code uses for things of its own."""
    words = (
        "q v p y w iw t_ phi nu gamma D M S lam rhs accept out ydot status numba math np f F f_slope p0 p16 s0".split()
    )
    tables = {word: {"x": [0.0, 1.0], "y": [1.0 + k, 1.0 + k]} for k, word in enumerate(words)}
    force = " + ".join(f"{word}(0.5)" for word in words)
    parameters = {f"{word}_": float(k) for k, word in enumerate(words)}
    point = {"type": "point", "mass": " + ".join(parameters), "velocity": [0.0, 0.0]}
    file = tmp_path / "names.toml"
    made = {
        "mechanism": {"name": "names"},
        "run": {"until": 0.01, "step": 0.001},
        "parameters": parameters,
        "tables": tables,
        "bodies": {"w": point, "rhs": {"type": "point", "mass": 1.0, "position": [1.0, 0.0]}},
        "joints": {"phi": {"type": "distance", "between": ["w", "rhs"], "at": ["centre", "centre"], "length": 1.0}},
        "forces": {"p": {"type": "force", "body": "w", "force": [force, 0.0]}},
    }
    file.write_text(text(made), encoding="utf-8")
    system, q, _ = reference(made, [0.0, 0.01])
    assert off(symgen.load(file).simulate(shape=shape, times=[0.0, 0.01]), system, q) < 1e-12


# -- B8, B9: numbers that are none -------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("integrator", ["rk4", "dopri5"])
def test_a_free_body_without_mass_is_no_quiet_success(shape: str, integrator: str) -> None:
    """Nothing determines its acceleration."""
    try:
        result = run("massless_point", shape=shape, integrator=integrator, until=0.01)
    except symgen.SymgenError as error:
        assert "bob" in str(error) and "mass" in str(error)
    else:
        assert result.status == "failed" and result.reason
        assert np.isfinite(np.asarray(result.q)).all() and np.isfinite(np.asarray(result.v)).all()


NOT_A_NUMBER = {
    "max": "max(1, sqrt(0.5-t))",
    "max after": "max(sqrt(0.5-t), 1)",
    "min": "min(1, sqrt(0.5-t))",
    "min of three": "min(1, 2, sqrt(0.5-t))",
    "sign": "sign(sqrt(0.5-t))",
    "abs": "abs(sqrt(0.5-t))",
    "choice": "1 if sqrt(0.5-t) > 0.1 else 2",
    "not": "1 if not sqrt(0.5-t) > 0.1 else 2",
    "and": "1 if t > 2 or (t >= 0 and sqrt(0.5-t) < 9) else 2",
    "piecewise": "piecewise(sqrt(0.5-t) > 0.1, 1, 2)",
    "table": "tab(sqrt(0.5-t))",
}


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("formula", NOT_A_NUMBER.values(), ids=NOT_A_NUMBER)
def test_what_is_no_number_does_not_become_one(formula: str, shape: str, tmp_path: Path) -> None:
    """The argument has no value after half a second; the choice or function round it must not hide that."""
    tables = raw("max_hides_nan")
    tables["forces"]["f"]["force"] = [formula, "0"]
    tables["tables"] = {"tab": {"x": [0.0, 1.0], "y": [1.0, 2.0]}}
    file = tmp_path / "formula.toml"
    file.write_text(text(tables), encoding="utf-8")
    result = symgen.load(file).simulate(shape=shape, until=1.0, step=1e-2)
    assert result.status == "failed", "ended although the force has no value"
    assert result.t[-1] < 0.53
    assert re.search(r"finite|is undefined", result.reason), result.reason


# -- B10: starts that were moved ---------------------------------------------------------------------------------------

COUPLER, ROCKER = "angle = 0.30823360485921275", "angle = 1.5966280632474863"


@pytest.mark.slow_cases("changes0-warnings")
@pytest.mark.parametrize(
    ("changes", "table"),
    [({COUPLER: "angle = -1.1", ROCKER: "angle = 0.6"}, "warnings"), ({ROCKER: "angle = 1.5967"}, "notes")],
)
def test_a_moved_start_has_names_and_numbers(changes: dict[str, str], table: str, tmp_path: Path) -> None:
    """Which coordinate moved from where to where; a warning where that is more than a tenth of the size or 0.3 rad."""
    content = FOUR_BAR
    for old, new in changes.items():
        content = content.replace(old, new)
    file = tmp_path / "guessed.toml"
    file.write_text(content, encoding="utf-8")
    result = symgen.load(file).simulate(until=0.01, step=1e-3)
    far = max(abs(result.q["coupler.theta"][0] + 1.1), abs(result.q["rocker.theta"][0] - 0.6))
    assert far > 0.3 if table == "warnings" else not result.warnings
    sentences = " ".join(getattr(result, table))
    assert re.search(r"\b(coupler|rocker|crank)\.(x|y|theta)\b", sentences), sentences
    assert re.search(r"from\s+-?[0-9.]+.*to\s+-?[0-9.]+", sentences), sentences
