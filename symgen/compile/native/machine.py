"""From text for LLVM to machine code in this process.

Object files that are loaded later may use the symbols of earlier ones: functions are compiled one by one, callees
first.
"""

from __future__ import annotations

import functools
import os
import re
import threading
from typing import Any

import llvmlite.binding as llvm

from symgen.compile.native import sines

#: Straight functions of more instructions are compiled in blocks, in time that grows no faster than their length.
#: Below, blocks save nothing, and the code of one block is some 5 % faster.
LARGEST_BLOCK = 4000
#: Attributes of code for one run with sines of several angles at once: such code has too few operations on vectors for
#: registers of 512 bits, with which it takes up to 1.7 times as long. All functions of a module have them, as callers
#: and callees have to agree on registers.
_LEGAL = '"min-legal-vector-width"="256"'
_NARROW = f' "prefer-vector-width"="256" {_LEGAL}'
#: Lock by which one thread at a time makes or loads machine code.
lock = threading.RLock()


@functools.cache
def _host_processor() -> tuple[str, str, str]:
    """Return triple, name and features of the processor; Numba's environment variables may name another one."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    name = os.environ.get("NUMBA_CPU_NAME") or llvm.get_host_cpu_name()
    features = "" if name == "generic" else llvm.get_host_cpu_features().flatten()
    return llvm.get_process_triple(), name, os.environ.get("NUMBA_CPU_FEATURES", features)


@functools.cache
def vector_width() -> int:
    """Return the number of floating-point numbers in a vector of this processor."""
    _, name, features = _host_processor()
    wide = {"+avx512f": 8, "+avx": 4}
    named = {"haswell": 4, "broadwell": 4, "znver1": 4, "znver2": 4, "znver3": 4}  # if features are missing
    return next((n for feature, n in wide.items() if feature in features.split(",")), named.get(name, 2))


@functools.cache
def processor_features() -> str:
    """Return the features of this processor that affect machine code."""
    return repr(_host_processor())


def _target_machine(level: int) -> Any:
    """Return the compiler of machine code, with the passes of a level of optimisation."""
    triple, name, features = _host_processor()
    # addresses are those of this process: code for x86 need not be relocated
    relocation = "static" if triple.startswith(("x86", "i386", "i686")) else "default"
    options = {"cpu": name, "features": features, "reloc": relocation, "codemodel": "jitdefault", "jit": True}
    return llvm.Target.from_triple(triple).create_target_machine(opt=level, **options)


@functools.cache
def _best_machine() -> Any:
    return _target_machine(3)


@functools.cache
def _execution_engine() -> Any:
    """Return the holder of machine code in memory."""
    return llvm.create_mcjit_compiler(llvm.parse_assembly(""), _target_machine(3))


def compile_module(text: str, symbol: str, once: bool = False) -> bytes:
    """Return the object file of a module in LLVM's language.

    Parameters
    ----------
    text : str
        The module.
    symbol : str
        Its function, divided into blocks if it is long.
    once : bool
        Whether the function is called about once, so that passes would take longer than they save.
    """
    from symgen.compile.native.blocks import split_into_blocks

    if once:
        return bytes(_target_machine(0).emit_object(_parse_module(text)))
    module = optimise_module(text)
    machine = _best_machine()
    divided = split_into_blocks(str(module), symbol, LARGEST_BLOCK)
    if divided is not None:
        module = llvm.parse_assembly(divided)
        machine = _target_machine(1)  # without the passes whose time grows with the square of a block's length
    return bytes(machine.emit_object(module))


def _parse_module(text: str) -> Any:
    """Return a module for this processor, before all passes."""
    if sines.sine_name(sines.MOST) in text:
        text = re.sub(r"(?m)^(define .*)\{$", rf"\1{_NARROW} {{", text)
    module = llvm.parse_assembly(text)
    module.triple, module.data_layout = _host_processor()[0], str(_best_machine().target_data)
    return module


def optimise_module(text: str) -> Any:
    """Return a module after the passes of the highest level.

    For straight code a few of these give the result of all: instructions in their plainest form, operands in
    the order that decides which product a sum is contracted with.
    """
    module = _parse_module(text)
    options = llvm.create_pipeline_tuning_options(speed_level=3)
    options.loop_vectorization = options.loop_unrolling = True
    options.slp_vectorization = False
    builder = llvm.create_pass_builder(_best_machine(), options)
    # the function of `symgen.compile.native.sines` jumps by a ``switch``: it needs no more than straight code
    straight = " br " not in text and "available_externally" not in text
    if straight:
        passes = llvm.create_new_module_pass_manager()
        passes.add_instruction_combine_pass()
        passes.add_reassociate_pass()
        passes.add_instruction_combine_pass()
    else:
        passes = builder.getModulePassManager()
    passes.run(module, builder)
    if straight or sines.sine_name(sines.MOST) not in text:
        return module
    # a pass that hands vectors over as values widens the registers of some functions only: sines would come out wrong
    return llvm.parse_assembly(re.sub(r'"min-legal-vector-width"="\d+"', _LEGAL, str(module)))


def load_machine_code(code: bytes, symbol: str) -> int:
    """Put machine code into memory and return the address of a symbol.

    Its callees must be in memory before: LLVM ends the process where a symbol is missing.
    """
    engine = _execution_engine()
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    return int(engine.get_function_address(symbol))
