"""Results: outcomes with labels, energies, judgement, plots and export. Nothing here integrates.

In: a prepared run and its outcome.
Out: a `Result` and its files.
Imports: NumPy; h5py, matplotlib, pandas, xarray when needed; `player` and rooms below.
"""
