"""Dynamics as C99 functions without memory of their own, for controllers: a C99 compiler."""

from __future__ import annotations

import re
import time
from collections.abc import Iterable, Iterator, Sequence

from symgen.base.errors import InputError
from symgen.base.escapes import comment_text
from symgen.compile.native import types
from symgen.compile.native.c99 import c_functions
from symgen.compile.native.c99_words import c_number, macro_definitions
from symgen.compile.native.read import Foreign
from symgen.derive.emit.libraries import ARGUMENTS
from symgen.derive.lower.function_programs import StateFunctions
from symgen.result.targets._c_derivatives import derivatives, step_declaration, step_source
from symgen.result.targets._c_names import prefix_of
from symgen.result.targets._state_functions import ModuleFunction, quantities, state_model
from symgen.result.targets._target import Request, Target
from symgen.run.compiling.checked import checked_function
from symgen.run.compiling.functions import StateFunction, compile_function
from symgen.run.planning.package import Package, write_folder
from symgen.run.planning.state_model import StateModel

_WHERE = "--target c-functions"


def _write(request: Request) -> Package:
    began = time.perf_counter()
    model = state_model(_WHERE, request)
    functions = StateFunctions(model.mechanism)
    prefix = prefix_of(model.mechanism.name, "")
    made, purposes = _made(model, functions, prefix, quantities(model))
    further = _made(model, functions, prefix, derivatives(model)) if request.derivatives else None
    derived = time.perf_counter()
    files = {f"{prefix}_functions.h": _header(model, prefix, made, purposes)}
    files[f"{prefix}_functions.c"] = _source(prefix, made, "functions")
    if further is not None:
        files[f"{prefix}_derivatives.h"] = _header_of_derivatives(prefix, *further)
        files[f"{prefix}_derivatives.c"] = _source(prefix, further[0], "derivatives") + step_source(prefix)
    paths = write_folder(request.path, files)
    return Package(request.path, paths, derived - began, time.perf_counter() - derived)


def _made(
    model: StateModel, functions: StateFunctions, prefix: str, wanted: Iterable[ModuleFunction]
) -> tuple[dict[str, StateFunction], dict[str, str]]:
    """Return functions by their names in C, and what they are."""
    made, purposes = dict[str, StateFunction](), dict[str, str]()
    for x in wanted:
        arguments = model.mechanism, lambda: functions, x.base, x.purpose, x.vectors, x.values, x.identity
        made[f"{prefix}_{x.name}"], purposes[f"{prefix}_{x.name}"] = compile_function(*arguments), x.purpose
    return made, purposes


def _source(prefix: str, made: dict[str, StateFunction], file: str) -> str:
    """Return the functions of a file."""
    vector = types.float64[::1]
    try:
        read = {
            name: checked_function(f.function, types.FunctionType(types.int64(*(vector,) * (len(f.lengths) + 1))))
            for name, f in made.items()
        }
    except Foreign as error:
        raise InputError(_WHERE, "code that C has", str(error)) from None
    text = c_functions(read)
    for name, f in made.items():
        text = _public(text, name, f.arguments)
    lines = ["/* Written by symgen. */", "#include <math.h>", "", f'#include "{prefix}_{file}.h"', ""]
    lines += [f"typedef {prefix}_real real;", "", macro_definitions(f"{prefix.upper()}_SINGLE"), "", text, ""]
    return "\n".join(lines)


def _public(text: str, name: str, arguments: Sequence[str]) -> str:
    """Return a text in which a function can be called from outside, without warnings on arguments it does not read."""
    before, _, rest = text.partition(f"static int {name}(")
    signature, _, rest = rest.partition("{\n")
    body, end, after = rest.partition("\n}")
    unused = "".join(f"(void){x};\n" for x in arguments if not re.search(rf"\b{x}\[", body))
    return f"{before}int {name}({signature}{{\n{unused}{body}{end}{after}"


def _header(model: StateModel, prefix: str, made: dict[str, StateFunction], purposes: dict[str, str]) -> str:
    """Return the declarations, with the meaning of the elements of arrays."""
    guard, upper = f"{prefix.upper()}_FUNCTIONS_H", prefix.upper()
    numbers = ", ".join(c_number(float(x)) for x in model.values({}))
    lines = [
        f"/* Dynamics of {comment_text(model.mechanism.name)}. Written by symgen.",
        "   Functions keep nothing and return 0, or 1 where a velocity has no inertia or a row is lost.",
        "   Matrices are row by row.",
    ]
    for letter, part in (("q", model.coordinates), ("v", model.velocities)):
        lines += [f"   {letter}[{i}] {comment_text(x.name)} [{comment_text(x.unit)}]" for i, x in enumerate(part)]
    lines += [f"   p[{i}] {comment_text(name)}" for i, name in enumerate(model.parameters)]
    lines += [f"   row {i} {comment_text(name)}" for i, name in enumerate(model.rows)]
    lines[-1] += " */"
    lines += [f"#ifndef {guard}", f"#define {guard}", "", f"#ifdef {upper}_SINGLE", f"typedef float {prefix}_real;"]
    lines += ["#else", f"typedef double {prefix}_real;", "#endif", ""]
    lines += [f"#define {upper}_{name} {n}" for name, n in _sizes(model).items()]
    lines += ["/* The numbers of the file. */", f"#define {upper}_P {{{numbers}}}", ""]
    return "\n".join([*lines, *_declarations(prefix, made, purposes), "", "#endif", ""])


def _header_of_derivatives(prefix: str, made: dict[str, StateFunction], purposes: dict[str, str]) -> str:
    """Return the declarations of derivatives and of the step."""
    guard = f"{prefix.upper()}_DERIVATIVES_H"
    lines = [
        "/* Written by symgen. Derivatives have a row for each element of what they are of, row by row. */",
        *(f"#ifndef {guard}", f"#define {guard}", "", f'#include "{prefix}_functions.h"', ""),
    ]
    declared = [*_declarations(prefix, made, purposes), step_declaration(prefix)]
    return "\n".join([*lines, *declared, "", "#endif", ""])


def _declarations(prefix: str, made: dict[str, StateFunction], purposes: dict[str, str]) -> Iterator[str]:
    for name, f in made.items():
        arguments = ", ".join(f"const {prefix}_real *{ARGUMENTS[x]}" for x in f.arguments)
        shape = " x ".join(map(str, f.shape)) or "a number"
        yield f"/* {comment_text(purposes[name])}: {shape} */"
        yield f"int {name}({arguments}, {prefix}_real *result);"


def _sizes(model: StateModel) -> dict[str, int]:
    return {
        "NQ": len(model.coordinates),
        "NV": len(model.velocities),
        "NP": len(model.parameters),
        "M": len(model.rows),
    }


KIND = Target(_write, bounded=True, derivatives=True)
