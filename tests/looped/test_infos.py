"""Both shapes name the same things: rows, multipliers, dropped rows, massless velocities, angles that count turns."""

import copy
import re
from dataclasses import replace
from typing import Any

import msgspec
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.emitted import mechanism_of
from support.random_mechanisms import descriptions
from support.random_space import make

from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.model import lower_model
from symgen.describe.facts.repeats import without_repeats
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model
from symgen.run.compiling.straight import model_info

PLANAR = ("revolute", "rigid", "translational", "pin-in-slot", "driver", "gear", "distance", "knife-edge", "rolling")
SPATIAL = ("revolute", "spherical", "cylindrical", "universal", "translational", "rigid", "screw", "driver", "distance")
#: What each shape lays out in its own way, and a digest that only straight code is told. Rows that are eliminated alone
#: are the same where kernels know all zeros of D. Looped code takes S, and closes no loops.
OWN = ("digest", "sections", "jacobian", "hoisted", "operations", "alone", "pairs", "fixed")


def infos(mechanism: Mechanism) -> list[dict[str, Any]]:
    """What results and reports learn of a mechanism from its straight and from its looped code."""
    equations = formulate(mechanism)
    method = choose_method("lagrange")
    looped = compile_model(mechanism, replace(method, shape="looped"))
    straight, found = model_info(lower_model(equations, ""), equations), []
    for info in (straight, looped.info):
        found.append({name: value for name, value in msgspec.to_builtins(info).items() if name not in OWN})
    straight, looped = ({(row, column) for row, column, _, _ in info.jacobian} for info in (straight, looped.info))
    assert straight <= looped, "kernels know fewer zeros of D than code for one mechanism, never more"
    return found


def rewritten(value: Any, rng: np.random.Generator) -> Any:
    """Keys of a joint with numbers and formulas written in another way."""
    if isinstance(value, dict):
        kept = ("type", "between", "body", "joint", "joints", "coordinate", "mesh", "carrier", "pinion", "rack")
        return {k: v if k in kept else rewritten(v, rng) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [rewritten(item, rng) for item in value]
    if isinstance(value, str) and re.fullmatch("[PQ]|centre|x|y|z|displacement.?|angle.?", value):
        return value
    return rng.choice([f"1*({value})", f"({value}) + 0", f"({value})/1"]).item() if rng.random() < 0.7 else value


def doubled(raw: dict[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """A description with some of its joints once more, in other words."""
    raw = copy.deepcopy(raw)
    for name, keys in list(raw["joints"].items()):
        if rng.random() < 0.6:
            raw["joints"][f"{name}_again"] = rewritten(keys, rng)
    return raw


def agree(raw: dict[str, Any]) -> tuple[dict[str, Any], int]:
    """Check that both shapes say the same; return it, and how many joints stand there twice."""
    straight, looped = infos(mechanism_of(raw))
    assert looped == straight
    straight["dropped_rows"] = list(straight["dropped_rows"])
    return straight, sum(name.endswith("_again") for name in raw["joints"])


SLOW = settings(max_examples=16, deadline=None, suppress_health_check=list(HealthCheck))


@pytest.mark.slow
@SLOW
@given(st.lists(st.sampled_from(PLANAR), min_size=1, max_size=4), st.integers(0, 10**6), st.data())
def test_planar_mechanisms(joints, seed, data):
    raw = data.draw(descriptions(tuple(joints), ("force",), 3))
    info, again = agree(doubled(raw, np.random.default_rng(seed)))
    assert len(info["dropped_rows"]) >= again, "all rows of a joint that stands there twice are dropped"


@pytest.mark.by_turns(2)
@pytest.mark.slow
@SLOW
@given(st.lists(st.sampled_from(SPATIAL), min_size=1, max_size=3), st.integers(0, 10**6))
def test_spatial_mechanisms(joints, seed):
    rng = np.random.default_rng(seed)
    raw, *_ = make(rng, tuple(joints), ("spring-damper",))
    info, again = agree(doubled(raw, rng))
    assert len(info["dropped_rows"]) >= again


def pins(second: object) -> dict[str, Any]:
    """Two pins between the same bodies, the second one at a point of another spelling."""
    rod = {"mass": 1.0, "inertia": 1.0, "points": {"P": ["p", 0.0]}}
    return {
        "mechanism": {"name": "pins", "gravity": [0.0, -9.81]},
        "parameters": {"p": 0.5, "none": 0.0},
        "bodies": {"a": rod},
        "joints": {
            "A": {"type": "revolute", "between": ["ground", "a"], "at": [["p", 0.0], "P"]},
            "B": {"type": "revolute", "between": ["ground", "a"], "at": [["p", 0.0], second]},
        },
    }


@pytest.mark.parametrize(
    "second", ["P", ["p", 0.0], ["1*p", 0.0], ["p + 0", "0*p"], ["2*p/2", "p - p"], ["-(-p)", 0.0]]
)
def test_a_point_is_the_same_however_it_is_written(second):
    info, _ = agree(pins(second))
    assert [row["name"] for row in info["rows"]] == ["A.x", "A.y"]
    assert info["dropped_rows"] == ["B.x = A.x", "B.y = A.y"]


def test_another_point_is_another_row():
    info, _ = agree(pins(["2*p", 0.0]))
    assert [row["name"] for row in info["rows"]] == ["A.x", "A.y", "B.x", "B.y"] and not info["dropped_rows"]


def test_a_parameter_that_is_zero_is_not_the_number_zero():
    info, _ = agree(pins(["p", "none"]))
    assert len(info["rows"]) == 4 and not info["dropped_rows"]


@pytest.mark.parametrize(
    ("joints", "dropped"),
    [
        # on the ground only the height along the row's direction counts
        ([{"at": [[0.0, 1.0], "centre"]}, {"at": [[5.0, "1*1"], "centre"]}], ["B.y = A.y"]),
        # an angle is a difference, whatever bodies it goes through
        (
            [
                {"type": "gear", "between": ["a", "b"], "ratio": 1.0, "mesh": "internal"},
                {"type": "rigid", "between": ["a", "b"], "at": ["centre", "centre"]},
            ],
            ["B.angle = A.mesh"],
        ),
    ],
)
def test_rows_of_different_joints_that_are_one_condition(joints, dropped):
    pin = {"type": "revolute", "between": ["ground", "a"]}
    raw = pins("P") | {"joints": dict(zip("AB", (pin | keys for keys in joints), strict=True))}
    raw["bodies"] = {name: {"mass": 1.0, "inertia": 1.0} for name in "ab"}
    _, repeats = without_repeats(mechanism_of(raw))
    names = [f"{row} = {other}" for row, other in repeats]
    assert names == dropped
    info, _ = agree(raw)
    assert info["dropped_rows"] == names
