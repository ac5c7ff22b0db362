"""Error against run time: models, several methods, integrators, steps and tolerances, one reference a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from msgspec import structs

from symgen.api import Model, load
from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.base.plugins import explain_plugin_errors
from symgen.base.settings import Settings, default_of_setting
from symgen.compile.store.paths import cache_location
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism, with_largest_step
from symgen.describe.parts.event_sections import RESET
from symgen.run.planning.outputs import multiples, output_size
from symgen.run.planning.plan import refuse_ends
from symgen.run.planning.prepare import find_preparation
from symgen.study.comparison.combinations import Combinations
from symgen.study.comparison.comparison_rows import Row, Trace
from symgen.study.comparison.comparison_study import Study, save_csv
from symgen.study.comparison.gradients import check_parameters
from symgen.study.comparison.laws import mechanisms_of_laws
from symgen.study.comparison.model_comparison import PATIENCE, PREPARATION, REPEAT, ModelComparison, compute_cell_ahead
from symgen.study.journal import Journal
from symgen.study.references.reference import Array
from symgen.study.references.routes import parts_without_derivation
from symgen.study.references.solvers import AUTO, check_solver
from symgen.study.runner import Status, run_cells

__all__ = ["Progress", "Row", "Study", "Trace", "compare", "compare_all", "save_csv"]

#: Output times of a study, unless the mechanism's output step is coarser.
OUTPUTS = 200
#: Called with the current activity, the progress and the total.
Progress = Callable[[str, float, float], None]

#: Largest number of coordinates for which a study compiles straight code by default.
LARGEST_STRAIGHT = 120
#: Largest number of processes.
MOST_JOBS = 4096
#: A run, the reference with the runs that it is made of, distances, and the times of every row take so much of a run.
COPIES = 8.0


@explain_plugin_errors
def compare(
    model: str | Path | Mechanism | Model,
    methods: Sequence[str] = (),
    integrators: Sequence[str] = (),
    steps: Sequence[float] = (),
    rtols: Sequence[float] = (),
    until: float | None = None,
    repeat: int = REPEAT,
    output_step: float | None = None,
    parameters: Mapping[str, float] | None = None,
    options: Mapping[str, str | float] | None = None,
    progress: Progress | None = None,
    jobs: int = 1,
    journal: Journal | None = None,
    reference_by: str = AUTO,
    shape: str = "auto",
    max_violation: float = default_of_setting("max_violation"),
    max_energy_error: float = default_of_setting("max_energy_error"),
    max_attempts: float | None = None,
    start: Mapping[str, float] | None = None,
    coordinates: Sequence[str] = (),
    max_step: float | None = None,
    error_at: Sequence[float] = (),
    laws: Sequence[str] = (),
    gradient: Sequence[str] = (),
) -> Study:
    """Run a model with every combination and measure error and run time.

    Parameters
    ----------
    model : str, path, Mechanism or Model
        What to run.
    methods, integrators : sequence of str
        Names, or ``all``. By default the six methods of the source with rk4, dopri5 and dop853. Incompatible pairs
        are left out. A method may have options of its own, ``"baumgarte:alpha=5:beta=5"``: each is a line of the
        study.
    steps : sequence of float
        Constant steps [s] of integrators without error estimate; multiples of the mechanism's own by default.
    rtols : sequence of float
        Relative tolerances of adaptive integrators.
    until : float, optional
        End time [s]; by default the mechanism's own, limited to the time in which its motion is predictable.
    repeat : int
        Rounds a row, after a warm-up, in which the row and its yardstick run in turn. Short runs and uncertain ratios
        are repeated more often; runs of more than ten seconds run once, as all do with 1.
    output_step : float, optional
        Time between the outputs that are compared [s].
    parameters, options, start : mapping
        As for `symgen.Settings`; `start` holds values by name alone.
    progress : callable, optional
        Called with the current activity, the progress and the total.
    jobs : int
        Processes for untimed work: derivation, compilation, references. With more than 1 a script needs the guard
        ``if __name__ == "__main__":``.
    journal : Journal, optional
        Stores every finished row, and supplies the rows of an earlier, interrupted study.
    reference_by : str
        Source of the reference motion: ``auto``, or one of SciPy's solvers on independently derived equations
        (``scipy-dop853``, ``scipy-radau``, ``scipy-bdf``, ``scipy-lsoda``).
    shape : str
        Shape of the code. ``auto`` is ``straight`` for all methods up to `LARGEST_STRAIGHT` coordinates, so that run
        times compare methods and not shapes.
    max_violation, max_energy_error : float
        As for `symgen.Settings`. A run that exceeds one is `failed` and measured to its end without it.
    max_attempts : float
        As for `symgen.Settings`.
    coordinates : sequence of str
        ``absolute``, ``joint`` or both, side by side; absolute ones by default.
    max_step : float
        Largest step of adaptive integrators and of the reference [s].
    error_at : sequence of float
        Errors [m] at which run times are interpolated, `Study.at`. Lines then have more settings, and all of them are
        timed again in turn.
    laws : sequence of str
        Laws of rows with two bounds, each with lines of its own: ``exact``, the default, and ``tanh:speed=1e-3``, the
        bound times tanh(rate / speed).
    gradient : sequence of str
        Parameters by which the motion is differentiated: rows have the error of the derivatives of coordinates, beside
        differences of references, and the run time with derivatives.

    Returns
    -------
    Study
        Also after an interruption (KeyboardInterrupt), with the finished rows.

    Raises
    ------
    InputError
        If a name or number is wrong; raised before any run.
    """
    common = Settings(
        until=until,
        output_step=output_step,
        parameters=parameters or {},
        start=arguments.mapping("start", start, "values by the names of coordinates and velocities"),
        options=options or {},
        max_violation=max_violation,
        max_energy_error=max_energy_error,
        max_step=max_step,
        max_attempts=max_attempts,
        repeat=repeat,
        shape=shape,
    )
    runs = Combinations(methods, integrators, steps, rtols, coordinates, error_at, laws, gradient)
    return compare_all([model], common, runs, reference_by, progress, jobs, journal)[0]


def compare_all(
    models: Sequence[str | Path | Mechanism | Model],
    common: Settings,
    runs: Combinations,
    reference_by: str = AUTO,
    progress: Progress | None = None,
    jobs: int = 1,
    journal: Journal | None = None,
) -> list[Study]:
    """Compare on several models.

    Parameters
    ----------
    models : sequence of str, path, Mechanism or Model
        Models to run; all are checked before the first run.
    common : Settings
        Common settings of all runs.
    runs : Combinations
        Differences between runs.
    reference_by, progress, jobs, journal
        As for `compare`.

    Returns
    -------
    list of Study
        One a model, in order; after an interruption up to and including the interrupted one.

    Raises
    ------
    InputError
        As for `compare`.
    """
    check_solver(reference_by)
    jobs = arguments.whole_number("jobs", jobs, 1, MOST_JOBS)
    arguments.callable_or_none("progress", progress)
    if journal is not None:
        arguments.instance("journal", journal, Journal, "a symgen.study.journal.Journal")
    works, records = [], Journal() if journal is None else journal
    for model in models:
        chosen = _prepare_model(load(model), common)
        end = _end_of_model(chosen, common.until)
        times = _output_times(chosen, end, common.output_step)
        small = chosen.mechanism.body_coordinates <= LARGEST_STRAIGHT
        shape = "straight" if common.shape == "auto" and small else common.shape
        base = replace(common, output_step=None, shape=shape, until=end, times=times.tolist())
        values = parameter_values(chosen.mechanism, common.parameters)
        mechanisms = mechanisms_of_laws(chosen.mechanism, runs.laws, values)
        if reference_by != AUTO and (lacking := parts_without_derivation(chosen.mechanism)):
            raise InputError("reference", f"auto, as there is no second derivation of {lacking}", f"'{reference_by}'")
        check_parameters(chosen.mechanism, runs.gradient)
        step = chosen.mechanism.defaults.step
        cases = [(law, s) for law in mechanisms for s in runs.settings(base, step, chosen.mechanism)]
        runs_of_model = [find_preparation(mechanisms[law], s) for law, s in cases]  # raises errors before the first run
        measures = (reference_by, records, tuple(runs.error_at), tuple(law for law, _ in cases), tuple(runs.gradient))
        works.append(ModelComparison(chosen, common, end, times, [s for _, s in cases], runs_of_model, *measures))
    ahead = jobs > 1 and cache_location().persistent  # else the code that another process compiles would be lost
    reached, total = 0.0, sum(work.progress_length(ahead) for work in works)
    report: Progress = progress or (lambda what, reached, of: None)
    if ahead:
        cells = [cell for work in works for cell in work.cells_ahead()]
        reached = PREPARATION * len(cells)
        total += reached

        def report_preparation(status: Status) -> None:
            report(f"preparing: {status.done} of {status.total}", PREPARATION * status.done, total)

        if run_cells(cells, compute_cell_ahead, records, jobs, report_preparation, PATIENCE)[1]:
            return [works[0].make_study(True)]
    studies = []
    for work in works:
        prefix = f"{work.model.name}: " if len(works) > 1 else ""

        def show_progress(what: str, done: float, prefix: str = prefix, reached: float = reached) -> None:
            report(prefix + what, reached + done, total)

        studies.append(work.run_rows(show_progress, ahead))
        reached += work.progress_length(ahead)
        if studies[-1].interrupted:
            break
    return studies


def _prepare_model(model: Model, common: Settings) -> Model:
    """Return a model without events that are only recorded, and with the largest step for all; refuse ends of runs."""
    mechanism = model.mechanism
    refuse_ends("compare", mechanism, common)
    kept = tuple(event for event in mechanism.events if event.action == RESET)
    plain = mechanism if kept == mechanism.events else structs.replace(mechanism, events=kept)
    plain = with_largest_step(plain, common.max_step)
    return model if plain is mechanism else Model(plain)


def _end_of_model(model: Model, until: float | None) -> float:
    defaults = model.mechanism.defaults
    if until is not None:
        return until
    return min(defaults.until, defaults.predictable_until or np.inf)


def _output_times(model: Model, end: float, output_step: float | None) -> Array:
    """Return the common output times: multiples of `output_step` or the mechanism's, at most about `OUTPUTS`."""
    own = model.mechanism.defaults.output_step
    size = COPIES * output_size(model.mechanism)
    if output_step is not None:
        return multiples(output_step, end, size)
    if own is None:
        return np.asarray(np.linspace(0.0, end, OUTPUTS + 1), dtype=np.float64)
    return multiples(own * max(1, round(end / own / OUTPUTS)), end, size)
