"""No two columns of a result have one name, whatever a file calls its bodies, joints and forces."""

import random
from collections import Counter

import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.parts.columns import FORMS, column_name

#: A door with a motor, a second bar on a pin, and a spring: every kind of column.
_NEUTRAL = ("one", "two", "post", "pin", "motor", "hand", "spring", "tip")


def _mechanism(names):
    one, two, post, pin, motor, hand, spring, tip = names
    model = symgen.MechanismBuilder("named", gravity=(0.0, -9.81))
    model.body(one, mass=1.0, inertia=0.1, centre_of_mass=[0.5, 0.0], points={tip: [1.0, 0.0], pin: [0.3, 0.0]})
    model.body(two, mass=1.0, inertia=0.1, position=[1.0, 0.0], points={post: [0.2, 0.0], motor: [0.4, 0.0]})
    model.joint(post, "revolute", between=["ground", one], at=[[0.0, 0.0], [0.0, 0.0]])
    model.joint(pin, "revolute", between=[one, two], at=[[1.0, 0.0], [0.0, 0.0]])
    model.joint(motor, "driver", joint=post, coordinate="angle", value="t")
    model.joint(hand, "driver", joint=pin, coordinate="angle", value="2*t")
    model.force(spring, "torsional-spring-damper", between=[one, two], stiffness=1.0)
    return model


def _columns(tables):
    """Return the columns of all tables: their table, and their key in parts."""
    return [(table, name.split(".")) for table, labelled in tables.items() for name in labelled.names]


@pytest.fixture(scope="module")
def neutral():
    model = symgen.Model(_mechanism(_NEUTRAL).build())
    run = model.simulate(until=0.02, step=0.01)
    actuators = [["motor", "hand"], ["post", "pin"], ["post.angle", "pin.angle"], ["post", "spring"]]
    found = [run, model.simulate(until=0.02, step=0.01, coordinates="absolute"), model.kinematics([0.0, 0.1])]
    found += [model.inverse(motion=run, actuators=names) for names in actuators]
    angles = [("transmission", [joint]) for joint in ("post", "pin", "motor", "hand")]  # of whichever is asked for
    whole = [_columns(x.tables()) for x in found]
    return [*whole[:2], whole[2] + angles, *whole[3:]]


@pytest.mark.slow
def test_names_of_columns_are_one_for_one_or_refused(neutral):
    rng, refused, accepted = random.Random(7), 0, 0
    heads = {part for form in FORMS.values() for part in form.split(".") if "{" not in part} - {"rate"}
    pool = [*sorted(heads), "x", "theta", "pin", "tip", "a", "b"]
    for _ in range(400):
        names = rng.sample(pool, len(_NEUTRAL))
        called = dict(zip(_NEUTRAL, names, strict=True))
        whole = [
            [column_name(table, ".".join(called.get(part, part) for part in parts)) for table, parts in columns]
            for columns in neutral
        ]
        try:
            model = symgen.Model(_mechanism(names).build())
        except InputError as error:
            refused += 1
            assert "columns of results of joints begin" in str(error)
        else:
            accepted += 1
            twice = {name for columns in whole for name, count in Counter(columns).items() if count > 1}
            assert not twice, f"{names} give {sorted(twice)} twice"
            if accepted % 40 == 0:
                frame = model.simulate(until=0.02, step=0.01).to_dataframe()
                assert sorted(frame.columns) == sorted(whole[0])
    assert refused > 10 and accepted > 10


@pytest.mark.parametrize("head", ["multiplier", "transmission"])
def test_a_body_called_as_columns_of_joints_begin_is_refused(head):
    model = symgen.MechanismBuilder("puck", space="spatial")
    model.body(head, mass=1.0, inertia=[1.0, 1.0, 1.0, 0.0, 0.0, 0.0])
    with pytest.raises(InputError, match=rf"bodies\.{head}: .*'{head}\.', got '{head}'"):
        model.build()
