"""Modules that people read and a script that runs one: NumPy and Numba."""

from __future__ import annotations

from symgen.result.targets._modules import modules_for

KIND = modules_for("cpu")
