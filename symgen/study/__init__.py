"""Studies: many runs of a mechanism against a reference, and what they say about methods."""
