"""What meets what: the page is the stored table, the table is what happens, and each feature of a file has a row."""

from collections import Counter

import pytest

from benchmarks import bodies_apart, meeting
from symgen.describe.files.json_schema import file_schema
from symgen.describe.files.load import parse_toml
from symgen.run.compiling.folders import generator_digest

#: A table takes minutes: at each state of the sources another one of so many parts is computed again.
TURNS = 288
#: Keys that at least so many kinds of joints share are features, but for those that place and begin any joint.
SHARED, PLACING = 10, {"type", "between", "at", "axis", "axes", "angle", "start", "cut", "reference"}


def test_the_page_is_the_stored_table() -> None:
    table = meeting.stored()
    assert list(table) == list(meeting.FEATURES), "run python -m benchmarks.meeting"
    assert all(list(row) == list(meeting.PLACES) for row in table.values())
    assert meeting.PAGE.read_text(encoding="utf-8") == meeting.page(table), "run python -m benchmarks.meeting"


def test_every_feature_of_a_file_has_a_row() -> None:
    files = [parse_toml(text, name) for name, text in meeting.FEATURES.items()]
    sections = file_schema()["properties"]
    assert set(sections) == {section for file in files for section in file}
    kinds = sections["joints"]["additionalProperties"]["oneOf"]
    shared = Counter(key for kind in kinds for key in kind["properties"])
    features = {key for key, count in shared.items() if count >= SHARED} - PLACING
    used = {key for file in files for joint in file["joints"].values() for key in joint}
    assert {"friction", "stop", "rotor_inertia"} <= used and features <= used
    events = {key for file in files for event in file.get("events", {}).values() for key in event}
    assert {"action", "reset"} <= events


def test_sentences_are_whole() -> None:
    """No cell holds a traceback, a path of this machine or several lines."""
    for row in [*meeting.stored().values(), bodies_apart.stored()]:
        for said in row.values():
            assert said == "+" or ("\n" not in said and "/tmp" not in said and len(said) > 20), said


@pytest.mark.slow
def test_the_table_is_what_happens() -> None:
    table, turn = meeting.stored(), int(generator_digest(), 16)
    cells = [(feature, place) for feature in meeting.FEATURES for place in meeting.PLACES]
    own = cells[turn % TURNS :: TURNS]
    assert {cell: meeting.cell(*cell) for cell in own} == {(f, p): table[f][p] for f, p in own}


def test_two_features_that_nothing_joins_never_disturb_each_other() -> None:
    cells = bodies_apart.stored()
    assert list(cells) == [f"{first} + {second}" for first, second in bodies_apart.PAIRS]
    assert set(cells.values()) == {"+"}


@pytest.mark.slow
def test_the_table_of_pairs_is_what_happens() -> None:
    """Another eleventh of the pairs at each state of the sources."""
    turn, cells = int(generator_digest(), 16), bodies_apart.stored()
    own = bodies_apart.PAIRS[turn % 11 :: 11]
    found = {f"{first} + {second}": bodies_apart.compare(first, second) for first, second in own}
    assert found == {pair: cells[pair] for pair in found}
