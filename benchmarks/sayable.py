"""How many examples of Exudyn and of Modelica's mechanics can be said in files of symgen, and what each feature adds.

python -m benchmarks.sayable [--left]

counts the lines of ``benchmarks/records/sayable.txt`` and writes `docs/tables/sayable.md`; ``--left`` prints what is
left. A line has the name of an example, what it is, and a verdict before and after the features that are named:
S where keys can be named, H where formulas have to be derived but nothing is left out, P where something is, N where it
cannot be said, ``-`` where there is no mechanism in it.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from benchmarks.said import SAID

ROOT = Path(__file__).resolve().parents[1]
RECORD, PAGE = ROOT / "benchmarks" / "records" / "sayable.txt", ROOT / "docs" / "tables" / "sayable.md"
VERDICTS = "SHPN-"
#: Sets of examples, with the words of the page.
SETS = {"exudyn": "Exudyn, examples", "exudyn-tests": "Exudyn, test models", "modelica": "Modelica, mechanics"}
#: What is no aim of a compiler of rigid mechanisms: the gravest reason of an example.
OUTSIDE = ("particles", "contact-mesh", "GUI/visual", "ROS/gym", "solver-API")
#: Features in the order in which they are counted, with the words of the page.
FEATURES = {
    "contacts": "contacts in the plane",
    "modal": "modal bodies",
    "rolling": "rolling that gives way",
    "damping": "damping of beams by strain",
    "efficiency": "efficiencies of gears",
    "states": "states that read results",
    "poses": "orientations of time",
    "ropes": "ropes over sheaves",
    "holds": "joints that hold for a while",
    "sliding": "points that slide along beams, cables",
    "formulas": "formulas that were found since",
    "touching": "contact of edges, barrels and cables by formulas",
    "recipes": "files of other programs by recipes",
}
_PAGE = """# Examples of other systems

How many of the examples that Exudyn and Modelica's library ship for mechanics can be said in files of symgen: read, \
judged, and for the doubtful ones run. S: keys can be named; H: nothing is left out, but formulas have to be derived, \
as [coming from Exudyn](../howto/from-exudyn.md) and [from Modelica](../howto/from-modelica.md) do for some. \
`benchmarks/records/sayable.txt` has a line for each with its keys or with what is left out.

{totals}

Without the examples whose reason lies outside the aim, {outside}: {aim_before} of {aim} before, and {aim_after}, \
{share:.0f} %, after. {ran} of these {aim_after}, {ran_share:.0f} % of those within the aim, stand as files in \
`benchmarks/examples`, which slow tests run in turns. What each feature added:

{features}
"""


class Example(NamedTuple):
    """A line of the record."""

    group: str
    name: str
    what: str
    before: str
    reason: str
    said_before: str
    after: str
    feature: str
    said_now: str


def examples() -> list[Example]:
    """Return all lines of the record."""
    _, *lines = RECORD.read_text(encoding="utf-8").splitlines()
    return [Example(*(part.strip() for part in f"{line} |".split(" |")[:9])) for line in lines]


def models(of: Sequence[Example]) -> list[Example]:
    """Return the lines that have a mechanism."""
    return [x for x in of if x.before != "-"]


def within_the_aim(of: Sequence[Example]) -> list[Example]:
    """Return the models without those that cannot be said for a reason outside the aim."""
    return [x for x in models(of) if not (x.reason in OUTSIDE and x.before in "PN")]


def said(of: Sequence[Example], *features: str) -> int:
    """Return how many can be said with some features, all but formulas that have to be derived included."""
    return sum((x.after if x.feature in features else x.before) in "SH" for x in of)


def page(of: Sequence[Example]) -> str:
    """Return the page."""
    aim = within_the_aim(of)
    before, after = said(aim), said(aim, *FEATURES)
    return _PAGE.format(
        totals="\n".join(_table_of_totals(of)),
        outside=f"{', '.join(OUTSIDE[:-1])} and {OUTSIDE[-1]}",
        aim=len(aim),
        aim_before=before,
        aim_after=after,
        share=100.0 * after / len(aim),
        ran=(ran := sum(f"{x.group}/{x.name}" in SAID for x in aim)),
        ran_share=100.0 * ran / len(aim),
        features="\n".join(_table_of_features(of)),
    )


def _table_of_totals(of: Sequence[Example]) -> Iterator[str]:
    yield "| | models | S before | S, H before | S now | S, H now | S, H, P now |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    for key, words in (*SETS.items(), ("", "together")):
        part = [x for x in models(of) if x.group == key or not key]
        counts = [Counter(verdicts) for verdicts in ([x.before for x in part], [x.after for x in part])]
        cells = [
            sum(counts[i][v] for v in which) for i, which in ((0, "S"), (0, "SH"), (1, "S"), (1, "SH"), (1, "SHP"))
        ]
        yield f"| {words} | {len(part)} | " + " | ".join(f"{n} ({n / len(part):.0%})" for n in cells) + " |"


def _table_of_features(of: Sequence[Example]) -> Iterator[str]:
    yield "| feature | newly S or H | H to S | N to P |"
    yield "| --- | --- | --- | --- |"
    for key, words in FEATURES.items():
        moved = Counter((x.before, x.after) for x in of if x.feature == key)
        new = sum(n for (before, after), n in moved.items() if before in "PN" and after in "SH")
        yield f"| {words} | {new} | {moved['H', 'S']} | {moved['N', 'P']} |"


def main() -> None:
    """Print the page and write it, or print what is left."""
    every = examples()
    if "--left" in sys.argv[1:]:
        for x in within_the_aim(every):
            if x.after in "PN":
                print(f"{x.after} {x.name}: {x.what}; {x.said_now or x.said_before or x.reason}")
        return
    PAGE.write_text(page(every), encoding="utf-8")
    print(page(every))


if __name__ == "__main__":
    main()
