"""A box over a plane, which its corners touch."""

from __future__ import annotations

from symgen.describe.contacts.pairs_in_space.capsule_plane import read_ends_over_plane
from symgen.describe.contacts.surfaces_in_space import PairInSpace

KIND = PairInSpace(("box", "plane"), read_ends_over_plane)
