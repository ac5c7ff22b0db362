"""The gallery of docs/gallery: a page, a picture and measured rows for each mechanism of the catalogue.

python -m benchmarks.gallery                    measure every entry anew, then the pictures of README
python -m benchmarks.gallery four-bar bricard   measure these
python -m benchmarks.gallery --missing          measure what has no data yet
python -m benchmarks.gallery --draw             draw what has no picture yet
python -m benchmarks.gallery --pages            write the pages from the data that are there
python -m benchmarks.gallery --pictures         the pictures of README in docs/pictures alone
python -m benchmarks.pictures                   the pictures of guides in docs/pictures

Data are kept as docs/gallery/data/NAME.json; a test holds the pages to them.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from statistics import median
from typing import Any

from benchmarks.kept_pictures import DOCS, REPEAT, put, readme_pictures
from symgen.api import load
from symgen.describe.catalogue import MACHINES, CatalogueEntry, entries
from symgen.describe.drawing.traced import traced_points
from symgen.describe.facts.digest import digest
from symgen.study.comparison.comparison_rows import Row
from symgen.study.machine_class import library_versions, machine_class
from symgen.study.report import words
from symgen.study.report.document import Picture
from symgen.study.yardstick import YARDSTICK

FOLDER = DOCS / "gallery"
DATA = FOLDER / "data"
#: What run times are of; data without it have the wall clock.
CLOCK = "processor"


@dataclass(frozen=True)
class Choice:
    """What is measured of an entry, where it is not what `symgen compare` does with these two integrators.

    Attributes
    ----------
    size : int or None
        Of a sized entry.
    methods, integrators : tuple of str
        As for `symgen compare`.
    until : float or None
        End [s]; the entry's own unless given.
    window : float
        Time that the picture shows, as a part of the run.
    """

    size: int | None = None
    methods: tuple[str, ...] = ()
    integrators: tuple[str, ...] = ("rk4", "dop853")
    until: float | None = None
    window: float = 0.1


#: Only entries that need something else; a new entry of the catalogue needs no line here.
CHOICES = {
    "andrews": Choice(window=0.4),
    "bricard": Choice(window=0.08),
    "chain": Choice(methods=("lagrange", "direct-correction")),
    "bicycle": Choice(window=0.1),
    "cam-follower": Choice(window=0.25),
    "driven-four-bar": Choice(window=0.15),
    "engine": Choice(window=0.05),
    "flyball-governor": Choice(
        methods=("lagrange", "baumgarte", "direct-correction", "ggl"), integrators=("rk4", "radau5"), until=2.0
    ),
    "four-bar": Choice(window=0.22),
    "free-rigid-body": Choice(methods=("lagrange", "direct-correction"), integrators=("rk4", "rkmk4", "dop853")),
    "geneva": Choice(window=0.17),
    "heavy-top": Choice(window=0.25),
    "jansen-leg": Choice(window=0.9),
    "klann-leg": Choice(window=0.9),
    "n-four-bar": Choice(size=2),
    "rocking-block": Choice(window=0.08),
    "scissor-lift": Choice(window=0.75),
    "shaper": Choice(window=0.2),
    "skidding-wheel": Choice(window=0.12),
    "slider-crank": Choice(window=0.12),
    "slider-crank-with-clearance": Choice(window=0.4),
    "stewart-platform": Choice(methods=("lagrange", "direct-correction"), window=0.5),
    "wiper": Choice(window=0.15),
    "woodpecker": Choice(window=0.05),
}


def choice(name: str) -> Choice:
    """Return what is measured of an entry."""
    return CHOICES.get(name, Choice())


def every() -> tuple[CatalogueEntry, ...]:
    """Return the entries that are measured and drawn, then the machines, which are drawn."""
    return (*entries(), *entries(MACHINES))


def model_name(entry: CatalogueEntry) -> str:
    """Return how an entry is typed: with the size that is measured where it has one."""
    size = choice(entry.name).size or entry.default_size
    return f"{entry.name}:{size}" if entry.sized else entry.name


def command(entry: CatalogueEntry) -> str:
    """Return the command that measures the rows of an entry."""
    own, model = choice(entry.name), load(model_name(entry))
    parts = ["symgen compare", model_name(entry)]
    parts += [f"--methods {','.join(own.methods)}"] if own.methods else []
    parts += [f"--integrators {','.join(own.integrators)}"]
    parts += [f"--steps {model.mechanism.defaults.step:g}", "--rtols 1e-8"]
    parts += [f"--until {own.until:g}"] if own.until else []
    parts += [f"--repeat {REPEAT}"]
    return " ".join(parts)


# -- measuring ---------------------------------------------------------------------------------------------------------


def measure(entry: CatalogueEntry) -> None:
    """Run the comparison of an entry and keep its rows."""
    from symgen.study.comparison.compare_models import compare

    own, model = choice(entry.name), load(model_name(entry))
    step = model.mechanism.defaults.step
    study = compare(model, own.methods, own.integrators, (step,), (1e-8,), own.until, REPEAT)
    keep(
        entry,
        command=command(entry),
        until=study.until,
        reference={"how": study.how, "estimated_error": study.estimated_error, "note": study.note},
        versions=library_versions(),
        machine=machine_class(),
        clock=CLOCK,
        rows=[_fields(row) for row in study.rows],
    )


def draw(entry: CatalogueEntry) -> None:
    """Draw an entry in motion, from a run in the shape of code that all mechanisms without friction share."""
    from symgen.describe.drawing import Drawing

    own, model = choice(entry.name), load(model_name(entry))
    window = own.window * (own.until or model.mechanism.defaults.until)
    shape = "straight" if model.mechanism.has_modes or model.mechanism.has_modal_bodies else "looped"
    result = model.simulate(method="direct-correction", until=window, shape=shape)
    picture = Drawing.of_motion(model.mechanism, result.q.values, result.parameters)
    free = any(point.free for point in traced_points(model.mechanism, model.parameters()))
    what = "paths of points that no joint ties" if free else "paths of the centres of mass"
    times = ", ".join(f"{k / 3.0 * window:.3g}" for k in range(4))
    caption = f"At {times} s, the start darkest; thin lines: {what}. [Symbols](../drawing.md)."
    words_for_it = f"{model.mechanism.title}, drawn at four times."
    drawn = Picture(entry.name, caption, words_for_it, picture.svg.encode(), "svg")
    put(drawn, FOLDER)
    keep(entry, caption=drawn.caption, rank=result.rank.rank)


def keep(entry: CatalogueEntry, **facts: Any) -> None:
    """Put facts into the data of an entry; rows of a mechanism that has changed since are dropped."""
    now = digest(load(model_name(entry)).mechanism)
    before = data(entry.name) or {}
    same = before if before.get("digest") == now else {}
    content = {"model": model_name(entry), "digest": now, **{k: v for k, v in same.items() if k != "model"}, **facts}
    DATA.mkdir(parents=True, exist_ok=True)
    text = json.dumps(content, indent=1, ensure_ascii=False) + "\n"
    (DATA / f"{entry.name}.json").write_text(text, encoding="utf-8")


#: Of a row this is kept.
KEPT = (
    "method",
    "integrator",
    "step",
    "rtol",
    "status",
    "reason",
    "error",
    "below_reference",
    "run_seconds",
    "cost_ratio",
    "cost_ratio_spread",
)


def _fields(row: Row) -> dict[str, Any]:
    """Return of a row what the pages show, to three digits."""
    all_of_it = asdict(row)
    return {k: float(f"{x:.3g}") if isinstance(x := all_of_it[k], float) else x for k in KEPT}


# -- pages -------------------------------------------------------------------------------------------------------------


def data(name: str) -> Mapping[str, Any] | None:
    """Return what was measured of an entry, None where nothing was."""
    path = DATA / f"{name}.json"
    content: Mapping[str, Any] | None = json.loads(path.read_text(encoding="utf-8")) if path.exists() else None
    return content


def page(entry: CatalogueEntry) -> str:
    """Return the page of an entry."""
    mechanism = load(model_name(entry)).mechanism
    measured = data(entry.name)
    rows = sum(len(joint.rows) for joint in mechanism.joints)
    nq, nv = (
        sum(len(names) for names in of)
        for of in zip(*((b.coordinates, b.speeds) for b in mechanism.bodies), strict=True)
    )
    defaults = mechanism.defaults
    lines = [f"# {entry.name}", "", words.as_sentence(entry.title), ""]
    if measured:
        lines += [f"![{entry.name} in motion]({entry.name}.svg)", "", words.as_sentence(measured["caption"]), ""]
    sizes = {
        "bodies": sum(body.carried is None for body in mechanism.bodies),
        "joints": len(mechanism.joints),
        "forces": len(mechanism.forces),
        "coordinates": nq,
        "velocities": nv,
        "constraint rows": rows,
        **({"rank": measured["rank"], "degrees of freedom": nv - measured["rank"]} if measured else {}),
    }
    until = defaults.predictable_until
    lines += [
        f"- {mechanism.space}: {', '.join(f'{name} {number}' for name, number in sizes.items())}",
        f"- end {defaults.until:g} s, step {defaults.step:g} s" + (f", predictable until {until:g} s" if until else ""),
        *([f"- {model_name(entry)}; `{entry.name}:N` has another size"] if entry.sized else []),
        f"- source: {entry.source}",
        "",
    ]
    lines += _measured(entry.name, measured) if measured and "rows" in measured else _unmeasured(entry)
    return "\n".join(lines)


def _unmeasured(entry: CatalogueEntry) -> list[str]:
    if entry in entries(MACHINES):
        guide = f"{entry.name}.md"
        more = (
            [f"A guide designs it: [{entry.name}](../tutorials/{guide}).", ""]
            if (DOCS / "tutorials" / guide).exists()
            else []
        )
        return ["```sh", f"symgen view {entry.name}", "```", "", *more]
    return [f"No rows have been measured for this page yet: `python -m benchmarks.gallery {entry.name}` does that.", ""]


def _measured(name: str, measured: Mapping[str, Any]) -> list[str]:
    rows, reference = measured["rows"], measured["reference"]
    lines = ["## Measured", "", *_table(rows), ""]
    estimated = reference["estimated_error"]
    how = f"The reference: {reference['how']}; its own error is estimated at {words.rounded_number(estimated)} m."
    lines += [
        how + (f" {words.as_sentence(words.readable_number(reference['note']))}" if reference["note"] else ""),
        "",
    ]
    if any(row["below_reference"] for row in rows):
        lines += ["\\* below the error of the reference itself.", ""]
    lines += [f"[Reasons of what did not end `ok`, versions, machine](data/{name}.json).", ""]
    lines += ["```sh", measured["command"], "```", ""]
    return lines


def _table(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return a line for each method, with its runs side by side."""
    runs = {(row["integrator"], words.setting_in_words(row["step"], row["rtol"])): None for row in rows}
    cells = {(row["method"], row["integrator"]): row for row in rows}
    heads = (f"`{integrator}`, {setting}: error [m] | time" for integrator, setting in runs)
    lines = [f"| method | {' | '.join(heads)} |", "| --- |" + " ---: | ---: |" * len(runs)]
    for method in dict.fromkeys(row["method"] for row in rows):
        parts = (_cells(cells.get((method, integrator))) for integrator, _ in runs)
        lines.append(f"| `{method}` | {' | '.join(parts)} |")
    return lines


def _cells(row: Mapping[str, Any] | None) -> str:
    """Return error and time of a run."""
    if row is None:
        return "– | –"
    marks = (" \\*" if row["below_reference"] else "") + (f" {row['status']}" if row["status"] != "ok" else "")
    return f"{words.rounded_number(row['error'])}{marks} | {words.seconds_in_words(row['run_seconds'])}"


def index() -> str:
    """Return the page that lists all entries."""
    lines = [
        "# Gallery",
        "",
        "All studied mechanisms of the catalogue, with measurements. Written by `python -m benchmarks.gallery`.",
        f"Times are processor time of the loop alone. {_spread()}",
        "",
        "| | mechanism | most accurate row |",
        "| --- | --- | --- |",
    ]
    for entry in entries():
        measured = data(entry.name)
        picture = f"![{entry.name}]({entry.name}.svg)" if measured else ""
        lines.append(f"| {picture} | [`{entry.name}`]({entry.name}.md): {entry.title} | {_best(measured)} |")
    lines += [
        "",
        *_across(),
        "## Machines",
        "",
        "Machines to start from. `symgen view` plays them.",
        "",
        "| | machine |",
        "| --- | --- |",
    ]
    lines += [f"| ![{e.name}]({e.name}.svg) | [`{e.name}`]({e.name}.md): {e.title} |" for e in entries(MACHINES)]
    return "\n".join([*lines, ""])


def _spread() -> str:
    """Return how far ratios of times may be off: half an interval of 95 % over the ratio, in the middle of all rows."""
    rows = [row for entry in entries() for row in (data(entry.name) or {}).get("rows", ())]
    shares = [row["cost_ratio_spread"] / row["cost_ratio"] for row in rows if row["cost_ratio_spread"]]
    return f"Ratios to `lagrange` hold to {100.0 * median(shares):.0f} % in the middle of all rows, beside other work."


def _across() -> list[str]:
    """Return what each pair did over all entries: how many runs ended ok, and medians relative to `lagrange`."""
    rows_by_pair: dict[tuple[str, str], list[tuple[Mapping[str, Any], Mapping[str, Any] | None]]] = {}
    for entry in entries():
        rows = (data(entry.name) or {}).get("rows", ())
        base = {row["integrator"]: row for row in rows if row["method"] == YARDSTICK}
        for row in rows:
            rows_by_pair.setdefault((row["method"], row["integrator"]), []).append((row, base.get(row["integrator"])))
    lines = [
        "## Over all entries",
        "",
        "Each entry at its own step, or at a tolerance of 1e-8. Error and time are medians of the ratios to `lagrange`",
        "with the same integrator, where both ended.",
        "",
        "| method | integrator | entries | ended ok | error | time |",
        "| --- | --- | ---: | ---: | ---: | ---: |",
    ]
    for (method, integrator), pairs in rows_by_pair.items():
        errors = [r["error"] / b["error"] for r, b in pairs if b and r["error"] and b["error"]]
        times = [r["cost_ratio"] for r, _ in pairs if r["cost_ratio"]]
        ok = sum(row["status"] == "ok" for row, _ in pairs)
        cells = [f"`{method}`", f"`{integrator}`", str(len(pairs)), str(ok)]
        cells += [
            words.rounded_number(median(errors) if errors else None),
            words.ratio_in_words(median(times) if times else None),
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return [*lines, ""]


def _best(measured: Mapping[str, Any] | None) -> str:
    rows = [row for row in (measured or {}).get("rows", ()) if row["error"] is not None]
    if not rows:
        return "not measured yet"
    row = min(rows, key=lambda r: float(r["error"]))
    how = f"`{row['method']}`, `{row['integrator']}`, {words.setting_in_words(row['step'], row['rtol'])}"
    return f"{words.rounded_number(row['error'])} m in {words.seconds_in_words(row['run_seconds'])} ({how})"


def pages() -> dict[str, str]:
    """Return all pages by file name."""
    return {"README.md": index(), **{f"{entry.name}.md": page(entry) for entry in every()}}


def write_pages() -> None:
    """Write all pages."""
    for name, text in pages().items():
        (FOLDER / name).write_text(text, encoding="utf-8")


def main(arguments: Sequence[str] | None = None) -> None:
    """Do what was asked for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("names", nargs="*")
    for flag in ("missing", "draw", "pages", "pictures"):
        parser.add_argument(f"--{flag}", action="store_true")
    options = parser.parse_args(arguments)
    by_name = {entry.name: entry for entry in every()}
    everything = not (options.names or options.missing or options.draw or options.pages or options.pictures)
    chosen = [by_name[re.sub(r":\d+$", "", name)] for name in options.names]
    chosen += [e for e in entries() if everything or (options.missing and "rows" not in (data(e.name) or {}))]
    for entry in chosen:
        print(f"measuring {model_name(entry)}", flush=True)
        measure(entry)
    undrawn = [e for e in by_name.values() if options.draw and "caption" not in (data(e.name) or {})]
    for entry in dict.fromkeys((*chosen, *undrawn)):
        print(f"drawing {model_name(entry)}", flush=True)
        draw(entry)
    if everything or options.pictures:
        readme_pictures()
    write_pages()


if __name__ == "__main__":
    main()
