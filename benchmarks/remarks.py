"""What every consumer says of a model: each remark in each command and target, as ``docs/tables/remarks.md``.

python -m benchmarks.remarks [REMARK ...]

computes the cells, of some remarks or of all, writes them to ``benchmarks/records/remarks.json`` and prints the page
from there. A cell is ``says it``; ``says that it does not judge``, of limits that only states of symgen are judged by;
the sentence that refuses the model; or ``silent``.
"""

from __future__ import annotations

import contextlib
import io
import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

import symgen
import symgen.gym
from benchmarks.finite_elements import solid
from benchmarks.meeting import MODAL_BAR, cart
from symgen.base.errors import InputError, SymgenError
from symgen.cli import main
from symgen.result.part_limits import UNJUDGED

ROOT = Path(__file__).resolve().parents[1]
RECORD, PAGE = ROOT / "benchmarks" / "records" / "remarks.json", ROOT / "docs" / "tables" / "remarks.md"
SAYS, UNJUDGING, SILENT = "says it", "says that it does not judge", "silent"

#: An arm of MJCF, which has contacts that an import leaves out.
_ARM = """<mujoco model="arm"><option gravity="0 0 -9.81"/><worldbody><geom type="plane" size="1 1 0.1"/>
<body name="arm" pos="0 0 1"><joint name="hinge" axis="0 1 0" damping="0.1"/>
<geom type="capsule" size="0.02" fromto="0 0 0 0.3 0 0" mass="0.8"/></body></worldbody>
<actuator><motor name="push" joint="hinge"/></actuator></mujoco>"""
_INPUT = "[inputs]\npush = { default = 0.0 }\n"
_PUSHED = "-k*cart.x - cart.vx + push"
_STRIP = """[beams.strip]
start = [0.1, 0.0]
end = [0.5, 0.0]
elements = 2
axial = 8e4
bending = 0.3
mass = 0.314
rotary = 1e-4
damping = 1e-2
clamp = "cart"
[forces.bend]
type = "force"
body = "strip"
at = "end"
force = [0.0, -12.0]
"""
_BAR = f"""{MODAL_BAR}[forces.bend]
type = "force"
body = "bar.tip"
at = [0.0, 0.0]
force = [0.0, -40.0]
"""
_AUTHOR = "the friction of the seal was not measured"

#: Remark -> the file, the name of its text, and a part of the sentence.
REMARKS: Mapping[str, tuple[str, str, str]] = {
    "an import left contacts out": (_ARM, "arm.xml", "the motion may depend on it: contacts"),
    "`remarks` of a file": (
        cart(more=_INPUT, force=_PUSHED).replace("[run]", f'remarks = ["{_AUTHOR}"]\n[run]'),
        "cart.toml",
        _AUTHOR,
    ),
    "a joint at the centre of a body whose frame has its origin elsewhere": (
        cart(more=_INPUT, force=_PUSHED).replace("mass = 2.0\n", "mass = 2.0\ncentre_of_mass = [0.01, 0.0]\n"),
        "cart.toml",
        "is the centre of mass of cart",
    ),
    "an angle of many turns": (
        cart(more=_INPUT, force=_PUSHED).replace('angle = "0.4 - pi/2"', "angle = 11.3955742876"),
        "cart.toml",
        "bodies.pole.angle: 11.3956 rad are 1.81 turns",
    ),
    "a beam that is bent too far": (cart(more=_INPUT + _STRIP, force=_PUSHED), "cart.toml", "beam element strip.e"),
    "a modal body beyond its modes": (cart(more=_INPUT + _BAR, force=_PUSHED), "cart.toml", "the most: linear modes"),
}

#: Asks something of a model, and returns all that is said of it.
Consumer = Callable[[Path, Path], str]


def _command(*words: str) -> Consumer:
    """Return what a command prints on both outputs."""

    def call(file: Path, folder: Path) -> str:
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main([word.format(file=file, folder=folder) for word in words])
        if code == 2:
            raise InputError(words[0], "a model that it takes", err.getvalue().strip().splitlines()[-1])
        return " ".join((out.getvalue() + err.getvalue()).split())

    return call


def _joined(sentences: object) -> str:
    return "; ".join(map(str, sentences)) if isinstance(sentences, list | tuple) else str(sentences)


def _of_result(result: symgen.Result) -> str:
    return _joined([*result.notes, *result.warnings, result.reason or ""])


def _loaded(file: Path, folder: Path) -> str:
    return _joined(symgen.load(file).remarks)


def _simulated(file: Path, folder: Path) -> str:
    return _of_result(symgen.load(file).simulate())


def _stepped(file: Path, folder: Path) -> str:
    run = symgen.load(file).start()
    for _ in range(8):
        run.step(0.05)
    return _joined(run.notes) + _of_result(run.result())


def _swept(file: Path, folder: Path) -> str:
    rows = symgen.sweep(symgen.load(file), vary={"push": [0.0, 0.1]}, jobs=1)
    return _joined([*rows.ensemble.notes, *(s for w in rows.warnings for s in w), *rows.reason])


def _analysed(name: str, **settings: object) -> Consumer:
    return lambda file, folder: _joined(getattr(symgen.load(file), name)(**settings).notes)


def _inverse(file: Path, folder: Path) -> str:
    model = symgen.load(file)
    return _joined(model.inverse(model.simulate(output_step=0.05), actuators=["push"]).notes)


def _gradient(file: Path, folder: Path) -> str:
    name = "hinge.angle" if file.suffix == ".xml" else "cart.x"
    return _of_result(symgen.load(file).gradient(name, by=("push",)).result)


def _identified(file: Path, folder: Path) -> str:
    model = symgen.load(file)
    name = "hinge.angle" if file.suffix == ".xml" else "cart.x"
    result = model.simulate(output_step=0.05, inputs={"push": 0.5})
    return _joined(model.identify({"t": result.t, name: result[name]}, free=["push"]).notes)


def _reported(file: Path, folder: Path) -> str:
    _command("report", "{file}", "-o", "{folder}/report.md")(file, folder)
    return " ".join((folder / "report.md").read_text(encoding="utf-8").replace("\\", "").split())


def _viewed(file: Path, folder: Path) -> str:
    _command("view", "{file}", "-o", "{folder}/page.html")(file, folder)
    return (folder / "page.html").read_text(encoding="utf-8").replace('\\"', '"')


def _header(file: Path, folder: Path) -> str:
    _command("generate", "{file}", "--target", "c", "-o", "{folder}/c")(file, folder)
    return " ".join(next((folder / "c").glob("[!m]*.h"), next((folder / "c").glob("*.h"))).read_text().split())


def _called(file: Path, folder: Path) -> str:
    """Return what the program of the target C prints of the remarks that it calls for."""
    _header(file, folder)
    sources = [str(x) for x in (folder / "c").glob("*.c")]
    subprocess.run(["cc", "-O0", *sources, "-lm", "-o", str(folder / "sim")], check=True, capture_output=True)
    done = subprocess.run([str(folder / "sim"), "0.001"], capture_output=True, text=True, check=False)
    return done.stderr


def _logged(file: Path, folder: Path) -> str:
    from fmpy import simulate_fmu

    _command("generate", "{file}", "--target", "fmu", "-o", "{folder}/own.fmu")(file, folder)
    log = list[str]()
    simulate_fmu(
        str(folder / "own.fmu"),
        stop_time=0.001,
        logger=lambda *words: log.append(words[-1].decode()),
        debug_logging=True,
    )
    return _joined(log)


def _reset(file: Path, folder: Path) -> str:
    observe = "hinge.angle" if file.suffix == ".xml" else "cart.x"
    environment = symgen.gym.make(symgen.load(file), [observe], ["push"], "0")
    return _joined(environment.reset()[1].get("remarks", ()))


#: Consumers of a model, in the order of the page.
CONSUMERS: Mapping[str, Consumer] = {
    "`symgen.load`": _loaded,
    "`check`": _command("check", "{file}"),
    "`run`": _command("run", "{file}"),
    "`run --json`": _command("run", "{file}", "--json"),
    "`simulate`": _simulated,
    "steps": _stepped,
    "`sweep`": _command("sweep", "{file}", "--vary", "push=lin(0,0.1,2)", "--jobs", "1"),
    "rows": _swept,
    "`compare`": _command(
        "compare", "{file}", "--methods", "direct-correction", "--integrators", "dop853", "--rtols", "1e-6", "--json"
    ),
    "`report`": _reported,
    "gradient": _gradient,
    "`identify`": _identified,
    "`equilibrium`": _analysed("equilibrium"),
    "`modes`": _analysed("modes"),
    "`linearise`": _analysed("linearise"),
    "`inverse`": _inverse,
    "page": _viewed,
    "C, header": _header,
    "C, call": _called,
    "FMU, log": _logged,
    "Gymnasium": _reset,
}
#: Of a description, which knows no state: what is judged at states is none of their business.
OF_DESCRIPTIONS = ("`symgen.load`", "`check`")
JUDGED = ("a beam that is bent too far", "a modal body beyond its modes")

Table = dict[str, dict[str, str]]


def cell(remark: str, consumer: str) -> str:
    """Return what a consumer says of a remark."""
    text, name, part = REMARKS[remark]
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        (file := folder / name).write_text(text, encoding="utf-8")
        if "bar.npz" in text:
            bar = solid((0.4, 0.02), (4, 1), young=1e8, thick=0.02)
            symgen.reduced(bar.x, bar.mass, bar.stiffness, bar.ends).save(folder / "bar.npz")
        try:
            said = CONSUMERS[consumer](file, folder)
        except SymgenError as error:
            return str(error).replace(f"{place}/", "")
    if part in said:
        return SAYS
    return UNJUDGING if UNJUDGED in said else SILENT


def stored() -> Table:
    """Return the cells as they are stored."""
    table: Table = json.loads(RECORD.read_text(encoding="utf-8"))
    return table


def asked(remark: str) -> list[str]:
    """Return the consumers of a remark."""
    return [name for name in CONSUMERS if not (remark in JUDGED and name in OF_DESCRIPTIONS)]


def page(table: Table) -> str:
    """Return the text of the page."""
    others = list(
        dict.fromkeys(x for row in table.values() for x in row.values() if x not in (SAYS, UNJUDGING, SILENT))
    )
    marks = {SAYS: "+", UNJUDGING: "not judged", SILENT: "**silent**"} | {x: str(i) for i, x in enumerate(others, 1)}
    lines = [
        "# Who says what is known",
        "",
        "Written by `python -m benchmarks.remarks`. Each column is a model with something that a reader of its results",
        "has to know, each row what is asked of it: `+` where it says so, `not judged` where it says that limits of",
        "parts are judged elsewhere, else the number of the sentence that refuses the model.",
        "",
        f"| | {' | '.join(REMARKS)} |",
        "| --- |" + " --- |" * len(REMARKS),
    ]
    for name in CONSUMERS:
        lines.append(f"| {name} | {' | '.join(marks.get(table[r].get(name, ''), '') for r in REMARKS)} |")
    lines += ["", *(f"{i}. `{x.replace('`', chr(39))}`" for i, x in enumerate(others, 1))] if others else []
    return "\n".join([*lines, ""])


def record(remarks: list[str]) -> None:
    """Compute the cells of some remarks, and write record and page."""
    table = stored() if RECORD.exists() else {}
    for remark in remarks:
        table[remark] = {}
        for consumer in asked(remark):
            table[remark][consumer] = cell(remark, consumer)
            print(f"{remark}, {consumer}: {table[remark][consumer]}", file=sys.stderr, flush=True)
        whole = {each: table[each] for each in REMARKS if each in table}
        RECORD.write_text(json.dumps(whole, indent=1) + "\n", encoding="utf-8")
    if len(whole) == len(REMARKS):
        PAGE.write_text(page(whole), encoding="utf-8")


if __name__ == "__main__":
    if shutil.which("cc") is None:
        raise SystemExit("expected a C compiler, for the columns of C and FMUs")
    record(sys.argv[1:] or list(REMARKS))
