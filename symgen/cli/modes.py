"""``symgen modes MODEL``: eigenvalues, frequencies, damping, and who takes part."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from symgen.cli import OK, write_files, write_json
from symgen.cli._analyses import axis, place_options
from symgen.cli._options import examples, json_option, output_file, tell
from symgen.errors import InputError
from symgen.settings import Settings

if TYPE_CHECKING:
    from symgen.analyses.locus import Locus
    from symgen.analyses.modes import Modes


@click.command(
    "modes",
    short_help="Find frequencies, damping and shapes about a state.",
    epilog=examples("symgen modes four-bar", "symgen modes four-bar --start crank.theta=4"),
)
@click.argument("model")
@place_options
@click.option("--count", type=int, metavar="N", help="Only that many of the lowest modes, by sparse matrices.")
@click.option(
    "--over", metavar="NAME=lin(A,B,N)", help="A parameter over which eigenvalues are followed: a root locus."
)
@click.option("--plot", metavar="FILE", help="Draw the root locus into a .svg, .png or .pdf file.")
@json_option
def command(
    model: str,
    place: dict[str, Any],
    count: int | None,
    over: str | None,
    plot: str | None,
    as_json: bool,
    **asked: Any,
) -> int:
    """Find eigenvalues, frequencies, damping and shapes of MODEL about a state of rest or of steady motion."""
    from symgen.api import load

    settings = Settings(**asked)
    if plot is not None and over is None:
        raise InputError("--plot", "a root locus, asked for with --over", "no --over")
    if count is not None and over is not None:
        raise InputError("--count", "all modes with --over", "both")
    path = output_file("--plot", plot, "plot")
    loaded = load(model)
    if over is None:
        found = loaded.modes(settings, count=count, **place)
        tell(found.notes)
        if as_json:
            write_json({"mechanism": loaded.name, **found.to_dict()})
        else:
            _show(found)
        return OK
    locus = loaded.locus(axis("--over", over), settings, **place)
    if as_json:
        write_json({"mechanism": loaded.name, **locus.to_dict()})
    else:
        _show_locus(locus)
    return write_files(OK, {path: locus.plot}, None if as_json else lambda file: click.echo(f"written: {file}"))


def _show(found: Modes, most: int = 40) -> None:
    from rich.table import Table

    from symgen.cli._tables import console
    from symgen.report.words import counted

    freedom, many = found.degrees_of_freedom, len(found.eigenvalues)
    click.echo(f"{counted(freedom, 'degree')} of freedom; {counted(many, 'eigenvalue')}")
    table = Table(box=None, header_style="dim", pad_edge=False)
    tables = {"moves": found.participation, "stiffness by": found.stiffening, "damping by": found.dissipation}
    tables = {heading: parts for heading, parts in tables.items() if parts}
    for heading in ("mode", "eigenvalue [1/s]", "frequency [Hz]", "damping", *tables):
        table.add_column(heading, justify="left" if heading in tables else "right")
    for k, value in enumerate(found.of_shapes[:most]):
        shares = [_shares(parts, k) for parts in tables.values()]
        table.add_row(str(k + 1), _complex(value), f"{found.frequencies[k]:.6g}", f"{found.damping[k]:.4g}", *shares)
    console().print(table)
    if len(found.of_shapes) > most:
        click.echo(f"... and {len(found.of_shapes) - most} more; --json has all")


def _shares(parts: Any, k: int, most: int = 4) -> str:
    shares = sorted(((name, float(values[k])) for name, values in parts.items()), key=lambda pair: -abs(pair[1]))
    shown = [(name, share) for name, share in shares[:most] if abs(share) >= 5e-4]
    left = sum(share for _, share in shares) - sum(share for _, share in shown)
    text = ", ".join(f"{name} {share:.1%}" for name, share in shown)
    return text + (f", others {left:.1%}" if abs(left) >= 5e-4 else "")


def _complex(x: complex) -> str:
    return f"{x.real:.6g}" + (f" +- {abs(x.imag):.6g}i" if x.imag else "")


def _show_locus(found: Locus) -> None:
    from rich.table import Table

    from symgen.cli._tables import console

    table = Table(box=None, header_style="dim", pad_edge=False)
    table.add_column(found.name, justify="right")
    for k in range(found.branches.shape[1]):
        table.add_column(f"eigenvalue {k + 1} [1/s]", justify="right")
    for value, row in zip(found.values, found.branches, strict=True):
        table.add_row(f"{value:g}", *(f"{x.real:.5g}{x.imag:+.5g}i" if x.imag else f"{x.real:.5g}" for x in row))
    console().print(table)
    for crossing in found.crossings:
        becomes = "grows" if crossing.rising else "decays"
        click.echo(f"from {found.name} = {crossing.value:.9g} on {_complex(crossing.eigenvalue)} {becomes}")
