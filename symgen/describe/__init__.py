"""Descriptions: text or Python in, one validated frozen `Mechanism` out.

TOML, catalogue entries and a `MechanismBuilder` become the same nested dictionary and pass the same validator.

In: a file, a catalogue entry or the keys of a builder.
Out: a `Mechanism` with its inputs, events, tables and described start.
Imports: msgspec; mujoco for MJCF; `catalogue` and rooms below; `forces`, `joints` by name.
"""

from __future__ import annotations

from symgen.describe.builder import MechanismBuilder
from symgen.describe.load import load
from symgen.describe.mechanism import Mechanism

__all__ = ["Mechanism", "MechanismBuilder", "load"]
