"""Pairs of surfaces in space, one file each: two shapes in, gaps out."""
