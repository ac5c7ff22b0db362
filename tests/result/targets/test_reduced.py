"""Model exchange of Bricard's six-bar beside the same CVode on its equation of one coordinate, in closed form."""

import numpy as np
import pytest
from fmpy.sundials import CVodeSolver
from scipy.integrate import solve_ivp
from support import bricard

from symgen import load
from tests.result.targets.test_fmu import fmu_of, simulated

UNTIL, OUTPUTS = 10.0, 100


class Reduced:
    """The first angle and its rate, with what the solver calls of an FMU."""

    def __init__(self):
        self.x = np.zeros(2)

    def get_x(self, numbers, count):
        numbers[0], numbers[1] = self.x

    def set_x(self, numbers, count):
        self.x[:] = numbers[0], numbers[1]

    def get_dx(self, numbers, count):
        numbers[0], numbers[1] = self.x[1], bricard.acceleration(*self.x)

    def get_z(self, numbers, count):
        numbers[0] = 1.0

    def get_nominals(self, numbers, count):
        numbers[0] = numbers[1] = 1.0

    def set_time(self, t):
        pass

    def apply(self, t):
        pass

    def run(self, tolerance):
        names = ("get_x", "set_x", "get_dx", "get_z", "get_nominals", "set_time")
        calls = {name: getattr(self, name) for name in names}
        limits = {"startTime": 0.0, "maxStep": UNTIL / 50, "relativeTolerance": tolerance}
        solver = CVodeSolver(2, 1, input=self, **limits, **calls)
        t, angles = 0.0, [0.0]
        for k in range(1, OUTPUTS + 1):
            _, _, t = solver.step(t, k * UNTIL / OUTPUTS)
            angles.append(self.x[0])
        return np.array(angles)


@pytest.fixture(scope="module")
def reference():
    def rates(t, x):
        return x[1], bricard.acceleration(*x)

    times = np.linspace(0.0, UNTIL, OUTPUTS + 1)
    return solve_ivp(rates, (0.0, UNTIL), (0.0, 0.0), "DOP853", times, rtol=1e-13, atol=1e-14).y[0]


@pytest.fixture
def evaluations(monkeypatch):
    times, own = [], CVodeSolver.f

    def counted(solver, t, *arrays):
        times.append(t)
        return own(solver, t, *arrays)

    monkeypatch.setattr(CVodeSolver, "f", counted)
    return times


@pytest.fixture(scope="module", params=["joint", pytest.param("absolute", marks=pytest.mark.slow)])
def exported(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("fmu") / "bricard.fmu"
    return request.param, fmu_of(load("bricard"), path, coordinates=request.param)


def test_the_closed_form_closes_the_loop():
    for angle in np.linspace(-0.4, 3.5, 40):
        *_, (turn, shift) = bricard.frames(angle)
        np.testing.assert_allclose(turn, np.eye(3), rtol=0, atol=1e-14)
        np.testing.assert_allclose(shift, np.zeros(3), rtol=0, atol=1e-14)


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [1e-9, 1e-11])
def test_bricard_is_as_exact_as_its_reduced_equation(exported, tolerance, reference, evaluations):
    coordinates, path = exported
    rows = simulated(path, "ModelExchange", UNTIL, tolerance, UNTIL / OUTPUTS)
    of_fmu = len(evaluations)
    angles = 2 * np.unwrap(np.arctan2(rows["rod1.e2"], rows["rod1.e0"]))
    by_hand = np.abs(Reduced().run(tolerance) - reference).max()
    assert np.abs(angles - reference).max() < 1.5 * by_hand
    # coordinates of bodies are chosen anew five times in 10 s, after which CVode begins with small steps
    assert of_fmu < (1.2 if coordinates == "joint" else 1.4) * (len(evaluations) - of_fmu)
    for k, angle in enumerate(angles):
        places = zip(bricard.CENTRES, bricard.frames(angle), strict=False)
        for i, (centre, (turn, shift)) in enumerate(places, 1):
            at = [rows[f"rod{i}.{axis}"][k] for axis in "xyz"]
            np.testing.assert_allclose(at, turn @ centre + shift, rtol=0, atol=1e-12)
