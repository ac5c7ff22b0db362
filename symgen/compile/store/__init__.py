"""The cache: data that outlive a process. Anything invalid in it is a miss, never an error.

`paths`: its folder; `private`: files that check themselves; `entries`: emitted modules with their metadata; `jit`:
functions whose machine code is kept; `modules`: emitted modules as Python modules.

In: sources, metadata and machine code, with keys made of content.
Out: the same, in this process or another.
Imports: filelock, llvmlite, platformdirs; Numba when needed; `native` and rooms below.
"""
