"""Dynamics as pure functions for jit, vmap and grad: JAX."""

from __future__ import annotations

from symgen.derive.emit.libraries import JAX
from symgen.result.targets._state_functions import write_functions
from symgen.result.targets._target import Request, Target
from symgen.run.planning.package import Package

_HEAD = """\
import jax
import jax.numpy as jnp

jax.config.update("jax_enable_x64", True)  # with 32 bits loops would not stay closed"""


def _write(request: Request) -> Package:
    return write_functions(request, "jax", JAX, _HEAD, "")


KIND = Target(_write, bounded=True)
