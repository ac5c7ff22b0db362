"""Cases at limits: friction that just holds or just slides, contacts that grip, a stop that is let go, rows at odds.

All bodies begin at rest and move with constant accelerations, known in closed form. `ratio` is what friction or a stop
can hold over what pulls: above 1 nothing moves.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from typing import Any

from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism
from symgen.study.stress.bench import STANDARD_GRAVITY, Base, Level

#: Angle of the slope, and of the walls of the wedge from the horizontal [rad].
SLOPE, WALL = 0.5, 0.9
#: Coefficient of friction in the wedge, radius of discs [m], their moment of inertia about the centre [kg m^2].
COEFFICIENT, RADIUS, INERTIA = 0.3, 0.1, 0.005
#: Torque on the disc of 1 kg in the wedge that both walls can just hold [N m].
HOLDING = COEFFICIENT * RADIUS * STANDARD_GRAVITY / (math.cos(WALL) * (1.0 + COEFFICIENT**2))
#: Step with which schemes of first order are accurate [s], and force with which the jaw presses [N].
_STEP, PRESS = 5e-4, 40.0

_UP, _ALONG = (0.0, 1.0), (1.0, 0.0)
_DOWN = [0.0, -STANDARD_GRAVITY]
_BLOCK: Mapping[str, Any] = {"mass": 1.0, "inertia": 0.1}
_DISC: Mapping[str, Any] = {"mass": 1.0, "inertia": INERTIA}


def _guide(body: str, axis: tuple[float, float], **keys: Mapping[str, float | str]) -> dict[str, Any]:
    """Return a translational joint from the ground to a body's centre of mass."""
    at = [[0.0, 0.0], "centre"]
    return {"type": "translational", "between": ["ground", body], "at": at, "axis": list(axis), **keys}


def _touching(
    disc: str, other: str, on: tuple[float, float], normal: tuple[float, float], friction: str | float
) -> dict[str, Any]:
    """Return a contact of a disc with a line of another body."""
    line = {"line": other, "on": list(on), "normal": list(normal)}
    return {"between": [{"body": disc, "disc": RADIUS}, line], "friction": friction}


def _walls() -> dict[str, Any]:
    """Return both contacts of the disc in the wedge, below its centre on either side."""
    s, c = math.sin(WALL), math.cos(WALL)
    places = {"left": (s, c), "right": (-s, c)}
    return {
        name: _touching("disc", "ground", (-RADIUS * n[0], -RADIUS * n[1]), n, COEFFICIENT)
        for name, n in places.items()
    }


_GRIPPING = f"ratio*{STANDARD_GRAVITY}/(2*{PRESS})"
#: Sections of the mechanisms besides their parameter.
_SECTIONS: Mapping[str, Mapping[str, Any]] = {
    "slope": {
        "mechanism": {"gravity": [STANDARD_GRAVITY * math.sin(SLOPE), -STANDARD_GRAVITY * math.cos(SLOPE)]},
        "bodies": {"block": _BLOCK},
        "joints": {"slope": _guide("block", _ALONG, friction={"coefficient": f"ratio*tan({SLOPE})"})},
    },
    "grip": {
        "mechanism": {"gravity": _DOWN},
        "bodies": {"disc": _DISC, "jaw": {**_BLOCK, "position": [2.0 * RADIUS, 0.0]}},
        "joints": {"way": _guide("jaw", _ALONG)},
        "forces": {"press": {"type": "force", "body": "jaw", "force": [-PRESS, 0.0]}},
        "contacts": {
            "wall": _touching("disc", "ground", (-RADIUS, 0.0), _ALONG, _GRIPPING),
            "pad": _touching("disc", "jaw", (-RADIUS, 0.0), (-1.0, 0.0), _GRIPPING),
        },
    },
    "wedge": {
        "mechanism": {"gravity": _DOWN},
        "bodies": {"disc": _DISC},
        "forces": {"turn": {"type": "torque", "body": "disc", "torque": f"{HOLDING!r}/ratio"}},
        "contacts": _walls(),
    },
    "pull-off": {
        "mechanism": {"gravity": _DOWN},
        "bodies": {"block": _BLOCK},
        "joints": {"guide": _guide("block", _UP, stop={"lower": 0.0})},
        "forces": {"pull": {"type": "force", "body": "block", "force": [0.0, f"{STANDARD_GRAVITY}/ratio"]}},
    },
    "contradiction": {
        "bodies": {"block": _BLOCK},
        "joints": {
            "guide": _guide("block", _ALONG),
            "one": {"type": "driver", "joint": "guide", "value": "t**2/2"},
            "other": {"type": "driver", "body": "block", "coordinate": "x", "value": "(1 + ratio)*t**2/2"},
        },
    },
}


@cache
def _mechanism(name: str) -> Mechanism:
    raw = {"parameters": {"ratio": 1.0}, "run": {"until": 2.0, "step": _STEP}, **_SECTIONS[name]}
    raw["mechanism"] = {"name": name, **raw.get("mechanism", {})}
    return validate(raw, name)


def _level(name: str, ratio: float, label: str, *accelerations: float) -> Level:
    """Return a case of 2 s whose coordinates have constant accelerations."""
    known, mechanism = {"ratio": ratio}, _mechanism(name)
    return Level(label, (ratio,), mechanism, 2.0, _STEP, parameters=known, accelerations=accelerations)


def slope(base: Base, ratio: float) -> Level:
    """Return the case of a block on a slope, with a ratio of the coefficient of friction to the slope."""
    slides = STANDARD_GRAVITY * math.sin(SLOPE) * max(0.0, 1.0 - ratio)
    return _level("slope", ratio, f"friction x {ratio:g}", slides, 0.0, 0.0)


def grip(base: Base, ratio: float) -> Level:
    """Return the case of a disc between a wall and a jaw, whose friction holds a ratio of its weight."""
    falls = -STANDARD_GRAVITY * max(0.0, 1.0 - ratio)
    return _level("grip", ratio, f"grip x {ratio:g}", *(0.0, falls, 0.0), *(0.0, 0.0, 0.0))


def wedge(base: Base, ratio: float) -> Level:
    """Return the case of a disc in a wedge, whose walls hold a ratio of the torque on it."""
    turns = HOLDING * max(0.0, 1.0 / ratio - 1.0) / INERTIA
    return _level("wedge", ratio, f"friction x {ratio:g}", 0.0, 0.0, turns)


def pull_off(base: Base, ratio: float) -> Level:
    """Return the case of a block on a stop, whose weight is a ratio of the pull away from it."""
    rises = STANDARD_GRAVITY * max(0.0, 1.0 / ratio - 1.0)
    return _level("pull-off", ratio, f"weight x {ratio:g}", 0.0, rises, 0.0)


def contradiction(base: Base, share: float) -> Level:
    """Return the case of two drivers of one coordinate that differ by a share: no motion follows both."""
    return _level("contradiction", share, f"drivers {share:g} apart", 1.0, 0.0, 0.0)
