"""What the cells of a process share: one object of each mechanism, its code, and its closed starts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from symgen.base.latest import get_or_make
from symgen.describe.facts.digest import digest, mechanism_digest
from symgen.describe.formulas.results_read import integrals_of_outputs
from symgen.describe.remembered import compute_once
from symgen.run.planning.starts import compiled_for

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.compiling.method_choice import MethodChoice
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.prepare import Assembled

#: Mechanisms, and codes of methods, that are kept at a time: cells come mechanism by mechanism and method by method,
#: and those of searches for extreme values again and again.
MECHANISMS, METHODS = 16, 96
#: Values of parameters of which closed starts are kept.
STARTS = 32

#: Digest of all of a mechanism.
identity_of = compute_once(mechanism_digest)
#: Mechanisms by their identity, the latest last; what is remembered of a mechanism is remembered of its object.
_mechanisms = dict[str, "Mechanism"]()
#: Compiled models by mechanism or what its looped code depends on, method, shape, the latest last.
_codes = dict[tuple[object, str, str], "CompiledModel"]()
#: Closed starts by mechanism, parameters and options, the latest last.
_starts = dict[tuple[str, tuple[tuple[str, float], ...], tuple[str, ...]], "dict[Any, Assembled]"]()


def shared_mechanism(mechanism: Mechanism) -> Mechanism:
    """Return the one object for equal mechanisms: each task comes to a process with a mechanism of its own."""
    return get_or_make(_mechanisms, identity_of(mechanism), lambda: mechanism, MECHANISMS)


def code_of_cell(mechanism: Mechanism, choice: MethodChoice) -> CompiledModel:
    """Return the compiled model of a run as `compiled_for` does, the same object for all values of parameters.

    Looped code is the same for all starts too; straight code may use which velocities are free at the start.
    """
    of_looped = digest(mechanism), *integrals_of_outputs(mechanism)
    key = of_looped if choice.shape == "looped" else identity_of(mechanism), choice.stem, choice.shape
    return get_or_make(_codes, key, lambda: compiled_for(mechanism, choice), METHODS)


def starts_of_cell(
    mechanism: Mechanism, parameters: Mapping[str, float], options: Mapping[str, Any]
) -> dict[Any, Assembled]:
    """Return the closed starts of a mechanism with these parameters, by `Plan.key`; new ones are added to it."""
    key = identity_of(mechanism), tuple(sorted(parameters.items())), tuple(sorted(options))
    return get_or_make(_starts, key, dict, STARTS)
