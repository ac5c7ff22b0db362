"""Data that outlive a process: emitted modules and compiled machine code, and their loading.

- `paths`: location of the cache, and whether it may be trusted;
- `private`: small self-checking files that are read only when they are the user's own;
- `entries`: emitted modules with their metadata, written so that a kill leaves a valid pair or nothing;
- `jit`: functions whose machine code is kept in the cache;
- `modules`: emitted modules as Python modules.

Anything invalid in the cache is a miss, never an error.
"""
