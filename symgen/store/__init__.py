"""What outlives a process: emitted modules, compiled machine code, and the way both are loaded.

- `paths`: where the cache is, and whether it may be trusted;
- `private`: small files that check themselves and are read only when they are ours;
- `entries`: emitted modules with their metadata, written so that a kill leaves a valid pair or nothing;
- `jit`: functions whose machine code is kept in the cache;
- `modules`: emitted modules as Python modules.

Everything odd in the cache is a miss, never an error.
"""
