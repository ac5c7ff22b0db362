"""Pictures that docs keep: small files, of which nothing is written that nobody sees; and those of README.

python -m benchmarks.kept_pictures              the pictures of README
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from symgen.study.report.document import Picture

if TYPE_CHECKING:
    from symgen.study.comparison.comparison_study import Study

DOCS = Path(__file__).resolve().parents[1] / "docs"
PICTURES = DOCS / "pictures"
#: Timed runs a row, after a warm-up.
REPEAT = 7
#: No picture of the gallery is larger, none of README, and no film [bytes].
LARGEST, LARGEST_OF_README, LARGEST_FILM = 60_000, 80_000, 700_000


def put(picture: Picture, folder: Path, name: str = "") -> Path:
    """Write a picture, unless it is too large."""
    content = slim(picture.data.decode()).encode() if picture.kind == "svg" else picture.data
    largest = LARGEST_OF_README if folder == PICTURES else LARGEST
    if len(content) > largest:
        raise ValueError(f"{picture.name} has {len(content)} bytes, more than {largest}")
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name or picture.name}.{picture.kind}"
    path.write_bytes(content)
    return path


def slim(svg: str) -> str:
    """Return a drawing without what nobody sees: names of groups, comments, blanks, and far digits."""
    svg = re.sub(r"<!--.*?-->|<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r'<g id="[^"]*"', "<g", svg)
    svg = re.sub(r' (?:x|y)="[^"]*"|translate\([^)]*\)', lambda m: re.sub(r"(\.\d\d)\d+", r"\1", m.group()), svg)
    curve = re.compile(r'(?<=<path d=")[^"]*(?=" clip-path)')
    # a tenth of a point is enough, and numbers behind a move are lines without being called so
    svg = curve.sub(lambda m: re.sub(r"(\.\d)\d+", r"\1", re.sub(r"\s+L(?=\s)", "", m.group())), svg)
    svg = svg.replace("xlink:href", "href").replace("DejaVuSans-", "")
    svg = re.sub(r'(?<= style=")[^"]*', lambda m: re.sub(r"([:;])\s+", r"\1", m.group()), svg)
    svg = re.sub(r"(?<= d=\")[^\"]*", lambda m: " ".join(m.group().split()), svg)
    return re.sub(r">\s+<", "><", re.sub(r"\n\s*", "\n", svg)) + "\n"


# -- pictures of README ------------------------------------------------------------------------------------------------

#: What the map of README shows.
STRESSED = ("four-bar", ("stiffness", "mass-ratio", "step", "gravity", "inconsistent-start"))
STRESSED_METHODS = ("lagrange", "baumgarte", "penalty", "augmented-lagrangian", "direct-correction", "auto")


def readme_pictures() -> None:
    """Make the three pictures of README: error against run time, violation over time, stress map."""
    from symgen.study.comparison.compare_models import compare
    from symgen.study.report.figures import pictures_of_study
    from symgen.study.report.stress_figures import outcome_maps
    from symgen.study.stress.study import stress

    study: Study = compare("four-bar", integrators=("rk4", "dopri5", "dop853"), repeat=REPEAT)
    drawn = {picture.name: picture for picture in pictures_of_study(study)}
    put(drawn["four-bar-error-rk4"], PICTURES, "error-against-run-time")
    put(drawn["four-bar-position-violation"], PICTURES, "violation-over-time")
    model, families = STRESSED
    outcomes = stress([model], families, STRESSED_METHODS, searches=False)
    put(next(p for p in outcome_maps(outcomes) if p.name == f"map-{model}"), PICTURES, "stress-map")


if __name__ == "__main__":
    readme_pictures()
