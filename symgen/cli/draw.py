"""Draw a mechanism."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.base.errors import InputError, SimulationError, quote
from symgen.cli import BAD_INPUT, OK, write_complaint, write_json
from symgen.cli._shared_options import examples_in_help, json_option, setting_options

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.describe.drawing import Drawing, View


@click.command(
    "draw",
    epilog=examples_in_help(
        "symgen draw four-bar -o four-bar.svg", "symgen draw crane.toml --at described --set length=2 -o crane.png"
    ),
)
@click.argument("model")
@click.option("-o", "--output", metavar="FILE", help="The picture: .svg, or with matplotlib .png or .pdf.  [MODEL.svg]")
@click.option(
    "--at", default="start", show_default=True, metavar="WHEN", help="start, described, or a time in seconds."
)
@click.option(
    "--view",
    "angles",
    metavar="TURN,TILT",
    show_default="34,24, or the view that hides least",
    help="In space: degrees about the vertical, and from above.",
)
@setting_options("parameters", "start")
@json_option
def command(
    model: str,
    output: str | None,
    at: str,
    angles: str | None,
    parameters: dict[str, float],
    start: dict[str, float],
    as_json: bool,
) -> int:
    """Draw MODEL: bodies from their points or shapes, joints and forces by their symbols.

    A mechanism that cannot be assembled is drawn in its last position, with open joints marked. The exit code is
    then 2.
    """
    from symgen.api import load
    from symgen.base.files import check_path
    from symgen.describe.drawing.drawing import PICTURES

    view = _view_of_angles(angles)
    loaded = load(model)
    if view is not None and loaded.mechanism.space == "planar":
        click.echo(f"symgen: --view counts for nothing: {loaded.name} is planar", err=True)
    file = check_path("--output", Path(output or f"{loaded.name}.svg"), PICTURES, "plot")
    drawing = _drawing_at(loaded, at, parameters, start, view)
    drawing.save(file)
    marked = [item.name for item in drawing.scene.items if item.role == "fault"]
    if as_json:
        write_json({"file": str(file), "at": at, "open": marked, "note": drawing.caption})
    else:
        click.echo(f"written: {file}")
    if marked or (drawing.caption and not drawing.ghosts):
        return write_complaint(drawing.caption, BAD_INPUT)
    if drawing.caption:
        return write_complaint(f"warning: {drawing.caption}", OK)
    return OK


def _drawing_at(
    model: Model, at: str, parameters: dict[str, float], start: dict[str, float], view: View | None
) -> Drawing:
    from symgen.result.result import FAILED

    if at in ("start", "described"):
        return model.draw(parameters, start, at=at, view=view)
    try:
        time = float(at)
    except ValueError:
        time = math.nan
    if not 0.0 <= time < math.inf:
        raise InputError("--at", "start, described or a time in seconds", quote(at))
    if time == 0.0:
        return model.draw(parameters, start, view=view)
    changes: dict[str, Any] = {"parameters": parameters, "start": start, "until": time, "times": (0.0, time)}
    result = model.simulate(**changes, step=min(model.mechanism.defaults.step, time), verify=False)
    if result.status == FAILED:
        raise SimulationError(f"the run to t = {time:g} s failed: {result.reason}")
    if result.end < time:
        expected = f"a time up to t = {result.end:.6g} s, where an event ends the run"
        raise InputError("--at", expected, quote(at))
    return model.draw(parameters, q=result.q.values[-1], view=view)


def _view_of_angles(angles: str | None) -> View | None:
    from symgen.describe.drawing import View

    if angles is None:
        return None
    try:
        turn, tilt = (math.radians(float(word)) for word in angles.split(","))
    except ValueError:
        raise InputError("--view", "two angles in degrees, such as 30,20", quote(angles)) from None
    if not (math.isfinite(turn) and math.isfinite(tilt)):
        raise InputError("--view", "two finite angles in degrees", quote(angles))
    return View(turn, tilt)
