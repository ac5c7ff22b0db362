"""Spheres without friction that strike each other and the walls of a box, beside flights in closed form."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.run.contacts.scenes import G, loaded
from tests.run.contacts.scenes_in_space import body, contact, head

#: Half of the width of the box; its floor is at 0.
HALF = 0.5
WALLS = [((1.0, 0.0, 0.0), HALF), ((-1.0, 0.0, 0.0), HALF), ((0.0, 1.0, 0.0), HALF), ((0.0, -1.0, 0.0), HALF)]
FLOOR = ((0.0, 0.0, 1.0), 0.0)


class Flights:
    """Spheres that fly on parabolas between impacts, whose times are roots of quadratic equations."""

    def __init__(self, places: Any, rates: Any, masses: Any, radii: Any, e: float) -> None:
        self.x, self.v = np.array(places, dtype=float), np.array(rates, dtype=float)
        self.m, self.r, self.e, self.t = masses, radii, e, 0.0
        self.impacts: list[float] = []

    def until(self, end: float) -> None:
        """Fly and strike until an end."""
        while True:
            t, normal, one, other = min(self._meetings(), key=lambda each: each[0])
            step = min(t, end - self.t)
            self.x += self.v * step
            self.x[:, 2] -= G * step * step / 2.0
            self.v[:, 2] -= G * step
            self.t += step
            if t > step:
                return
            self.impacts.append(self.t)
            n = np.array(normal) if other < 0 else (self.x[one] - self.x[other]) / (self.r[one] + self.r[other])
            closing = (self.v[one] - (0.0 if other < 0 else self.v[other])) @ n
            impulse = -(1.0 + self.e) * closing / (1.0 / self.m[one] + (0.0 if other < 0 else 1.0 / self.m[other]))
            self.v[one] += impulse / self.m[one] * n
            if other >= 0:
                self.v[other] -= impulse / self.m[other] * n

    def _meetings(self) -> list[tuple[float, Any, int, int]]:
        found: list[tuple[float, Any, int, int]] = [(math.inf, (0.0, 0.0, 0.0), 0, -1)]
        for i in range(len(self.m)):
            for normal, far in (*WALLS, FLOOR):
                n = np.array(normal)
                a, b, c = -0.5 * G * n[2], self.v[i] @ n, self.x[i] @ n + far - self.r[i]
                found.append((_first_root(a, b, c), normal, i, -1))
            for j in range(i):
                x, v = self.x[i] - self.x[j], self.v[i] - self.v[j]
                t = _first_root(v @ v, 2.0 * (x @ v), x @ x - (self.r[i] + self.r[j]) ** 2)
                found.append((t, (0.0, 0.0, 0.0), i, j))
        return found


def _first_root(a: float, b: float, c: float) -> float:
    """Return when a t^2 + b t + c falls through 0, inf for never; what is near 0 and rises has just struck."""
    c = 0.0 if abs(c) < 1e-12 else c
    roots = [-c / b] if a == 0.0 and b != 0.0 else []
    if a != 0.0 and b * b >= 4.0 * a * c:
        q = -0.5 * (b + math.copysign(math.sqrt(b * b - 4.0 * a * c), b))
        roots = [q / a] + ([c / q] if q != 0.0 else [])
    return min((t for t in roots if t >= 0.0 and 2.0 * a * t + b < 0.0), default=math.inf)


def heap(seed: int, count: int) -> tuple[Flights, str]:
    """Return spheres in a box, and their file, in which `speed` is that of the first one along x."""
    draw = np.random.default_rng(seed)
    radii = draw.uniform(0.05, 0.12, count)
    places = [[0.6 * HALF * math.cos(2.4 * i), 0.6 * HALF * math.sin(2.4 * i), 0.3 + 0.26 * i] for i in range(count)]
    rates, masses, e = draw.normal(size=(count, 3)), draw.uniform(0.5, 2.0, count), float(draw.uniform(0.8, 1.0))
    text = head() + f"[parameters]\nspeed = {float(rates[0, 0])!r}\n"
    for i in range(count):
        text += body(f"b{i}", places[i], rates[i], masses[i])
        for k, (normal, far) in enumerate((*WALLS, FLOOR)):
            on, way = [-far * x for x in normal], list(normal)
            plane = f'plane = "ground", on = {on!r}, normal = {way!r}'
            text += contact(f'body = "b{i}", sphere = {float(radii[i])!r}', plane, e, f"w{i}_{k}")
        for j in range(i):
            spheres = (f'body = "b{k}", sphere = {float(radii[k])!r}' for k in (i, j))
            text += contact(*spheres, e, f"c{i}_{j}")
    text = text.replace(f"velocity = [{float(rates[0, 0])!r}", 'velocity = ["speed"', 1)
    return Flights(places, rates, masses, radii, e), text


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_random_heaps_are_their_closed_forms(seed: int, tmp_path: Path) -> None:
    """Errors grow with each impact; the first fifteen are compared, and the places after them."""
    flights, text = heap(seed, 2 + seed % 2)
    flights.until(3.0)
    until = 0.5 * (flights.impacts[14] + flights.impacts[15])
    end, _ = heap(seed, 2 + seed % 2)
    end.until(until)
    result = loaded(text, tmp_path).simulate(until=until, integrator="dop853", verify=False, rtol=1e-12)
    hits = [event.t for event in result.events if event.name.endswith(".hit")]
    assert result.ok and np.allclose(hits, end.impacts, rtol=0.0, atol=1e-8) and len(hits) == 15
    for i, place in enumerate(end.x):
        assert np.allclose([result[f"b{i}.{x}"][-1] for x in "xyz"], place, rtol=0.0, atol=1e-7)


@pytest.mark.slow
def test_three_hundred_speeds(tmp_path: Path) -> None:
    """Rows of a sweep of three spheres: none fails, and each is its closed form unless two impacts meet."""
    flights, text = heap(11, 3)
    speeds, until = np.linspace(-1.5, 1.5, 300), 0.7
    table = loaded(text, tmp_path).sweep(vary={"speed": speeds}, until=until, integrator="dop853", rtol=1e-11)
    frame = table.to_dataframe()
    keys = [next(key for key in frame.columns if key.startswith(f"b{i}.{x}")) for i in range(3) for x in "xyz"]
    start, counts = flights.v.copy(), set()
    for speed, row in zip(speeds, frame[keys].to_numpy(), strict=True):
        own, _ = heap(11, 3)
        own.v = start.copy()
        own.v[0, 0] = speed
        own.until(until)
        counts.add(len(own.impacts))
        assert np.allclose(row, own.x.ravel(), rtol=0.0, atol=1e-7), speed
    assert len(counts) > 1
