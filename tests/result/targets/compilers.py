"""C code of a mechanism compiled and called: what tests of C and of FMUs share."""

import ctypes
import subprocess
from pathlib import Path

import numpy as np

from symgen.result.targets import TARGETS, Request

STRICT = ("-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror")
#: Called over the states that a test has: rates, and states as they are corrected.
HARNESS = """
#include "{prefix}.h"
#include <string.h>
static {prefix} model;
int begin(double *y, double *p) {{
    {prefix}_init(&model);
    const int failed = {prefix}_start(&model);
    memcpy(y, model.y, sizeof model.y);
    memcpy(p, model.p, sizeof model.p);
    return failed;
}}
int rates(double t, const double *y, double *ydot) {{ return {prefix}_rates(&model, t, y, ydot); }}
int corrected(double t, double h, double *y) {{ return {prefix}_accept(&model, t, h, y); }}
void set(int parameter, double value) {{ {prefix}_set(&model, parameter, value); }}
int start(double *y) {{
    const int failed = {prefix}_start(&model);
    memcpy(y, model.y, sizeof model.y);
    return failed;
}}
"""


def written(mechanism, folder: Path, **keys) -> Path:
    """Write a mechanism as C; return the folder."""
    TARGETS.get("c").write(Request(mechanism, folder, **keys))
    return folder


def compiled(folder: Path, *options: str, output: str = "sim", files=None) -> Path:
    """Compile the files of a folder without a warning; return what comes of it."""
    sources = [str(f) for f in (files or sorted(folder.glob("*.c")))]
    command = ["cc", *STRICT, "-O1", *options, *sources, "-lm", "-o", str(folder / output)]
    result = subprocess.run(command, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return folder / output


def called(folder: Path) -> ctypes.CDLL:
    """Return the functions of the harness."""
    prefix = next(folder.glob("*.h")).stem
    harness = folder / "harness.c"
    harness.write_text(HARNESS.format(prefix=prefix))
    files = [harness, folder / f"{prefix}.c"]
    library = ctypes.CDLL(str(compiled(folder, "-shared", "-fPIC", output="library.so", files=files)))
    double, array = ctypes.c_double, np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
    library.begin.argtypes, library.rates.argtypes = (array, array), (double, array, array)
    library.corrected.argtypes, library.set.argtypes = (double, double, array), (ctypes.c_int, double)
    library.start.argtypes = (array,)
    return library
