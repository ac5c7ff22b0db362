"""The part of a mechanism that decides where its bodies start, which closes at once, without a compiler."""

from __future__ import annotations

import msgspec

from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.base.vocabulary.expressions import ZERO
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.pipeline import refuse_loops


def closing_part(mechanism: Mechanism) -> tuple[Mechanism, Settings]:
    """Return the parts of a mechanism that close it, without forces, in a shape that needs no compiling."""
    kept = tuple(state for state in mechanism.states if state.rate == ZERO)  # whether a rope is on its sheave
    bare = msgspec.structs.replace(
        mechanism, forces=(), outputs=(), events=(), states=kept, rotors=(), bounded=(), switchable=()
    )
    return bare, settings_in_loops(bare)


def settings_in_loops(mechanism: Mechanism) -> Settings:
    """Return settings of runs that begin at once: loops over tables that all mechanisms share, where these can be."""
    try:
        refuse_loops(mechanism)
    except InputError:
        return Settings()
    return Settings(shape="looped")
