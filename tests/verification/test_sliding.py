"""Points that slide along curves, beams and cables, beside closed forms and simulations of their own."""

import itertools
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import fsolve
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c import rows_of

G, LENGTH, SPAN, STIFF, MASS, LOAD = 9.81, 4.05, 4.0, 500.0, 0.5, 2.0
TIGHT = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12, "verify": False}
#: Weights of the nodes at either end of a rule for even steps that integrates cubics (Gregory's).
ENDS = (3 / 8, 7 / 6, 23 / 24)


def model_of(**sections) -> symgen.Model:
    return symgen.Model(mechanism_of({"mechanism": {"name": "sliding", "gravity": [0.0, -G]}, **sections}))


def trolley(elements: int, x: float = 0.9, **joints) -> symgen.Model:
    """Return a trolley on a cable between two supports, which hangs in an arc at the start."""
    cable = {"start": [0.0, 0.0], "end": [SPAN, 0.0], "arc": 0.77, "length": LENGTH, "elements": elements}
    cable |= {"cable": True, "axial": "stiff", "mass": MASS, "clamp": ["ground", "ground"]}
    return model_of(
        parameters={"load": LOAD, "stiff": STIFF},
        beams={"line": cable},
        bodies={"trolley": {"type": "point", "mass": "load", "position": [x, -0.3]}},
        joints={"wheel": {"type": "slides-on", "body": "trolley", "beam": "line"}, **joints},
    )


class OwnTrolley:
    """The same trolley by Lagrange's equations of nodes and way; pieces end at events of SciPy."""

    def __init__(self, elements: int) -> None:
        n, self.step = elements, LENGTH / elements
        weights = [(*ENDS, 1.0)[min(k, n - k, 3)] for k in range(n + 1)]
        self.masses = MASS * self.step * np.array(weights)[1:-1]
        slopes = np.zeros((n + 1, n + 1))
        for k in range(1, n):
            slopes[k, k - 1 : k + 2] = -0.5, 0.0, 0.5
        slopes[0, :3], slopes[n, n - 2 :] = (-1.5, 2.0, -0.5), (0.5, -2.0, 1.5)
        self.pieces, self.elements = CubicHermiteSpline(np.arange(n + 1.0), np.eye(n + 1), slopes).c, n

    def rates(self, piece: int) -> Callable[[float, np.ndarray], np.ndarray]:
        def evaluate(_: float, y: np.ndarray) -> np.ndarray:
            q, v = np.split(y, 2)
            nodes = np.vstack([[0.0, 0.0], q[:-1].reshape(-1, 2), [SPAN, 0.0]])
            moving = np.vstack([[0.0, 0.0], v[:-1].reshape(-1, 2), [0.0, 0.0]])
            between = np.diff(nodes, axis=0)
            lengths = np.linalg.norm(between, axis=1)
            pulls = (STIFF / self.step * np.maximum(lengths - self.step, 0.0) / lengths)[:, None] * between
            forces = np.vstack([pulls, [[0.0, 0.0]]]) - np.vstack([[[0.0, 0.0]], pulls])
            forces[1:-1, 1] -= self.masses * G
            u, rate = q[-1] / self.step - piece, v[-1] / self.step
            powers = [u**3, u**2, u, 1.0], [3.0 * u**2, 2.0 * u, 1.0, 0.0], [6.0 * u, 2.0, 0.0, 0.0]
            shape, slope, bend = (np.array(p) @ self.pieces[:, piece] for p in powers)
            along = np.column_stack([np.kron(shape[1:-1], np.eye(2)), slope @ nodes / self.step])
            bias = 2.0 * rate * (slope @ moving) + rate**2 * (bend @ nodes)
            mass = np.diag([*np.repeat(self.masses, 2), 0.0]) + LOAD * along.T @ along
            right = np.append(forces[1:-1].ravel(), 0.0) + LOAD * along.T @ (np.array([0.0, -G]) - bias)
            return np.concatenate([v, np.linalg.solve(mass, right)])

        return evaluate

    def run(self, q: np.ndarray, until: float) -> tuple[np.ndarray, int]:
        """Return the coordinates at the end of a run from rest, and how often the piece has changed."""
        t, y, passed = 0.0, np.concatenate([q, np.zeros_like(q)]), 0
        piece, place = int(q[-1] / self.step), len(q) - 1
        while t < until:
            ends = []
            for edge, direction in ((piece + 1, 1.0), (piece, -1.0)):
                ends.append(lambda _, y, edge=edge: y[place] / self.step - edge)
                ends[-1].terminal, ends[-1].direction = True, direction
            part = solve_ivp(self.rates(piece), (t, until), y, "DOP853", rtol=1e-11, atol=1e-12, events=ends)
            t, y = part.t[-1], part.y[:, -1]
            if part.status == 1:
                piece, passed = piece + (1 if len(part.t_events[0]) else -1), passed + 1
        return y[: len(q)], passed


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_bead_on_a_straight_rigid_curve_falls_as_on_a_slope(coordinates):
    """Over four pieces, with steps that know nothing of them but their ends; then it strikes the end."""
    stations = [{"at": [0.4 * k, -0.3 * k]} for k in range(5)]
    on = {"type": "slides-on", "body": "bead", "along": stations, "step": 0.5, "start": {"displacement": 0.1}}
    on["stop"] = {"upper": 2.0, "restitution": 0.5}
    model = model_of(bodies={"bead": {"type": "point", "mass": 0.3, "position": [0.08, -0.06]}}, joints={"on": on})
    hit = np.sqrt(2.0 * 1.9 / (0.6 * G))
    run = model.simulate(until=hit + 0.2, coordinates=coordinates, **TIGHT)
    assert run.ok
    before = run.t < hit
    np.testing.assert_allclose(run["on.displacement"][before], 0.1 + 0.3 * G * run.t[before] ** 2, atol=1e-9)
    back = 2.0 - 0.5 * 0.6 * G * hit * (run.t - hit) + 0.3 * G * (run.t - hit) ** 2
    np.testing.assert_allclose(run["on.displacement"][~before], back[~before], atol=1e-9)
    np.testing.assert_allclose(run["on.F"][before], 0.8 * 0.3 * G, atol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_bead_on_a_turning_rod_leaves_its_axis(space):
    """r'' = r w^2: a hyperbolic cosine, over five points of the rod with directions."""
    spatial = space == "spatial"
    rest = [0.0] if spatial else []
    stations = [{"body": "rod", "at": [0.5 * k, 0.0, *rest], "axis": [1.0, 0.0, *rest]} for k in range(5)]
    pin = {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0, *rest], "centre"]}
    bead = {"type": "point", "mass": 0.3, "position": [0.2, 0.0, *rest]}
    rod = {"mass": 1.0, "inertia": [1.0] * 3 if spatial else 1.0}
    model = symgen.Model(
        mechanism_of(
            {
                "mechanism": {"name": "rod", "space": space},
                "bodies": {"rod": rod, "bead": bead},
                "joints": {
                    "pin": pin | ({"axis": [0.0, 0.0, 1.0]} if spatial else {}),
                    "motor": {"type": "driver", "joint": "pin", "value": "2*t"},
                    "on": {"type": "slides-on", "body": "bead", "along": stations, "step": 0.5},
                },
            }
        )
    )
    run = model.simulate(until=1.2, **TIGHT)
    np.testing.assert_allclose(run["on.displacement"], 0.2 * np.cosh(2.0 * run.t), atol=1e-9)


@pytest.mark.slow
def test_a_bead_falls_freely_along_a_hanging_cable_until_friction_brakes_it():
    """The cable hangs straight, so that the bead falls as if it were alone; the weight of the cable stretches it."""
    cable = {"start": [0.0, 0.0], "end": [0.0, -2.0], "elements": 5, "cable": True, "axial": 900.0, "mass": 0.4}
    bead = {"type": "point", "mass": 0.3, "position": [0.0, -0.1], "velocity": [0.0, -1.0], "hold": "velocity"}
    on = {"type": "slides-on", "body": "bead", "beam": "rope"}
    for force in (0.0, 1.2):
        keys = {"friction": {"sliding": force}} if force else {}
        model = model_of(
            beams={"rope": cable | {"clamp": ["ground", ""]}}, bodies={"bead": bead}, joints={"on": on | keys}
        )
        run = model.simulate(until=0.4, **TIGHT)
        fall = -0.1 - run.t - 0.5 * (G - force / 0.3) * run.t**2
        strain = 0.02 if force else 0.0  # friction counts by the unloaded length
        np.testing.assert_array_less(abs(run["bead.y"] - fall), 1e-9 + strain * 0.5 * force / 0.3 * run.t**2)
        if force:  # what the bead loses pulls at the cable
            assert run["rope.e1.force"].min() < -0.4 * 2.0 * G


@pytest.mark.slow
@pytest.mark.parametrize(("elements", "coordinates"), [(6, "absolute"), (6, "joint"), (9, "absolute")])
def test_a_trolley_on_a_sagging_cable_beside_a_simulation_of_its_own(elements, coordinates):
    run = trolley(elements).simulate(until=0.8, coordinates=coordinates, **TIGHT)
    nodes = [f"line.{k}.{c}" for k in range(1, elements) for c in "xy"]
    first, end = (np.array([*(run[name][i] for name in nodes), run["wheel.displacement"][i]]) for i in (0, -1))
    own, passed = OwnTrolley(elements).run(first, 0.8)
    assert passed >= 1
    np.testing.assert_allclose(end, own, atol=1e-9)


def hanging(at: float) -> tuple[float, float]:
    """Return where a load hangs on an elastic catenary (Irvine, Cable Structures, 1981, section 1.4)."""
    weight, load = MASS * G, LOAD * G

    def place(across: float, up: float, s: float) -> tuple[float, float]:
        x = across * s / STIFF + across / weight * (np.arcsinh(up / across) - np.arcsinh((up - weight * s) / across))
        stretched = (up * s - weight * s**2 / 2.0) / STIFF
        return x, -stretched - (np.hypot(across, up) - np.hypot(across, up - weight * s)) / weight

    def miss(forces: np.ndarray) -> list[float]:
        near, far = place(*forces, at), place(forces[0], forces[1] - weight * at - load, LENGTH - at)
        return [near[0] + far[0] - SPAN, near[1] + far[1]]

    return place(*fsolve(miss, (30.0, 24.0), xtol=1e-13), at)


@pytest.mark.slow
@pytest.mark.parametrize(("part", "order", "last"), [(0.25, 2, 2.2e-4), (1.0 / 3.0, 1, 1e-2)])
def test_a_held_trolley_hangs_where_a_load_on_an_elastic_catenary_does(part, order, last):
    """Second order at nodes; between them the kink under the load is as wide as an element: first order."""
    at = part * LENGTH
    exact, errors = hanging(at), []
    for elements in (8, 16, 32):
        model = trolley(elements, hold={"type": "driver", "joint": "wheel", "value": at})
        rest = model.equilibrium().q
        errors.append(np.hypot(rest["trolley.x"] - exact[0], rest["trolley.y"] - exact[1]))
    assert errors[-1] < last
    for before, after in itertools.pairwise(errors):
        assert abs(np.log2(before / after) - order) < 0.35, errors


@pytest.mark.slow
def test_derivatives_pass_from_element_to_element():
    model, values = trolley(6), {"load": LOAD, "stiff": STIFF}
    settings = {"until": 0.8, **TIGHT}
    run = model.simulate(sensitivities=tuple(values), **settings)
    way = model.gradient(
        "trolley.x", by=tuple(values), way="adjoint", **{k: x for k, x in settings.items() if k != "verify"}
    )
    assert run.ok and int(run["wheel.displacement"][0] * 6 / LENGTH) < int(run["wheel.displacement"][-1] * 6 / LENGTH)
    for name, value in values.items():
        h = 1e-4 * value
        ends = [model.simulate(parameters={name: value + d}, **settings)["trolley.x"][-1] for d in (h, -h)]
        difference = (ends[0] - ends[1]) / (2.0 * h)
        assert abs(run.gradient("trolley.x")[name][-1] - difference) < 1e-6 * abs(difference)
        assert abs(way.by[name] - difference) < 1e-6 * abs(difference)


@pytest.mark.slow
def test_rows_steps_and_c_slide_as_a_run_does(tmp_path):
    model = trolley(6)
    run = model.simulate(until=0.8, **TIGHT)
    settings = {k: x for k, x in TIGHT.items() if k != "verify"}
    sweep = model.sweep({"load": [1.5, LOAD]}, quantities=["trolley.x"], until=0.8, **settings)
    assert list(sweep.status) == ["ok", "ok"]
    assert abs(sweep["trolley.x"][1] - run["trolley.x"][-1]) < 1e-12
    steps = model.start(**settings)
    while steps.t < 0.8 - 1e-12:
        steps.step(0.1)
    assert abs(steps["trolley.x"] - run["trolley.x"][-1]) < 1e-9
    names, rows = rows_of(
        compiled(
            written(model.mechanism, tmp_path, coordinates="absolute", integrator="dop853", rtol=1e-11, atol=1e-12)
        ),
        "0.8",
    )
    assert abs(rows[-1, names.index("trolley.x")] - run["trolley.x"][-1]) < 1e-9


@pytest.mark.slow
def test_friction_by_the_reaction_on_a_straight_rigid_curve():
    """300 coefficients on a slope of 3 to 4, as x'' = g (0.6 - 0.8 mu), or at rest from mu = 0.75 on."""
    stations = [{"at": [0.4 * k, -0.3 * k]} for k in range(5)]
    on = {"type": "slides-on", "body": "bead", "along": stations, "step": 0.5, "friction": {"coefficient": "mu"}}
    model = model_of(
        parameters={"mu": 0.3},
        bodies={"bead": {"type": "point", "mass": 0.3, "position": [0.08, -0.06]}},
        joints={"on": on},
    )
    mu, until = np.linspace(0.0, 1.0, 300), 0.7
    rows = model.sweep({"mu": list(mu)}, quantities=["on.displacement"], until=until, rtol=1e-10, atol=1e-12)
    assert set(rows.status) == {"ok"}
    for keys, refused in (({"shape": "looped"}, "straight code"), ({"method": "udwadia-kalaba"}, "massless bodies")):
        with pytest.raises(InputError, match=refused):
            model.simulate(until=until, **keys)
    way = 0.1 + 0.5 * G * np.maximum(0.6 - 0.8 * mu, 0.0) * until**2
    np.testing.assert_allclose(rows["on.displacement"][:, 0], way, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_bead_loses_its_speed_round_a_bend_as_a_rope_its_tension(space):
    """v = v0 exp(-mu angle), exactly where tangents are given, for any curve between; in space the bend is tilted."""
    spatial, mu, speed = space == "spatial", 0.3, 2.0
    tilt = np.array([[1.0, 0.0], [0.0, 0.8], [0.0, 0.6]] if spatial else np.eye(2))
    angles = np.linspace(0.0, np.pi, 5)
    at = 0.5 * np.column_stack([np.sin(angles), 1.0 - np.cos(angles)]) @ tilt.T
    axes = np.column_stack([np.cos(angles), np.sin(angles)]) @ tilt.T
    stations = [{"at": p.tolist(), "axis": a.tolist()} for p, a in zip(at, axes, strict=True)]
    bead = {"type": "point", "mass": 0.3, "position": at[0].tolist(), "velocity": (speed * axes[0]).tolist()}
    on = {"type": "slides-on", "body": "bead", "along": stations, "step": 0.125 * np.pi, "stop": {"lower": -1.0}}
    model = symgen.Model(
        mechanism_of(
            {
                "mechanism": {"name": "bend", "space": space},
                "bodies": {"bead": bead},
                "joints": {"on": on | {"friction": {"coefficient": mu}}},
                "outputs": {"lost": {"value": "on.dissipated", "unit": "J"}},
            }
        )
    )
    run = model.simulate(until=2.2, **TIGHT)
    assert run.ok
    passed = [event for event in run.events if event.name.startswith("on.passes")]
    speeds = [np.linalg.norm([event.v[f"bead.v{x}"] for x in "xyz"[: tilt.shape[0]]]) for event in passed]
    np.testing.assert_allclose(speeds, speed * np.exp(-mu * angles[1:4]), rtol=1e-7)  # events are found a little late
    last = np.linalg.norm([run[f"bead.v{x}"][-1] for x in "xyz"[: tilt.shape[0]]])  # straight on after the bend
    np.testing.assert_allclose(last, speed * np.exp(-mu * np.pi), rtol=1e-9)
    lost = 0.5 * 0.3 * (speed**2 - last**2)
    np.testing.assert_allclose(run["lost"][-1], lost, rtol=1e-8)


@pytest.mark.slow
def test_friction_by_the_reaction_on_a_sagging_cable_in_rows_steps_derivatives_and_c(tmp_path):
    """A trolley rolls on a cable and comes to rest; targets agree, and the power of the force is what is lost."""
    wheel = {"type": "slides-on", "body": "trolley", "beam": "line", "friction": {"coefficient": 0.1}}
    model = trolley(6, wheel=wheel)
    run = model.simulate(until=0.8, sensitivities=["load"], **{k: x for k, x in TIGHT.items() if k != "verify"})
    assert run.ok and abs(run["wheel.force"]).max() > 0.09
    np.testing.assert_allclose(run.energy["error"], 0.0, atol=1e-8)
    ends = [model.simulate(parameters={"load": LOAD + d}, until=0.8, **TIGHT)["trolley.x"][-1] for d in (1e-4, -1e-4)]
    assert abs(run.gradient("trolley.x")["load"][-1] - (ends[0] - ends[1]) / 2e-4) < 1e-6
    settings = {k: x for k, x in TIGHT.items() if k != "verify"}
    rows = model.sweep({"load": [LOAD]}, quantities=["trolley.x"], until=0.8, **settings)
    assert abs(rows["trolley.x"][0] - run["trolley.x"][-1]) < 1e-10
    c = written(model.mechanism, tmp_path, coordinates="absolute", integrator="dop853", rtol=1e-11, atol=1e-12)
    names, printed = rows_of(compiled(c), "0.8")
    assert abs(printed[-1, names.index("trolley.x")] - run["trolley.x"][-1]) < 1e-9
