"""What the commands that write a report share."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from symgen.api import Model

#: Larger mechanisms have no sketch in reports.
MOST_BODIES = 200
#: Options that say where or how fast to work, not what to do.
_WORKING = ("--resume", "--journal", "--jobs")


def report_file(text: str | None) -> Path | None:
    """Return where the report will be written, after making sure that it can be."""
    if text is None:
        return None
    from symgen.report.write import check_report

    check_report("--output", Path(text))
    return Path(text)


def command_again() -> str:
    """Return the command that makes the report again: this one without where its working files are."""
    context = click.get_current_context()
    found = ["symgen", context.info_name or "", *context.params["models"]]
    for parameter in context.command.params:
        value = context.params.get(parameter.name or "")
        flag = max(parameter.opts, key=len)
        left_out = isinstance(parameter, click.Argument) or flag in _WORKING
        if left_out or value in (None, (), {}, False, parameter.default):
            continue
        if value is True:
            found.append(flag)
            continue
        if isinstance(value, dict):
            value = tuple(f"{name}={str(item).removesuffix('.0')}" for name, item in value.items())
        for item in value if isinstance(value, tuple) else (value,):
            # where the file lies is nobody's business
            found += [flag, Path(item).name if flag in ("--output", "--csv") else str(item).removesuffix(".0")]
    return shlex.join(found)


def sketches_of(models: Sequence[Model], parameters: Mapping[str, float] | None = None) -> dict[str, str]:
    """Return sketches for the head of a report, by the names of mechanisms; changed parameters are known ones."""
    small = [model for model in models if len(model.mechanism.bodies) <= MOST_BODIES]
    return {model.name: model.draw(parameters).svg for model in small}
