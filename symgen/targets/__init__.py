"""Targets of emitted code, one file each: ``symgen generate --target NAME`` finds a target by its file name."""

from __future__ import annotations

from symgen.registry import Registry
from symgen.targets._target import Request, Target

TARGETS: Registry[Target] = Registry("symgen.targets", "target")

__all__ = ["TARGETS", "Request", "Target"]
