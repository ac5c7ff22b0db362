"""Dynamics as casadi.Function, for optimal control: CasADi."""

from __future__ import annotations

from symgen.derive.emit.libraries import CASADI
from symgen.result.targets._state_functions import write_functions
from symgen.result.targets._target import Request, Target
from symgen.run.planning.package import Package

_HEAD = '''\
import inspect

import casadi as ca


def _function(name, elements, sizes, shape):
    """Return a function of symbols; matrices are row by row in `elements`."""
    names = list(inspect.signature(elements).parameters)
    symbols = [ca.SX.sym(name, size) for name, size in zip(names, sizes)]
    result = ca.vertcat(*elements(*symbols))
    if len(shape) == 2:
        result = ca.reshape(result, shape[1], shape[0]).T
    return ca.Function(name, symbols, [result], names, ["result"])'''


def _write(request: Request) -> Package:
    return write_functions(request, "casadi", CASADI, _HEAD, "{name} = _function({name!r}, _{name}, {sizes}, {shape})")


KIND = Target(_write, bounded=True)
