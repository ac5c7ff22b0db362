"""More than four contacts that depend on each other: boxes on each other, and a plank on five feet."""

from pathlib import Path

import numpy as np
import pytest

from tests.result.targets.test_c_modes import assert_same_run, program_of
from tests.run.contacts.scenes import G, body, head, loaded

#: Half the side of a box [m].
HALF = 0.1


def stack(places: np.ndarray, drop: float = 0.0, push: str = "0.0", friction: float = 0.5) -> str:
    """Return boxes of 1 kg on each other at places along a floor, each dropped by a height; the last one is pushed."""
    text = head("stack")
    for i, x in enumerate(places):
        text += body(f"b{i}", 1.0, 2.0 / 3.0 * HALF**2, (float(x), HALF + (2.0 * HALF + drop) * i + drop))
        below = '"ground"' if i == 0 else f'"b{i - 1}", on = [0.0, {HALF}]'
        for side, at in (("l", -HALF), ("r", HALF)):
            text += (
                f'[contacts.c{i}{side}]\nbetween = [{{ body = "b{i}", at = [{at}, {-HALF}] }}, {{ line = {below} }}]\n'
            )
            text += f"friction = {friction!r}\n"
    last = f"b{len(places) - 1}"
    return text + f'[forces.push]\ntype = "force"\nbody = "{last}"\nforce = ["{push}", 0.0]\n'


def supports(places: np.ndarray) -> np.ndarray:
    """Return what the left and right corners of each box carry, by the weight and the moment of all above it."""
    above = [places[i:] - x for i, x in enumerate(places)]
    weights, moments = np.array([G * len(x) for x in above]), np.array([G * np.sum(x) for x in above])
    return np.column_stack([weights / 2.0 - moments / (2.0 * HALF), weights / 2.0 + moments / (2.0 * HALF)])


def forces(result: object, count: int, row: int = -1) -> np.ndarray:
    """Return the forces of the contacts of a run, left and right of each box."""
    return np.array([[result[f"c{i}{side}.force"][row] for side in "lr"] for i in range(count)])


@pytest.mark.parametrize("count", [3])
def test_boxes_on_each_other_rest(count: int, tmp_path: Path) -> None:
    places = 0.02 * np.cos(1.7 * np.arange(count))
    result = loaded(stack(places), tmp_path).simulate(until=0.2, verify=False)
    assert result.ok and not result.events
    np.testing.assert_allclose(forces(result, count), supports(places), rtol=1e-11)
    assert np.max(np.abs(result[f"b{count - 1}.x"] - places[-1])) < 1e-13
    # a gap and its friction of each corner: too many for all combinations
    note = f"other motions were not sought among {4 * count} rows of contacts and friction"
    assert note in result.notes


def test_rows_of_a_sweep_warn_of_motions_that_were_not_sought(tmp_path: Path) -> None:
    text = stack(np.array([0.0, 0.01, 0.0])).replace("[bodies", "[parameters]\nm = 1.0\n[bodies", 1)
    table = loaded(text.replace("mass = 1.0", 'mass = "m"', 1), tmp_path).sweep({"m": [1.0, 2.0]}, until=0.01)
    assert list(table.status) == ["ok", "ok"]
    for sentences in table.warnings:
        assert "other motions were not sought among 12 rows of contacts and friction" in sentences


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("count", [3, 5, 10])
def test_boxes_that_fall_onto_each_other_come_to_rest(count: int, tmp_path: Path) -> None:
    places = 0.02 * np.cos(1.7 * np.arange(count))
    result = loaded(stack(places, drop=0.001), tmp_path).simulate(until=0.3, verify=False)
    assert result.ok, result.reason
    assert {event.name for event in result.events} >= {f"c{i}{side}.hit" for i in range(count) for side in "lr"}
    np.testing.assert_allclose(forces(result, count), supports(places), rtol=1e-9)
    assert any("not unique" in note for note in result.notes)


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_the_upper_box_slides_where_it_is_pushed_beyond_its_friction(coordinates: str, tmp_path: Path) -> None:
    """It begins at mu m g, and goes on with (F - mu m g)/m; those below stay."""
    mu, pace = 0.2, 4.0
    text = stack(np.zeros(3), push=f"{pace}*t", friction=mu)
    result = loaded(text, tmp_path).simulate(until=0.7, coordinates=coordinates, verify=False, rtol=1e-10)
    begin = mu * G / pace
    assert result.ok, result.reason
    assert {event.name for event in result.events} == {"c2l.slip", "c2r.slip"}
    assert all(abs(event.t - begin) < 1e-9 for event in result.events)
    assert result["b2.x"][-1] == pytest.approx(pace * (0.7 - begin) ** 3 / 6.0, abs=1e-10)
    assert abs(result["b1.x"][-1]) + abs(result["b0.x"][-1]) < 1e-12


@pytest.mark.slow
def test_a_plank_on_five_feet_rests_and_slides(tmp_path: Path) -> None:
    text = head("five") + body("plank", 1.0, 0.02, (0.0, 0.1), (0.4, 0.0))
    for i in range(5):
        shapes = f'[{{ body = "plank", at = [{0.1 * i - 0.2!r}, -0.1] }}, {{ line = "ground" }}]'
        text += f"[contacts.c{i}]\nbetween = {shapes}\nfriction = 0.5\n"
    result = loaded(text, tmp_path).simulate(until=0.2, verify=False)
    assert result.ok, result.reason
    assert result["plank.x"][-1] == pytest.approx(0.4**2 / (2.0 * 0.5 * G), abs=1e-10)
    assert sum(result[f"c{i}.force"][-1] for i in range(5)) == pytest.approx(G, rel=1e-10)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("count", [5, 10])
def test_taller_stacks_rest_in_joint_coordinates(count: int, tmp_path: Path) -> None:
    places = 0.02 * np.cos(1.7 * np.arange(count))
    result = loaded(stack(places), tmp_path).simulate(until=0.2, coordinates="joint", verify=False)
    assert result.ok and not result.events
    np.testing.assert_allclose(forces(result, count), supports(places), rtol=1e-10)


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("count", [3, 5, 10])
def test_rows_of_stacks_whose_upper_box_is_pushed(count: int, tmp_path: Path) -> None:
    """300 slopes of the push F = k t: the box begins at mu m g/k, and is at k (t - begin)^3 / 6."""
    mu, slopes = 0.2, np.linspace(1.0, 6.0, 300)
    text = stack(np.zeros(count), push="k*t", friction=mu).replace("[bodies.b0]", "[parameters]\nk = 4.0\n[bodies.b0]")
    rows = loaded(text, tmp_path).sweep(
        vary={"k": slopes}, quantities=[f"b{count - 1}.x", "b0.x"], until=0.7, rtol=1e-10, atol=1e-12
    )
    assert set(rows.status) == {"ok"}
    later = np.maximum(0.7 - mu * G / slopes, 0.0)
    np.testing.assert_allclose(rows[f"b{count - 1}.x"][:, -1], slopes * later**3 / 6.0, rtol=0.0, atol=1e-9)
    assert np.abs(rows["b0.x"][:, -1]).max() < 1e-12


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("places", [(0.0, 0.01, -0.01), (0.0, 0.01, -0.01, 0.005, -0.015)])
def test_a_stack_in_c_is_that_of_a_run(places: tuple[float, ...], tmp_path: Path) -> None:
    model = loaded(stack(np.array(places), drop=0.001), tmp_path)
    transitions = assert_same_run(model, program_of(model, tmp_path / "c"), 0.1, 0.0005)
    assert len({word for _, word in transitions}) > 6


@pytest.mark.slow_cases("5-looped")
@pytest.mark.parametrize(("count", "shape"), [(2, "straight"), (5, "looped")])
def test_discs_fall_into_a_bin_in_the_shape_whose_compilation_is_short(count: int, shape: str, tmp_path: Path) -> None:
    """Each may touch floor, walls and all others: straight code of eight takes many minutes."""
    text, radius, drop = head("bin"), 0.05, 0.02
    walls = {"f": "", "l": ", on = [-0.06, 0.0], normal = [1.0, 0.0]", "r": ", on = [0.3, 0.0], normal = [-1.0, 0.0]"}
    for i in range(count):
        text += body(f"d{i}", 1.0, 0.5 * radius**2, (0.12 * (i % 3), radius + drop + 0.13 * (i // 3)))
        touched = {name: f'{{ line = "ground"{where} }}' for name, where in walls.items()}
        touched |= {f"d{k}": f'{{ body = "d{k}", disc = {radius} }}' for k in range(i)}
        for name, other in touched.items():
            text += f'[contacts.d{i}{name}]\nbetween = [{{ body = "d{i}", disc = {radius} }}, {other}]\n'
            text += "friction = 0.3\nrestitution = 0.3\n"
    result = loaded(text, tmp_path).simulate(until=0.065, verify=False)
    assert result.status == "ok", result.reason
    assert result.shape == shape
    lands = np.sqrt(2.0 * drop / G)
    assert {e.name for e in result.events} == {f"d{i}f.hit" for i in range(min(count, 3))}
    assert all(abs(e.t - lands) < 1e-9 for e in result.events)
    later = 0.065 - lands
    upwards = radius + 0.3 * G * lands * later - G * later**2 / 2.0
    assert result["d0.y"][-1] == pytest.approx(upwards, abs=1e-9)
    assert result[f"d{count - 1}.x"][-1] == pytest.approx(0.12 * ((count - 1) % 3), abs=1e-9)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_eight_discs_come_to_rest_in_a_bin(tmp_path: Path) -> None:
    """What the contacts exert balances the weight of each, and is within their cones."""
    count, radius, mu = 8, 0.05, 0.3
    places = [(0.12 * (i % 3) + 0.006 * (i // 3), radius + 0.02 + 0.13 * (i // 3)) for i in range(count)]
    text, pairs = head("bin"), dict[str, tuple[int, int | None, tuple[float, float]]]()
    walls = {"f": ((0.0, 1.0), (0.0, 0.0)), "l": ((1.0, 0.0), (-0.06, 0.0)), "r": ((-1.0, 0.0), (0.3, 0.0))}
    for i, place in enumerate(places):
        text += body(f"d{i}", 1.0, 0.5 * radius**2, place)
        others = {
            name: f'{{ line = "ground", on = {list(on)}, normal = {list(normal)} }}'
            for name, (normal, on) in walls.items()
        }
        pairs |= {f"d{i}{name}": (i, None, normal) for name, (normal, _) in walls.items()}
        others |= {f"d{k}": f'{{ body = "d{k}", disc = {radius} }}' for k in range(i)}
        pairs |= {f"d{i}d{k}": (i, k, (0.0, 0.0)) for k in range(i)}
        for name, other in others.items():
            text += f'[contacts.d{i}{name}]\nbetween = [{{ body = "d{i}", disc = {radius} }}, {other}]\n'
            text += f"friction = {mu}\n"
    result = loaded(text, tmp_path).simulate(until=3.0, verify=False)
    assert result.ok, result.reason
    assert max(abs(result[f"d{i}.{rate}"][-1]) for i in range(count) for rate in ("vx", "vy", "omega")) < 1e-9
    ends = np.array([[result[f"d{i}.x"][-1], result[f"d{i}.y"][-1]] for i in range(count)])
    loads, turns = np.tile([0.0, -G], (count, 1)), np.zeros(count)
    for name, (i, k, wall) in pairs.items():
        force, friction = result[f"{name}.force"][-1], result[f"{name}.friction"][-1]
        normal = np.array(wall) if k is None else (ends[i] - ends[k]) / np.linalg.norm(ends[i] - ends[k])
        assert force >= 0.0 and abs(friction) <= mu * force * (1.0 + 1e-8) + 1e-10
        sense = 1.0 if k is None else -1.0  # the slip of a disc on a line is the other way round
        whole = force * normal + sense * friction * np.array([normal[1], -normal[0]])
        loads[i] += whole
        turns[i] += sense * friction
        if k is not None:
            loads[k] -= whole
            turns[k] += sense * friction
    np.testing.assert_allclose(loads, 0.0, atol=1e-8)
    np.testing.assert_allclose(turns, 0.0, atol=1e-8)
