"""Studies: many runs of a mechanism against a reference, and the findings about methods."""
