"""The `System` that methods are given, with what corrections and descriptor forms are written with."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.methods._formula import Factor, Matrix, Operation, Scalar, System, Tape, Value, Vector


class Recorder(System):
    """Notes down on a tape what formulas ask for.

    Parameters
    ----------
    parameters : sequence of str
        Parameters of the method.
    """

    def __init__(self, parameters: Sequence[str]) -> None:
        self.tape, self.parameters = Tape(), tuple(parameters)
        self.D = self.tape.named(Matrix, "constraints")
        self.f, self.v = (self.tape.named(Vector, "quantity", name, size="nv") for name in ("f", "v"))
        self.gamma, self.nu, self.phi = (
            self.tape.named(Vector, "quantity", name, size="m") for name in ("gamma", "nu", "phi")
        )
        self.q_rates = self.tape.named(Vector, "quantity", "q_rates", size="nq")
        self.power = self.tape.named(Scalar, "power")  # of the applied forces without potential

    def flag(self) -> Value:
        """Return whether a pivot of S was suspicious so far."""
        return self.tape.named(Value, "flag")

    def geometry(self, rank: Factor) -> Value:
        """Return what every `geometry` writes: Phi, its norm, nu, D, relative pivots and the rank they decide."""
        return rank.made(Value, "geometry", rank)

    def rank_factor(self) -> Factor:
        """Return the factor of D G D^T that decides rank."""
        return self.tape.named(Factor, "rank")

    def weighted_factor(self, rank: Factor, weight: str) -> Factor:
        """Return the factor of D W D^T without the rows that `rank` leaves out.

        W is M^-1 (``mass``) or the identity (``identity``), with D as ``geometry`` left it; or the choice of dependent
        columns times G (``dependent``), or the inverse of the metric of carried bodies (``body``), with D as it is
        being evaluated.
        """
        return rank.made(Factor, f"weighted_{weight}", rank)

    def body_entries(self) -> Vector:
        """Return the entries of the metric of carried bodies that change with the position."""
        return self.tape.named(Vector, "body_entries", size="nv")

    def body_inverse(self, x: Vector) -> Vector:
        """Return the inverse of that metric times x, from the section ``body_entry``."""
        return x.made(Vector, "body_inverse", x, size="nv")

    def augmented_metric(self, penalties: Vector) -> Factor:
        """Return the factor of ``M + D^T a D``, of D as ``geometry`` left it."""
        return penalties.made(Factor, "augmented_metric", penalties)

    def gauged(self, x: Vector) -> Vector:
        """Return G x."""
        return x.made(Vector, "gauged", x, size="nv")

    def partition_quality(self, rank: Factor, factor: Factor) -> Scalar:
        """Return det(D P G D^T) / det(D G D^T)."""
        return rank.made(Scalar, "partition_quality", rank, factor)

    def stored_factor(self, factor: Factor, prefix: str) -> Factor:
        """Return a factor as another function reads it, from ``<prefix>lower`` and ``<prefix>reciprocal``."""
        return Factor(self.tape, self.tape.add(Operation("stored_factor", (factor.index,), (prefix,))))

    def stored_constraints(self) -> Matrix:
        """Return D as ``geometry`` left it."""
        return self.tape.named(Matrix, "stored_constraints")

    def driving(self, accelerations: Vector) -> Scalar:
        """Return the power of the drivers of prescribed coordinates, without what they do against rows."""
        return accelerations.made(Scalar, "driving", accelerations)

    def holonomic_or(self, otherwise: Vector) -> Vector:
        """Return Phi, and in nonholonomic rows what stands in its place."""
        return otherwise.made(Vector, "holonomic_or", otherwise, size="m")
