"""What `symgen.native` needs of Numba beyond its documented interface, asked before it is used.

Where something is not as expected, functions are compiled by Numba as ever; `tests/native/test_canary.py` says what has
changed.
"""

from __future__ import annotations

import functools
import inspect
from typing import Any

from numba.core import config, types
from numba.core.base import BaseContext
from numba.core.codegen import JITCPUCodegen, JitEngine
from numba.core.cpu import CPUContext
from numba.core.environment import Environment
from numba.core.funcdesc import FunctionDescriptor
from numba.core.registry import CPUDispatcher, cpu_target

# Owner, name, parameters.
_NEEDED: tuple[tuple[Any, str, list[str]], ...] = (
    (JITCPUCodegen, "_module_pass_manager", ["self", "kwargs"]),
    (JITCPUCodegen, "_customize_tm_options", ["self", "options"]),
    (JITCPUCodegen, "magic_tuple", ["self"]),
    (JitEngine, "__init__", ["self", "ee"]),
    (BaseContext, "insert_user_function", ["self", "func", "fndesc", "libs"]),
    (BaseContext, "subtarget", ["self", "kws"]),
    (CPUContext, "create_cpython_wrapper", ["self", "library", "fndesc", "env", "call_helper", "release_gil"]),
    (CPUContext, "get_executable", ["self", "library", "fndesc", "env"]),
    (Environment, "from_fndesc", ["fndesc"]),
    (
        FunctionDescriptor,
        "__init__",
        [
            *("self", "native", "modname", "qualname", "unique_name", "doc", "typemap", "restype", "calltypes"),
            *("args", "kws", "mangler", "argtypes", "inline", "noalias", "env_name", "global_dict", "abi_tags", "uid"),
        ],
    ),
    (CPUDispatcher, "compile", ["self", "sig"]),
    (CPUDispatcher, "add_overload", ["self", "cres"]),
    (CPUDispatcher, "get_compile_result", ["self", "sig"]),
)
_OF_THE_COMPILER = ("_tm", "_tm_features", "_engine", "_data_layout", "_llvm_module")
#: How a function of a number and an array is called, in LLVM's words.
_CONVENTION = "i32 (double*, {i8*, i32, i8*, i8*, i32}**, double, i8*, i8*, i64, i64, double*, i64, i64)"


def changed() -> list[str]:
    """Return a sentence for everything that is not as expected; empty if all is well."""
    found = []
    for owner, name, parameters in _NEEDED:
        method = getattr(owner, name, None)
        if method is None:
            found.append(f"{owner.__name__} has no '{name}' any more")
        elif list(inspect.signature(method).parameters) != parameters:
            wanted = ", ".join(parameters)
            found.append(f"{owner.__name__}.{name} should take ({wanted}), but takes {inspect.signature(method)}")
    compiler = cpu_target.target_context.codegen()
    found += [f"the compiler has no '{name}' any more" for name in _OF_THE_COMPILER if not hasattr(compiler, name)]
    if not found:
        convention = cpu_target.target_context.call_conv
        text = str(convention.get_function_type(types.float64, (types.float64, types.float64[::1])))
        if text != _CONVENTION:
            found.append(f"functions should be called as {_CONVENTION}, but are called as {text}")
    return found


@functools.cache
def usable() -> bool:
    """Whether functions may be put into machine code here; where Numba is asked to check or to debug, they are not."""
    return not (config.BOUNDSCHECK or config.DEBUGINFO_DEFAULT or changed())
