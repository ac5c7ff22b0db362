"""A module for browsers and Node, as pages have it: start, rates and steps."""

from __future__ import annotations

from symgen.base.errors import InputError
from symgen.base.escapes import script_json
from symgen.result.player.live import live_part
from symgen.result.player.motion_page import model_script
from symgen.result.targets._target import Request, Target
from symgen.run.planning.package import Package, write_folder
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare

_MODULE = """\
// {name} by the method {method}. Written by symgen; the same mechanism gives the same bytes.
// model.start() returns the state y at t = 0, model.rates(t, y) its rates, model.step(t, y, h) advances y.
{script}
const absent = {{ confirm: null, bodies: null, find_lock: null }};
export const model = makeLive({spec}, Object.assign(absent, emitted));
"""


def _write(request: Request) -> Package:
    mechanism = request.mechanism
    run = prepare(mechanism, request.settings("javascript"), Purpose.STATE)
    live, reason = live_part(run.mechanism, run.compiled, run.start, mechanism.defaults.step, run=run)
    if live is None:
        raise InputError("--target javascript", "a mechanism that a page can work out", f"{mechanism.name}: {reason}")
    words = {"name": mechanism.name, "method": run.compiled.law.method}
    text = _MODULE.format(script=model_script(live), spec=script_json(live.spec), **words)
    files = write_folder(request.path, {f"{mechanism.name}.mjs": text})
    return Package(request.path, files, run.compiled.derive_seconds, run.compiled.emit_seconds)


KIND = Target(_write, bounded=True)
