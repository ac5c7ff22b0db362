"""Translate a robot's file into a mechanism file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import click

from symgen.base.errors import plural
from symgen.cli import OK, write_json
from symgen.cli._shared_options import examples_in_help, json_option


@click.command(
    "import",
    epilog=examples_in_help("symgen import arm.urdf", "symgen import quadruped.xml --floating -o quadruped.toml"),
)
@click.argument("file")
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    help="File to write; NAME.toml by default, with --json none; - for standard output.",
)
@click.option("--floating", is_flag=True, help="Leave the base free where the file does not fix it to the ground.")
@click.option("--stops", is_flag=True, help="Write limits of joints as stops without restitution.")
@click.option(
    "--contacts", type=click.Choice(["ground"]), help="Let spheres, capsules, boxes and wheels touch the ground."
)
@json_option
def command(file: str, output: str | None, floating: bool, stops: bool, contacts: str | None, as_json: bool) -> int:
    """Write FILE, a robot in URDF, MJCF or SDF, as a mechanism file. Never overwrites a file.

    What the mechanism file leaves out is listed on the screen and in it: as `remarks`, which all results repeat, where
    the motion may depend on it, else as comments.
    """
    from symgen.base.errors import InputError, quote
    from symgen.base.files import check_writable, write_whole
    from symgen.describe.files.builder import to_toml
    from symgen.describe.files.validate import validate
    from symgen.describe.formats import FORMATS, LeftOut, format_of, read_robot
    from symgen.describe.parts.mesh_files import with_mesh_folder

    if as_json and output == "-":
        raise InputError("--json", "a file to write (-o FILE), or none", "-o -", "standard output takes one of both")
    path = Path(file)
    name = format_of(path)
    if name is None:
        ends = ", ".join(sorted({end for _, kind in FORMATS.items() for end in kind.SUFFIXES}))
        raise InputError("FILE", f"a file of another program ({ends})", quote(file))
    read = read_robot(path, name, floating=floating, stops=stops, contacts=contacts is not None)
    target = Path(f"{read.raw['mechanism']['name']}.toml" if output in (None, "-") else str(output))
    raw, lost = with_mesh_folder(read.raw, read.folder, target.parent)
    if lost:
        why = f"their files are not in the folder of {'the output' if output == '-' else target.name}"
        read = replace(read, left_out=(*read.left_out, LeftOut("meshes", f"{lost} in pictures", why, False)))
    mechanism = validate(raw, path.name)
    comments = [f"left out: {item}" for item in read.left_out if not item.moves]
    lines = [*mechanism.remarks, *comments]
    if output == "-":
        click.echo("".join(f"# {line}\n" for line in comments) + to_toml(raw), nl=False)
        return OK
    if output is not None or not as_json:
        check_writable("-o", target)
        write_whole(target, "".join(f"# {line}\n" for line in comments) + to_toml(raw), replace=False)
    if as_json:
        left_out = [{"what": x.what, "where": x.where, "why": x.why, "moves": x.moves} for x in read.left_out]
        counts = {"bodies": len(mechanism.bodies), "joints": len(mechanism.joints), "inputs": len(mechanism.inputs)}
        write_json(
            {"file": None if output is None else str(target), "format": read.format, **counts, "left_out": left_out}
        )
        return OK
    click.echo(
        f"wrote {target}: {plural(len(mechanism.bodies), 'body', 'bodies')}, {plural(len(mechanism.joints), 'joint')}"
    )
    for line in lines:
        click.echo(line)
    return OK
