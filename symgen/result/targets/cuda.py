"""Device functions for kernels of your own: Numba and a CUDA device."""

from __future__ import annotations

from symgen.result.targets._modules import modules_for

KIND = modules_for("cuda")
