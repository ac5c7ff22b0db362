"""Rows that depend on others for ever: which of them stand for all follows the position."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import symgen
from benchmarks.plain.motion import integrate
from benchmarks.plain.system import read
from symgen.api import Model
from symgen.base.settings import Settings
from symgen.compile.loopcode.exact import plain_form
from symgen.describe import MechanismBuilder
from symgen.run.layout.redundancy import choose_rows, farthest_row
from symgen.run.planning.prepare import prepare
from symgen.run.planning.tree_starts import map_to_tree
from symgen.run.starts.assembler import ALONE, as_one_row
from tests.verification.running import DEFECTS, off, raw, reference

SETTINGS = (
    {"method": "lagrange", "integrator": "rk4"},
    {"method": "lagrange", "integrator": "dop853"},
    {"method": "direct-correction", "integrator": "dop853", "rtol": 1e-10},
    {"method": "direct-correction", "integrator": "rk4", "shape": "looped"},
    {"method": "direct-correction", "integrator": "radau5"},
    {"method": "coordinate-partitioning", "integrator": "rk4"},
    {"method": "null-space", "integrator": "dop853"},
)


@pytest.mark.by_turns(4)
@pytest.mark.fast("two_pins_tilted-direct-correction dop853 1e-10", "two_pins_tilted-direct-correction radau5")
@pytest.mark.parametrize("settings", SETTINGS, ids=lambda s: " ".join(map(str, s.values())))
@pytest.mark.parametrize("name", ["two_pins", "two_pins_tilted"])
def test_two_pins_of_one_turning_body(name: str, settings: dict) -> None:
    """A body held twice by one that turns: the row that repeats is another one at every angle."""
    times = [0.0, 0.5, 1.0]
    system, q, _ = reference(raw(name), times)
    result = symgen.load(DEFECTS / f"{name}.toml").simulate(until=1.0, times=times, **settings)
    assert result.status == "ok", result.reason
    assert result.rank.rows - result.rank.rank == 1 == len(result.rank.redundant_rows)
    assert not result.rank_events
    assert off(result, system, q) < 1e-7
    # accelerations are found after the run, with rows chosen anew
    ahead, _, later = reference(raw(name), [0.0, 1.0, 1.0 + 1e-5])
    slope = (later[2] - later[1]) / 1e-5
    assert [n.rpartition(".")[0] for n in ahead.names_v] == [n.rpartition(".")[0] for n in result.a.names]
    np.testing.assert_allclose(result.a.values[-1], slope, rtol=0, atol=1e-3 * np.abs(slope).max())


@pytest.mark.parametrize("target", ["cpu", pytest.param("lanes", marks=pytest.mark.slow)])
def test_rows_of_a_sweep_follow_as_well(target: str, tmp_path: Path) -> None:
    """Every number of a row of a sweep is that of the run alone, accelerations after the run too."""
    settings = {"method": "direct-correction", "integrator": "rk4", "step": 2e-3, "times": [0.0, 0.3, 0.6, 1.0]}
    model = symgen.load(DEFECTS / "two_pins_tilted.toml")
    speeds, names = [2.0, 3.0], ("plate.x", "plate.omega", "plate.alpha")
    found = symgen.sweep(model, {"crank.omega": speeds}, quantities=names, target=target, until=1.0, **settings)
    assert found.counts["ok"] == 2
    for i, speed in enumerate(speeds):
        file = tmp_path / f"{i}.toml"
        text = (DEFECTS / "two_pins_tilted.toml").read_text(encoding="utf-8")
        file.write_text(text.replace("angular_velocity = 3.0", f"angular_velocity = {speed}"), encoding="utf-8")
        alone = symgen.load(file).simulate(until=1.0, **settings)
        for k, name in enumerate(names):
            table = (alone.q, alone.v, alone.a)[k]
            np.testing.assert_allclose(found.values[i, k], table[name], rtol=0, atol=1e-9, err_msg=name)


def dense_layout(m: int, n: int, alone: tuple[int, ...] = ()) -> SimpleNamespace:
    """Of a model whose scratch holds a dense D, then the section ``gauge``, then the masks of its rows."""
    entries = np.array([(i, j, n * i + j) for i in range(m) for j in range(n)], dtype=np.int64).ravel()
    first = np.array([*alone, *[0] * (m - len(alone))], dtype=np.int64)
    places = {"jacobian": 0, "gauge": m * n, "mask": m * n + n}
    return SimpleNamespace(
        m=m, nv=n, entries=entries, constants=np.zeros(m * n), alone=first, switches=np.full(m, -1), **places
    )


def test_kept_rows_span_the_others() -> None:
    rng = np.random.default_rng(3)
    d = rng.uniform(-1.0, 1.0, (3, 6))
    d = np.vstack([d, d[0] + d[1], 1e3 * d[2], d[1] - 2.0 * d[2]])[rng.permutation(6)]
    w = np.concatenate([d.ravel(), np.ones(6), np.zeros(6)])
    changed = plain_form(choose_rows)(dense_layout(6, 6), 3, 0, w, np.zeros(84))
    kept = w[42:] == 0.0
    assert changed == 1 and kept.sum() == 3
    rows = d[kept] / np.linalg.norm(d[kept], axis=1, keepdims=True)
    assert np.linalg.svd(rows, compute_uv=False)[-1] > 0.05


def test_rows_that_are_off_stand_for_none_and_are_not_masked() -> None:
    a, b = np.random.default_rng(7).uniform(-1.0, 1.0, (2, 5))
    layout = dense_layout(4, 5)
    layout.switches[0] = 29
    w = np.concatenate([[*a, *b, *(a + b), *(2.0 * b)], np.ones(5), np.zeros(4), [1.0]])
    choose, mask, room = plain_form(choose_rows), w[25:29], np.zeros(44)
    choose(layout, 2, 0, w, room)
    assert np.count_nonzero(mask) == 2
    w[29] = 0.0
    assert plain_form(farthest_row)(layout, 5, 4, 1e-12, 0, w, room) == 2
    choose(layout, 3, 0, w, room)
    assert list(mask[[0, 2]]) == [0.0, 0.0]
    assert sorted(mask[[1, 3]]) == [0.0, np.inf]


@pytest.mark.slow
def test_rows_of_which_rounding_is_left_stand_for_none() -> None:
    """In joint coordinates rows of loops vanish for ever; their direction is rounding's, and of length 1 if weighed."""
    settings = Settings(method="lagrange", integrator="dop853", coordinates="joint")
    model = symgen.load(DEFECTS / "flat_loop.toml")
    run = prepare(model.mechanism, settings).tree
    compiled, start = run.compiled, run.start
    carried, bodies = map_to_tree(run.whole, run.mechanism, run.bodies, compiled), run.body_start
    rng = np.random.default_rng(5)
    for _ in range(100):  # as other processors may round
        y, nq, w = bodies.y.copy(), run.bodies.info.nq, compiled.scratch()
        y[:nq] += rng.uniform(-2e-16, 2e-16, nq)
        carried.settle(as_one_row(y, bodies.p, bodies.w), as_one_row(start.y.copy(), start.p.copy(), w), *ALONE)
        kept = compiled.section(w, "mask") == 0.0
        assert (compiled.rank(w), len(compiled.redundant(w)), kept.sum()) == (2, 3, 2)
        assert np.linalg.svd(compiled.jacobian(w)[kept], compute_uv=False)[-1] > 0.05


@pytest.mark.parametrize("seed", range(20))
def test_errors_of_kept_rows_are_not_enlarged_in_the_others(seed: int) -> None:
    """Rows that are left out are sums of kept ones with factors that elimination bounds by 1 and hardly exceeds."""
    rng = np.random.default_rng(seed)
    m, n, left_out = 8, 9, 1 + seed % 3
    d = rng.uniform(-1.0, 1.0, (m - left_out, n))
    d = np.vstack([d, rng.uniform(-1.0, 1.0, (left_out, m - left_out)) @ d])[rng.permutation(m)]
    d *= 10.0 ** rng.uniform(-3.0, 3.0, (m, 1))
    mask = np.zeros(m)
    mask[rng.permutation(m)[:left_out]] = np.inf
    w = np.concatenate([d.ravel(), np.ones(n), mask])
    plain_form(choose_rows)(dense_layout(m, n), m - left_out, 0, w, np.zeros(m * (n + m + 2)))
    kept = w[m * n + n :] == 0.0
    assert kept.sum() == m - left_out
    rows = d / np.linalg.norm(d, axis=1, keepdims=True)
    factors = np.linalg.lstsq(rows[kept].T, rows[~kept].T, rcond=None)[0]
    assert np.abs(rows[kept].T @ factors - rows[~kept].T).max() < 1e-9
    # complete pivoting: 1 for one row, and at most twice as much for each further one
    assert np.abs(factors).max() <= 2.0 ** (left_out - 1) + 1e-9


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["rk4", "dop853"])
def test_a_pin_held_twice_drifts_no_more_than_one_held_once(integrator: str) -> None:
    """Which rows stand for all changes as the rod turns; each time drift was enlarged, some hundredfold a turn."""
    settings = {"method": "lagrange", "integrator": integrator, "rtol": 1e-10, "step": 1e-4, "until": 1.0}
    found = []
    for twice in (False, True):
        raw = MechanismBuilder("rod", gravity=(0.0, -9.81))
        raw.body("hub", type="point", mass=4.668, position=(0.574, -0.527))
        raw.joint("fixed", "revolute", between=("hub", "ground"), at=("centre", (0.574, -0.527)))
        turning = {"angle": 0.2129, "angular_velocity": -9.0}
        raw.body("rod", mass=1.628, inertia=0.08581, position=(0.7654, -0.3621), **turning)
        if twice:
            away = {"at": ((-0.1221, -0.5206), "centre"), "length": 0.4121362467606458}
            raw.joint("again", "distance", between=("rod", "hub"), **away)
        pinned = (-0.2219212187793171, -0.1207350100654425)
        raw.joint("pin", "revolute", between=("rod", "hub"), at=(pinned, "centre"))
        found.append(Model(raw.build()).simulate(**settings))
    once, again = found
    assert again.rank.rows - again.rank.rank == 1 and again.status == once.status == "ok"
    assert again.position_violation_max < 100.0 * max(once.position_violation_max, 1e-15)
    np.testing.assert_allclose(again["rod.theta"][-1], once["rod.theta"][-1], rtol=0.0, atol=1e-8)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    "settings",
    (
        {"method": "lagrange", "integrator": "dop853", "rtol": 1e-10},
        {"method": "direct-correction", "integrator": "rk4", "step": 1e-3},
        {"method": "direct-correction", "integrator": "rk4", "step": 1e-3, "shape": "looped"},
        {"method": "lagrange", "integrator": "dop853", "rtol": 1e-10, "coordinates": "joint"},
    ),
    ids=lambda s: " ".join(map(str, s.values())),
)
def test_rows_kept_at_the_start_differ(settings: dict) -> None:
    """Rows that hardly differ stand for others only by what rounding and unfinished iterations leave of them.

    In `flat_loop` the last rows in the order of elimination leave a pivot of 3e-6, the best ones 1e-2: nothing is near
    a singular position, as the reference's singular values say, and nothing may be said to be.
    """
    times = [0.0, 0.25, 0.5]
    system, q, v = reference(raw("flat_loop"), times)
    for at, here in zip(times, zip(q, v, strict=True), strict=True):
        d = system.constraints(system.at(at, *here)).d
        assert np.linalg.svd(d / np.linalg.norm(d, axis=1, keepdims=True), compute_uv=False)[16] > 0.04
    result = symgen.load(DEFECTS / "flat_loop.toml").simulate(until=0.5, times=times, **settings)
    assert result.status == "ok", result.reason
    assert not result.warnings and not result.rank_events
    assert (result.rank.rows, result.rank.rank) == (20, 17) and len(result.rank.redundant_rows) == 3
    assert off(result, system, q) < 1e-9


@pytest.mark.parametrize(("angle", "left_out"), [(0.05, "slot1.normal"), (0.3, "slot2.normal")])
def test_rows_at_a_small_angle_do_not_stand_for_others(angle: float, left_out: str) -> None:
    """A ball in three slots, of which two hold it: the two that come first, unless they hardly differ."""
    built = MechanismBuilder("slots").run(until=0.01, step=0.01).body("ball", mass=1.0, inertia=0.1)
    for i, way in enumerate((0.0, angle, 1.5)):
        axis = (math.cos(way), math.sin(way))
        built.joint(f"slot{i}", "pin-in-slot", between=("ground", "ball"), at=((0.0, 0.0), "centre"), axis=axis)
    compiled = Model(built.build()).compile("lagrange")
    assert Model(built.build()).assemble(compiled).redundant_rows == (left_out,)


@pytest.mark.slow
def test_rows_kept_at_the_start_differ_in_sweeps(tmp_path: Path) -> None:
    """The compiled start keeps the same rows: the run is the single one, and near no singular position."""
    settings = {"method": "direct-correction", "integrator": "rk4", "step": 2e-3, "times": [0.2], "until": 0.2}
    model = symgen.load(DEFECTS / "flat_loop.toml")
    found = symgen.sweep(model, {"last": [0.6054]}, quantities=("b1.x", "smallest_pivot"), **settings)
    alone = model.simulate(**settings)
    assert found.counts["ok"] == 1
    np.testing.assert_allclose(found.values[0, 0], alone.q["b1.x"], rtol=0, atol=1e-12)
    assert found.values[0, 1] > 1e-3


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize(
    ("name", "rank", "until"),
    [("poor_order", 11, 0.5), pytest.param("poor_order_driven", 16, 0.3, marks=pytest.mark.slow)],
)
def test_the_rank_is_none_of_the_order_of_elimination(name: str, rank: int, until: float, shape: str) -> None:
    """Rows that depend on others behind a small pivot have pivots of rounding over that pivot, above what is no pivot.

    The motion is the reference's, which takes singular values; nothing is said to be near a singular position.
    """
    times = [0.0, until]
    system, q, _ = reference(raw(name), times)
    result = symgen.load(DEFECTS / f"{name}.toml").simulate(
        method="lagrange", integrator="dop853", rtol=1e-10, until=until, times=times, shape=shape
    )
    assert (result.status, result.reason, result.rank_events) == ("ok", None, ())
    assert result.rank.rank == rank and len(result.rank.redundant_rows) == result.rank.rows - rank
    assert off(result, system, q) < 1e-7


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    "settings",
    (
        {"method": "lagrange", "integrator": "dop853", "rtol": 1e-10},
        {"method": "direct-correction", "integrator": "rk4", "step": 2.5e-3},
        {"method": "lagrange", "integrator": "dop853", "rtol": 1e-10, "shape": "looped"},
    ),
    ids=lambda s: " ".join(map(str, s.values())),
)
def test_a_hinge_beside_a_slide(settings: dict) -> None:
    """One of the rows that would be left out from 0.56 s on is eliminated before all others, whatever its mask."""
    times = [0.0, 0.4, 0.8]
    result = symgen.load(DEFECTS / "doubled_slide.toml").simulate(until=0.8, times=times, **settings)
    assert (result.status, result.reason, result.warnings, result.rank_events) == ("ok", None, (), ())
    system = read(raw("doubled_slide"))
    q, v = (
        np.asarray(values)[0, [values.names.index(name) for name in names]]
        for values, names in ((result.q, system.names_q), (result.v, system.names_v))
    )
    system.follow(system.at(0.0, q, v))
    motion = integrate(system, q, v, np.array(times), 1e-11)
    assert not motion.ended and off(result, system, np.array(motion.q)) < 1e-6


def test_rows_that_are_eliminated_alone_are_never_left_out() -> None:
    """Their masks are not read: left out they would count as kept, and a row that depends on them as singular."""
    rng = np.random.default_rng(11)
    m, n = 6, 8
    first = np.linalg.qr(rng.uniform(-1.0, 1.0, (n, 2)))[0].T
    others = rng.uniform(-1.0, 1.0, (2, n))
    d = np.vstack([first, others, 5.0 * first[0] + 0.1 * others[0], first[1] - 0.2 * others[1]])
    for alone in ((), (1, 1)):
        w = np.concatenate([d.ravel(), np.ones(n), np.zeros(m)])
        plain_form(choose_rows)(dense_layout(m, n, alone), 4, 0, w, np.zeros(m * (n + m + 2)))
        kept = w[m * n + n :] == 0.0
        assert kept.sum() == 4 and np.linalg.matrix_rank(d[kept]) == 4
        assert not any(alone) or kept[:2].all()


def test_rows_that_are_no_numbers_leave_the_choice_as_it_was() -> None:
    """Three rows in two columns, one to be left out: where D is not defined, nothing is chosen or written."""
    m, n, kept = 3, 2, 2
    w = np.concatenate([[1.0, 0.0, 0.0, 1.0, 1.0, 1.0], np.ones(n), [0.0, 0.0, np.inf]])
    mask = slice(m * n + n, None)
    room = np.full(m * (n + m) + 2 * m + 1, 7.0)
    for broken, where in ((np.nan, slice(6)), (np.inf, slice(6)), (np.nan, slice(4, 6)), (np.nan, slice(2, 6))):
        w[:6] = [1.0, 0.0, 0.0, 1.0, 1.0, 1.0]
        w[where] = broken
        before = w.copy()
        with np.errstate(invalid="ignore"):
            changed = plain_form(choose_rows)(dense_layout(m, n), kept, 0, w, room[1:])
        assert changed == 0
        np.testing.assert_array_equal(w, before)
        assert np.count_nonzero(w[mask]) == m - kept and room[0] == 7.0
