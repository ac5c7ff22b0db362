"""Find parameters from measured data."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Unpack

from symgen.analyses.kinds import Analysis, AnalysisOutput, AnalysisTable, Option, change_settings_checked
from symgen.base.errors import InputError
from symgen.base.keywords import RunKeywords, keyword_names
from symgen.base.settings import Settings
from symgen.base.units import known_unit

if TYPE_CHECKING:
    from symgen.analyses.fit.identification import Fit
    from symgen.analyses.fit.objective import Gradient, Objective
    from symgen.analyses.model_methods import Analysed
    from symgen.analyses.search.ranges import Bounds

#: Settings that count: not those of outputs and checks, which the data and the fit decide.
COUNTING = tuple(
    name
    for name in keyword_names(RunKeywords)
    if name not in ("verify", "times", "until", "output_step", "stop_when", "record_when", "events", "repeat")
)

#: Those that count where a quantity at the end is differentiated.
OF_ENDS = tuple(name for name in keyword_names(RunKeywords) if name not in ("verify", "times", "output_step", "repeat"))


def identify(
    model: Analysed,
    data: object,
    settings: Settings | None = None,
    *,
    free: Mapping[str, Bounds] | Sequence[str],
    quantities: Sequence[str] = (),
    bias: Sequence[str] = (),
    weights: Mapping[str, float] | None = None,
    **changes: Unpack[RunKeywords],
) -> Fit:
    """Fit numbers of the model to measured data by least squares, with exact derivatives of the runs.

    Parameters
    ----------
    data : path, mapping or sequence of these
        Files of columns over ``t``, or mappings with arrays: ``{"t": t, "crank.theta": angles}``. Several are
        measurements of several runs.
    settings : Settings, optional
        All settings at once. Runs end with the data.
    free : mapping of str to (float, float), or sequence of str
        Numbers to be found: parameters, values of the start such as ``crank.omega``, ``method.NAME``. The bounds may
        be None. The search begins with the values of the run.
    quantities : sequence of str
        Columns of the data that count; all that the model has by default.
    bias : sequence of str
        Quantities measured with a constant error, which is found too.
    weights : mapping of str to float
        Factors of the residuals of quantities; one over the deviation of the data by default.
    **changes
        Single settings by name, as listed above.

    Raises
    ------
    InputError
        If an argument is wrong, or the data do not determine the numbers: says which can change together.
    AnalysisError
        If the model has no motion with the values it begins with.
    """
    from symgen.analyses.fit.identification import fit_to_data

    own = change_settings_checked("identify", settings, changes, COUNTING)
    return fit_to_data(model.mechanism, own, data, free, quantities, bias, weights)


def objective(
    model: Analysed,
    quantity: str,
    settings: Settings | None = None,
    *,
    by: Mapping[str, Bounds | None] | Sequence[str],
    way: str = "auto",
    **changes: Unpack[RunKeywords],
) -> Objective:
    """Return a quantity at the end of the run as a function of chosen numbers, for ``scipy.optimize.minimize``.

    The number of derivatives is not limited: few are carried along, as in runs with ``sensitivities``, and for many the
    adjoint goes back through the run.

    Parameters
    ----------
    quantity : str
        A column of results such as ``rocker.theta``, an output of the file, or a formula as in ``[outputs]``:
        ``"(arm.tip.x - 1)**2"``, ``"integral(motor.power)"``.
    settings : Settings, optional
        All settings at once. Tolerances are 1e-10 where they are left open.
    by : mapping of str to (float, float), or sequence of str
        The numbers: parameters, values of the start such as ``crank.omega``, ``method.NAME``. Their bounds may be None.
    way : {"auto", "forward", "adjoint"}
        As for `gradient`.
    **changes
        Single settings by name, as listed above.

    Returns
    -------
    Objective
        Called with an array, it returns value and gradient; it has `names`, `x0` and `bounds`.

    Raises
    ------
    InputError
        If an argument is wrong, or an event ends the run.
    AssemblyError
        If the mechanism cannot be closed.
    AnalysisError
        If the run fails.
    """
    from symgen.analyses.fit.objective import Objective

    own = change_settings_checked("objective", settings, changes, OF_ENDS)
    return Objective("objective", model.mechanism, own, quantity, by, way)


def gradient(
    model: Analysed,
    quantity: str,
    settings: Settings | None = None,
    *,
    by: Sequence[str],
    way: str = "auto",
    **changes: Unpack[RunKeywords],
) -> Gradient:
    """Return a quantity at the end of the run with its derivatives by chosen numbers.

    Few derivatives are carried along with the run; for many of them the adjoint goes back through its steps, at the
    cost of about three runs in all.

    Parameters
    ----------
    quantity, settings
        As for `objective`.
    by : sequence of str
        Parameters, numbers of the file by their paths, values of the start such as ``crank.omega``, ``method.NAME``.
    way : {"auto", "forward", "adjoint"}
        How derivatives are found: whichever costs less and covers the run, or one of them. The adjoint takes explicit
        Runge-Kutta schemes without events, and laws in closed form, with or without corrections of the state.
    **changes
        Single settings by name, as listed above.

    Returns
    -------
    Gradient
        Its `way` says how the derivatives were found.

    Raises
    ------
    InputError, AssemblyError, AnalysisError
        As for `objective`, and where the adjoint is wanted and does not cover the run.
    """
    from symgen.analyses.fit.objective import Objective

    own = change_settings_checked("gradient", settings, changes, OF_ENDS)
    return Objective("gradient", model.mechanism, own, quantity, by, way).first


def command(
    load: Callable[[], Analysed],
    settings: Settings,
    data: Sequence[str],
    free: Sequence[str],
    least: Mapping[str, float],
    most: Mapping[str, float],
    bias: Sequence[str],
    quantities: Sequence[str],
) -> AnalysisOutput:
    """Find parameters of MODEL from measured data.

    For example: symgen identify rod.toml --data angle.csv --free length,damping --least damping=0
    """
    if not data or not free:
        missing = "--data" if not data else "--free"
        raise InputError("identify", "--data FILE,... and --free NAME,...", f"no {missing}")
    for option, bounds in (("--least", least), ("--most", most)):
        for name in bounds:
            if name not in free:
                raise InputError(option, "a name that --free has", f"'{name}'")
    pairs = {name: (least.get(name), most.get(name)) for name in free}
    fit = identify(load(), list(data), settings, free=pairs, bias=bias, quantities=quantities)
    return AnalysisOutput(fit.to_json(), _fit_lines(fit), (*fit.null, *fit.notes))


def _fit_lines(fit: Fit) -> Iterator[str | AnalysisTable]:
    """Yield values with errors and intervals, and how far the model is from the data."""
    rows = list[tuple[str, ...]]()
    for name, x in fit.parameters.items():
        own = fit.written[name] if name in fit.written else known_unit("")
        values = (own.from_si(float(v)) for v in (x, fit.errors[name], *fit.intervals[name]))
        rows.append((name, *(f"{v:.6g}" for v in values), own.text if name in fit.written else fit.units[name]))
    headings = ("parameter", "value", "error", "95 % from", "to", "unit")
    yield AnalysisTable(headings, rows, left=("parameter", "unit"))
    yield AnalysisTable(
        ("quantity", "root mean square of residuals"),
        [(name, f"{x:.3g}") for name, x in fit.deviations.items()],
        left=("quantity",),
    )


KIND = Analysis(
    methods=(identify, objective, gradient),
    command=command,
    options=(
        Option(
            "--data", "Measured columns over t: .csv, .parquet or .nc; several for several runs.", "words", "FILE,..."
        ),
        Option("--free", "Numbers to be found: parameters, values of the start, method.NAME.", "words", "NAME,..."),
        Option("--least", "Lower bound of one of them.", "numbers", "NAME=VALUE"),
        Option("--most", "Upper bound of one of them.", "numbers", "NAME=VALUE"),
        Option("--bias", "Quantities measured with a constant error, which is found too.", "columns", "NAME,..."),
        Option(
            "--quantity",
            "Columns of the data that count.  [default: all that MODEL has]",
            "columns",
            "NAME,NAME",
            "quantities",
        ),
        *(Option(name) for name in ("parameters", "start", "method", "integrator", "options", "rtol", "coordinates")),
    ),
    examples=("symgen identify rod.toml --data angle.csv --free length,damping",),
)
