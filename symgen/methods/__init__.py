"""Constraint stabilisation methods, one file each; `METHODS` finds them."""

from __future__ import annotations

from symgen.methods._base import Method
from symgen.registry import Registry

METHODS: Registry[Method] = Registry("symgen.methods", "method")
