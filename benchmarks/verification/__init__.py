"""Runs of symgen judged from outside: against the reference of `benchmarks.plain`, in processes that may fail."""
