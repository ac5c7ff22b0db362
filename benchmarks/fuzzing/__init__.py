"""Broken mechanism files by the thousand, and what `symgen check` makes of them."""
