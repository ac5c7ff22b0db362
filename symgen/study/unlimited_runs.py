"""Limits of the runs of a study: it measures what a single run would stop at."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.run.planning.prepare import Prepared

#: Limits of a run that does not watch itself.
UNWATCHED: dict[str, Any] = {"max_violation": 1e30, "max_energy_error": 1e30}
#: Statuses of loops that stopped although they could have continued.
WATCHES = (abi.POSITION, abi.VELOCITY, abi.ENERGY)


def without_limits(run: Prepared) -> Prepared:
    """Return a run that does not watch itself, also where its method limits velocities in another way."""
    return run.with_spec(**UNWATCHED, max_velocity_violation=None)
