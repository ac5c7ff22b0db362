"""Remarks on a model: what a reader of any of its results has to know, whichever command or target made it.

A remark is one sentence. It belongs to the model: `Mechanism.remarks` is the one list, which the key ``remarks`` of a
file fills, as an import writes it, and each of `RULES`. All consumers repeat the list: runs, rows of sweeps, steps,
analyses, emitted C, FMUs, environments, pages and reports. What depends on the state that a motion reaches is judged by
`symgen.result.part_limits` instead.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import msgspec

from symgen.describe.files.joints_at_centres import warnings_on_centres
from symgen.describe.files.large_angles import warnings_on_angles
from symgen.describe.files.pitch_circles import warnings_on_gears
from symgen.describe.mechanism import Mechanism

#: Each takes a mechanism and its nested tables, and returns its sentences.
RULES: tuple[Callable[[Mechanism, Mapping[str, Any]], Iterable[str]], ...] = (
    warnings_on_centres,
    warnings_on_angles,
    warnings_on_gears,
)


def with_remarks(mechanism: Mechanism, raw: Mapping[str, Any]) -> Mechanism:
    """Return a mechanism with what the rules say of it after the remarks that it has, each once."""
    found = [sentence for rule in RULES for sentence in rule(mechanism, raw)]
    return msgspec.structs.replace(mechanism, remarks=tuple(dict.fromkeys((*mechanism.remarks, *found))))
