"""Formulas on whole vectors: the operations that methods apply to the equations of motion, and their values.

A method computes nothing while it writes its law. Every value represents an operation on a `Tape`, which records the
operations in order. Code for one mechanism replays the tape element by element (`symgen.derive.lower.scalar`), code for
all mechanisms converts it to loops (`symgen.derive.lower.looped.law_loops`).
"""

from __future__ import annotations

from symgen.derive.methods._tape import Factor, FormulaStep, Matrix, Scalar, Tape, Value, Vector


class System:
    """The equations as a method sees them: named vectors and matrices, products and solves.

    Attributes
    ----------
    tape : Tape
        Record of the operations.
    D : Matrix
        Velocity Jacobian of the constraints.
    f, gamma, nu, phi, v, q_rates : Vector
        Symbols of the notation, q_rates = N v; `phi` is zero in nonholonomic rows.
    power : Scalar
        Power of the applied forces without potential.
    """

    def __init__(self) -> None:
        self.tape = Tape()
        self.D = self.tape.named(Matrix, "constraints")
        self.f, self.v = (self.tape.named(Vector, "quantity", name, size="nv") for name in ("f", "v"))
        self.gamma, self.nu, self.phi = (
            self.tape.named(Vector, "quantity", name, size="m") for name in ("gamma", "nu", "phi")
        )
        self.q_rates = self.tape.named(Vector, "quantity", "q_rates", size="nq")
        self.power = self.tape.named(Scalar, "power")

    @property
    def Phi(self) -> Vector:  # the symbol of the notation
        """The same as `phi`, as files and equations write it."""
        return self.phi

    def parameter(self, name: str) -> Scalar:
        """Return a parameter of the method."""
        return self.tape.named(Scalar, "parameter", name)

    def scale(self, name: str) -> Scalar:
        """Return a number of the status that the runtime sets: ``mean_mass``, ``length_scale``, ``step``, ..."""
        return self.tape.named(Scalar, "status", name)

    def of_mean_mass(self, factor: Scalar) -> Vector:
        """Return a factor times the mean mass for each row, scaled to derivatives of length 1.

        The mean has I / l^2 for rotations, so a penalty has the same effect at any size and any mass of a mechanism
        [kg, or kg m^2 for rows that are angles].
        """
        return (factor * self.scale("mean_mass")) * self.variable("row_weight", "m")

    @property
    def heavy_penalty(self) -> Vector:
        """1e5 times the mean mass for each row: few iterations, and few digits are lost."""
        return self.of_mean_mass(self.tape.constant(1e5))

    @property
    def inverse_step(self) -> Scalar:
        """One over the current step [1/s]."""
        return self.inverse(self.scale("step"))

    def inverse(self, x: Scalar) -> Scalar:
        """Return 1 / x."""
        return self.tape.constant(1.0) / x

    def inverses(self, x: Vector) -> Vector:
        """Return 1 / x of each element."""
        return x.apply(Vector, "div", self.tape.constant(1.0), x, size=x.size)

    def zeros(self, size: str) -> Vector:
        """Return the zero vector of a size."""
        return self.tape.named(Vector, "zeros", size=size)

    # -- M -------------------------------------------------------------------------------------------------------------

    def mass(self, x: Vector) -> Vector:
        """Return M x."""
        return x.apply(Vector, "mass", x, size="nv")

    def minv(self, x: Vector) -> Vector:
        """Return M^-1 x."""
        return x.apply(Vector, "minv", x, size="nv")

    @property
    def free_acceleration(self) -> Vector:
        """M^-1 f, or 0 where M is singular: the start of iterations."""
        return self.f.apply(Vector, "free_acceleration", self.f, size="nv")

    @property
    def inverse_mass_root(self) -> Matrix:
        """L^-T with M = L L^T, by rows of L^-1; any root serves a least-squares solution in the metric of M."""
        return self.tape.named(Matrix, "inverse_mass_root")

    # -- factorisations ------------------------------------------------------------------------------------------------

    def solve(self, factor: Factor, right: Vector) -> Vector:
        """Return the solution for a right-hand side."""
        return right.apply(Vector, "solve", factor, right, size=right.size)

    def solve_schur(self, right: Vector) -> Vector:
        """Return lambda with ``S lambda = right``, S = D M^-1 D^T.

        Rows masked by the runtime are left out, and a small pivot raises the flag that the law returns.
        """
        return self.solve(self.tape.named(Factor, "schur"), right)

    def constrained(self, f: Vector, gamma: Vector) -> tuple[Vector, Vector]:
        """Return v' and lambda with ``M v' + D^T lambda = f``, ``D v' = gamma``.

        ``S lambda = D M^-1 f - gamma``, then ``v' = M^-1 (f - D^T lambda)``; code for one mechanism may eliminate in
        another order, where that takes fewer operations.
        """
        multipliers = self.solve_schur(self.D @ self.minv(f) - gamma)
        accelerations = self.minv(f - self.D.transposed(multipliers))

        def result(name: str, x: Vector) -> Vector:
            step = FormulaStep("constrained", (x.index, f.index, gamma.index), (name,), x.size)
            return Vector(self.tape, self.tape.add(step))

        return result("accelerations", accelerations), result("multipliers", multipliers)

    def compliant_factor(self, compliance: Vector) -> Factor:
        """Return the factor of ``S + e``, e the compliance of each row, infinite for rows that the runtime leaves out.

        It is positive definite for any rank of D, so no pivot is suspicious.
        """
        return compliance.apply(Factor, "compliant", compliance)

    def pseudoinverse_factor(self, matrix: Matrix) -> Factor:
        """Return the factor of B B^T for a scaled constraint matrix B, with masks and flags as for `solve_schur`."""
        return matrix.apply(Factor, "pseudoinverse", matrix)

    def penalties(self, penalty: Scalar | Vector) -> Vector:
        """Return the penalty of each row, from a scalar or by rows; 0 for rows that the runtime leaves out.

        A row that depends on others where the constraints hold is independent at the stages of a step, where they hold
        to the integrator's error only: its penalty would then act on the motion itself.
        """
        return penalty.apply(Vector, "penalties", penalty, size="m")

    def row_stiffness(self, otherwise: Scalar) -> Vector:
        """Return the stiffness of each row from the file, or else `otherwise` [N/m]; masks are ignored.

        It has no loop: methods that use it state this in `dense`.
        """
        return otherwise.apply(Vector, "row_stiffness", otherwise, size="m")

    def augmented_factor(self, penalties: Vector) -> Factor:
        """Return the factor of ``M + D^T a D``, a by rows, which is positive definite for any rank of D."""
        return penalties.apply(Factor, "augmented", penalties)

    # -- what an iterated law keeps in w -------------------------------------------------------------------------------

    def keep(self, section: str, x: Vector) -> Vector:
        """Store a vector in a section once per evaluation; return the stored vector for the iteration."""
        return self.tape.stored_value(Vector, "keep", section, x, x.size)

    def keep_constraints(self) -> Matrix:
        """Store D; return the stored matrix for the iteration."""
        return self.tape.stored_value(Matrix, "keep_constraints", "kept_jacobian", self.D)

    def keep_factor(self, factor: Factor) -> Factor:
        """Store a factor; return the stored one for the iteration."""
        return self.tape.stored_value(Factor, "keep_factor", "kept_factor", factor)

    def variable(self, section: str, size: str) -> Vector:
        """Return an iterated vector, read from a section."""
        return self.tape.named(Vector, "section", section, size=size)

    # -- along the motion ----------------------------------------------------------------------------------------------

    def at_velocity(self, x: Vector, v: Vector) -> Vector:
        """Return a vector with the velocities replaced by `v`."""
        return x.apply(Vector, "at_velocity", x, v, size=x.size)

    def mass_rate(self, x: Vector, v: Vector) -> Vector:
        """Return (dM/dt) x along the motion with velocities `v`; 0 where bodies have coordinates of their own."""
        return x.apply(Vector, "mass_rate", x, v, size="nv")

    def constraint_rate_transposed(self, y: Vector, v: Vector) -> Vector:
        """Return (dD/dt)^T y along the motion with velocities `v`."""
        return y.apply(Vector, "constraint_rate_transposed", y, v, size="nv")

    # -- what corrections and descriptor forms are written with, beside ------------------------------------------------

    def flag(self) -> Value:
        """Return the flag of a suspicious pivot of S."""
        return self.tape.named(Value, "flag")

    def geometry(self, rank: Factor) -> Value:
        """Return the outputs of every `geometry`: Phi, its norm, nu, D, relative pivots and the resulting rank."""
        return rank.apply(Value, "geometry", rank)

    def rank_factor(self, whole: bool = False) -> Factor:
        """Return the factor of D G D^T that decides rank; `whole`: with the pivots of rows that nothing decides on."""
        return self.tape.named(Factor, "rank", *(("whole",) if whole else ()))

    def stored_constrained(
        self, metric: str, name: str, rank: Factor, f: Vector, gamma: Vector, by_factor: Vector
    ) -> Vector:
        """Return x or y with ``W x + D^T y = f``, ``D x = gamma``, of D as ``geometry`` left it.

        Rows that `rank` leaves out are left out. W is M (``mass``), the identity (``identity``) or G^-1 (``scaled``).

        Parameters
        ----------
        metric : str
            W.
        name : {"change", "multipliers"}
            x or y.
        rank, f, gamma
            Decisions and right-hand sides.
        by_factor : Vector
            The same by a factor of D W^-1 D^T.
        """
        operands = (by_factor.index, rank.index, f.index, gamma.index)
        return Vector(
            self.tape, self.tape.add(FormulaStep("stored_constrained", operands, (metric, name), by_factor.size))
        )

    def weighted_factor(self, rank: Factor, weight: str) -> Factor:
        """Return the factor of D W D^T without the rows that `rank` leaves out.

        W is M^-1 (``mass``) or the identity (``identity``), with D as ``geometry`` left it; or the choice of dependent
        columns times G (``dependent``), or the inverse of the metric of carried bodies (``body``), with the D under
        evaluation.
        """
        return rank.apply(Factor, f"weighted_{weight}", rank)

    def body_entries(self) -> Vector:
        """Return the entries of the metric of carried bodies that change with the position."""
        return self.tape.named(Vector, "body_entries", size="nv")

    def body_inverse(self, x: Vector) -> Vector:
        """Return the inverse of the metric of carried bodies times x, from the section ``body_entry``."""
        return x.apply(Vector, "body_inverse", x, size="nv")

    def augmented_metric(self, penalties: Vector) -> Factor:
        """Return the factor of ``M + D^T a D``, of D as ``geometry`` left it."""
        return penalties.apply(Factor, "augmented_metric", penalties)

    def gauged(self, x: Vector) -> Vector:
        """Return G x."""
        return x.apply(Vector, "gauged", x, size="nv")

    def partition_quality(self, rank: Factor, factor: Factor) -> Scalar:
        """Return det(D P G D^T) / det(D G D^T)."""
        return rank.apply(Scalar, "partition_quality", rank, factor)

    def stored_factor(self, factor: Factor, prefix: str) -> Factor:
        """Return a factor stored by another function in ``<prefix>lower`` and ``<prefix>reciprocal``."""
        return Factor(self.tape, self.tape.add(FormulaStep("stored_factor", (factor.index,), (prefix,))))

    def stored_constraints(self) -> Matrix:
        """Return D as ``geometry`` left it."""
        return self.tape.named(Matrix, "stored_constraints")

    def driving(self, accelerations: Vector) -> Scalar:
        """Return the power of the drivers of prescribed coordinates, without that against rows."""
        return accelerations.apply(Scalar, "driving", accelerations)

    def holonomic_or(self, otherwise: Vector) -> Vector:
        """Return Phi, with `otherwise` in nonholonomic rows."""
        return otherwise.apply(Vector, "holonomic_or", otherwise, size="m")
