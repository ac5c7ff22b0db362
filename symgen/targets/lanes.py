"""Modules that advance eight motions at once, for loops of your own: NumPy and Numba."""

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
        "lanes",
    )


KIND = Target(_write)
