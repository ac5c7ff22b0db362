"""Text for LLVM to machine code by the compiler inside Numba, and machine code into this process.

Symbols of one object file may be used by others that are loaded later: functions are compiled one by one, and what is
called stands in memory already.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from typing import Any

import llvmlite.binding as llvm
from numba.core.registry import cpu_target

#: Straight functions of more instructions are compiled in blocks, which takes time that grows no faster than they do.
#: Below, nothing is saved by it, and the code of one block is some five parts in a hundred faster.
LARGEST_BLOCK = 4000
#: In longer ones it is said as well which values wait in memory, where that pays. Below, the compiler finds that out in
#: less time than it takes in all to compile, and its code is up to five parts in a hundred faster.
LARGEST_LEFT = 16_000


def codegen() -> Any:
    """Return what Numba compiles with on this processor."""
    return cpu_target.target_context.codegen()


@functools.cache
def processor() -> str:
    """Return what machine code depends on of this processor."""
    return repr(codegen().magic_tuple())


def compiled(text: str, symbol: str, vectors: bool = True) -> bytes:
    """Return the object file of a module in LLVM's language.

    Parameters
    ----------
    text : str
        The module.
    symbol : str
        Its function, which is divided into blocks if it is long.
    vectors : bool
        Whether operations may be taken together in vectors, which takes the compiler a third of its time.
    """
    from symgen.native.blocks import split

    target = codegen()
    module = optimised(text, vectors)
    machine = target._tm
    divided = split(str(module), symbol, LARGEST_BLOCK, LARGEST_LEFT)
    if divided is not None:
        module = llvm.parse_assembly(divided)
        machine = _quick_machine()
    return bytes(machine.emit_object(module))


def optimised(text: str, vectors: bool = True) -> Any:
    """Return a module after the passes that Numba ends with.

    Of these, straight code needs few to become what all make of it: instructions in their plainest form, operands in
    the order that decides which product a sum is contracted with.
    """
    target = codegen()
    module = llvm.parse_assembly(text)
    module.triple, module.data_layout = target._llvm_module.triple, target._data_layout
    asked = {} if vectors else {"loop_vectorize": False, "slp_vectorize": False}
    passes, builder = target._module_pass_manager(**asked)
    # the function of `symgen.native.sines` jumps by a ``switch``: it needs no more than straight code
    if " br " not in text and "available_externally" not in text:
        passes = llvm.create_new_module_pass_manager()
        passes.add_instruction_combine_pass()
        passes.add_reassociate_pass()
        passes.add_instruction_combine_pass()
    passes.run(module, builder)
    return module


def _quick_machine() -> Any:
    """Return the same processor without the passes of which the time grows with the square of a block's length."""
    target = codegen()
    options: dict[str, Any] = {"opt": 1, "features": target._tm_features}
    target._customize_tm_options(options)
    return llvm.Target.from_triple(llvm.get_process_triple()).create_target_machine(**options)


def load(code: bytes, symbols: Iterable[str]) -> dict[str, int]:
    """Put machine code into memory and return the addresses of symbols.

    What it calls must be in memory before: LLVM ends the process where a symbol is missing.
    """
    engine = codegen()._engine._ee
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    return {symbol: engine.get_function_address(symbol) for symbol in symbols}
