"""Write a page that plays a motion, or a film."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.base.errors import InputError
from symgen.base.settings import Settings, command_flag, differs_from_default, setting_names
from symgen.cli import FAILURE, INTERRUPTED, OK, write_complaint, write_json
from symgen.cli._shared_options import examples_in_help, json_option, setting_options

if TYPE_CHECKING:
    from symgen.result.player.recording import Recording
    from symgen.result.result import Result


#: Settings that count for mode shapes.
_OF_MODES = ("parameters", "inputs", "start", "coordinates")


@click.command(
    "view",
    epilog=examples_in_help(
        "symgen view four-bar -o four-bar.html",
        "symgen run four-bar --save a.nc && symgen view a.nc -o a.html",
        "symgen view pendulum --until 3 -o pendulum.gif",
        "symgen view four-bar --mode 1 -o mode.html",
    ),
)
@click.argument("what", metavar="MODEL|RESULT.nc")
@click.option(
    "-o", "--output", metavar="FILE", help="The page, .html, or a film: .gif, .mp4 with ffmpeg.  [MODEL.html]"
)
@click.option(
    "--beside", metavar="RESULT.nc", help="Another motion of the same mechanism, drawn faintly in the background."
)
@click.option(
    "--model", "described", metavar="MODEL", help="The mechanism of RESULT.nc, if it is not in the catalogue."
)
@click.option("--live/--no-live", default=None, show_default="live", help="Put the equations into the page.")
@click.option("--mode", type=int, metavar="N", help="Play mode shape N instead of a run.")
@click.option(
    "--at",
    default="equilibrium",
    show_default=True,
    metavar="PLACE",
    help="With --mode: the state it is about: equilibrium, start, or a time of a run [s].",
)
@setting_options(
    *("method", "integrator", "step", "rtol", "atol", "until", "output_step", "parameters", "inputs", "start"),
    *("options", "coordinates"),
)
@json_option
def command(
    what: str,
    output: str | None,
    beside: str | None,
    described: str | None,
    live: bool | None,
    mode: int | None,
    at: str,
    as_json: bool,
    **values: Any,
) -> int:
    """Write a page or film of a motion of MODEL, of one of its modes, or of a saved result.

    The page is one file that works offline: play, scrub, loop, traces of points, forces, plots with a cursor. Unless
    the equations are too large, the page contains them, and sliders of parameters change the motion.
    """
    stored, film = what.lower().endswith(".nc"), output is not None and Path(output).suffix.lower() in (".gif", ".mp4")
    model_text = f"the model '{what}'"
    for refused, option, expected, got in (
        (described is not None and not stored, "--model", "a saved result to be viewed", model_text),
        (beside is not None and not stored, "--beside", "two saved results", model_text),
        (beside is not None and film, "--beside", "a page, .html", f"'{output}'"),
        (mode is not None and stored, "--mode", "a model, about whose equilibrium modes are", f"the result '{what}'"),
        (mode is None and at != "equilibrium", "--at", "a mode shape, asked for with --mode", "no --mode"),
        (live and film, "--live", "a page of a run, which alone has equations in it", f"'{output}'"),
        (live and mode is not None, "--live", "a page of a run, which alone has equations in it", "--mode as well"),
    ):
        if refused:
            raise InputError(option, expected, got)
    settings = Settings(**values)
    if stored or mode is not None:
        _refuse_idle_settings(settings, () if stored else _OF_MODES, "a saved result" if stored else "a mode shape")

    from symgen.api import load
    from symgen.base.files import check_path
    from symgen.result.player.motion_page import PAGES, Page
    from symgen.result.player.moving import check_film, write_film
    from symgen.result.viewed import mechanism_name, playable_motion, recorded_file, view_file

    model = load(described or mechanism_name("view", Path(what)) if stored else what)
    file = Path(output or f"{model.name}.html")
    file = check_film("--output", file) if film else check_path("--output", file, PAGES, "plot")
    result: Result | None = None
    shown: Page | Recording
    if mode is not None:
        from symgen.analyses.linear.animation import mode_page, mode_recording

        shape = (model.mechanism, model.modes(settings, at=at), mode, settings.parameters)
        shown = mode_recording(*shape) if film else mode_page(*shape)
    elif stored:
        source, behind = Path(what), None if beside is None else Path(beside)
        if film:
            shown = recorded_file("view", source, model.mechanism)
        else:
            shown = view_file("view", source, model.mechanism, behind, live is not False)
    else:
        from symgen.cli._progress import Bar

        with Bar(f"{model.name}, {settings.method}", settings.until or model.mechanism.defaults.until) as bar:
            result = model.simulate(settings, progress=bar)
        if not len(result.t):
            return write_complaint(f"failed: {result.reason}", FAILURE)
        shown = playable_motion(result) if film else result.view(live=live is not False and _live_method(settings))
    if isinstance(shown, Page):
        shown.save(file)
    else:
        write_film(file, shown)
    if as_json:
        facts = {"live": isinstance(shown, Page) and shown.live, "status": "ok" if result is None else result.status}
        write_json({"file": str(file), **facts, "bytes": file.stat().st_size})
    else:
        click.echo(f"written: {file}")
    if result is not None and result.interrupted:
        return write_complaint("interrupted; the page shows what was kept", INTERRUPTED)
    return (
        write_complaint(f"failed: {result.reason}", FAILURE) if result is not None and result.status == "failed" else OK
    )


def _live_method(settings: Settings) -> bool | str:
    """Return the live method of a page: the one that was named, whose gains have sliders, if pages can run it."""
    from symgen.derive.methods import METHODS
    from symgen.result.live_run import is_live
    from symgen.run.planning.automatic import AUTO

    if not differs_from_default(settings, "method") or settings.method == AUTO:
        return True
    return settings.method if is_live(METHODS.resolve_alias(settings.method, "--method")) else True


def _refuse_idle_settings(settings: Settings, allowed: Collection[str], what: str) -> None:
    """Refuse settings that have no effect without a run."""
    for name in setting_names():
        if name not in allowed and differs_from_default(settings, name):
            raise InputError(command_flag(name), f"settings of {what}", "one of a run")
