"""Make a page that plays a motion, or a film."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.cli import FAILURE, INTERRUPTED, OK, complain, write_json
from symgen.cli._options import examples, json_option, setting_options
from symgen.errors import InputError
from symgen.settings import Settings, flag, is_given, names

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.result.result import Result


#: Settings that count for mode shapes.
_OF_MODES = ("parameters", "inputs", "start", "coordinates")


@click.command(
    "view",
    epilog=examples(
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
@click.option("--beside", metavar="RESULT.nc", help="Another motion of the same mechanism, drawn faintly behind.")
@click.option(
    "--model", "described", metavar="MODEL", help="The mechanism of RESULT.nc, where it is none of the catalogue."
)
@click.option("--live/--no-live", default=None, show_default="live", help="Put the equations into the page.")
@click.option("--mode", type=int, metavar="N", help="Play the mode shape of that number instead of a run.")
@click.option(
    "--at",
    default="equilibrium",
    show_default=True,
    metavar="PLACE",
    help="With --mode: about what, equilibrium, start, or a time of a run [s].",
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
    **asked: Any,
) -> int:
    """Make a page or film of the motion of MODEL, which is run for that, of a mode of it, or of a saved result.

    The page is one file without anything from elsewhere: play, scrub, loop, traces of points, forces, plots with a
    cursor. Where the equations are not too large it holds them, so that sliders of parameters change the motion.
    """
    from symgen.api import load

    stored = Path(what) if what.lower().endswith(".nc") else None
    settings = Settings(**asked)
    if stored is not None:
        from symgen.result.viewed import mechanism_name

        model = load(described or mechanism_name("view", stored))
    elif described is not None:
        raise InputError("--model", "a saved result to be viewed", f"the model '{what}'")
    else:
        model = load(what)
    if beside is not None and stored is None:
        raise InputError("--beside", "two saved results", f"the model '{what}'")
    without = () if stored is not None else _OF_MODES if mode is not None else None
    if without is not None:
        _refuse(settings, without, "a saved result" if mode is None else "a mode shape")
    if mode is not None and stored is not None:
        raise InputError("--mode", "a model, about whose equilibrium modes are", f"the saved result '{what}'")
    if mode is None and at != "equilibrium":
        raise InputError("--at", "a mode shape, asked for with --mode", "no --mode")
    file = _checked(Path(f"{model.name}.html" if output is None else output))
    if live and (mode is not None or file.suffix.lower() != ".html"):
        expected = "a page of a run, which alone has equations in it"
        raise InputError("--live", expected, f"'{file}'" if mode is None else "--mode as well")
    if mode is not None:
        return _mode(model, settings, mode, at, file, as_json)
    if stored is not None:
        return _stored(stored, model, beside, live is not False, file, as_json)
    from symgen.cli._progress import Bar

    with Bar(f"{model.name}, {settings.method}", settings.until or model.mechanism.defaults.until) as bar:
        result = model.simulate(settings, progress=bar)
    if not len(result.t):
        return complain(f"failed: {result.reason}", FAILURE)
    if file.suffix.lower() != ".html":
        from symgen.player.moving import write_film
        from symgen.result.viewed import recorded

        write_film(file, recorded(result))
        return _told(file, False, as_json, result.status) or _code(result)
    made = result.view(live=live is not False)
    made.save(file)
    return _told(file, made.live, as_json, result.status) or _code(result)


def _refuse(settings: Settings, known: Collection[str], what: str) -> None:
    """Refuse settings that mean nothing where nothing is run by them."""
    for name in names():
        if name not in known and is_given(settings, name):
            raise InputError(flag(name), f"settings of {what}", "one of a run")


def _checked(file: Path) -> Path:
    """Return the file if it can be written: a film or a page."""
    from symgen.player.motion_page import check_page
    from symgen.player.moving import check_film, is_film

    if is_film(file):
        check_film("--output", file)
    else:
        check_page("--output", file)
    return file


def _mode(model: Model, settings: Settings, mode: int, at: str, file: Path, as_json: bool) -> int:
    """Write a page or film of a mode shape."""
    from symgen.analyses.animation import mode_page, mode_recording
    from symgen.player.moving import is_film, write_film

    of = (model.mechanism, model.modes(settings, at=at), mode, settings.parameters)
    if is_film(file):
        write_film(file, mode_recording(*of))
    else:
        mode_page(*of).save(file)
    return _told(file, False, as_json, "ok")


def _stored(stored: Path, model: Model, beside: str | None, live: bool, file: Path, as_json: bool) -> int:
    """Write a page or film of a saved result."""
    from symgen.player.moving import is_film, write_film
    from symgen.result.viewed import recorded_file, view_file

    if is_film(file):
        if beside is not None:
            raise InputError("--beside", "a page, .html", f"'{file}'")
        write_film(file, recorded_file("view", stored, model.mechanism))
        return _told(file, False, as_json, "ok")
    made = view_file("view", stored, model.mechanism, None if beside is None else Path(beside), live)
    made.save(file)
    return _told(file, made.live, as_json, "ok")


def _told(file: Path, live: bool, as_json: bool, status: str) -> int:
    if as_json:
        write_json({"file": str(file), "live": live, "status": status, "bytes": file.stat().st_size})
    else:
        click.echo(f"written: {file}")
    return OK


def _code(result: Result) -> int:
    if result.interrupted:
        return complain("interrupted; the page shows what was kept", INTERRUPTED)
    if result.status == "failed":
        return complain(f"failed: {result.reason}", FAILURE)
    return OK
