"""Targets of emitted code, one file each; ``symgen generate --target NAME`` finds them by name.

In: a mechanism and a method.
Out: files: Python modules, JavaScript, C, an FMU.
Imports: msgspec, NumPy; `player` and rooms below.
"""

from __future__ import annotations

from symgen.base.registry import Registry
from symgen.result.targets._target import Request, Target

TARGETS: Registry[Target] = Registry("symgen.result.targets", "target")

__all__ = ["TARGETS", "Request", "Target"]
