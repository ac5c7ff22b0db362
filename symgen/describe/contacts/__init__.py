"""Contacts: surfaces of bodies that touch, and what a pair of them makes of gap and slip, one file a pair in `pairs`.

In: tables of two surfaces.
Out: measures of their gap and of the coordinate along it.
Imports: msgspec, ezdxf (where a DXF file is read); `parts`, `formulas`.
"""
