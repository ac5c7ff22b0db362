"""Move a driven mechanism without integrating."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from symgen.analyses.kinds import (
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
from symgen.base.errors import plural
from symgen.base.keywords import DrivenKeywords
from symgen.base.settings import Settings

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from symgen.analyses.model_methods import Analysed
    from symgen.analyses.prescribed.driven_motion import Kinematics


def kinematics(
    model: Analysed,
    times: ArrayLike | None = None,
    settings: Settings | None = None,
    transmission: Sequence[str] = (),
    sensitivities: Sequence[str] = (),
    **changes: Unpack[DrivenKeywords],
) -> Kinematics:
    """Return the motion of a mechanism whose freedom is all driven, without integrating; see `docs/kinematics.md`.

    Parameters
    ----------
    times : array, optional
        Increasing, of any sign [s]; those of the outputs of a run of the file by default.
    settings : Settings, optional
        All settings at once.
    transmission : sequence of str
        Pins with requested transmission angles, such as ``"C"`` or ``"C(B, D)"``.
    sensitivities : sequence of str
        Numbers that the motion is differentiated by: parameters, and numbers of the file by their paths such as
        ``bodies.crank.mass``. `Kinematics.gradient` returns the derivatives.
    **changes
        Other settings are refused. Of several ways to close the mechanism that nearest to a start such as
        ``{"rocker.theta": -1.5}`` is taken.

    Raises
    ------
    InputError
        If freedom is left that no driver drives, or is driven twice; if an argument is wrong; if a motion that is
        differentiated passes a singular position.
    AssemblyError
        If the mechanism cannot be closed.
    """
    from symgen.analyses.prescribed.driven_motion import driven_motion as motion_of

    own = change_settings_checked("kinematics", settings, changes, OF_MOTIONS)
    return motion_of(model.mechanism, own, times, transmission, sensitivities=sensitivities)


def command(
    load: Callable[[], Analysed],
    settings: Settings,
    times: Sequence[float] | None,
    transmission: Sequence[str],
    sensitivities: Sequence[str],
    quantities: Sequence[str],
    save: Path | None,
    plot: Path | None,
    over: str | None,
    curves: Path | None,
) -> AnalysisOutput:
    """Move MODEL, whose freedom is all driven, through any times without integrating.

    For example: symgen kinematics driven-four-bar --times "lin(0, 1, 361)" --transmission C --save motion.csv
    """
    from symgen.result.labelled import PRODUCTS, common_scales
    from symgen.result.summary import extreme_values

    check_over(over, plot)
    result = kinematics(load(), times, settings, transmission, sensitivities)
    result.along(over or "t")
    shown = (
        extreme_values(result.select(quantities) if quantities else result.whole(("q", "transmission")))
        if len(result.t)
        else {}
    )
    loads = any(entry["unit"] in PRODUCTS or entry["unit"] == "N" for entry in shown.values())
    scales = common_scales((result.q, result.v, result.a, *((result.lam,) if loads else ())))
    scaled = {name: {**entry, "scale": scales.get(entry["unit"], 0.0)} for name, entry in shown.items()}
    return AnalysisOutput(
        result.to_json() | ({"quantities": shown} if quantities else {}),
        (
            f"{result.mechanism}: {plural(len(result.t), 'time')}, {plural(result.steps, 'step')}",
            scaled,
            *_derivatives_at_end(result, quantities),
        ),
        result.notes,
        result.ended,
        {
            save: lambda path: result.save(path, quantities),
            plot: lambda path: result.plot(path, quantities, over or "t"),
            curves: lambda path: result.plot_curves(path),
        },
    )


def _derivatives_at_end(result: Kinematics, quantities: Sequence[str]) -> Iterator[AnalysisTable]:
    """Yield a table of the derivatives at the last time, of coordinates and outputs by default."""
    if result.sensitivities is None or not len(result.t):
        return
    rows = list[tuple[str, ...]]()
    for name in quantities or (*result.q.names, *result.outputs.names):
        table = result.gradient(name)
        cells = zip(table.row().items(), table.units, strict=True)
        rows += [(name, by, f"{value + 0.0:.6g}", unit) for (by, value), unit in cells]
    left = ("final derivative of", "by", "unit")
    yield AnalysisTable(("final derivative of", "by", "value", "unit"), rows, left)


KIND = Analysis(
    methods=(kinematics,),
    command=command,
    options=(
        Option(
            "--times",
            "Times [s]: lin(0, 1, 101) or 0,0.25,0.5.  [default: outputs of a run of MODEL]",
            "times",
            "TIMES",
        ),
        Option(
            "--transmission",
            "A pin whose transmission angle to compute; C(B, D) if its bodies have several further joints.",
            "texts",
            "PIN",
        ),
        Option(
            "--sensitivity",
            "Differentiate the motion by parameters, or numbers of the file such as bodies.crank.mass.",
            "columns",
            "NAME,NAME",
            "sensitivities",
        ),
        *motion_settings("Value of a coordinate: of several closed positions of MODEL the nearest is used."),
        *table_options(
            "What to show, save and plot: a column, a body, a joint or a table, such as points.", "quantities"
        ),
        Option("--curves", "Draw the paths of points into FILE: .png, .svg, .pdf or .pgf.", "plot", "FILE"),
    ),
    examples=(
        'symgen kinematics driven-four-bar --times "lin(0,1,101)"',
        "symgen kinematics driven-four-bar --transmission C --plot motion.svg",
    ),
)
