"""Pictures of guides show the mechanisms as they are drawn now."""

import re

import numpy as np
import pytest

from benchmarks import gallery, kept_pictures, pictures

NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def split(svg: str) -> tuple[str, np.ndarray]:
    """Return a picture without its numbers, and these."""
    return NUMBER.sub("0", svg), np.array([float(x) for x in NUMBER.findall(svg)])


@pytest.mark.slow_cases("leg")
@pytest.mark.parametrize("name", pictures.DRAWN)
def test_a_picture_is_drawn_as_it_is_kept(name: str) -> None:
    """Numbers are tenths of a pixel: another machine's rounding moves some by one of these."""
    kept = (kept_pictures.PICTURES / f"{name}.svg").read_text(encoding="utf-8")
    (words, places), (words_now, places_now) = split(kept), split(kept_pictures.slim(pictures.DRAWN[name]()))
    assert words_now == words, "run python -m benchmarks.pictures"
    np.testing.assert_allclose(places_now, places, rtol=0.0, atol=0.25)
    assert len(kept) < 15_000


def test_every_machine_is_in_the_gallery() -> None:
    text = (gallery.FOLDER / "README.md").read_text(encoding="utf-8")
    for entry in gallery.every():
        assert f"]({entry.name}.svg) |" in text and (gallery.FOLDER / f"{entry.name}.svg").is_file()
