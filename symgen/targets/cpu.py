"""Modules that people read and a script that runs one: NumPy and Numba."""

from __future__ import annotations

from symgen.running.package import Package, write_package
from symgen.targets._target import Request, Target


def _write(request: Request) -> Package:
    return write_package(
        request.mechanism,
        request.path,
        request.methods,
        request.options or {},
        request.coordinates,
        request.shape,
        "cpu",
    )


KIND = Target(_write)
