"""Examples of other systems: the page is what the record says, and what the record names is there."""

from benchmarks import sayable
from benchmarks.said import SAID
from benchmarks.said_in_files import AT_REST, DOUBTED, IN_JOINTS, SAME
from benchmarks.said_parts import PARTS
from symgen.describe.files.json_schema import file_schema


def test_the_page_is_the_record() -> None:
    assert sayable.PAGE.read_text(encoding="utf-8") == sayable.page(sayable.examples()), (
        "run python -m benchmarks.sayable"
    )


def test_each_line_has_a_verdict_with_its_reason() -> None:
    every = sayable.examples()
    assert len(sayable.models(every)) == 415
    assert len({(x.group, x.name) for x in every}) == len(every)
    for x in every:
        assert x.group in sayable.SETS and x.before in sayable.VERDICTS and x.after in sayable.VERDICTS, x
        assert bool(x.reason) == (x.before in "HPN"), x
        assert bool(x.feature) == (x.before != x.after) == bool(x.said_now), x
        assert sayable.VERDICTS.index(x.after) <= sayable.VERDICTS.index(x.before), "no feature takes one away"


def test_most_of_what_lies_within_the_aim_can_be_said() -> None:
    aim = sayable.within_the_aim(sayable.examples())
    assert sayable.said(aim, *sayable.FEATURES) >= 0.8 * len(aim)


def test_most_of_that_stands_as_files() -> None:
    aim = sayable.within_the_aim(sayable.examples())
    assert sum(f"{x.group}/{x.name}" in SAID for x in aim) >= 0.8 * len(aim)
    assert AT_REST | DOUBTED | IN_JOINTS | set(SAME) | set(PARTS) <= set(SAID)


def test_the_features_are_there() -> None:
    sections = file_schema()["properties"]
    kinds = {
        kind["properties"]["type"]["enum"][0]: kind for kind in sections["joints"]["additionalProperties"]["oneOf"]
    }
    assert {"stiffness", "damping", "friction", "between"} <= set(kinds["rolling-disc"]["properties"])
    assert "efficiency" in kinds["gear"]["properties"]
    assert "contacts" in sections
    assert "modal" in str(sections["bodies"])
    assert "damping" in str(sections["beams"]) and "states" in sections
    assert {x.feature for x in sayable.examples()} - {""} == set(sayable.FEATURES)
