"""Fails with a clear sentence where a version of llvmlite is no longer what `symgen.native` stands on."""

from __future__ import annotations

import ctypes
import inspect

import llvmlite
import llvmlite.binding as llvm
import pytest
from llvmlite import ir

from symgen.native import machine
from symgen.runtime import vector_code

CHANGED = f"llvmlite {llvmlite.__version__} changed; adapt symgen/native/machine.py: "
#: What is used of it: owner, name, and parameters that are given.
USED = (
    *((llvm, name, ()) for name in ("initialize_native_target", "initialize_native_asmprinter")),
    *((llvm, name, ()) for name in ("get_host_cpu_name", "get_host_cpu_features", "get_process_triple")),
    (llvm, "parse_assembly", ("llvmir",)),
    (llvm, "create_mcjit_compiler", ("module", "target_machine")),
    (llvm, "create_pass_builder", ("tm", "pto")),
    (llvm, "create_pipeline_tuning_options", ("speed_level",)),
    (llvm, "create_new_module_pass_manager", ()),
    (llvm.Target, "from_triple", ("triple",)),
    (llvm.Target, "create_target_machine", ("cpu", "features", "opt", "reloc", "codemodel", "jit")),
    (llvm.TargetMachine, "emit_object", ("module",)),
    (llvm.TargetMachine, "target_data", ()),
    (llvm.PassBuilder, "getModulePassManager", ()),
    (llvm.ModulePassManager, "add_instruction_combine_pass", ()),
    (llvm.ModulePassManager, "add_reassociate_pass", ()),
    (llvm.ModulePassManager, "run", ()),
    (llvm.PipelineTuningOptions, "loop_vectorization", ()),
    (llvm.PipelineTuningOptions, "slp_vectorization", ()),
    (llvm.ObjectFileRef, "from_data", ("data",)),
    (llvm.ExecutionEngine, "add_object_file", ("obj_file",)),
    (llvm.ExecutionEngine, "finalize_object", ()),
    (llvm.ExecutionEngine, "get_function_address", ("name",)),
)
#: A sum with a product by one, which passes take out, and with a jump, or without one, which takes fewer passes.
PLAIN = """
define double @"symgen.canary.{name}"(double %a, double %b, ptr %c) {{
  %x = load double, ptr %c
  %u = fmul double %a, 1.0
  %y = fmul contract double %u, %b
  %z = fadd contract double %y, %x
  {end}
  ret double %z
}}
"""
BRANCH = "br label %end\nend:"


@pytest.mark.parametrize(("owner", "name", "parameters"), USED, ids=lambda x: getattr(x, "__name__", str(x)))
def test_what_is_used_of_llvmlite_is_there(owner, name, parameters):
    found = getattr(owner, name, None)
    assert found is not None, f"{CHANGED}{owner.__name__} has no '{name}' any more"
    if parameters:
        taken = list(inspect.signature(found).parameters)
        assert set(parameters) <= set(taken), f"{CHANGED}{owner.__name__}.{name} takes {taken}"


@pytest.mark.parametrize("end", ["", BRANCH], ids=["few passes", "all passes"])
def test_text_is_parsed_optimised_emitted_loaded_and_called(end):
    name = f"symgen.canary.{'branch' if end else 'straight'}"
    text = PLAIN.format(name=name.rpartition(".")[2], end=end)
    module = str(machine.optimised(text))
    assert "define double" in module and " br " not in module and " 1.0" not in module, CHANGED + "passes do nothing"
    code = machine.compiled(text, name)
    assert code == machine.compiled(text, name), CHANGED + "an object file is another one each time"
    address = machine.load(code, name)
    assert address, CHANGED + "what is loaded is not found by its name"
    function = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double, ctypes.c_double, ctypes.c_void_p)(address)
    assert function(2.0, 3.0, ctypes.addressof(ctypes.c_double(4.0))) == 10.0, CHANGED + "a call gives something else"


def test_what_is_loaded_may_call_what_was_loaded_before():
    inner, outer = "symgen.canary.inner", "symgen.canary.outer"
    texts = {
        inner: f'define i64 @"{inner}"(i64 %x) {{\n  %y = add i64 %x, 1\n  ret i64 %y\n}}\n',
        outer: f'declare i64 @"{inner}"(i64)\n'
        f'define i64 @"{outer}"(i64 %x) {{\n  %y = call i64 @"{inner}"(i64 %x)\n  ret i64 %y\n}}\n',
    }
    for name, text in texts.items():
        address = machine.load(machine.compiled(text, name), name)
    found = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64)(address)(41)
    assert found == 42, CHANGED + "object files do not find each other's symbols"


def test_what_is_no_text_for_llvm_is_refused():
    with pytest.raises(RuntimeError):
        machine.compiled("define nonsense", "f")


def test_vectors_are_written_by_its_builder():
    double = ir.DoubleType()
    module = ir.Module("symgen.canary.vectors")
    kind = ir.FunctionType(ir.IntType(1), [ir.IntType(64), double.as_pointer()])
    function = ir.Function(module, kind, "symgen.canary.finite")
    builder = ir.IRBuilder(function.append_basic_block())
    builder.ret(vector_code.finite(builder, *function.args))
    address = machine.load(machine.compiled(str(module), function.name), function.name)
    call = ctypes.CFUNCTYPE(ctypes.c_bool, ctypes.c_int64, ctypes.c_void_p)(address)
    for last, expected in ((1.0, True), (float("nan"), False)):
        array = (ctypes.c_double * 16)(*[0.5] * 15, last)
        assert call(16, ctypes.addressof(array)) == expected, CHANGED.replace("native/machine", "runtime/vector_code")
