"""Find frequencies, damping and shapes about a state."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from symgen.analyses.kinds import PLACE, Analysis, AnalysisOutput, AnalysisTable, Option, settings_about_place
from symgen.base import arguments
from symgen.base.digits import digits, format_complex
from symgen.base.errors import InputError, fit_lines
from symgen.base.files import heading_with_unit
from symgen.base.keywords import PlaceKeywords
from symgen.base.settings import Settings

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from symgen.analyses.linear.eigenmodes import Modes
    from symgen.analyses.linear.locus import Locus
    from symgen.analyses.model_methods import Analysed
    from symgen.result.player.motion_page import Page

    Array = NDArray[np.float64]

#: Largest number of modes shown.
MOST = 40


def modes(
    model: Analysed,
    settings: Settings | None = None,
    *,
    at: str | float | Mapping[str, float] = "equilibrium",
    states: Sequence[str] = (),
    cyclic: Sequence[str] = (),
    count: int | None = None,
    **changes: Unpack[PlaceKeywords],
) -> Modes:
    """Return eigenvalues, frequencies, damping and shapes about a state of rest or of steady motion.

    Parameters
    ----------
    settings : Settings, optional
        As for `equilibrium`.
    at : {"equilibrium", "start", "steady"}, float or mapping
        Place: the equilibrium that the start leads to, the start itself, the steady motion that the start
        leads to, the state at a time of a run [s], or the equilibrium with values of coordinates by name, such
        as ``{"pole.theta": 0}``.
    states, cyclic
        As for `linearise`.
    count : int, optional
        Only that many of the lowest modes, without dampers, about the equilibrium near the start: by sparse
        matrices from looped code, for mechanisms of any size.
    **changes
        Other settings are refused; settings of a run count where `at` is a time.

    Raises
    ------
    InputError
        If the motion is neither at rest nor steady.
    AnalysisError
        If no equilibrium is found.
    """
    from symgen.analyses.linear.named_places import NamedPlace, modes_at

    place = NamedPlace(
        model.mechanism, settings_about_place("modes", settings, changes, at), at, model.simulate, cyclic
    )
    return modes_at(place, states, count)


def view_mode(
    model: Analysed,
    number: int,
    settings: Settings | None = None,
    *,
    at: str | float | Mapping[str, float] = "equilibrium",
    **changes: Unpack[PlaceKeywords],
) -> Page:
    """Return a page that plays a mode shape, with the state that it is about drawn faintly behind.

    Parameters
    ----------
    number : int
        Number of a shape of `modes`, from 1 on.
    settings : Settings, optional
        As for `modes`.
    at : {"equilibrium", "start"}, float or mapping
        As for `modes`; in a steady motion shapes are not motions of bodies.
    **changes
        Other settings are refused; settings of a run count where `at` is a time.

    Raises
    ------
    InputError
        If the mode does not exist.
    AnalysisError
        If no equilibrium is found.
    """
    from symgen.analyses.linear.animation import mode_page

    whole = settings_about_place("view_mode", settings, changes, at)
    number = arguments.whole_number("number", number, 1, 10**6)
    return mode_page(model.mechanism, modes(model, whole, at=at), number, whole.parameters)


def locus(
    model: Analysed,
    over: tuple[str, Sequence[float] | Array],
    settings: Settings | None = None,
    *,
    at: str | float | Mapping[str, float] = "equilibrium",
    states: Sequence[str] = (),
    cyclic: Sequence[str] = (),
    **changes: Unpack[PlaceKeywords],
) -> Locus:
    """Return how the eigenvalues move with a parameter.

    Parameters
    ----------
    over : (str, sequence of float)
        The parameter and its values.
    settings, at, states, cyclic
        As for `modes`.
    **changes
        Other settings are refused; settings of a run count where `at` is a time.
    """
    from symgen.analyses.linear.locus import eigenvalue_locus as locus_of
    from symgen.analyses.linear.named_places import NamedPlace

    place = NamedPlace(
        model.mechanism, settings_about_place("locus", settings, changes, at), at, model.simulate, cyclic
    )
    return locus_of(place, over, states)


def command(
    load: Callable[[], Analysed],
    settings: Settings,
    count: int | None,
    over: tuple[str, Array] | None,
    plot: Path | None,
    **place: Any,
) -> AnalysisOutput:
    """Find eigenvalues, frequencies, damping and shapes of MODEL about a state of rest or of steady motion."""
    if plot is not None and over is None:
        raise InputError("--plot", "a root locus, asked for with --over", "no --over")
    if count is not None and over is not None:
        raise InputError("--count", "all modes with --over", "both")
    model = load()
    name = model.mechanism.name
    if over is None:
        result = modes(model, settings, count=count, **place)
        return AnalysisOutput({"mechanism": name, **result.to_dict()}, mode_lines(result), result.notes)
    roots = locus(model, over, settings, **place)
    return AnalysisOutput({"mechanism": name, **roots.to_dict()}, locus_lines(roots), files={plot: roots.plot})


def mode_lines(result: Modes) -> Iterator[str | AnalysisTable]:
    """Yield the lines of modes."""
    first = fit_lines(len(result.of_shapes), MOST)
    freedom, many = result.degrees_of_freedom, len(result.eigenvalues)
    if not many:
        yield "no degree of freedom is left: there are no modes"
        return
    yield (
        f"{freedom} {'degree' if freedom == 1 else 'degrees'} of freedom; "
        f"{many} {'eigenvalue' if many == 1 else 'eigenvalues'}"
    )
    tables = {"moves": result.participation, "stiffness by": result.stiffening, "damping by": result.dissipation}
    tables = {heading: parts for heading, parts in tables.items() if parts}
    rows = [
        (
            *(str(k + 1), _complex_text(value), f"{result.frequencies[k]:.6g}", digits(result.damping[k], 1.0, 4)),
            *(_shares_in_words(parts, k) for parts in tables.values()),
        )
        for k, value in enumerate(result.of_shapes[:first])
    ]
    yield AnalysisTable(("mode", "eigenvalue [1/s]", "frequency [Hz]", "damping", *tables), rows, left=(*tables,))
    if len(result.of_shapes) > first:
        yield f"... and {len(result.of_shapes) - first} more; --json has all"
    if result.multiple:
        groups = "; ".join(f"modes {', '.join(map(str, group))}" for group in result.multiple)
        yield f"of one eigenvalue, so that each shape alone and its shares are not unique: {groups}"


def _shares_in_words(parts: Mapping[str, Any], k: int, most: int = 4) -> str:
    shares = sorted(((name, float(values[k])) for name, values in parts.items()), key=lambda pair: -abs(pair[1]))
    shown = [(name, share) for name, share in shares[:most] if abs(share) >= 5e-4]
    left = sum(share for _, share in shares) - sum(share for _, share in shown)
    text = ", ".join(f"{name} {share:.1%}" for name, share in shown)
    return text + (f", others {left:.1%}" if abs(left) >= 5e-4 else "")


def _complex_text(x: complex) -> str:
    real, imaginary = format_complex(x)
    return real + (f" +- {imaginary[1:]}i" if imaginary else "")


def locus_lines(result: Locus) -> Iterator[str | AnalysisTable]:
    """Yield the lines of a root locus."""
    headings = (
        heading_with_unit(result.name, result.own_unit.text),
        *(f"eigenvalue {k + 1} [1/s]" for k in range(result.branches.shape[1])),
    )
    rows = [
        (
            f"{result.as_written(value):g}",
            *("".join((real, imaginary, "i" * bool(imaginary))) for real, imaginary in map(format_complex, row)),
        )
        for value, row in zip(result.values, result.branches, strict=True)
    ]
    yield AnalysisTable(headings, rows)
    for crossing in result.crossings:
        becomes = "grows" if crossing.rising else "decays"
        value = f"{result.as_written(crossing.value):.9g} {result.own_unit.text}".strip()
        yield f"from {result.name} = {value} on {_complex_text(crossing.eigenvalue)} {becomes}"


KIND = Analysis(
    methods=(modes, view_mode, locus),
    command=command,
    options=(
        *PLACE,
        Option("--count", "Only that many of the lowest modes, by sparse matrices.", "whole", "N"),
        Option("--over", "A parameter over which eigenvalues are followed: a root locus.", "range", "NAME=lin(A,B,N)"),
        Option("--plot", "Draw the root locus into a .svg, .png or .pdf file.", "plot", "FILE"),
    ),
    examples=("symgen modes four-bar", "symgen modes four-bar --start crank.theta=4"),
    lines={"Modes": mode_lines, "Locus": locus_lines},
)
