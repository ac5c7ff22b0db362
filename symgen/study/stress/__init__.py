"""Stress: which methods stay stable on stiff and extreme cases."""
