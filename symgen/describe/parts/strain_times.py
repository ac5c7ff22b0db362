"""Times of damping by strain, which elements and whole beams have as a key."""

from __future__ import annotations

import msgspec

from symgen.describe.parts.fields import Scalar


class StrainTimes(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Damping of a beam by strain: the time by which each stress follows its own strain.

    Parameters
    ----------
    axial, shear, bending : scalar
        Times of stretch, shear and bending [s]; 0 by default. Where shear is rigid the ends move across the beam by
        bending alone, and its time damps that too.
    torsion : scalar
        In space, of twist [s]; 0 by default.
    """

    axial: Scalar = 0.0
    shear: Scalar = 0.0
    bending: Scalar = 0.0
    torsion: Scalar = 0.0
