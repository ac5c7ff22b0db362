"""Kinds of rows with bounds, one file each: a key of joints or a section of files in, frozen rows out."""
