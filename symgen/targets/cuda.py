"""Device functions for kernels of your own: Numba and a CUDA device."""

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
        "cuda",
    )


KIND = Target(_write)
