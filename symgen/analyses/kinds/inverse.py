"""Find the efforts that a motion needs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from symgen.analyses.kinds import (
    OF_DRIVEN,
    OF_MOTIONS,
    Analysis,
    AnalysisOutput,
    AnalysisTable,
    Option,
    change_settings_checked,
    check_over,
    motion_settings,
    table_options,
)
from symgen.base.digits import digits, scale_of
from symgen.base.errors import InputError, plural
from symgen.base.keywords import DrivenKeywords
from symgen.base.settings import Settings, command_flag, differs_from_default

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from symgen.analyses.efforts.inverse_dynamics import Inverse
    from symgen.analyses.model_methods import Analysed
    from symgen.analyses.prescribed.driven_motion import Kinematics
    from symgen.result.result import Result


def inverse(
    model: Analysed,
    motion: Result | Kinematics | str | Path | None = None,
    settings: Settings | None = None,
    times: ArrayLike | None = None,
    actuators: Sequence[str] = (),
    weights: Mapping[str, float] | None = None,
    **changes: Unpack[DrivenKeywords],
) -> Inverse:
    """Return the efforts that a motion needs; see `docs/inverse.md`.

    Parameters
    ----------
    motion : Result, Kinematics or path, optional
        A recorded motion, or the file of one; by default the motion that the drivers prescribe.
    settings : Settings, optional
        All settings at once.
    times : array, optional
        Of a motion that drivers prescribe [s].
    actuators : sequence of str
        Actuators of the motion: drivers, joints, forces and inputs; all drivers by default.
    weights : mapping of str to float, optional
        Of efforts that are not unique: the sum of (weight effort)^2 is smallest. 1 / N, or 1 / (N m) times the
        length of the mechanism, by default.
    **changes
        Other settings are refused; ``start`` and ``strict`` belong to a motion that drivers prescribe.

    Raises
    ------
    InputError
        If an argument is wrong; without a motion, if freedom is left that no driver drives.
    AssemblyError
        If the mechanism cannot be closed.
    """
    from symgen.analyses.efforts.inverse_dynamics import inverse_dynamics as efforts_of

    counting = OF_MOTIONS if motion is None else [name for name in OF_MOTIONS if name not in OF_DRIVEN]
    whole = change_settings_checked("inverse", settings, changes, counting)
    return efforts_of(model.mechanism, whole, motion, times, actuators, weights)


def command(
    load: Callable[[], Analysed],
    settings: Settings,
    motion: str | None,
    times: Sequence[float] | None,
    actuators: Sequence[str],
    weights: Mapping[str, float],
    quantities: Sequence[str],
    save: Path | None,
    plot: Path | None,
    over: str | None,
) -> AnalysisOutput:
    """Find the efforts that a motion of MODEL needs: motor torques, forces of actuators.

    For example: symgen inverse driven-four-bar --times "lin(0, 1, 361)" --plot torque.svg, or of a recorded run:
    symgen inverse andrews --from run.nc --actuators drive
    """
    for name in OF_DRIVEN if motion is not None else ():
        if differs_from_default(settings, name):
            raise InputError(command_flag(name), "settings of a recorded motion", "one of drivers' motion")
    if quantities and save is None and plot is None:
        raise InputError("--quantity", "--save or --plot, where quantities go", "neither")
    check_over(over, plot)
    result = inverse(load(), motion, settings, times, actuators, weights)
    result.select(quantities)  # wrong names are refused before any output
    result.along(over or "t")
    return AnalysisOutput(
        result.to_json(),
        _effort_lines(result),
        (*result.notes, *filter(None, [result.too_few()])),
        result.ended,
        {
            save: lambda path: result.save(path, ("efforts", *quantities) if quantities else ()),
            plot: lambda path: result.plot(path, ("efforts", "power", *quantities), over or "t"),
        },
    )


def _effort_lines(result: Inverse) -> Iterator[str | AnalysisTable]:
    """Yield the sizes of each actuator: its largest effort and when, root mean square, peak power and energy."""
    yield f"{result.mechanism}: efforts at {plural(len(result.t), 'time')}"
    columns = {"largest": "max", "rms": "rms", "unit": "unit", "at [s]": "at"}
    columns |= {"peak power [W]": "peak_power", "energy [J]": "energy"}
    entries = result.summary()
    scales = {key: scale_of(e[key] for e in entries.values() if key in e) for key in columns.values() if key != "unit"}
    rows = [
        (name, *(x if isinstance(x := entry.get(key, ""), str) else digits(x, scales[key]) for key in columns.values()))
        for name, entry in entries.items()
    ]
    yield AnalysisTable(("effort", *columns), rows, left=("effort", "unit"))


KIND = Analysis(
    methods=(inverse,),
    command=command,
    options=(
        Option(
            "--from",
            "A recorded motion: .nc, .parquet or .csv that a result was saved to.  "
            "[default: what the drivers prescribe]",
            metavar="FILE",
            argument="motion",
        ),
        Option(
            "--times",
            "Times of the drivers' motion [s]: lin(0, 1, 101) or 0,0.25,0.5.  [default: outputs of a run of MODEL]",
            "times",
            "TIMES",
        ),
        Option(
            "--actuators",
            "Actuators of the motion: drivers, joints, forces, inputs.  [default: all drivers]",
            "words",
            "NAME,...",
        ),
        Option(
            "--weight",
            "Weight of an actuator where efforts are not unique: the sum of (weight effort)^2 is smallest.",
            "numbers",
            "NAME=VALUE",
            "weights",
        ),
        *motion_settings(
            "Coordinate of the drivers' motion: of several closed positions of MODEL the nearest is used."
        ),
        *table_options(
            "What to save and plot in addition to efforts: a column, a joint or a table, such as power or reactions.",
            "efforts and power",
        ),
    ),
    examples=("symgen inverse driven-four-bar", 'symgen inverse driven-four-bar --times "lin(0,1,101)" --json'),
)
