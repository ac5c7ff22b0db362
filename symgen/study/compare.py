"""Error against run time: one model, several methods, integrators, steps and tolerances, one reference."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from symgen.api import Model, load
from symgen.describe.mechanism import Mechanism
from symgen.errors import InputError
from symgen.integrators import INTEGRATORS
from symgen.methods import METHODS
from symgen.plan import Plan, Settings, make_plan
from symgen.result.judge import judge
from symgen.result.result import FAILED, finite
from symgen.runtime import abi
from symgen.study.points import Points
from symgen.study.reference import Array, Reference, reference
from symgen.study.timing import repeated

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.runtime.assembly import Start
    from symgen.runtime.run import Outcome

#: Constant steps of a study are these multiples of the mechanism's own, unless steps are given.
STEP_FACTORS = (4.0, 2.0, 1.0, 0.5)
#: Relative tolerances of adaptive runs, unless given; absolute ones are this fraction of them.
RTOLS = (1e-6, 1e-8, 1e-10)
ATOL_SHARE = 1e-2
#: Output times of a study where the mechanism does not say more coarsely.
OUTPUTS = 200
#: Timed runs a row, unless told.
REPEAT = 3

#: Called with what is being done, how far it is, and how much there is in all.
Progress = Callable[[str, float, float], None]

#: What `compare` runs unless methods are named: the six of Marques, Souto and Flores (2017).
DEFAULT_METHODS = (
    *("lagrange", "baumgarte", "augmented-lagrangian", "index1-augmented-lagrangian"),
    *("coordinate-partitioning", "direct-correction"),
)
#: And with which integrators; a method that none of them suits gets its own.
DEFAULT_INTEGRATORS = ("rk4", "dopri5", "dop853")
#: Stands for every method or integrator.
ALL = "all"


@dataclass(frozen=True)
class Row:
    """One method with one integrator at one step or tolerance.

    Attributes
    ----------
    method, integrator : str
        What was run.
    step, rtol : float or None
        Constant step [s], or relative tolerance.
    status, reason
        As of a result; a failed run stays a row.
    error : float or None
        Largest distance to the reference [m] over bodies, output times and points (`symgen.study.points`); None for a
        run that failed.
    below_reference : bool
        The error is below what the reference itself may be off, so it says no more than that.
    run_seconds, run_seconds_spread : float
        Shortest of several runs after a warm-up, and longest minus shortest [s].
    evaluations : int
        Right-hand sides.
    position_violation_max, velocity_violation_max, energy_drift_max : float
        Largest norms of Phi and ``D v - nu``, and energy error [J].
    warnings : tuple of str
        Sentences: what to be careful with.
    """

    method: str
    integrator: str
    step: float | None
    rtol: float | None
    status: str
    reason: str | None
    error: float | None
    below_reference: bool
    run_seconds: float
    run_seconds_spread: float
    evaluations: int
    position_violation_max: float
    velocity_violation_max: float
    energy_drift_max: float
    warnings: tuple[str, ...] = ()

    def texts(self) -> list[str]:
        """Return the fields as the cells of a table; None is empty."""
        return ["" if x is None else "; ".join(x) if isinstance(x, tuple) else str(x) for x in asdict(self).values()]


@dataclass(frozen=True)
class Study:
    """Rows of one mechanism against one reference.

    Attributes
    ----------
    mechanism : str
        What was run.
    how : str
        Where the reference comes from.
    estimated_error : float
        How far the reference may be off [m].
    until : float
        End time [s].
    rows : tuple of Row
        In the order of methods, integrators, steps or tolerances.
    interrupted : bool
        Whether rows are missing because the study was stopped.
    """

    mechanism: str
    how: str
    estimated_error: float
    until: float
    rows: tuple[Row, ...]
    interrupted: bool = False

    @property
    def failed(self) -> bool:
        """Whether not one run came to an end."""
        return not any(row.status != FAILED for row in self.rows)

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen compare --json``."""
        contract = {
            "mechanism": self.mechanism,
            "until": self.until,
            "reference": {"how": self.how, "estimated_error": self.estimated_error},
            "rows": [asdict(row) for row in self.rows],
        }
        return cast(dict[str, Any], finite(contract))

    def to_dataframe(self) -> Any:
        """Return the rows as a pandas data frame."""
        from symgen.result.export import need

        need("to_dataframe", "pandas")
        import pandas as pd

        return pd.DataFrame([asdict(row) for row in self.rows], columns=[f.name for f in fields(Row)])

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the rows to a CSV file; it appears whole or not at all."""
        return save_csv([self], Path(path))


def save_csv(studies: Sequence[Study], path: Path) -> Path:
    """Write the rows of studies to one CSV file, with the mechanism in the first column."""
    import csv

    from symgen.result.export import check_writable, write_whole

    if path.suffix.lower() != ".csv":
        raise InputError("save", "a file ending in .csv", f"'{path}'")
    check_writable("save", path)

    def write(file: Path) -> None:
        with file.open("w", newline="", encoding="utf-8") as handle:
            writer = csv.writer(handle)
            writer.writerow(["mechanism", *(f.name for f in fields(Row))])
            for study in studies:
                for row in study.rows:
                    writer.writerow([study.mechanism, *row.texts()])

    return write_whole(path, write)


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
) -> Study:
    """Run a model with every combination and measure error and run time.

    Parameters
    ----------
    model : str, path, Mechanism or Model
        What to run.
    methods, integrators : sequence of str
        Names, or ``all``. Unless given, the six methods of the source with `DEFAULT_INTEGRATORS`. Pairs that do not
        suit each other are left out.
    steps : sequence of float
        Constant steps [s] of integrators without error estimate; multiples of the mechanism's own unless given.
    rtols : sequence of float
        Tolerances of adaptive ones.
    until : float, optional
        End time [s]; the mechanism's own unless given, and no longer than it is predictable.
    repeat : int
        Timed runs a row, after a warm-up; the shortest counts.
    output_step : float, optional
        Time between the outputs that are compared [s].
    parameters, options : mapping
        As for `symgen.plan.Settings`.
    progress : callable, optional
        Called with what is being done, how far it is, and how much there is in all.

    Returns
    -------
    Study
        Also after an interruption (KeyboardInterrupt), with the rows that are done.

    Raises
    ------
    InputError
        If a name or number is wrong; nothing has been run then.
    SimulationError
        If the reference motion cannot be had.
    """
    chosen = model if isinstance(model, Model) else load(model)
    base = Settings(parameters=parameters or {}, options=options or {}, repeat=repeat)
    end = _end(chosen, until)
    times = _times(chosen, end, output_step)
    settings = list(_combinations(chosen, base, methods, integrators, steps, rtols, end, times))
    plans = [make_plan(chosen, s) for s in settings]  # refuses what is wrong before anything is run
    total = float(len(plans) + 1)
    say: Progress = progress or (lambda what, reached, of: None)

    known: Reference | None = None
    rows: list[Row] = []
    ready: dict[tuple[str, tuple[tuple[str, float], ...]], tuple[CompiledModel, Start]] = {}
    points = Points.of(chosen.mechanism, chosen.parameters(parameters))
    interrupted = False
    try:
        for i, (s, plan) in enumerate(zip(settings, plans, strict=True)):
            key = plan.choice.stem, tuple(sorted(plan.method_parameters.items()))
            if key not in ready:
                ready[key] = chosen.ready(plan, parameters)
            compiled, start = ready[key]
            if known is None:
                say("reference", 0.0, total)
                nq, nv = compiled.info.nq, compiled.info.nv
                q, v = start.y[:nq], start.y[nq : nq + nv]
                values = chosen.parameters(parameters)
                known = reference(chosen.mechanism, values, q, v, times, lambda f: say("reference", f, total))
            say(f"{s.method}, {s.integrator}", 1.0 + i, total)
            outcome, spread = repeated(compiled, plan.tableau, start, plan.spec, repeat)
            if outcome.code != abi.STOPPED:
                rows.append(_row(s, plan, outcome, spread, known, points))
            if outcome.interrupted:
                interrupted = True
                break
    except KeyboardInterrupt:
        interrupted = True
    how, estimated = ("not computed", np.nan) if known is None else (known.how, known.estimated_error)
    return Study(chosen.name, how, float(estimated), end, tuple(rows), interrupted)


def _row(settings: Settings, plan: Plan, outcome: Outcome, spread: float, known: Reference, points: Points) -> Row:
    """Judge and measure one run."""
    compiled = outcome.compiled
    verdict = judge(settings, plan, compiled, outcome)
    error = None
    if outcome.code == abi.DONE:
        error = points.distance(outcome.states[:, : compiled.info.nq], known.q)
    adaptive = plan.spec.adaptive
    return Row(
        method=plan.choice.method.name,
        integrator=plan.tableau.name,
        step=None if adaptive else plan.spec.step,
        rtol=plan.spec.rtol if adaptive else None,
        status=verdict.status,
        reason=verdict.reason,
        error=error,
        below_reference=error is not None and error < known.estimated_error,
        run_seconds=outcome.run_seconds,
        run_seconds_spread=spread,
        evaluations=outcome.evaluations,
        position_violation_max=outcome.position_violation_max,
        velocity_violation_max=outcome.velocity_violation_max,
        energy_drift_max=outcome.energy_drift_max,
        warnings=verdict.warnings,
    )


def _end(model: Model, until: float | None) -> float:
    defaults = model.mechanism.defaults
    if until is not None:
        return until
    return min(defaults.until, defaults.predictable_until or np.inf)


def _times(model: Model, end: float, output_step: float | None) -> Array:
    """Return the common output times: multiples of the asked or the mechanism's step, at most about `OUTPUTS`."""
    if not (np.isfinite(end) and end > 0.0):
        raise InputError("until", "a finite number above 0", f"{end:g}")
    every = output_step if output_step is not None else model.mechanism.defaults.output_step
    if every is None:
        return np.asarray(np.linspace(0.0, end, OUTPUTS + 1), dtype=np.float64)
    if not (np.isfinite(every) and every > 0.0):
        raise InputError("output_step", "a finite number above 0", f"{every:g}")
    if output_step is None:
        every *= max(1, round(end / every / OUTPUTS))
    count = int(end / every * (1.0 + 1e-12))
    times: Array = np.arange(count + 1, dtype=np.float64) * every
    return np.minimum(times, end) if end - times[-1] <= 1e-9 * every else np.append(times, end)


def _combinations(
    model: Model,
    base: Settings,
    methods: Sequence[str],
    integrators: Sequence[str],
    steps: Sequence[float],
    rtols: Sequence[float],
    end: float,
    times: Any,
) -> Iterator[Settings]:
    from dataclasses import replace

    own = model.mechanism.defaults.step
    for method in _named(methods, DEFAULT_METHODS, METHODS.names):
        for integrator in _suitable(method, integrators):
            common = replace(base, method=method, integrator=integrator, until=end, times=times)
            common = replace(common, options=_options_for(base.options, method, methods, integrator, integrators))
            if INTEGRATORS.get(integrator, "--integrators").adaptive:
                for rtol in rtols or RTOLS:
                    yield replace(common, rtol=rtol, atol=rtol * ATOL_SHARE)
            else:
                for step in steps or [own * factor for factor in STEP_FACTORS]:
                    yield replace(common, step=step)


def _named(given: Sequence[str], default: Sequence[str], everything: Sequence[str]) -> tuple[str, ...]:
    """Return the names asked for, each once; ``all`` stands for everything there is."""
    wanted = [name for g in given or default for name in (everything if g == ALL else (g,))]
    return tuple(dict.fromkeys(wanted))


def _suitable(method: str, integrators: Sequence[str]) -> tuple[str, ...]:
    """Return those of the integrators that solve a form of the method.

    Raises
    ------
    InputError
        If integrators were named and none of them does.
    """
    chosen = METHODS.get(method, "--methods")
    named = _named(integrators, DEFAULT_INTEGRATORS, INTEGRATORS.names)
    fit = tuple(n for n in named if set(INTEGRATORS.get(n, "--integrators").forms) & set(chosen.forms))
    if fit or not integrators:
        return fit or (chosen.default_integrator,)
    forms = ", ".join(chosen.forms)
    raise InputError("--integrators", f"one that solves a form of {method} ({forms})", f"'{', '.join(integrators)}'")


def _options_for(
    options: Mapping[str, str | float], method: str, methods: Sequence[str], integrator: str, integrators: Sequence[str]
) -> dict[str, str | float]:
    """Return the options that are meant for this method and integrator: those of others in the study are left out."""
    others = {*(methods or METHODS.names), *(integrators or INTEGRATORS.names)} - {method, integrator}
    return {key: value for key, value in options.items() if key.partition(".")[0] not in others}
