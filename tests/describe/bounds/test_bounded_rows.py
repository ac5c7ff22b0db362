"""Rows with bounds are asked, not named: a kind is files of one room, and sentences take their words from kinds."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, ClassVar

import pytest

import symgen
from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import ZERO, Expr
from symgen.describe.bounded import RowFamily
from symgen.describe.bounds.bounded_modes import refuse_bounds, rows_by_family
from symgen.describe.bounds.dry_friction import Friction
from symgen.describe.bounds.keys import BOUNDS, KeyOfJoints, all_families, keys_of_any_joint, nouns_of_families
from symgen.describe.facts.digest import canonical_text, digest, mechanism_digest
from symgen.describe.files.json_schema import file_schema
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Joint, Mechanism
from symgen.describe.parts.scope import Scope

PACKAGE = Path(symgen.__file__).parent
#: Who may name a kind: its own room, formats of other programs, whose keys these are, and rolling, by its forces; and
#: the laws of contacts and of impacts, which are those of a gap and of the friction along it or by reactions, with the
#: analyses that solve them at rest and along a recorded motion; and the stress families at their limits.
NAMING = (
    *(
        "describe/bounds/",
        "describe/formats/",
        "describe/joints/rolling",
        "describe/joints/_rolling.py",
        "describe/joints/_giving.py",
        "cli/compare.py",
        "study/stress/at_limits.py",
        "describe/files/joint_tables.py",
        "describe/edits/snippet",
    ),
    *("run/modes/contact", "run/modes/impact_memory.py", "run/modes/pin_impulses.py", "run/modes/refusals.py"),
    "run/modes/paired_rows.py",
    *("run/effects/pushing.py", "run/directions/push_directions.py", "run/laws/motions.py", "run/modes/probing.py"),
    *("run/single/contact_notes.py", "analyses/efforts/", "analyses/rest/lawful.py"),
)
PENDULUM = """
[mechanism]
name = "brake"
space = "planar"
gravity = [0.0, -9.81]
[bodies.arm]
mass = 1.0
inertia = 0.1
[joints.pin]
type = "revolute"
between = ["ground", "arm"]
at = [[0.0, 0.0], "centre"]
"""


def named(text: str) -> list[str]:
    return re.findall(r"friction|EndStop|end[_ -]stop", text, re.IGNORECASE)


def test_no_other_room_names_a_kind() -> None:
    sources = {path.relative_to(PACKAGE).as_posix(): path.read_text(encoding="utf-8") for path in PACKAGE.rglob("*.py")}
    found = {path for path, text in sources.items() if named(text)}
    assert any(path.startswith(NAMING[0]) for path in found)
    assert {path for path in found if not path.startswith(NAMING)} == set()


class Brake(Friction, frozen=True):
    """Friction of another name: what a further kind of rows brings along."""

    family: ClassVar[RowFamily] = RowFamily(
        one="brake",
        some="a brake",
        noun="brakes",
        in_force="shut",
        off="slipping",
        part="brakes",
        fact="brakes",
        named="{}",
        hint="runs have them",
        held="while it is shut, {} does not change",
        line=lambda facts: f"brake {facts['name']}",
    )


def read_brake(scope: Scope, joint: Joint, raw: object) -> Iterator[Brake]:
    label, measure = joint.coordinates[0]
    bound: Expr = scope.constant("brake", raw)
    return iter((Brake(joint.name, joint.name, measure, joint.unit(label), bound, bound, ZERO),))


@pytest.fixture
def braked(monkeypatch: pytest.MonkeyPatch) -> Mechanism:
    """A mechanism with a row of a kind that no room knows."""
    loaded: dict[str, Any] = {**BOUNDS._loaded, "brake": KeyOfJoints("brake", Brake.family, float | str, read_brake)}
    monkeypatch.setattr(BOUNDS, "_loaded", loaded)
    return validate(parse_toml(PENDULUM + "brake = 2.0\n", "brake"), "brake.toml")


def test_a_further_kind_has_its_key_words_and_digest(braked: Mechanism) -> None:
    assert "brake" in keys_of_any_joint() and "brake" in str(file_schema())
    assert Brake.family in all_families() and "brakes" in nouns_of_families()
    assert list(rows_by_family(braked)) == [Brake.family]
    plain = validate(parse_toml(PENDULUM, "brake"), "brake.toml")
    assert '"brakes"' in canonical_text(braked).replace("'", '"') and "brakes" not in canonical_text(plain)
    assert digest(braked) != digest(plain) and mechanism_digest(braked) != mechanism_digest(plain)


@pytest.mark.slow
def test_a_further_kind_runs_and_is_refused_in_its_own_words(braked: Mechanism) -> None:
    model = symgen.load(braked)
    run = model.simulate(until=0.5, start={"arm.omega": 4.0})
    assert run["pin.mode"][0] == 1.0 and run["pin.mode"][-1] == 0.0
    (stuck,) = [event for event in run.events if event.name == "pin.stick"]
    assert stuck.t == pytest.approx(4.0 * 0.1 / 2.0, abs=1e-9)
    assert "brake pin" in str(model.inspect())
    with pytest.raises(InputError, match="expected a mechanism without brakes, got pin; runs have them"):
        refuse_bounds("equations", braked)
