"""Beams of files: what they become, names of nodes, clamps, sections, and one sentence for each wrong input."""

import msgspec
import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from symgen.describe.beams.beam_lines import node_weights
from symgen.describe.facts.finer_beams import refine_beams
from symgen.describe.mechanism import Mechanism

STIFF = {"axial": 1e4, "bending": 1.0, "mass": 2.0, "rotary": 1e-3}
ROD = {"start": [0.0, 0.0], "end": [1.0, 0.0], "elements": 8, **STIFF}


def raw(beam=None, space="planar", **sections):
    rod = {**ROD, **(beam or {})}
    return {"mechanism": {"name": "beam", "space": space}, "beams": {"rod": rod}, **sections}


def body(mechanism: Mechanism, name: str):
    return next(b for b in mechanism.bodies if b.name == name)


@pytest.mark.parametrize("elements", [1, 2, 3, 4, 5, 6, 9, 16])
def test_masses_of_nodes_are_those_of_the_beam(elements):
    """Mass, centre and moment of inertia; above one element the weights integrate cubics exactly and are positive."""
    w, x = np.array(node_weights(elements)), np.arange(elements + 1.0)
    assert np.all(w > 0.0)
    for power in range(4 if elements > 1 else 2):
        assert abs(w @ x**power / (elements ** (power + 1) / (power + 1)) - 1.0) <= 1e-12


def test_a_beam_becomes_nodes_and_elements():
    mechanism = mechanism_of(raw())
    assert [b.name for b in mechanism.bodies] == ["rod.start", *(f"rod.{k}" for k in range(1, 8)), "rod.end"]
    assert [f.name for f in mechanism.forces] == [f"rod.e{k}" for k in range(1, 9)]
    assert abs(sum(b.mass.value for b in mechanism.bodies) - 2.0) <= 1e-14
    assert [b.position[0].value for b in mechanism.bodies] == [k / 8 for k in range(9)]


@pytest.mark.slow
def test_an_arc_is_unloaded_and_as_long_as_it_should_be():
    model = symgen.Model(mechanism_of(raw({"arc": 2.0, "start": [1.0, 1.0], "end": [1.0, 3.0]})))
    run = model.simulate(until=1e-6, step=1e-6)
    assert run.potential[0] <= 1e-24
    nodes = np.array([[run.q[f"{b.name}.{c}"][0] for c in "xy"] for b in model.mechanism.bodies])
    chords = np.linalg.norm(np.diff(nodes, axis=0), axis=1)
    np.testing.assert_allclose(chords, chords[0], rtol=1e-13)
    # to the left of the way from the start
    assert nodes[4, 0] > 1.0 and abs(nodes[4, 1] - 2.0) <= 1e-14


def test_nodes_are_named_in_every_way():
    at = {"start": "rod.start", "end": "rod.end", "3": "rod.3", "at(0.25)": "rod.2", "at(1)": "rod.end"}
    for written, node in at.items():
        push = {"type": "force", "body": "rod", "at": written, "force": [1.0, 0.0]}
        assert mechanism_of(raw(forces={"push": push})).forces[-1].bodies == (node,)
    pin = {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], 0]}
    turn = {"type": "torque", "body": "rod.5", "torque": "-0.1*rod.5.omega"}
    torque = {"type": "torque", "body": "rod", "at": "start", "torque": 1.0}
    outputs = {"tip": "rod.end.y - rod.3.y + rod.e2.M"}
    mechanism = mechanism_of(raw(joints={"pin": pin}, forces={"turn": turn, "other": torque}, outputs=outputs))
    assert mechanism.joints[0].bodies == ("ground", "rod.start")
    assert [f.bodies[0] for f in mechanism.forces[-2:]] == ["rod.5", "rod.start"]


WRONG = [
    ({"rotary": 0.0}, "rotary: expected a rotary inertia by length above 0, got 0.0"),
    ({"rotary": None}, "rotary: expected a rotary inertia by length above 0, got no such key"),
    ({"axial": float("inf")}, "axial: expected a finite stiffness, got inf"),
    ({"bending": 0.0}, "bending: expected a value above 0, got 0.0"),
    ({"elements": 251}, "elements: expected a number of elements, 1 to 250, got 251"),
    ({"elements": 0}, "elements: expected a number of elements, 1 to 250, got 0"),
    ({"end": [0.0, 0.0]}, "end: expected another point than start"),
    ({"material": {"young": 1.0, "density": 1.0}}, "section: expected a table"),
    ({"clamp": "hub"}, "clamp: expected the name of a body or 'ground', got the unknown body 'hub'"),
    ({"torsion": 1.0}, "torsion: expected no such key in the plane"),
    ({"damping": -1.0}, "damping: expected a time of 0 or more"),
    ({"arc": 7.0}, "arc: expected less than a turn"),
    ({"lenght": 1.0}, "got the unknown key 'lenght'"),
    (
        {"start": None},
        "start: expected a point, as a beam without the key line has a start and an end, got no such key",
    ),
    ({"line": [[0.0, 0.0], [1.0, 0.0]]}, "start: expected no such key beside the key line, got [0.0, 0.0]"),
    ({"elements": [4, 4]}, "elements: expected a number of elements, 1 to 250, got [4, 4]"),
]
CORNER = {"start": None, "end": None, "line": [[0.0, 0.0], [1.0, 0.0], [1.0, 0.7]], "elements": 4}
SPATIAL = {"line": [[0.0] * 3, [1.0, 0.0, 0.0], [1.0, 0.7, 0.0]], "torsion": 1.0, "rotary": [1e-3] * 3}
WRONG += [
    ({**CORNER, **keys}, sentence)
    for keys, sentence in (
        ({"line": [[0.0, 0.0]]}, "line: expected a list of points, two or more, got [[0.0, 0.0]]"),
        ({"line": [[0.0, 0.0], [1.0]]}, "line[1]: expected two numbers or expressions of parameters"),
        (
            {"line": [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]]},
            "line[2]: expected another point than the one before, got the",
        ),
        ({"arc": 0.5}, "arc: expected no such key beside the key line, got 0.5"),
        (
            {"elements": 1},
            "elements: expected a number of elements, 2 to 250, or 2 numbers above 0, one for each seg",
        ),
        ({"elements": [3, 0]}, "one for each segment, got [3, 0]"),
        ({"elements": "many"}, "elements: expected a number of elements, or of a line a list of numbers, one for each"),
        ({"y_axis": [0.0, 1.0]}, "y_axis: expected no such key in the plane"),
        (SPATIAL, "y_axis: expected a direction across the beam, got one along it"),
        ({**SPATIAL, "y_axis": [[0.0, 1.0, 0.0]]}, "y_axis: expected one direction, or 2, one for each segment"),
        (
            {**SPATIAL, "y_axis": [0.0, 1.0, [0.0, 1.0, 0.0]]},
            "y_axis: expected one direction, or 2, one for each segment",
        ),
    )
]


@pytest.mark.parametrize(("beam", "sentence"), WRONG)
def test_wrong_beams_get_one_sentence(beam, sentence):
    space = "spatial" if len(beam.get("line", [[]])[0]) == 3 else "planar"
    description = raw({key: value for key, value in beam.items() if value is not None}, space)
    for key in (key for key, value in beam.items() if value is None):
        del description["beams"]["rod"][key]
    with pytest.raises(InputError) as error:
        mechanism_of(description)
    assert sentence in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("at", "words"),
    [("9", "a number up to 8"), (None, "got no such key"), ("at(0.3)", "the nearest node is number 2, at(0.25)")],
)
def test_nodes_that_are_none_get_one_sentence(at, words):
    push = {"type": "force", "body": "rod", "force": [1.0, 0.0], **({} if at is None else {"at": at})}
    with pytest.raises(InputError) as error:
        mechanism_of(raw(forces={"push": push}))
    assert "forces.push.at: expected a node of the beam 'rod'" in str(error.value) and words in str(error.value)
    with pytest.raises(InputError, match="name that body"):
        push = {"type": "force", "body": "rod", "at": "start", "force": [1.0, 0.0]}
        mechanism_of(raw({"clamp": "ground"}, forces={"push": push}))


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_clamped_end_gives_its_mass_to_the_body(space):
    """Mass, centre and inertia of the body and the nodes together are those of body and beam."""
    more = {"torsion": 1.0, "rotary": [3e-3, 1e-3, 2e-3]} if space == "spatial" else {}
    pad = [0.0] if space == "spatial" else []
    hub = {"mass": 3.0, "inertia": [0.3, 0.4, 0.5] if space == "spatial" else 0.5, "position": [0.2, 0.1, *pad]}
    hub |= {"orientation": {"rotation_vector": [0.0, 0.0, 0.4]}} if space == "spatial" else {"angle": 0.4}
    beam = {"start": [0.5, 0.3, *pad], "end": [1.5, 0.3, *pad], "clamp": "hub", **more}
    clamped = mechanism_of(raw(beam, space, bodies={"hub": hub}))
    hubs = body(clamped, "hub")
    end = node_weights(8)[0] / 8
    assert abs(hubs.mass.value - 3.0 - 2.0 * end) <= 1e-14
    turn = np.array([[np.cos(0.4), -np.sin(0.4)], [np.sin(0.4), np.cos(0.4)]])
    place = turn.T @ (np.array([0.5, 0.3]) - [0.2, 0.1])
    centre = np.array([e.value for e in hubs.centre_of_mass[:2]])
    np.testing.assert_allclose(centre, 2.0 * end * place / hubs.mass.value, atol=1e-14)
    reduced = 3.0 * 2.0 * end / hubs.mass.value * (place @ place)
    about_z = hubs.inertia[2].value if space == "spatial" else hubs.inertia.value
    assert abs(about_z - 0.5 - end * (2e-3 if space == "spatial" else 1e-3) - reduced) <= 1e-14
    first = clamped.forces[0]
    assert first.bodies == ("hub", "rod.1")
    assert symgen.Model(clamped).simulate(until=1e-6, step=1e-6).potential[0] <= 1e-20


def test_section_and_material_give_the_stiffnesses_of_the_handbooks():
    """E A, k G A, G J, E I of a rectangle of 12.77 mm x 3.2024 mm and of tubes; J of a square is 0.140577 a^4."""
    material = {"young": 71.7e9, "poisson": 0.31, "density": 2700.0}
    keys = {"start": [0.0] * 3, "end": [1.0, 0.0, 0.0], "elements": 1, "material": material}

    def of(**section):
        beam = {"mechanism": {"name": "b", "space": "spatial"}, "beams": {"rod": {**keys, "section": section}}}
        mechanism = mechanism_of(beam)
        return [1.0 / e.value for e in mechanism.forces[0].flexures[0].compliances], mechanism.bodies[0]

    found, node = of(width=3.2024e-3, height=12.77e-3)
    shear = 71.7e9 / 2.62
    area = 3.2024e-3 * 12.77e-3
    expected = [
        71.7e9 * area,
        *[13.1 / 15.41 * shear * area] * 2,
        shear * 1.1770172836e-10,
        2.505852697877054,
        39.84613284193922,
    ]
    np.testing.assert_allclose(found, expected, rtol=1e-6)
    assert abs(node.mass.value - 0.5 * 2700.0 * area) <= 1e-15
    assert abs(of(width=0.1, height=0.1)[0][3] / (shear * 0.1405770 * 1e-4) - 1.0) <= 1e-5
    tube = of(diameter=0.1, thickness=0.01)[0]
    second = np.pi / 64 * (0.1**4 - 0.08**4)
    np.testing.assert_allclose(tube[3:], [shear * 2 * second, 71.7e9 * second, 71.7e9 * second], rtol=1e-12)


def test_elements_are_spread_over_the_segments_of_a_line():
    """By their lengths, at least one each, and ends at vertices; twice as many keep the places of all nodes."""
    line = {"line": [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.99, 1.0]], "elements": 8}
    rod = {key: value for key, value in {**ROD, **line}.items() if key not in ("start", "end")}
    push = {"type": "force", "body": "rod", "at": "at(0.497512)", "force": [1.0, 0.0]}
    description = {"mechanism": {"name": "frame"}, "beams": {"rod": rod}, "forces": {"push": push}}
    mechanism = mechanism_of(description)
    places = {b.name: tuple(e.value for e in b.position) for b in mechanism.bodies}
    assert [places[n] for n in ("rod.4", "rod.7", "rod.end")] == [(1.0, 0.0), (1.0, 1.0), (0.99, 1.0)]
    assert mechanism.forces[-1].bodies == ("rod.4",)
    finer, names = refine_beams(mechanism)
    twice = {b.name: tuple(e.value for e in b.position) for b in finer.bodies}
    assert len(finer.bodies) == 17
    np.testing.assert_allclose([twice[names[name]] for name in places], list(places.values()), atol=1e-15)
    description["beams"]["rod"]["elements"] = [3, 3, 2]
    assert body(mechanism_of(description), "rod.6").position[1].value == 1.0


def test_elements_are_doubled():
    push = {"type": "force", "body": "rod", "at": "3", "force": ["-rod.3.vx", 0.0]}
    mechanism = mechanism_of(raw(forces={"push": push}, outputs={"moment": "rod.e3.M"}))
    finer, names = refine_beams(mechanism)
    assert len(finer.bodies) == 17 and names["rod.3"] == "rod.6" and names["rod.end"] == "rod.end"
    assert finer.forces[-1].bodies == ("rod.6",)
    assert b"rod.6.vx" in msgspec.json.encode(finer.forces[-1])


def test_who_has_no_beam_pays_nothing():
    """No text of a mechanism without beams, of which code and caches are named, has changed."""
    mechanism = symgen.load("four-bar").mechanism
    assert b"flexures" not in msgspec.json.encode(mechanism) and mechanism.beams == b""
    assert "flexures" not in repr(mechanism.forces)
