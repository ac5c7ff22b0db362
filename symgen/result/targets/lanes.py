"""Modules that advance eight motions at once, for loops of your own: NumPy and Numba."""

from __future__ import annotations

from symgen.result.targets._modules import modules_for

KIND = modules_for("lanes")
