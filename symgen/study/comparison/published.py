"""Problems of a library of benchmarks, run beside what others published of them.

`symgen compare --benchmark iftomm` shows these rows. What is compared is what was published: the largest error of the
energy balance [J], and the seconds of a run.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from symgen.api import load
from symgen.base.errors import InputError, suggest
from symgen.base.settings import Settings


@dataclass(frozen=True)
class PublishedProblem:
    """A problem of a library, how it is run here, and what was published of it.

    Attributes
    ----------
    problem, model : str
        Name in the library, and the mechanism of the catalogue.
    until : float
        Duration of the simulation [s].
    settings : dict
        Method, integrator, tolerance and coordinates of the run here.
    published_error, published_seconds : float or None
        Largest error of the energy balance [J], as read from the published curve, and run time [s]; None: unpublished.
    """

    problem: str
    model: str
    until: float
    settings: dict[str, Any]
    published_error: float | None = None
    published_seconds: float | None = None


@dataclass(frozen=True)
class Benchmark:
    """A library of problems; `source` is where it stands, `published` where the numbers beside ours come from."""

    source: str
    published: str
    problems: tuple[PublishedProblem, ...]


@dataclass(frozen=True)
class PublishedRow:
    """A problem as it ran here, beside what was published.

    Attributes
    ----------
    problem, model, method, integrator, coordinates : str
        What ran, and how.
    until, rtol : float
        Duration [s] and relative tolerance.
    status : str
        How the run ended.
    error, published_error : float, float or None
        Largest error of the energy balance [J].
    seconds, published_seconds : float, float or None
        Processor time of the loop [s], the best of the rounds, on this machine; run time as published, on theirs.
    warnings : tuple of str
        What the run has to say.
    """

    problem: str
    model: str
    until: float
    method: str
    integrator: str
    rtol: float
    coordinates: str
    status: str
    error: float
    published_error: float | None
    seconds: float
    published_seconds: float | None
    warnings: tuple[str, ...]


def _dop853(method: str, rtol: float) -> dict[str, Any]:
    return {"method": method, "integrator": "dop853", "rtol": rtol, "atol": 0.01 * rtol}


#: A tolerance is the loosest power of ten at which the error here is below the published one. Published errors are
#: read from the figures of the energy; a legend hides the largest values of A02 and A03, which are these or more.
BENCHMARKS = {
    "iftomm": Benchmark(
        "IFToMM benchmark library, problems A01 to A05 (M. Gonzalez and others, doi 10.1007/s00366-009-0139-0)",
        "OpenSim 3.2 on an Intel Core i5-4570, by L. Tagliapietra, M. Vivian and M. Reggiani (2014), "
        "Multi-Body Systems Benchmark in OpenSim",
        (
            PublishedProblem("A01", "pendulum", 10.0, _dop853("direct-correction", 1e-12), 4.0e-11, 0.637),
            PublishedProblem("A01, 2000 s", "pendulum", 2000.0, _dop853("direct-correction", 1e-12)),
            PublishedProblem("A02", "n-four-bar:2", 10.0, _dop853("index1-augmented-lagrangian", 1e-8), 3e-7, 0.455),
            PublishedProblem("A02, N = 40", "n-four-bar:40", 20.0, _dop853("index1-augmented-lagrangian", 1e-8)),
            PublishedProblem("A03", "andrews", 0.05, _dop853("lagrange", 1e-8), 3.4e-7, 0.384),
            PublishedProblem("A04", "bricard", 10.0, _dop853("lagrange", 1e-6), 9.1e-7, 0.258),
            PublishedProblem(
                *("A05", "flyball-governor", 10.0),
                {"method": "lagrange", "integrator": "radau5", "rtol": 1e-6, "atol": 1e-8, "coordinates": "joint"},
                None,
                0.233,
            ),
        ),
    )
}


def run_benchmark(name: str, repeat: int) -> tuple[Benchmark, list[PublishedRow]]:
    """Run every problem of a library and return its rows.

    Parameters
    ----------
    name : str
        Name of the library.
    repeat : int
        Rounds after a warm-up; the time of a row is the best of them.

    Returns
    -------
    benchmark : Benchmark
        The library.
    rows : list of PublishedRow
        One for each problem, in its order.

    Raises
    ------
    InputError
        No library has this name.
    """
    benchmark = BENCHMARKS.get(name)
    if benchmark is None:
        raise InputError(
            "--benchmark", "the name of a library of problems", f"'{name}'", suggest(name, list(BENCHMARKS))
        )
    return benchmark, [_row_of_problem(problem, repeat) for problem in benchmark.problems]


def _row_of_problem(problem: PublishedProblem, repeat: int) -> PublishedRow:
    model = load(problem.model)
    result = model.simulate(Settings(until=problem.until, repeat=repeat, **problem.settings))
    return PublishedRow(
        problem=problem.problem,
        model=problem.model,
        until=problem.until,
        method=result.method,
        integrator=result.integrator,
        rtol=problem.settings["rtol"],
        coordinates=result.coordinates,
        status=result.status,
        error=result.energy_drift_max,
        published_error=problem.published_error,
        seconds=result.seconds.run,
        published_seconds=problem.published_seconds,
        warnings=result.warnings,
    )


def benchmark_json(benchmark: Benchmark, rows: list[PublishedRow]) -> dict[str, Any]:
    """Return the rows as `--json` prints them."""
    return {"source": benchmark.source, "published": benchmark.published, "rows": [asdict(row) for row in rows]}
