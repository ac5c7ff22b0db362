"""Modules that people read, for one kind of processor."""

from __future__ import annotations

from symgen.result.targets._target import Request, Target
from symgen.run.planning.package import Package, write_package


def modules_for(processor: str) -> Target:
    """Return the target whose files are the modules of a mechanism.

    Parameters
    ----------
    processor : {"cpu", "lanes", "cuda"}
        Processor of the modules.
    """

    def write(request: Request) -> Package:
        choices = request.methods, request.options or {}, request.coordinates, request.shape
        return write_package(request.mechanism, request.path, *choices, processor)

    return Target(write, bounded=processor == "cpu")
