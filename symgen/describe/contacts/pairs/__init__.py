"""Pairs of surfaces, one file each: tables of a disc and of what it meets in, gap and slip out."""
