"""Stacks and discs beside Siconos: the page is the record, and rows of symgen are made again."""

from itertools import pairwise

import pytest

from benchmarks import beside_siconos


def test_the_page_is_the_record() -> None:
    rows = beside_siconos.stored()
    assert beside_siconos.PAGE.read_text(encoding="utf-8") == beside_siconos.page(rows)
    own = [row for row in rows if row["tool"] == "symgen"]
    assert [(row["scene"], row["setting"]) for row in own] == [
        (scene, setting) for scene in beside_siconos.SCENES for setting in beside_siconos.OWN
    ]


def test_siconos_comes_nearer_to_the_same_places_with_its_step() -> None:
    """The reference of the discs is symgen's own, that of stacks a closed form."""
    found: dict[str, dict[float, float]] = {}
    for row in beside_siconos.stored():
        if row["tool"] == "Siconos" and row["setting"] == "as it comes" and not row["scene"].startswith("pushed"):
            found.setdefault(row["scene"], {})[row["step"]] = row["error"]
    for scene, errors in found.items():
        steps = sorted(errors, reverse=True)
        assert all(errors[b] < 0.3 * errors[a] for a, b in pairwise(steps)), scene
    assert len(found["discs 8"]) == 3 and len(found["dropped 3"]) == 3


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("scene", ["pushed 3", "dropped 5", "pushed 10"])
def test_stacks_are_their_closed_forms(scene: str) -> None:
    for keys in beside_siconos.OWN.values():
        ends, _ = beside_siconos.ends_of(scene, **keys)
        assert beside_siconos.error(scene, ends) < 1e-12
