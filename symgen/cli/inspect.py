"""Show the equations of a mechanism, and what was left out."""

from __future__ import annotations

from pathlib import Path

import click

from symgen.base.errors import InputError
from symgen.cli import OK, write_json
from symgen.cli._shared_options import examples_in_help, setting_options


@click.command(
    "inspect",
    epilog=examples_in_help(
        "symgen inspect pendulum", "symgen inspect slider-crank --method lagrange --format latex --select M,f,law"
    ),
)
@click.argument("model")
@click.option("--format", "form", type=click.Choice(["text", "latex", "json"]), show_default="text")
@click.option("--json", "as_json", is_flag=True, help="The same as --format json.")
@click.option("--document", is_flag=True, help="With --format latex: a document that compiles as it is.")
@click.option(
    "--select", metavar="NAME,NAME", help="With --format latex: sections (Phi, D, gamma, M, f, law, ...) and joints."
)
@click.option("--symbols", is_flag=True, help="With --format latex: symbols for lengths that are numbers in the file.")
@click.option("-o", "--output", metavar="FILE.html", help="Write a self-contained page with all sections.")
@click.option("--method", help="Also show the operation counts of this method's functions.")
@setting_options(
    *("options", "shape", "coordinates", "parameters"),
    text={"options": "Of the method: weight=mass.", "parameters": "Value of a parameter, for the start."},
)
def command(
    model: str,
    form: str | None,
    as_json: bool,
    document: bool,
    select: str | None,
    symbols: bool,
    output: str | None,
    method: str | None,
    options: dict[str, str],
    shape: str,
    coordinates: str,
    parameters: dict[str, float],
) -> int:
    """Show the equations that symgen derives for MODEL, exactly as they are compiled.

    Coordinates, constraints, Jacobian with its pattern, quadratic velocity terms, forces, mass matrix, sizes, degrees
    of freedom, redundant rows, operation counts, shared terms, and what was left out and why.
    """
    from symgen.api import load
    from symgen.base.settings import Settings
    from symgen.result.reading.inspection import equation_facts, method_of, write_page
    from symgen.result.reading.inspection_text import inspection_as_text

    named = method or "direct-correction"
    own = {f"method.{key}": value for key, value in _options_of_method(options, named).items()}
    settings = Settings(named, options=own, shape=shape, coordinates=coordinates, parameters=parameters)
    method_of(settings)  # refuses options that are numbers of runs
    if as_json and form not in (None, "json"):
        raise InputError("--json", "the same as --format json", f"--format {form} as well")
    form = "json" if as_json else form or "text"
    if output is not None:
        if as_json or document or select is not None or symbols or form != "text":
            raise InputError("inspect: -o", "a page, which has everything", "options of text, LaTeX or JSON with it")
        from symgen.result.reading.listing import text_of_model

        written = write_page(load(model).mechanism, settings, Path(output), "inspect: -o", text_of_model(model))
        click.echo(f"{written}  {written.stat().st_size} bytes")
        return OK
    if form == "latex":
        if document and shape == "looped":
            raise InputError("--shape", "straight code, as a document shows the equations of one mechanism", "looped")
        from symgen.cli._reading import latex_of_equations

        click.echo(latex_of_equations(model, settings, select, symbols, document), nl=False)
        return OK
    if document or select is not None or symbols:
        expected = "--format latex, with which alone --document, --select and --symbols mean something"
        raise InputError("inspect", expected, f"--format {form}")
    facts = equation_facts(load(model).mechanism, settings, method is not None)
    if form == "json":
        write_json(facts)
    else:
        click.echo(inspection_as_text(facts), nl=False)
    return OK


def _options_of_method(options: dict[str, str], method: str) -> dict[str, str]:
    """Return options of a method by their own names; prefixes are its name, ``method``, or none."""
    own = {}
    for key, value in options.items():
        owner, _, name = key.rpartition(".")
        if owner not in ("", "method", method):
            raise InputError(f"--option {key}", f"{method}.NAME, method.NAME or NAME", f"'{key}'")
        if name in own:
            raise InputError(f"--option {key}", "each option once", f"{name} twice")
        own[name] = value
    return own
