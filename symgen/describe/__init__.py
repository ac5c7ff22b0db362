"""Descriptions: text or Python in, one validated frozen `Mechanism` out.

TOML, catalogue entries and a `MechanismBuilder` become the same nested dictionary and pass the same validator.

In: a file, a catalogue entry or the keys of a builder.
Out: a `Mechanism` with its inputs, events, tables and described start.
Imports: msgspec; `base`; kinds of `forces` and `joints` by name.
"""

from __future__ import annotations

from symgen.describe.files.builder import MechanismBuilder
from symgen.describe.files.load import load_mechanism as load
from symgen.describe.mechanism import Mechanism

__all__ = ["Mechanism", "MechanismBuilder", "load"]
