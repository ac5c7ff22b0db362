"""Describing a mechanism: text or Python in, one validated frozen `Mechanism` out.

The stage reads a TOML file, a catalogue entry or the keys of a `MechanismBuilder`; all three become the same nested
dictionary and pass the same validator. Neither SymPy nor NumPy is imported here.
"""

from __future__ import annotations

from symgen.describe.builder import MechanismBuilder
from symgen.describe.load import load
from symgen.describe.mechanism import Mechanism

__all__ = ["Mechanism", "MechanismBuilder", "load"]
