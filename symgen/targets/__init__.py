"""What code is emitted for, one file a target: ``symgen generate --target NAME`` finds it by its file name."""

from __future__ import annotations

from symgen.registry import Registry
from symgen.targets._target import Request, Target

TARGETS: Registry[Target] = Registry("symgen.targets", "target")

__all__ = ["TARGETS", "Request", "Target"]
