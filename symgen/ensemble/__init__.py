"""Many runs of one compiled model over parameters and starts: on all cores, and through Dask on other machines."""
