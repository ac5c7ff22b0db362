"""Settings of a run that a mechanism brings along."""

from __future__ import annotations

import msgspec


class Defaults(msgspec.Struct, frozen=True):
    """Default settings of a run; `max_step` bounds its adaptive steps.

    `step` is that of constant steps; adaptive ones begin with `first_step`, the step that a file has, if any.
    """

    until: float = 10.0
    step: float = 1e-3
    output_step: float | None = None
    predictable_until: float | None = None  # None: not chaotic, or not known to be
    max_step: float | None = None
    source: str = ""
    first_step: float | None = None
    integrator: str | None = None
    verify: bool | None = None
