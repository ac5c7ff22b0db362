"""Find the linear system about a state."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Unpack

from symgen.analyses.kinds import PLACE, Analysis, AnalysisOutput, AnalysisTable, Option, settings_about_place
from symgen.base.digits import format_rows
from symgen.base.keywords import PlaceKeywords
from symgen.base.settings import Settings

if TYPE_CHECKING:
    from symgen.analyses.linear.linear_system import LinearSystem
    from symgen.analyses.model_methods import Analysed


def linearise(
    model: Analysed,
    settings: Settings | None = None,
    *,
    at: str | float | Mapping[str, float] = "equilibrium",
    states: Sequence[str] = (),
    cyclic: Sequence[str] = (),
    instantaneous: bool = False,
    by: Sequence[str] = (),
    **changes: Unpack[PlaceKeywords],
) -> LinearSystem:
    """Return the linear system x' = A x + B u, y = C x + D u about a state of rest or of steady motion.

    Parameters
    ----------
    settings, at
        As for `modes`.
    states : sequence of str
        Quantities that are the states: coordinates of bodies and joints, velocities, outputs of the file, and
        ``NAME.rate`` of any of these; rates of coordinates are added. Found by default.
    cyclic : sequence of str
        With ``at="steady"``, the coordinates of joints that turn on; found by default.
    instantaneous : bool
        Whether a motion that is not steady has the system of the instant.
    by : sequence of str
        Parameters that are inputs as well: constants, changed once and for all while the states stay.
    **changes
        Other settings are refused; those from ``options`` on count where `at` is a time of a run.

    Raises
    ------
    InputError
        If the motion is not steady, or a name means nothing.
    AnalysisError
        If no equilibrium is found.
    """
    from symgen.analyses.linear.named_places import NamedPlace, system_at

    place = NamedPlace(
        model.mechanism, settings_about_place("linearise", settings, changes, at), at, model.simulate, cyclic
    )
    return system_at(place, states, instantaneous, by)


def command(load: Callable[[], Analysed], settings: Settings, **further: Any) -> AnalysisOutput:
    """Find the linear system of MODEL about a state of rest or of steady motion.

    Inputs are those of the file, outputs its formulas. A motion in which states change is refused. With --by, columns
    of B and D are derivatives by parameters as well, the states held.
    """
    model = load()
    system = linearise(model, settings, **further)
    return AnalysisOutput({"mechanism": model.mechanism.name, **system.to_dict()}, system_lines(system), system.notes)


def system_lines(system: LinearSystem) -> Iterator[str | AnalysisTable]:
    """Yield the lines of a linear system."""
    if not system.states:
        yield "no degree of freedom is left: there is nothing to linearise"
    matrices = (
        ("x' = A x", system.states, system.states, system.A),
        ("+ B u", system.states, system.inputs, system.B),
        ("y = C x", system.outputs, system.states, system.C),
        ("+ D u", system.outputs, system.inputs, system.D),
    )
    for title, rows, columns, values in matrices:
        if values.size:
            cells = [(name, *row) for name, row in zip(rows, format_rows(values.tolist()), strict=True)]
            yield AnalysisTable((title, *columns), cells, left=(title,))
    if system.left_out:
        yield f"outputs left out, as they depend on more than the states: {', '.join(system.left_out)}"


KIND = Analysis(
    methods=(linearise,),
    command=command,
    options=(
        *PLACE,
        Option("--instantaneous", "Give the system at an instant of a motion that is not steady.", "switch"),
        Option("--by", "Parameters that are inputs as well: constants, changed once.", "words", "NAME,NAME"),
    ),
    examples=("symgen linearise pendulum", "symgen linearise bicycle --at start --states lean,steer --json"),
    lines={"LinearSystem": system_lines},
)
