"""Results: labelled arrays, conversion, files."""
