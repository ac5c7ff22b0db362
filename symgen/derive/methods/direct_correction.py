"""Direct correction of positions and velocities with the Moore-Penrose inverse of the Jacobian."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.errors import InputError
from symgen.base.ir.program import Correction
from symgen.derive.methods._base import SOLVER, TOLERANCE, Descriptor, MethodOption, MultiplierMethod
from symgen.derive.methods._system import System


class DirectCorrection(MultiplierMethod):
    """As `lagrange`; after each step ``dv = -D^+ Phi``, ``q <- q + N dv`` until small, then ``v -= D^+ (D v - nu)``.

    ``D^+ = W^-1 D^T (D W^-1 D^T)^-1``: with weight W = 1 the Moore-Penrose inverse of the source; with W = M the
    mass-orthogonal projection. The minimum-norm metric weighs 1 rad like 1 m: well defined, not unit-invariant.

    Option `when` corrects before every evaluation too: the scheme then integrates the rate at the nearest state that
    satisfies the constraints, which keeps its order.
    """

    name = "direct-correction"
    summary = "positions and velocities are projected after each step with the pseudoinverse of D"
    reference = (
        "Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; "
        "Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076; "
        "Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064; Yu, Chen, Comput. Mech. 26 (2000) 52-57"
    )
    parameters = (TOLERANCE,)
    options = (
        MethodOption("weight", ("identity", "mass", "body"), "metric of the correction; the source's is the identity"),
        MethodOption("when", ("step", "stage"), "after each step, or before every evaluation too"),
        SOLVER,
    )

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the equations of implicit stages, which are corrected after the step alone."""
        if options["when"] == "stage":
            expected = "step with an implicit integrator, whose stages are unknowns of one iteration"
            raise InputError("option direct-correction.when", expected, "'stage'", "--integrator dop853")
        return super().descriptor(system, options)

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return Newton's iteration at position level and one correction at velocity level, in the chosen metric."""
        return Correction("newton", True, options["weight"], stages=options["when"] == "stage")


KIND = DirectCorrection()
