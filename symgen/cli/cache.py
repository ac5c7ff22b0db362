"""Show or empty the cache of generated and compiled code."""

from __future__ import annotations

import click

from symgen.cli import OK, write_json
from symgen.cli._shared_options import examples_in_help, json_option


@click.group(
    "cache",
    epilog=examples_in_help("symgen cache info", "symgen cache clear"),
)
def command() -> None:
    """Show or empty the cache of generated and compiled code; SYMGEN_CACHE_DIR says where it is."""


@command.command("info", epilog=examples_in_help("symgen cache info --json"))
@json_option
def info_command(as_json: bool) -> int:
    """Show the folder and contents of the cache."""
    return _show_sizes(as_json, "")


@command.command("clear", epilog=examples_in_help("symgen cache clear"))
@json_option
def clear_command(as_json: bool) -> int:
    """Remove all files of symgen from the cache."""
    from symgen.compile.store import upkeep
    from symgen.compile.store.paths import cache_root

    upkeep.clear_cache(cache_root())
    return _show_sizes(as_json, "cleared; ")


def _show_sizes(as_json: bool, done: str) -> int:
    from symgen.compile.store import upkeep
    from symgen.compile.store.paths import cache_location

    place = cache_location()
    held = upkeep.cache_info(place.path)
    if as_json:
        facts = {"path": str(place.path), "persistent": place.persistent, "reason": place.reason}
        write_json(facts | {"entries": held.entries, "compiled": held.compiled, "bytes": held.bytes})
        return OK
    size = f"{held.bytes / 1e6:.1f} MB"
    click.echo(f"{done}{place.path}: {held.entries} generated modules, {held.compiled} compiled functions, {size}")
    if not place.persistent:
        click.echo(f"symgen: warning: a temporary folder is used because {place.reason}", err=True)
    return OK
