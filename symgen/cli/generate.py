"""Write the emitted code of a mechanism."""

from __future__ import annotations

import click

from symgen.base.errors import InputError
from symgen.base.registry import Registry
from symgen.cli import OK, write_json
from symgen.cli._shared_options import examples_in_help, json_option, setting_options, write_note

#: By name alone: files of targets are imported when one is chosen.
_TARGETS: Registry[object] = Registry("symgen.result.targets", "target")
_LISTED = [f"  {name:<12}{_TARGETS.summary(name)}" for name in _TARGETS.names]


@click.command(
    "generate",
    epilog="\n".join(["\b", "Targets, and what their code needs:", *_LISTED, "", ""])
    + examples_in_help(
        "symgen generate four-bar --output code", "symgen generate four-bar --target c --output four-bar"
    ),
)
@click.argument("model")
@click.option(
    "--method", "methods", multiple=True, help="Method to emit; may be repeated. [default: direct-correction]"
)
@click.option("--all", "every", is_flag=True, help="Emit all methods that suit the mechanism.")
@setting_options("options", "coordinates", text={"options": "Such as direct-correction.weight=mass."})
@setting_options(
    *("integrator", "rtol", "atol"),
    text={
        "integrator": "Of C and FMUs: print a whole run by this scheme, such as dop853, with its error control.",
        "rtol": "Relative tolerance of its adaptive steps.",
        "atol": "Absolute tolerance of its adaptive steps.",
    },
    otherwise={"integrator": "(steps of the classical scheme)"},
)
@click.option(
    "--shape",
    type=click.Choice(["straight", "looped"]),
    default="straight",
    show_default=True,
    help="Code for this mechanism alone, or loops over tables that all mechanisms share.",
)
@click.option(
    "--target",
    type=click.Choice(_TARGETS.names),
    default="cpu",
    show_default=True,
    help="What the code is for: see the list below.",
)
@click.option("--fmi", type=click.Choice(["2", "3"]), default="2", show_default=True, help="Version of an FMU.")
@click.option(
    "--derivatives",
    is_flag=True,
    help="Of c-functions: write derivatives as well, and those of a step. Of an FMU: directional derivatives.",
)
@click.option("-o", "--output", metavar="PATH", help="Folder, or FMU, to write; the mechanism's name by default.")
@json_option
def command(
    model: str,
    methods: tuple[str, ...],
    every: bool,
    options: dict[str, str],
    coordinates: str,
    integrator: str | None,
    rtol: float | None,
    atol: float | None,
    shape: str,
    target: str,
    fmi: str,
    derivatives: bool,
    output: str | None,
    as_json: bool,
) -> int:
    """Write the emitted modules of MODEL into a folder, and list the files.

    The folder has model.py and a module for each method, which need only math, numpy and numba. The same mechanism
    always gives the same bytes. With straight code for processors, simulate.py starts where model.json says.
    """
    from symgen.api import load

    if every and methods:
        raise InputError("--all", "no --method with it", ", ".join(methods))
    mechanism = load(model)
    selection = None if every else methods or "direct-correction"
    package = mechanism.generate(
        output,
        selection,
        options,
        coordinates=coordinates,
        shape=shape,
        target=target,
        fmi=int(fmi),
        integrator=integrator,
        rtol=rtol,
        atol=atol,
        derivatives=derivatives,
    )
    if as_json:
        files = [{"path": str(path), "bytes": path.stat().st_size} for path in package.files]
        seconds = {"derive": package.derive_seconds, "emit": package.emit_seconds}
        write_json(
            {
                "mechanism": mechanism.name,
                "folder": str(package.folder),
                "files": files,
                "seconds": seconds,
                "notes": package.notes,
            }
        )
        return OK
    for path in package.files:
        click.echo(f"{path}  {path.stat().st_size} bytes")
    write_note(package.notes)
    return OK
