"""A second run with finer steps, which estimates the error of the first."""
