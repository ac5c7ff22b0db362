"""Two features in one file, on bodies that have nothing to do with each other: each moves as it does alone.

The features meet in one problem of rows with bounds, in one choice of modes and in one list of events; nothing else
joins them. `python -m benchmarks.meeting apart` computes the cells.
"""

from __future__ import annotations

import itertools
import json
import tempfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import symgen
from symgen.base.errors import SimulationError, SymgenError

RECORD = Path(__file__).resolve().parent / "records" / "bodies_apart.json"
Array = NDArray[np.float64]
#: Largest difference of a place or an angle from what it is alone [m, rad].
SAME = 2e-11
TIMES = np.linspace(0.0, 1.5, 31)
HEAD = '[mechanism]\nname = "apart"\ngravity = [0.0, -9.81]\n[run]\nuntil = 1.5\n'

#: A rod on a pin; `at` is the place of the pin and of its centre.
_ROD = """
[bodies.{body}]
mass = 1.0
inertia = 0.1
position = [{middle}, 0.0]
points = {{ a = [-0.5, 0.0] }}
[joints.{body}_pin]
type = "revolute"
between = ["ground", "{body}"]
at = [[{at}, 0.0], "a"]
{more}
"""
#: A block that slides along a line.
_BLOCK = """
[bodies.{body}]
mass = 1.0
inertia = 0.1
position = [{at}, 0.0]
velocity = [1.0, 0.0]
[joints.{body}_slide]
type = "translational"
between = ["ground", "{body}"]
at = [[{at}, 0.0], "centre"]
axis = [1.0, 0.0]
{more}
"""
#: A body that flies.
_FREE = """
[bodies.{body}]
mass = 1.0
inertia = 0.1
position = [{at}, {high}]
velocity = [{speed}, 0.0]
{more}
"""


def _rod(body: str, at: float, more: str) -> str:
    return _ROD.format(body=body, at=at, middle=at + 0.5, more=more)


def _block(body: str, at: float, more: str) -> str:
    return _BLOCK.format(body=body, at=at, more=more)


def _free(body: str, at: float, high: float, speed: float, more: str) -> str:
    return _FREE.format(body=body, at=at, high=high, speed=speed, more=more)


_WALL = """[contacts.wall]
between = [{ body = "H1", at = [0.0, 0.0], disc = 0.1 }, { line = "ground", on = [0.0, 0.0], normal = [0.0, 1.0] }]
friction = 0.3
restitution = 0.5"""
_TWO_WAYS = "friction = { sliding = { forwards = 1.0, backwards = 2.0 }, static = { forwards = 1.5, backwards = 2.5 } }"
_PLAY = "clearance = { hole = 0.010, pin = 0.0095, restitution = 0.5, friction = 0.1 }"

#: Feature -> the text of its bodies.
FEATURES: Mapping[str, str] = {
    "friction by a reaction": _rod("A1", 0.0, "friction = { coefficient = 0.2, radius = 0.05 }"),
    "efficiency of a gear": """
[bodies.B1]
mass = 1.0
inertia = 0.1
position = [10.0, 0.0]
angular_velocity = 1.0
[bodies.B2]
mass = 1.0
inertia = 0.1
position = [11.0, 0.0]
angular_velocity = -1.0
[joints.B1_axle]
type = "revolute"
between = ["ground", "B1"]
at = [[10.0, 0.0], "centre"]
[joints.B2_axle]
type = "revolute"
between = ["ground", "B2"]
at = [[11.0, 0.0], "centre"]
[joints.mesh]
type = "gear"
between = ["B1", "B2"]
ratio = 1.0
efficiency = 0.9
[forces.brake]
type = "torque"
body = "B2"
torque = "0.3 - 0.5*B2.omega"
""",
    "friction": _block("C1", 20.0, "friction = { sliding = 1.0, static = 1.5 }"),
    "friction, two directions": _block("D1", 30.0, _TWO_WAYS),
    "stop": _free("E1", 40.0, 0.1, 0.0, '[stops.floor]\ngap = "E1.y"\nrestitution = 0.5'),
    "stop, elastic": _free("F1", 50.0, 0.1, 0.0, '[stops.soft]\ngap = "F1.y"\nstiffness = 1e4'),
    "contact": _free("H1", 60.0, 0.2, 1.0, _WALL),
    "clearance": _rod("K1", 70.0, _PLAY),
    "joint that lets go": _rod("L1", 80.0, 'holds = { releases = "t > 0.1" }'),
    "joint that catches": """
[bodies.M1]
mass = 1.0
inertia = 0.1
position = [90.0, 0.0]
velocity = [0.0, 1.0]
[joints.M1_slide]
type = "translational"
between = ["ground", "M1"]
at = [[90.0, 0.0], "centre"]
axis = [0.0, 1.0]
[joints.M1_latch]
type = "translational"
between = ["ground", "M1"]
at = [[90.0, 0.0], "centre"]
axis = [1.0, 0.0]
holds = { catches = "M1.vy < -0.3", at_start = false }
holds_at = "present"
""",
    "massless body": """
[bodies.N1]
mass = 0.0
inertia = 0.0
position = [100.5, 0.0]
points = { a = [-0.5, 0.0], b = [0.5, 0.0] }
[bodies.N2]
mass = 1.0
inertia = 0.1
position = [101.0, 0.0]
[joints.N1_pin]
type = "revolute"
between = ["ground", "N1"]
at = [[100.0, 0.0], "a"]
[joints.N2_pin]
type = "revolute"
between = ["N1", "N2"]
at = ["b", "centre"]
""",
    "event with a reset": """
[bodies.O1]
type = "point"
mass = 1.0
position = [110.0, 0.05]
[events.kick]
when = "O1.y"
direction = "falling"
reset = { "O1.vy" = "1.0" }
""",
}
PAIRS = tuple(itertools.combinations(FEATURES, 2))


def places_of(feature: str) -> list[str]:
    """Return the places and angles of the bodies of a feature; points have no angle."""
    bodies = [line[8:-1] for line in FEATURES[feature].splitlines() if line.startswith("[bodies.")]
    axes = ("x", "y") if 'type = "point"' in FEATURES[feature] else ("x", "y", "theta")
    return [f"{body}.{axis}" for body in bodies for axis in axes]


def motion(*features: str) -> dict[str, Array]:
    """Return places and angles of bodies over time.

    Raises
    ------
    SymgenError
        With the sentence that refuses the file or ends the run.
    """
    with tempfile.TemporaryDirectory() as folder:
        (file := Path(folder) / "apart.toml").write_text(HEAD + "".join(FEATURES[f] for f in features))
        result = symgen.load(file).simulate(times=TIMES, until=TIMES[-1], rtol=1e-13, atol=1e-14, verify=False)
    if not result.ok:
        raise SimulationError(str(result.reason or result.status))
    return {place: result[place] for feature in features for place in places_of(feature)}


def compare(first: str, second: str) -> str:
    """Return ``+`` where both features move as alone; else the sentence, or how far off they are."""
    try:
        together = motion(first, second)
    except SymgenError as error:
        return str(error)
    alone = motion(first) | motion(second)
    worst = max(float(np.max(np.abs(together[place] - values))) for place, values in alone.items())
    return "+" if worst <= SAME else f"places and angles differ by {worst:.2g} m, rad"


def stored() -> dict[str, str]:
    """Return the cells as they are stored, by the names of both features."""
    cells: dict[str, str] = json.loads(RECORD.read_text(encoding="utf-8"))
    return cells


def table(cells: Mapping[str, str]) -> list[str]:
    """Return the lines of the table, half of it, and what is not done."""
    names, refusals = list(FEATURES), list(dict.fromkeys(said for said in cells.values() if said != "+"))
    lines = [
        "## Two features, on bodies of their own",
        "",
        "Two features in one file, on bodies that nothing joins: `+` where each body moves as it does alone, to",
        f"{SAME:.0e} m and rad in 1.5 s.",
        "",
        f"| | {' | '.join(names[1:])} |",
        "| --- |" + " --- |" * (len(names) - 1),
    ]
    for i, first in enumerate(names[:-1]):
        said = [cells[f"{first} + {second}"] for second in names[i + 1 :]]
        shown = [""] * i + [s if s == "+" else str(1 + refusals.index(s)) for s in said]
        lines.append(f"| {first} | {' | '.join(shown)} |")
    lines += ["", *(f"{i}. `{sentence}`" for i, sentence in enumerate(refusals, 1))] if refusals else []
    done = sum(said == "+" for said in cells.values())
    return [*lines, "", f"{done} of {len(PAIRS)} pairs are done."]


def record() -> None:
    """Compute all cells and write them."""
    cells = {f"{first} + {second}": compare(first, second) for first, second in PAIRS}
    RECORD.write_text(json.dumps(cells, indent=1) + "\n", encoding="utf-8")
