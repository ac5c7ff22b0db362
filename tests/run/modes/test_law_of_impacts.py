"""The law of impacts is one formula: a plugin's own law moves the motion, all books, C and derivatives together."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import pytest

G, HEIGHT, RATE = 9.81, 1.0, 2.0

#: A module that gives stops another law.
PLUGIN = """
import json, sys
import symgen
from symgen.base.vocabulary.expressions import Number, call
from symgen.describe.bounds.end_stop import EndStop
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

given = EndStop.rebound


def rebound(self, rate):
    return LAW


EndStop.rebound = rebound

FILE = '''
[mechanism]
name = "hammer"
gravity = [0.0, -9.81]
[parameters]
e = 0.8
[bodies.hammer]
type = "point"
mass = 2.0
position = [0.0, 1.0]
velocity = [0.0, -2.0]
[stops.anvil]
gap = "hammer.y"
restitution = "e"
[outputs]
lost = { value = "anvil.dissipated", unit = "J" }
'''
model = symgen.load(validate(parse_toml(FILE, "hammer.toml"), "hammer.toml"))
"""
HALVED = 'call("mul", Number(0.5), given(self, rate))'
#: A restitution that falls with the rate: e / (1 + |u| / 4).
FALLING = 'call("div", given(self, rate), call("add", Number(1.0), call("mul", Number(0.25), call("abs", rate))))'


def answer(law: str, code: str, *words: str) -> dict:
    """Return what a process with the plugin prints."""
    program = PLUGIN.replace("LAW", law) + code
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program, *words], capture_output=True, text=True, timeout=600, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


MOTION = """
run = model.simulate(until=6.0, integrator="dop853", rtol=1e-11, atol=1e-12, coordinates=sys.argv[1])
hits = [event for event in run.events if event.name.endswith(".hit")]
rest = [event.t for event in run.events if event.name.endswith(".rest")]
sweep = model.sweep({"e": [0.4, 0.8]}, until=6.0, quantities=("hammer.y",), times=[0.9], coordinates=sys.argv[1])
alone = model.simulate(until=6.0, times=[0.9], coordinates=sys.argv[1], verify=False)
print(json.dumps({
    "status": run.status, "rest": rest, "notes": list(run.notes), "lost": float(run.outputs["lost"][-1]),
    "before": [event.v["hammer.vy"] for event in hits], "after": [event.v_after["hammer.vy"] for event in hits],
    "work": sum(event.work for event in run.events), "energy": float(run.kinetic[0] + run.potential[0]),
    "row": float(sweep["hammer.y"][1, 0]), "alone": float(alone["hammer.y"][0]),
}))
"""


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_all_books_follow_a_law_that_is_halved(coordinates: str) -> None:
    """Rates, works of impacts, dissipation, rest and rows by the closed form of a restitution of 0.4."""
    found, e = answer(HALVED, MOTION, coordinates), 0.4
    first = math.sqrt(RATE**2 + 2.0 * G * HEIGHT)
    assert found["status"] == "ok" and len(found["before"]) > 10
    for k, (before, after) in enumerate(zip(found["before"], found["after"], strict=True)):
        assert before == pytest.approx(-first * e**k, rel=1e-8, abs=1e-7)
        assert after == pytest.approx(-e * before, rel=1e-12)
    whole = 0.5 * 2.0 * first**2  # all that is there is taken in the end
    assert found["work"] == pytest.approx(-whole, rel=1e-9)
    assert found["lost"] == pytest.approx(whole, rel=1e-9)
    fall = (first - RATE) / G
    assert found["rest"] == pytest.approx([fall + 2.0 * first * e / (1.0 - e) / G], abs=1e-5)
    assert f"accumulate at t = {fall + 2.0 * first * e / (1.0 - e) / G:.6g}"[:-1] in found["notes"][0]
    assert found["row"] == found["alone"]


@pytest.mark.slow
def test_a_restitution_that_falls_with_the_rate_is_a_line() -> None:
    found = answer(FALLING, MOTION, "absolute")
    assert found["status"] == "ok" and len(found["before"]) > 10
    for before, after in zip(found["before"], found["after"], strict=True):
        assert after == pytest.approx(-before * 0.8 / (1.0 + 0.25 * abs(before)), rel=1e-12)
    taken = sum(v**2 - u**2 for v, u in zip(found["before"], found["after"], strict=True))
    assert found["work"] == pytest.approx(-taken, rel=1e-5) and found["lost"] == pytest.approx(
        -found["work"], rel=1e-12
    )
    assert found["row"] == found["alone"]


DERIVATIVES = """
options = {"until": 1.1, "integrator": "dop853", "rtol": 1e-12, "atol": 1e-13, "verify": False}
exact = model.simulate(sensitivities=("e",), **options)
ends = [model.simulate(parameters={"e": 0.8 + d}, **options)["hammer.y"][-1] for d in (-1e-5, 1e-5)]
print(json.dumps({"exact": float(exact.gradient("hammer.y")["e"][-1]), "differences": (ends[1] - ends[0]) / 2e-5}))
"""


@pytest.mark.slow
def test_derivatives_follow_the_law() -> None:
    found = answer(FALLING, DERIVATIVES)
    assert abs(found["exact"]) > 0.1 and found["exact"] == pytest.approx(found["differences"], rel=1e-7)


PRINTED = """
from pathlib import Path
from symgen.result.targets import TARGETS
model.generate(sys.argv[1], target="c", integrator="dop853")
run = model.simulate(until=1.5, integrator="dop853", verify=False)
print(json.dumps({"end": [float(run["hammer.y"][-1]), float(run["hammer.vy"][-1])]}))
"""


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_c_follows_the_law(tmp_path: Path) -> None:
    found, folder = answer(FALLING, PRINTED, str(tmp_path / "c")), tmp_path / "c"
    command = ["cc", "-std=c99", "-O2", *map(str, sorted(folder.glob("*.c"))), "-lm", "-o", str(tmp_path / "run")]
    subprocess.run(command, check=True, timeout=300)
    done = subprocess.run([tmp_path / "run", "1.5"], check=True, capture_output=True, text=True, env=os.environ)
    head, *rows = done.stdout.splitlines()
    last = dict(zip(head.split(","), map(float, rows[-1].split(",")), strict=True))
    assert [last["hammer.y"], last["hammer.vy"]] == pytest.approx(found["end"], abs=1e-8)
