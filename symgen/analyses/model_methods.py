"""Methods of `symgen.api.Model` that are analyses."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.analyses.kinds import ANALYSES
from symgen.base.keywords import make_entry

if TYPE_CHECKING:
    from symgen.analyses.kinds import equilibrium as _equilibrium
    from symgen.analyses.kinds import identify as _identify
    from symgen.analyses.kinds import inverse as _inverse
    from symgen.analyses.kinds import kinematics as _kinematics
    from symgen.analyses.kinds import linearise as _linearise
    from symgen.analyses.kinds import modes as _modes
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result


class Analysed:
    """A model that can be analysed; who inherits it has a mechanism and runs it."""

    if TYPE_CHECKING:

        @property
        def mechanism(self) -> Mechanism:
            """The validated description."""

        def simulate(self, settings: Settings | None = None) -> Result:
            """Run it."""

        # type checkers and editors, which read and do not run, see these; the registry gives them
        equilibrium = _equilibrium.equilibrium
        equilibria = _equilibrium.equilibria
        steady = _equilibrium.steady
        modes = _modes.modes
        view_mode = _modes.view_mode
        locus = _modes.locus
        linearise = _linearise.linearise
        kinematics = _kinematics.kinematics
        inverse = _inverse.inverse
        identify = _identify.identify
        objective = _identify.objective
        gradient = _identify.gradient


for _, _analysis in ANALYSES.items():
    for _method in _analysis.methods:
        setattr(Analysed, _method.__name__, make_entry(_method))
