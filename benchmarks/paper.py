r"""The paper: its numbers and tables from records and measured pages, its pictures, and the PDF.

    python -m benchmarks.paper FOLDER [--minutes M]
        writes paper.tex, numbers.tex, three pictures and, with pdflatex, paper.pdf; tables.md has the tables of all
        records, records/ these, lock.txt the libraries, a wheel the program, CITATION.cff how to cite it, and again.md
        what M minutes of measuring anew have found; FOLDER.zip holds all of it

The text is ``docs/paper/paper.tex``, in which every measured number is ``\n{KEY}`` and every table of numbers
``\numbers{KEY}``. What it says in words about their order is in `claims`, and a test asks for it.
"""

from __future__ import annotations

import argparse
import math
import platform
import shutil
import statistics as middle
import subprocess
import sys
import zipfile
from collections.abc import Iterator, Sequence
from importlib.metadata import distributions
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from benchmarks import equal_error, equal_work, literature, measured_again, statistics
from benchmarks.page_tables import ROOT, PageTable, cells_of, markdown, place
from benchmarks.records import FOLDER, Line

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SOURCE, CITATION = ROOT / "docs" / "paper" / "paper.tex", ROOT / "CITATION.cff"
#: Words of a key -> the method in `benchmarks.statistics` and `benchmarks.equal_error`.
METHODS = {
    "baumgarte": "baumgarte",
    "motion": "baumgarte:rule=motion",
    "velocity": "velocity-projection",
    "post": "post-stabilization",
    "direct": "direct-correction",
    "mass": "direct-correction:weight=mass",
    "partitioning": "coordinate-partitioning",
    "augmented": "augmented-lagrangian",
    "index-one": "index1-augmented-lagrangian",
}
#: The same as people read them.
NAMES = {
    "baumgarte": "Baumgarte, 5\\,s$^{-1}$",
    "motion": "Baumgarte, gain of the motion",
    "velocity": "velocity projection",
    "post": "post-stabilisation",
    "direct": "direct correction",
    "mass": "direct correction, metric of $M$",
    "partitioning": "coordinate partitioning",
    "augmented": "augmented Lagrangian",
    "index-one": "index-1 augmented Lagrangian",
}
#: Lines of the table of closed joints, of the page's methods.
CLOSING = ("lagrange", "baumgarte", "velocity-projection", "direct-correction", "mass-orthogonal-projection",
           "post-stabilization", "null-space", "coordinate-partitioning", "ggl")  # fmt: skip
HIGH = ("dop853", "picard")


def plain(key: str) -> str:
    """Return the name of a method for a picture."""
    return NAMES[key].replace("\\,", " ").replace("s$^{-1}$", "1/s")


def page_rows(table: PageTable) -> list[list[str]]:
    """Return the rows of a table as its page has them."""
    text = (ROOT / table.page).read_text(encoding="utf-8")
    first, end = place(table, text)
    return [cells_of(line) for line in text.splitlines()[first + 2 : end]]


def tex(cell: str) -> str:
    """Return a cell as LaTeX: names in type, powers of ten as such."""
    if cell.startswith("`"):
        return rf"\texttt{{{cell.strip('`')}}}"
    if "e" in cell and cell.replace("e", "").replace("-", "").replace(".", "").isdigit():
        mantissa, power = cell.split("e")
        return rf"${mantissa}\cdot10^{{{int(power)}}}$"
    return cell.replace("-", "$-$") if cell[:1] == "-" else cell


def rows_of(rows: Sequence[Sequence[str]]) -> str:
    """Return the lines of a tabular."""
    return "\n".join(" & ".join(map(tex, row)) + r" \\" for row in rows)


def samples() -> list[list[Line]]:
    """Return the lines of both seeds."""
    lines = statistics.RECORD.lines()
    return [[line for line in lines if line["seed"] == seed] for seed in statistics.SEEDS]


def measures(integrator: str, key: str) -> list[dict[str, str]]:
    """Return the quantiles, shares and medians of a method, for both seeds."""
    pairs = (statistics.pairs_of(own, integrator, METHODS[key]) for own in samples())
    return [dict(zip(statistics.HEADINGS[1:], statistics.cells_of_ratios(each), strict=True)) for each in pairs]


def improvements(integrator: str, key: str) -> list[float]:
    """Return the errors of `lagrange` over those of a method, of both seeds."""
    pairs = [pair for own in samples() for pair in statistics.pairs_of(own, integrator, METHODS[key])]
    return [base.error / own.error for base, own in pairs if own.error > 0.0]


def random_rows() -> list[list[str]]:
    """Return the table of random mechanisms, both seeds together."""
    rows = []
    for key, name in NAMES.items():
        low, half, high = np.percentile(improvements("rk4", key), (10, 50, 90))
        cells = [statistics.digits(str(x)) for x in (low, half, high)]
        both = measures("rk4", key)
        shares = [f"{one['better'][:-2]}/{one['worse'][:-2]}" for one in both]
        means = [statistics.estimate(improvements("rk4", key), np.mean)]
        times = statistics.digits(f"{middle.mean(float(one['time']) for one in both)}")
        rows.append([name, *cells, *shares, *means, times])
    return rows


def mean(integrator: str, key: str) -> str:
    """Return the geometric mean over both seeds."""
    return statistics.digits(f"{math.exp(float(np.mean(np.log(improvements(integrator, key))))):.3g}")


def ratios(key: str, *integrators: str) -> list[float]:
    """Return the run times of a method at equal error over those of `lagrange`."""
    return [x for integrator in integrators for x in equal_error.ratios(METHODS[key], integrator)]


def between_seeds() -> dict[str, str]:
    """Return by how much shares and geometric means of the two seeds differ at most."""
    points, means = [0.0], [0.0]
    for key in NAMES:
        one, other = measures("rk4", key)
        points += [abs(float(one[share][:-2]) - float(other[share][:-2])) for share in ("better", "worse")]
        pairs = [statistics.pairs_of(own, "rk4", METHODS[key]) for own in samples()]
        logs = [np.mean([math.log(base.error / own.error) for base, own in each if own.error > 0.0]) for each in pairs]
        means.append(math.exp(abs(logs[0] - logs[1])) - 1.0)
    return {"seeds.points": f"{max(points):.0f}", "seeds.means": f"{100.0 * max(means):.0f}"}


def numbers() -> dict[str, str]:
    """Return the numbers of the text by their keys."""
    regular = [[line for line in own if line.get("runs") is not None] for own in samples()]
    followed = [[line for line in own if statistics.predictable(line)] for own in samples()]
    both = [line for own in followed for line in own]
    found = {
        "drawn": str(statistics.COUNT * len(statistics.SEEDS)),
        "regular": str(sum(map(len, regular))),
        "followed": str(len(both)),
        "dependent": str(sum(line["dependent"] > 0 for line in both)),
        "freedoms": f"{np.percentile([line['freedoms'] for line in both], 90):.0f}",
    }
    for key in ("baumgarte", "motion"):
        found[f"harm.{key}"] = " and ".join(one["worse"][:-2] for one in measures("rk4", key))
    for key in NAMES:
        found[f"mean.{key}.rk4"] = mean("rk4", key)
    for key in ("velocity", "direct"):
        for integrator in ("rk4", "dop853"):
            own = equal_work.ratios(integrator, METHODS[key])
            found[f"work.{key}.{integrator}"] = f"{math.exp(float(np.mean(np.log(own)))):.2f}"
            low, high = np.quantile(own, (0.1, 0.9))
            found |= {f"work.{key}.{integrator}.{end}": f"{x:.2f}" for end, x in (("low", low), ("high", high))}
    found |= between_seeds()
    found["work.count"] = str(len(equal_work.predictable_lines()))
    more = np.log(statistics.paired(both, "rk4", METHODS["velocity"], METHODS["direct"]))
    upper = np.sort(more)[-(len(more) // 20) :].sum() / more.sum()
    metric = statistics.paired(both, "rk4", METHODS["direct"], METHODS["mass"])
    found |= {"positions.median": f"{math.exp(np.median(more)):.3f}", "positions.upper": f"{100 * upper:.0f}"}
    found |= {"positions.mean": f"{math.exp(more.mean()):.2f}", "metric.median": f"{middle.median(metric):.3f}"}
    for key in ("baumgarte", "velocity", "direct", "mass"):
        for name, integrators in (("rk4", ("rk4",)), ("high", HIGH)):
            own = ratios(key, *integrators)
            found |= {f"{key}.{name}.low": f"{min(own):.2f}", f"{key}.{name}.high": f"{max(own):.2f}"}
            found[f"{key}.{name}.middle"] = f"{middle.median(own):.2f}"
    dear = [x for key in ("partitioning", "augmented", "index-one") for x in ratios(key, "rk4", *HIGH)]
    found |= {"dear.middle": f"{middle.median(dear):.1f}", "dear.high": f"{max(dear):.0f}"}
    law = page_rows(literature.law())
    gains, rates = [[float(row[k]) for row in law] for k in (2, 1)]
    found |= {"gain.low": f"{min(gains):g}", "gain.high": f"{max(gains):g}", "rates": f"{max(rates) / min(rates):.0f}"}
    rk4 = next(row for row in page_rows(literature.gains()) if row[0] == "`rk4`")
    none, one = (float(cell.partition(" ")[0]) for cell in (rk4[3], rk4[-1]))
    found["worse"] = f"{one / none:.0f}"[:1] + "0" * (len(f"{one / none:.0f}") - 1)
    closing = {row[0].strip("`"): float(row[4]) for row in page_rows(literature.closing())}
    found |= {f"closing.{name}": f"{100.0 * (closing[name] - 1.0):.0f}" for name in CLOSING[1:6]}
    return found


def tables() -> dict[str, str]:
    """Return the rows of the tables by their keys."""
    closing = {row[0].strip("`"): row for row in page_rows(literature.closing())}
    gains = [[row[0], row[1], *(cell.partition(" ")[0] for cell in row[3:])] for row in page_rows(literature.gains())]
    return {
        "law": rows_of(page_rows(literature.law())),
        "gains": rows_of(gains),
        "closing": rows_of([closing[name] for name in CLOSING]),
        "random": rows_of(random_rows()),
    }


def claims() -> Iterator[tuple[str, bool]]:
    """Yield what the text says of the order of numbers, and whether they have it."""
    law = page_rows(literature.law())
    yield "the best gain is near the rate", all(0.4 < float(row[2]) < 2.5 for row in law)
    orders = [float(row[-1].partition("(")[2].strip(")")) for row in page_rows(literature.gains())[1:]]
    yield "gains of the step leave order two", all(order < 2.6 for order in orders)
    yield "closing joints pays with rk4", max(ratios("velocity", "rk4") + ratios("direct", "rk4")) < 1.0
    yield "it does not with high orders", middle.median(ratios("velocity", *HIGH)) > 1.0
    yield "projection costs less than iteration", max(ratios("velocity", *HIGH)) < 1.5
    best = [float(mean("rk4", key)) for key in ("velocity", "direct", "mass")]
    yield "velocities have most of it", best[0] > 0.5 * best[1] and best == sorted(best)
    worse = [float(one["worse"][:-2]) for key in ("motion", "baumgarte") for one in measures("rk4", key)]
    yield "the gain of the motion harms less often", max(worse[:2]) < min(worse[2:])
    more = statistics.paired(statistics.RECORD.lines(), "rk4", METHODS["velocity"], METHODS["direct"])
    yield "positions add nothing in the middle", 0.95 < middle.median(more) < 1.05


def macros() -> str:
    """Return the file of numbers and tables."""
    lines = [rf"\expandafter\def\csname n:{key}\endcsname{{{value}}}" for key, value in numbers().items()]
    lines += [rf"\expandafter\def\csname t:{key}\endcsname{{{rows}}}" for key, rows in tables().items()]
    return "\n".join(lines) + "\n"


def tables_of_records() -> str:
    """Return the tables that follow from records, and the sentences about them."""
    lines = list[str]()
    for table in (equal_error.page_table(), equal_work.page_table(), statistics.page_table()):
        lines += [f"`python -m benchmarks.{table.command}`", "", *markdown(table.headings, table.measured()), ""]
        lines += [*(f"- {claim}" for claim in table.claims()), ""]
    return "\n".join(lines)


def lock() -> str:
    """Return the interpreter and the versions of all installed libraries, as pip reads them."""
    found = sorted({f"{x.metadata['Name']}=={x.version}" for x in distributions()}, key=str.lower)
    return "\n".join([f"# Python {platform.python_version()}, {platform.machine()}", *found, ""])


def build_wheel(folder: Path) -> Path:
    """Build the wheel of this checkout into a folder, with the build backend that is installed or with pip's own.

    Raises
    ------
    subprocess.CalledProcessError
        If pip cannot build it.
    """
    for older in folder.glob("*.whl"):
        older.unlink()
    own = ["--no-build-isolation"] if find_spec("hatchling") is not None else []
    words = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", *own, "--wheel-dir", str(folder), str(ROOT)]
    subprocess.run(words, check=True)
    (wheel,) = folder.glob("*.whl")
    return wheel


def archive(folder: Path) -> Path:
    """Pack what a folder has, but what LaTeX leaves, into an archive beside it."""
    packed = folder.with_name(f"{folder.name}.zip")
    left = {f".{ending}" for ending in ("aux", "log", "out")}
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as file:
        for path in sorted(path for path in folder.rglob("*") if path.is_file() and path.suffix not in left):
            file.write(path, path.relative_to(folder.parent))
    return packed


def pictures(folder: Path) -> None:
    """Draw the three pictures."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    style: Any = {"font.size": 8, "axes.spines.top": False, "axes.spines.right": False, "pdf.fonttype": 42}
    with mpl.rc_context(style):
        for name, draw in (("law", _law), ("random", _random), ("equal", _equal)):
            figure = Figure(figsize=(3.3, 2.4), layout="constrained")
            draw(figure.add_subplot())
            figure.savefig(folder / f"{name}.pdf", metadata={"CreationDate": None})


def _law(axes: Axes) -> None:
    rows = page_rows(literature.law())
    rates = np.array([float(row[1]) for row in rows])
    axes.loglog(rates, rates * [float(row[2]) for row in rows], "o", color="#0072b2", label="best gain")
    line = np.array([rates.min() / 2.0, rates.max() * 2.0])
    axes.loglog(line, line, color="#999999", linewidth=1.0, label="gain = rate")
    axes.axhline(5.0, color="#d55e00", linewidth=1.0, linestyle="--", label="5 1/s")
    axes.set(xlabel="rate of the motion [1/s]", ylabel="gain of least violation [1/s]")
    axes.legend(frameon=False)


def _random(axes: Axes) -> None:
    colours = ("#d55e00", "#e69f00", "#56b4e9", "#0072b2", "#009e73")
    for key, colour in zip(("baumgarte", "motion", "velocity", "direct", "mass"), colours, strict=True):
        values = np.sort(improvements("rk4", key))
        axes.semilogx(values, np.linspace(0.0, 1.0, len(values)), color=colour, linewidth=1.2, label=plain(key))
    axes.axvline(1.0, color="#999999", linewidth=0.8)
    axes.set(xlim=(0.05, 1e3), xlabel="error without over error with the method", ylabel="share of mechanisms")
    axes.legend(frameon=False, fontsize=6)


def _equal(axes: Axes) -> None:
    keys = ("baumgarte", "velocity", "direct", "mass", "partitioning", "index-one", "augmented")
    markers = {"rk4": ("o", "#0072b2"), "dop853": ("s", "#d55e00"), "picard": ("^", "#009e73")}
    for shift, (integrator, (marker, colour)) in zip((-0.22, 0.0, 0.22), markers.items(), strict=True):
        for k, key in enumerate(keys):
            own = ratios(key, integrator)
            axes.semilogx(own, np.full(len(own), k + shift), marker, color=colour, markersize=2.5, alpha=0.8,
                          label=integrator if k == 0 else None)  # fmt: skip
    axes.axvline(1.0, color="#999999", linewidth=0.8)
    names = [*map(plain, keys)]
    axes.set(xlabel="run time over that of lagrange", yticks=range(len(keys)), yticklabels=names)
    axes.tick_params(axis="y", labelsize=6)
    axes.legend(frameon=False, fontsize=6)


def main(arguments: Sequence[str]) -> int:
    """Write the paper into a folder; 1 if LaTeX finds errors, or numbers measured anew are others."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.paper")
    parser.add_argument("folder", nargs="?", type=Path, default=Path("out/paper"))
    parser.add_argument("--minutes", type=float, default=0.0, help="of measuring anew; none by default")
    chosen = parser.parse_args(arguments)
    folder, sources = chosen.folder, measured_again.sources_of_paper(seed=1) if chosen.minutes else []
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(SOURCE, folder)
    (folder / "numbers.tex").write_text(macros(), encoding="utf-8")
    (folder / "tables.md").write_text(tables_of_records(), encoding="utf-8")
    (folder / "lock.txt").write_text(lock(), encoding="utf-8")
    shutil.copy(CITATION, folder)
    shutil.copytree(FOLDER, folder / FOLDER.name, dirs_exist_ok=True)
    pictures(folder)
    build_wheel(folder)
    done = typeset(folder)  # before what takes long: an error of LaTeX shows in the first minute
    try:
        measured_again.measure_in_turns(sources, 60.0 * chosen.minutes)
    finally:  # an interruption leaves what has been found
        if sources:
            (folder / "again.md").write_text(measured_again.in_words(sources), encoding="utf-8")
        sys.stdout.write(f"{archive(folder)}\n")
    return max(done, int(not all(source.agrees for source in sources)))


def typeset(folder: Path) -> int:
    """Make the PDF, where there is pdflatex; 1 if it finds errors."""
    engine = shutil.which("pdflatex")
    if engine is None:
        sys.stdout.write(f"{folder}: the PDF needs pdflatex\n")
        return 0
    words = [engine, "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", SOURCE.name]
    for _ in range(2):
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.stderr.write(done.stdout[-2000:])
            return 1
    sys.stdout.write(f"{folder / 'paper.pdf'}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
