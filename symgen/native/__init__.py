"""From the source of emitted functions to machine code, without Numba's front end."""
