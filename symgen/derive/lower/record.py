"""Recording of a law: what a method says becomes the functions of a law and its correction, as formulas before layout.

Code for one mechanism (`symgen.derive.lower.law`) and loops for all (`symgen.derive.lower.looped.looped_law`) are two
layouts of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import assert_never

from symgen.base.ir.program import Correction
from symgen.derive.lower.recorded_law import Part, RecordedLaw
from symgen.derive.methods._base import Acceleration, Dense, Iteration, Law, Method, TangentLaw, multiplier_law
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Factor, Scalar, Value, Vector

#: Operations that end in v' = M^-1 (f - D^T lambda), so that forces balance whatever the multipliers are.
_BALANCED = frozenset(("constrained", "minv"))


def record_law(
    method: Method, options: Mapping[str, str], driven: bool = False, correction: Correction | None = None
) -> RecordedLaw:
    """Record a method: its acceleration law, and its correction where it differs from the model's.

    `driven`: drivers prescribe coordinates of a tree, and their power is work. `correction` takes the place of the
    method's own.
    """
    recording = _Law(driven)
    recording.add_law(method.law(recording.system, options))
    correction = method.correction(options) if correction is None else correction
    recording.role = "metric"
    if correction.any and correction.metric != "scaled":  # which is the model's own
        recording.share = correction.share
        getattr(recording, f"{correction.metric}_metric")()
    if correction.energy:
        recording.sections["balance"] = ("one",)  # the target energy of the scaling of velocities
    return recording.recorded()


def record_multipliers(driven: bool) -> RecordedLaw:
    """Record a right-hand side of multipliers without a correction: what plans of elimination are compared by."""
    recording = _Law(driven)
    recording.add_law(multiplier_law(recording.system, recording.system.gamma))
    return recording.recorded()


class _Law:
    def __init__(self, driven: bool = False) -> None:
        self.driven = driven
        self.system = System()
        self.parts: list[Part] = []
        self.sections: dict[str, tuple[str, ...]] = {}
        self.form, self.role, self.share = "", "acceleration", ""

    def recorded(self) -> RecordedLaw:
        return RecordedLaw(
            tuple(self.system.tape.operations), tuple(self.parts), tuple(self.sections.items()), self.form
        )

    def add_part(self, name: str, purpose: str, *outputs: tuple[str, Value], flag: Value | None = None) -> None:
        places = tuple((place, value.index) for place, value in outputs)
        self.parts.append(Part(name, purpose, places, None if flag is None else flag.index, self.role))

    def add_law(self, law: Law) -> None:
        kind = ""
        if isinstance(law, Acceleration):
            self.form, flag = "direct", self.system.flag()
            rates = self.state_rates(law.acceleration, law.multipliers, law.position)
            outputs = [*rates, ("multipliers", law.multipliers)]
            self.add_part("rhs", "q', v', power and multipliers", *outputs, flag=flag)
            kind = self.system.tape.operations[law.acceleration.index].kind
        elif isinstance(law, Iteration):
            self.add_iteration(law)
            kind = "" if law.rates is None else "constrained"  # the rates of results
        elif isinstance(law, Dense):
            self.add_orthogonal_factorisation(law)
        elif isinstance(law, TangentLaw):
            self.add_tangent_basis()
        else:
            assert_never(law)
        if kind not in _BALANCED:
            self.add_balance()

    def add_balance(self) -> None:
        """Add what v' and the multipliers leave of the forces: rounding may move a law without any violation."""
        s = self.system
        forces = s.D.transposed(s.variable("multipliers", "m")) - s.f
        left = s.mass(s.variable("rates.v", "nv")) + forces
        self.role = "balance"
        self.add_part("balance", "M v' + D^T lambda - f in the section `change`", ("change", left))

    def state_rates(
        self,
        acceleration: Vector,
        multipliers: Vector,
        position: Vector | None = None,
        velocities: Vector | None = None,
    ) -> list[tuple[str, Value]]:
        """Return the rates of the state; forces do work at `velocities` where these differ from the state's."""
        s = self.system
        work = self.power_without_potential(acceleration, multipliers, velocities)
        return [("rates.q", position or s.q_rates), ("rates.v", acceleration), ("rates.work", work)]

    def power_without_potential(
        self, acceleration: Vector, multipliers: Vector, velocities: Vector | None = None
    ) -> Scalar:
        """Return the power of forces without potential and of drivers: those with rows, and those with coordinates."""
        s = self.system
        power = s.power + s.driving(acceleration) if self.driven else s.power
        if velocities is not None:
            power = power.apply(Scalar, "at_velocity", power, velocities)
        return power - multipliers.dot(s.nu)

    def add_iteration(self, law: Iteration) -> None:
        """Add the parts of an iterated law: ``begin``, ``iterate`` and ``finish``."""
        s, self.form = self.system, "iterated"
        first, change = law.state[0], law.increment
        # in the metric of M, relative to a motion at the mechanism's speed
        speed, length = s.scale("speed_scale"), s.scale("length_scale")
        usual = speed if law.rates is not None else speed * speed / length
        least = s.scale("mean_mass") * usual * usual
        relative = (change.dot(s.mass(change)) / (least + first.following.dot(s.mass(first.following)))).root()
        final = [s.variable(state.section, state.start.size) for state in law.state]
        if law.rates is None:
            finish = self.state_rates(final[0], final[1])
            if law.multipliers is not None:
                finish.append(("multipliers", law.multipliers))
        else:
            rates = law.rates
            finish = self.state_rates(rates.velocity, rates.multipliers, rates.position, rates.velocities)
            # the integrated quantity is not v: v' and lambda for results have their own law
            observed = multiplier_law(s, s.gamma)
            outputs = [
                *self.state_rates(observed.acceleration, observed.multipliers),
                ("multipliers", observed.multipliers),
            ]
            self.add_part("rates", "q', v' and multipliers for results", *outputs)
        for name, _ in s.tape.stored:
            self.sections[name] = ()
        for state in law.state:
            if state.section != "multipliers":
                self.sections[state.section] = (state.start.size,)
        begin = [*s.tape.stored, *((state.section, state.start) for state in law.state)]
        following = [(state.section, state.following) for state in law.state]
        self.add_part("begin", "matrices and start of the iteration", *begin)
        self.role = "iteration"
        self.add_part("iterate", "one iteration", *following, ("status.increment", relative))
        self.add_part("finish", "rates of the state, and power", *finish)
        if law.rates is not None:
            self.parts[-1] = replace(self.parts[-1], velocities=law.rates.velocities.index)

    # -- laws on dense matrices ----------------------------------------------------------------------------------------

    def add_dense_constraints(self) -> None:
        """Add D as a dense matrix, for the choice of independent columns, or for an orthogonal factorisation."""
        if "dense" not in self.sections:
            self.sections |= {"dependent": ("nv",), "dense": ("m", "nv")}
            self.add_part("expand", "D as a dense matrix", ("dense", self.system.stored_constraints()))

    def add_tangent_basis(self) -> None:
        """Add the parts of a law on a tangent basis."""
        s, self.form = self.system, "tangent"
        self.add_dense_constraints()
        basis = ("nv", "degrees")
        self.sections |= {"basis": basis, "trial": basis, "small": ("degrees", "degrees"), "reduced": ("degrees",)}
        self.sections |= {"force": ("nv",), "weighed": ("nv",)}
        constraints, rank = s.stored_constraints(), s.rank_factor()
        factor = s.stored_factor(rank, "")
        change, accelerations = s.variable("change", "nv"), s.variable("rates.v", "nv")
        left = s.f - s.mass(accelerations)
        multipliers = s.solve(factor, constraints @ s.gauged(left))
        multipliers = s.stored_constrained("scaled", "multipliers", rank, left, s.zeros("m"), multipliers)
        work = self.power_without_potential(accelerations, multipliers)
        aim = [("residual", -s.gamma), ("force", s.f)]
        struck, weighed = constraints @ change, s.mass(change)
        self.add_part("aim", "the section `residual` = -gamma, the section `force` = f", *aim)
        self.add_part("strike", "the section `residual` = D times `change`", ("residual", struck))
        self.add_part("weigh", "the section `weighed` = M times `change`", ("weighed", weighed))
        finish = (("rates.q", s.q_rates), ("multipliers", multipliers), ("rates.work", work))
        self.add_part("finish", "q', power and multipliers", *finish)

    def add_orthogonal_factorisation(self, law: Dense) -> None:
        """Add the parts of a law on an orthogonal factorisation of D^T."""
        s, self.form = self.system, "dense"
        self.add_dense_constraints()
        self.sections |= {name: ("m",) for name in ("row_length", "row_chosen", "row_corner", "row_factor")}
        self.sections |= {"basis": ("nv", "nv"), "small": ("nv", "nv"), "reduced": ("nv",), "force": ("nv",)}
        self.sections["weighed"] = ("nv",)
        change, multipliers = s.variable("change", "nv"), s.variable("multipliers", "m")
        work, weighed = self.power_without_potential(s.variable("rates.v", "nv"), multipliers), s.mass(change)
        aim = (("residual", law.target), ("force", s.f))
        self.add_part("aim", "the section `residual` = what D v' shall be, `force` = f", *aim)
        self.add_part("weigh", "the section `weighed` = M times `change`", ("weighed", weighed))
        self.add_part("finish", "q' and power", ("rates.q", s.q_rates), ("rates.work", work))

    # -- metrics of corrections ----------------------------------------------------------------------------------------

    def add_metric(self, name: str, purpose: str, *outputs: tuple[str, Value]) -> None:
        self.sections |= {"law_lower": (), "law_reciprocal": ()}
        self.add_part(name, purpose, *outputs)

    def add_refactor(self, matrix: str, factor: Factor) -> None:
        """Add ``refactor``, which the law's own ``geometry`` calls after the model's."""
        purpose = f"the factorisation of {matrix} from D, without the rows that depend on others"
        self.add_metric("refactor", purpose, ("law_", factor))

    def only_for_factors(self) -> None:
        """Mark the factor of the last part as one that solutions without factors need not."""
        part = self.parts[-1]
        self.parts[-1] = replace(part, factors=tuple(output for output in part.outputs if output[0] in ("", "law_")))

    def add_spread(self, change: Vector) -> None:
        if self.share:
            change = self.system.parameter(self.share) * change
        self.add_part(
            "spread", "the correction -D^+ times the section `residual`, of v, or of q by N", ("change", change)
        )

    def identity_metric(self) -> None:
        """Add a factorisation and spread in the metric of the identity, in which 1 rad weighs as 1 m: D D^T."""
        s = self.system
        rank = s.rank_factor()
        factor = s.weighted_factor(rank, "identity")
        self.add_refactor("D D^T", factor)
        self.only_for_factors()
        self.add_spread(_nearest_change(s, "identity", rank, _correcting_change(s, s.stored_factor(factor, "law_"))))

    def mass_metric(self) -> None:
        """Add a factorisation and spread in the metric of M: S = D M^-1 D^T, rows skipped as D G D^T decides."""
        s = self.system
        rank = s.rank_factor()
        factor = s.weighted_factor(rank, "mass")
        self.add_refactor("D M^-1 D^T", factor)
        self.only_for_factors()
        self.add_spread(
            _nearest_change(s, "mass", rank, s.minv(_correcting_change(s, s.stored_factor(factor, "law_"))))
        )

    def body_metric(self) -> None:
        """Add a factorisation and spread in the metric of the velocities of bodies that joints of a tree carry."""
        s = self.system
        rank = s.rank_factor()
        factor = s.weighted_factor(rank, "body")
        entries = s.body_entries()
        purpose = "Phi, nu, D, the pivots that decide rank, and the factorisation of D W^-1 D^T"
        self.sections["body_entry"] = ()
        self.add_metric("geometry", purpose, ("geometry", s.geometry(rank)), ("law_", factor), ("body_entry", entries))
        self.add_spread(s.body_inverse(_correcting_change(s, s.stored_factor(factor, "law_"))))

    def independent_metric(self) -> None:
        """Add geometry and spread that change dependent coordinates only: W^-1 = P G, P in ``dependent``."""
        s = self.system
        self.add_dense_constraints()
        chosen, rank = s.variable("dependent", "nv"), s.rank_factor(whole=True)
        factor = s.weighted_factor(rank, "dependent")
        written = ("status.partition_quality", s.partition_quality(rank, factor)), ("law_", factor)
        purpose = "Phi, nu, D, the pivots of D G D^T that decide rank, and the factorisation of D P D^T"
        self.add_metric("geometry", purpose, ("geometry", s.geometry(rank)), *written)
        self.add_spread(chosen.times(s.gauged(_correcting_change(s, s.stored_factor(factor, "law_")))))

    def augmented_metric(self) -> None:
        """Add the mass-orthogonal projection by iterations with M + a D^T D (Bayo and Ledesma 1996).

        ``(M + a D^T D) dv = -M delta - D^T (a r + lambda)``, ``delta += dv``, ``lambda += a r`` with the residual r of
        positions or velocities after the change; delta and lambda are kept in their own sections. The block raises
        lambda before it solves, so lambda begins at -a r.
        """
        s = self.system
        penalties = s.penalties(s.of_mean_mass(s.parameter("penalty")))
        factor = s.augmented_metric(penalties)
        self.add_refactor("M + a D^T D", factor)
        self.sections |= {"moved": ("nv",), "force_of_constraints": ("m",)}
        residual, moved = s.variable("residual", "m"), s.variable("moved", "nv")
        raised = s.variable("force_of_constraints", "m") + penalties.times(residual)
        pressed = raised + penalties.times(residual)
        right = s.mass(moved) + s.stored_constraints().transposed(pressed)
        x = s.solve(s.stored_factor(factor, "law_"), -right)
        outputs = (("change", x), ("moved", moved + x), ("force_of_constraints", raised))
        self.add_part("spread", "one iteration of the mass-orthogonal projection", *outputs)


def _correcting_change(s: System, factor: Factor) -> Vector:
    """Return ``-D^T (D W D^T)^-1 r`` of the section ``residual``."""
    y = s.solve(factor, -s.variable("residual", "m"))
    return s.stored_constraints().transposed(y)


def _nearest_change(s: System, metric: str, rank: Factor, by_factor: Vector) -> Vector:
    """Return the smallest change in a metric with ``D x = -r``."""
    return s.stored_constrained(metric, "change", rank, s.zeros("nv"), -s.variable("residual", "m"), by_factor)


def record_model() -> RecordedLaw:
    """Record the shared functions: geometry with the factor that decides rank, and x = -G D^T (D G D^T)^-1 r.

    G makes rows of one unit: 1 for translations, 1 / l^2 for rotations, l being the length of the body.
    """
    recording = _Law()
    s = recording.system
    rank = s.rank_factor()
    purpose = "Phi, nu, D, and the factorisation of D G D^T that decides rank"
    recording.add_part("geometry", purpose, ("geometry", s.geometry(rank)), ("", rank))
    recording.only_for_factors()
    recording.add_spread(_nearest_change(s, "scaled", rank, s.gauged(_correcting_change(s, s.stored_factor(rank, "")))))
    return recording.recorded()
