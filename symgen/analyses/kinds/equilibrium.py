"""Find where a mechanism rests, and whether it stays there."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Unpack

from symgen.analyses.kinds import STATE, Analysis, AnalysisOutput, AnalysisTable, Option, change_settings_checked
from symgen.base.digits import digits, scale_of
from symgen.base.errors import InputError, fit_lines, plural
from symgen.base.keywords import StateKeywords
from symgen.base.settings import Settings

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from symgen.analyses.model_methods import Analysed
    from symgen.analyses.rest.equilibria import Equilibrium

    Array = NDArray[np.float64]

#: Largest number of values shown.
MOST = 40


def equilibrium(model: Analysed, settings: Settings | None = None, **changes: Unpack[StateKeywords]) -> Equilibrium:
    """Return the equilibrium that the start leads to: the one it is near to, or a stable one further away.

    Parameters
    ----------
    settings : Settings, optional
        All settings at once; ``parameters``, ``inputs``, ``start``, ``coordinates`` and ``shape`` are looked at:
        looped code, and any mechanism with more than 300 coordinates, is searched with sparse matrices.
    **changes
        Other settings are refused. Drivers hold what they drive where it is at the time 0.

    Raises
    ------
    AnalysisError
        If no equilibrium is found.
    """
    from symgen.analyses.linear.named_places import rest_from

    return rest_from(model.mechanism, change_settings_checked("equilibrium", settings, changes))


def equilibria(
    model: Analysed,
    scan: tuple[str, Sequence[float] | Array],
    settings: Settings | None = None,
    **changes: Unpack[StateKeywords],
) -> tuple[Equilibrium, ...]:
    """Return all equilibria that are found over a range of a coordinate.

    Parameters
    ----------
    scan : (str, sequence of float)
        The coordinate and its values, such as ``("crank.theta", numpy.linspace(0, 6.28, 25))``.
    settings : Settings, optional
        As for `equilibrium`.
    **changes
        Other settings are refused.

    Raises
    ------
    AnalysisError
        If no equilibrium is found.
    """
    from symgen.analyses.linear.named_places import scan_for_rests

    return scan_for_rests(model.mechanism, change_settings_checked("equilibria", settings, changes), scan)


def steady(
    model: Analysed, settings: Settings | None = None, *, cyclic: Sequence[str] = (), **changes: Unpack[StateKeywords]
) -> Equilibrium:
    """Return the steady motion that the start leads to: cyclic coordinates turn on, everything else stays.

    Parameters
    ----------
    settings : Settings, optional
        As for `equilibrium`; coordinates are those of joints. Cyclic coordinates keep their speeds of the start,
        and drivers move.
    cyclic : sequence of str
        Coordinates of joints that turn on; those that nothing depends on by default.
    **changes
        Other settings are refused.

    Raises
    ------
    AnalysisError
        If no steady motion is found.
    """
    from symgen.analyses.linear.named_places import steady_from

    return steady_from(model.mechanism, change_settings_checked("steady", settings, changes), cyclic)


def command(
    load: Callable[[], Analysed], settings: Settings, scan: tuple[str, Array] | None, moving: bool
) -> AnalysisOutput:
    """Find the equilibrium that the start of MODEL leads to.

    The equilibrium near the start is found whatever its stability; from further away a stable one. With --scan the
    coordinate is held at one value after the other, and equilibria are where the force that this takes changes its
    sign. Drivers hold what they drive where it is at the time 0. With --steady cyclic coordinates turn on at their
    speed at the start.
    """
    if scan is not None and moving:
        raise InputError("--scan", "an equilibrium at rest", "--steady as well")
    model = load()
    if scan is not None:
        results = equilibria(model, scan, settings)
    else:
        results = (steady(model, settings) if moving else equilibrium(model, settings),)
    return AnalysisOutput(
        {"mechanism": model.mechanism.name, "equilibria": [one.to_dict() for one in results]},
        (item for one in results for item in equilibrium_lines(one)),
        dict.fromkeys(note for one in results for note in one.notes),
    )


def equilibrium_lines(result: Equilibrium) -> Iterator[str | AnalysisTable]:
    """Yield the lines of an equilibrium."""
    squares = ", ".join([f"{x:.6g}" for x in result.omega_squared[:8]] + ["..."] * (len(result.omega_squared) > 8))
    yield f"{result.stability}; omega^2 [1/s^2]: {squares or 'nothing can move'}"
    yield f"  {plural(result.iterations, 'step')}, largest force that is not balanced {result.residual:.3g}"
    if result.not_unique:
        yield f"  reactions are not unique at {', '.join(result.not_unique)}"
    for title, values in (("coordinate", result.q), ("state", result.states), ("multiplier", result.multipliers)):
        first = fit_lines(len(values), MOST)
        if values:
            kinds = {name: _scale_of_coordinate(name) if title == "coordinate" else "" for name in values}
            scales = {
                kind: scale_of((x for n, x in values.items() if kinds[n] == kind), kind) for kind in kinds.values()
            }
            rows = [(n, digits(x, scales[kinds[n]], 9)) for n, x in list(values.items())[:first]]
            yield AnalysisTable((title, "value"), rows, left=(title,))
        if len(values) > first:
            yield f"... and {len(values) - first} more; --json has all"


def _scale_of_coordinate(coordinate: str) -> str:
    """Return the scale of a coordinate: a length for lengths, a radian for angles."""
    return "m" if coordinate.rpartition(".")[2] in ("x", "y", "z", "displacement") else "rad"


KIND = Analysis(
    methods=(equilibrium, equilibria, steady),
    command=command,
    options=(
        Option("--scan", "Find all equilibria over a range of a coordinate.", "range", "NAME=lin(A,B,N)"),
        Option(
            "--steady", "Find the steady motion that the start leads to instead of a rest.", "switch", argument="moving"
        ),
        *STATE,
    ),
    examples=("symgen equilibrium four-bar", 'symgen equilibrium four-bar --scan "crank.theta=lin(0,6.28,25)" --json'),
    lines={"Equilibrium": equilibrium_lines},
)
