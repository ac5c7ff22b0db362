"""``symgen view MODEL``: a page that plays a motion, one file that works offline."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symgen.cli import FAILURE, INTERRUPTED, OK, complain, write_json
from symgen.cli._options import examples, json_option, setting_options
from symgen.errors import InputError
from symgen.settings import Settings

if TYPE_CHECKING:
    from symgen.result.result import Result


@click.command(
    "view",
    epilog=examples(
        "symgen view four-bar -o four-bar.html",
        "symgen run four-bar --save a.nc && symgen view a.nc -o a.html",
        "symgen view pendulum --until 3 -o pendulum.gif",
    ),
    short_help="Make a page that plays a motion, or a GIF.",
)
@click.argument("what", metavar="MODEL|RESULT.nc")
@click.option("-o", "--output", metavar="FILE", help="The page: .html; or .gif, with matplotlib.  [MODEL.html]")
@click.option("--beside", metavar="RESULT.nc", help="Another motion of the same mechanism, drawn faintly behind.")
@click.option(
    "--model", "described", metavar="MODEL", help="The mechanism of RESULT.nc, where it is none of the catalogue."
)
@click.option("--live/--no-live", default=True, show_default=True, help="Put the equations into the page.")
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
    live: bool,
    as_json: bool,
    **asked: Any,
) -> int:
    """Make a page that plays the motion of MODEL, which is run for that, or of a saved result.

    The page is one file without anything from elsewhere: play, scrub, loop, traces of points, forces, plots with a
    cursor. Where the equations are not too large it holds them, so that sliders of parameters change the motion.
    """
    from symgen.api import load
    from symgen.player.page import check_page

    stored = Path(what) if what.endswith(".nc") else None
    settings = Settings(**asked)
    if stored is not None:
        from symgen.result.viewed import mechanism_name

        model = load(described or mechanism_name("view", stored))
    elif described is not None:
        raise InputError("--model", "a saved result to be viewed", f"the model '{what}'")
    else:
        model = load(what)
    file = Path(output or f"{model.name}.html")
    if file.suffix.lower() == ".gif":
        from symgen.player.moving import check_gif

        check_gif("--output", file)
    else:
        check_page("--output", file)
    if stored is not None:
        from symgen.result.viewed import view_file

        if file.suffix.lower() == ".gif":
            raise InputError("--output", "a page of a saved result, .html", f"'{file}'")
        made = view_file("view", stored, model.mechanism, None if beside is None else Path(beside), live)
        made.save(file)
        return _told(file, made.live, as_json, "ok")
    if beside is not None:
        raise InputError("--beside", "two saved results", f"the model '{what}'")
    from symgen.cli._progress import Bar

    with Bar(f"{model.name}, {settings.method}", settings.until or model.mechanism.defaults.until) as bar:
        result = model.simulate(settings, progress=bar)
    if not len(result.t):
        return complain(f"failed: {result.reason}", FAILURE)
    if file.suffix.lower() == ".gif":
        from symgen.player.moving import write_gif
        from symgen.result.viewed import recorded

        write_gif(file, recorded(result))
        return _told(file, False, as_json, result.status) or _code(result)
    made = result.view(live=live)
    made.save(file)
    return _told(file, made.live, as_json, result.status) or _code(result)


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
