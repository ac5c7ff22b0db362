"""Native code: emitted functions and loops as text for LLVM, C and JavaScript, and as machine code.

In: the source of a function.
Out: a typed tree of it, and what is printed or compiled from that.
Imports: llvmlite, msgspec, NumPy; `base` and `vocabulary`.
"""
