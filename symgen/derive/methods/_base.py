"""Constraint stabilisation methods: an acceleration law, a correction after each accepted step, parameters.

A method is a formula over named blocks (`symgen.derive.methods._system.System`), lowered like everything else, so one
file serves every layout of the emitted code.
"""

from __future__ import annotations

import hashlib
import inspect
import marshal
from abc import ABC, abstractmethod
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import ClassVar

from symgen.base.errors import InputError, suggest
from symgen.base.ir.program import Correction
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Scalar, Vector


@dataclass(frozen=True)
class MethodParameter:
    """A numerical parameter of a method, set at run time.

    Parameters
    ----------
    name, unit, note : str
        `note` describes its effect and the source of the default.
    default, minimum : float
        Values below `minimum` are refused.
    """

    name: str
    default: float
    unit: str
    note: str
    minimum: float = 0.0


@dataclass(frozen=True)
class MethodOption:
    """A choice, usually one that changes the emitted code.

    Parameters
    ----------
    name, note : str
        `note` describes its effect.
    values : tuple of str
        The first one is the default.
    emitted : bool
        Whether the emitted code depends on it; if not, it sets parameters of a run.
    """

    name: str
    values: tuple[str, ...]
    note: str
    emitted: bool = True


@dataclass(frozen=True)
class Acceleration:
    """A law in closed form.

    Parameters
    ----------
    acceleration : Vector
        v'.
    multipliers : Vector
        lambda.
    position : Vector, optional
        q' where it is not N v.
    """

    acceleration: Vector
    multipliers: Vector
    position: Vector | None = None


@dataclass(frozen=True)
class Iteration:
    """A law that is iterated until v' converges.

    Parameters
    ----------
    state : tuple of IterationState
        Iterated vectors; the first one is v', the second the multipliers.
    increment : Vector
        The change of the first one in an iteration, which ends when this is small.
    rates : Rates, optional
        The rates of the state where they are not v and v' as iterated.
    multipliers : Vector, optional
        lambda for results where it is not the iterated one.
    """

    state: tuple[IterationState, ...]
    increment: Vector
    rates: Rates | None = None
    multipliers: Vector | None = None


@dataclass(frozen=True)
class Rates:
    """Rates of the vectors integrated in place of q and v.

    Parameters
    ----------
    position, velocity : Vector
        q' and v'.
    velocities : Vector
        Velocities in the power of forces.
    multipliers : Vector
        lambda.
    """

    position: Vector
    velocity: Vector
    velocities: Vector
    multipliers: Vector


@dataclass(frozen=True)
class IterationState:
    """A vector that an iteration changes.

    Parameters
    ----------
    section : str
        Its section of ``w``.
    start, following : Vector
        Its initial and its next value.
    """

    section: str
    start: Vector
    following: Vector


@dataclass(frozen=True)
class TangentLaw:
    """A law on a basis R of the tangent space: v' = b + R z', D R = 0, D b = gamma, R^T M R z' = R^T (f - M b)."""


@dataclass(frozen=True)
class Dense:
    """The law ``M v' + D^T lambda = f``, ``D v' = target`` by a rank-revealing orthogonal factorisation of D^T."""

    target: Vector


@dataclass(frozen=True)
class Descriptor:
    """The constraints that implicit integrators solve with ``M v' + D^T lambda = f``.

    Parameters
    ----------
    level : {"acceleration", "position", "stabilised", "projected", "explicit"}
        ``D v' = g + e lambda``; ``Phi = 0``; ``Phi = 0`` and ``D v = nu`` with ``q' = N (v - D^T eta)``; ``Phi = 0``
        with the terms for projections to the other levels; or ``Phi = 0`` and ``D v = nu`` with M and D as the only
        derivatives, for schemes that evaluate forces explicitly.
    target : Vector, optional
        g of the acceleration level.
    compliance : Vector, optional
        e of the acceleration level for each row; 0 by default.
    """

    level: str
    target: Vector | None = None
    compliance: Vector | None = None


#: Forms of problems that explicit integrators solve with the law alone; all others have a descriptor form.
EXPLICIT_FORMS = frozenset(("ode", "one-step", "semi-implicit", "symmetric"))

Law = Acceleration | Iteration | TangentLaw | Dense


class Method(ABC):
    """Base of all methods.

    Class attributes
    ----------------
    name : str
        Lower-case name, as typed.
    summary, reference : str
        One line, and the literature.
    forms : tuple of str
        Problem forms of the method: ``ode`` for explicit integrators; ``index-1``, ``index-2`` or ``index-3`` for
        implicit ones.
    default_integrator : str
        Integrator of runs by default: ``picard`` for laws whose right-hand side has a form in vectors, ``dop853`` for
        laws that iterate, choose coordinates or factorise in loops.
    integrates : str
        ``"all"`` coordinates, or only the ``"independent"`` ones of a partition.
    dense : str
        Reason why the method has no looped shape, as the rest of a sentence; empty if it has one.
    velocities_follow : bool
        Whether every step enforces the positions and derives velocities by the integrator's formula: they violate their
        constraint by its error, which does not grow with time.
    unique_multipliers : bool
        Whether the law determines the multipliers of dependent rows; else results have those of minimum norm.
    """

    name: ClassVar[str]
    summary: ClassVar[str]
    reference: ClassVar[str]
    forms: ClassVar[tuple[str, ...]] = ("ode",)
    parameters: ClassVar[tuple[MethodParameter, ...]] = ()
    options: ClassVar[tuple[MethodOption, ...]] = ()
    default_integrator: ClassVar[str] = "picard"
    integrates: ClassVar[str] = "all"
    dense: ClassVar[str] = ""
    velocities_follow: ClassVar[bool] = False
    unique_multipliers: ClassVar[bool] = False

    @abstractmethod
    def law(self, system: System, options: Mapping[str, str]) -> Law:
        """Return the law as a formula over the blocks of `system`."""

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the descriptor form for implicit integrators, None for a method of explicit ones only."""
        return None

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return the correction after each accepted step; none by default."""
        return Correction()

    def complete_options(self, values: Mapping[str, str]) -> dict[str, str]:
        """Return the options that the emitted code depends on, completed by the defaults.

        Raises
        ------
        InputError
            If an option or its value is unknown.
        """
        options = {o.name: o for o in self.options}
        for name, value in values.items():
            if name not in options:
                numbers = [p.name for p in self.parameters]
                got = f"'{name}'" + (", a number that runs are given" if name in numbers else "")
                hint = suggest(name, options if name in numbers else [*options, *numbers]) or "it has none"
                raise InputError(f"option {self.name}.{name}", "an option of the method", got, hint)
            if value not in options[name].values:
                raise InputError(
                    f"option {self.name}.{name}",
                    "one of " + ", ".join(options[name].values),
                    f"'{value}'",
                    suggest(value, options[name].values),
                )
        return {o.name: values.get(o.name, o.values[0]) for o in self.options if o.emitted}

    def needs_regular_mass(self, options: Mapping[str, str]) -> bool:
        """Whether the method excludes massless bodies."""
        return options.get("weight") == "mass"

    def stem(self, options: Mapping[str, str], implicit: bool = False) -> str:
        """Return the file stem of the emitted module: the method, non-default options, the form if implicit.

        For a method from outside the package it includes a digest of the code.
        """
        chosen = (options[o.name] for o in self.options if o.emitted and options[o.name] != o.values[0])
        parts = [self.name, *chosen, *(("implicit",) if implicit else ()), *_digest_of_registered(type(self))]
        return "_".join(parts).replace("-", "_")

    def largest_step(self, parameters: Mapping[str, float], boundary: float) -> float | None:
        """Return the largest stable step of the law, None without a limit.

        Parameters
        ----------
        parameters : mapping
            Values of the method's parameters.
        boundary : float
            End of the integrator's region of stability on the negative real axis.
        """
        return None

    def placed(self, options: Mapping[str, str], zero: complex | None, integrator: str) -> dict[str, float]:
        """Return the default parameters that follow from the integrator; none unless overridden.

        Parameters
        ----------
        options : mapping
            The structural options, complete.
        zero : complex or None
            The zero of the integrator's stability function nearest to the negative real axis.
        integrator : str
            Its name.
        """
        return {}


@lru_cache(maxsize=32)
def _digest_of_registered(kind: type[Method]) -> tuple[str, ...]:
    """Return the digest of a method registered by hand: the key of the cache covers symgen's sources only."""
    outside = [base for base in kind.__mro__ if base.__module__.partition(".")[0] not in ("symgen", "builtins", "abc")]
    if not outside:
        return ()
    digest = hashlib.sha256()
    for base in outside:
        with suppress(OSError, TypeError):  # a class typed at a prompt has no file
            digest.update(Path(inspect.getfile(base)).read_bytes())
        for name, value in sorted(vars(base).items()):
            code = getattr(value, "__code__", None)
            text = repr(value).encode() if isinstance(value, str | int | float | tuple) else b""
            digest.update(name.encode() + (text if code is None else marshal.dumps(code)))
    return (digest.hexdigest()[:8],)


def multiplier_law(system: System, gamma: Vector) -> Acceleration:
    """Solve ``M v' + D^T lambda = f``, ``D v' = gamma`` by eliminating v'."""
    return Acceleration(*system.constrained(system.f, gamma))


def augmented_iteration(system: System, penalty: Scalar | Vector, target: Vector) -> Iteration:
    """Return the augmented Lagrangian iteration for D v' = target.

    ``(M + a D^T D) dv' = f - M v' - D^T (lambda + a (D v' - target))``, ``v' += dv'``, ``lambda += a (D v' -
    target)``, from ``v' = M^-1 f`` (0 where M is singular) and ``lambda = 0``. This is the iteration of
    Bayo, Garcia de Jalon and Serna (1988) in increments, so that rounding is that of the residual, not of a times the
    residual.
    """
    penalties = system.penalties(penalty)
    factor = system.keep_factor(system.augmented_factor(penalties))
    penalties = system.keep("kept_penalties", penalties)
    constraints = system.keep_constraints()
    force, target = system.keep("kept_force", system.f), system.keep("kept_target", target)
    rows, columns = target.size, force.size
    v = system.variable("kept_acceleration", columns)
    multipliers = system.variable("multipliers", rows)
    residual = constraints @ v - target
    right = force - system.mass(v) - constraints.transposed(multipliers + penalties.times(residual))
    increment = system.solve(factor, right)
    following = v + increment
    raised = multipliers + penalties.times(constraints @ following - target)
    return Iteration(
        (
            IterationState("kept_acceleration", system.free_acceleration, following),
            IterationState("multipliers", system.zeros(rows), raised),
        ),
        increment,
    )


TOLERANCE = MethodParameter(
    "tolerance", 1e-13, "m", "|Phi| at which the position iteration ends, times the mechanism's length"
)
WEIGHT = MethodOption("weight", ("identity", "mass", "body"), "metric of the correction")
SOLVER = MethodOption(
    "solver",
    ("elimination", "augmented", "dense"),
    "how the law is solved: by elimination of v'; with M + W D^T D, for light and massless bodies; or by a dense, "
    "rank-revealing orthogonal factorisation, the last resort",
)


class MultiplierMethod(Method):
    """Base of the methods that solve ``M v' + D^T lambda = f``, ``D v' = target`` and differ in the target only.

    Very light bodies spoil the elimination, whose matrix S = D M^-1 D^T mixes 1 / m of all bodies, and massless ones
    forbid it: the residual form of the augmented iteration then solves the same equations. A dense factorisation of
    D^T, which decides rank without squares, is an option.
    """

    forms: ClassVar[tuple[str, ...]] = ("ode", "index-1")
    options: ClassVar[tuple[MethodOption, ...]] = (SOLVER,)

    def target(self, system: System) -> Vector:
        """Return the right-hand side of D v'; gamma by default."""
        return system.gamma

    def chosen_target(self, system: System, options: Mapping[str, str]) -> Vector:
        """Return the right-hand side of D v' for some options; `target` by default."""
        return self.target(system)

    def law(self, system: System, options: Mapping[str, str]) -> Law:
        """Return the elimination of v', the iteration for light bodies, or the dense factorisation."""
        target = self.chosen_target(system, options)
        if options["solver"] == "augmented":
            return augmented_iteration(system, system.heavy_penalty, target)
        return Dense(target) if options["solver"] == "dense" else multiplier_law(system, target)

    def descriptor(self, system: System, options: Mapping[str, str]) -> Descriptor | None:
        """Return the same equations without elimination."""
        return Descriptor("acceleration", self.chosen_target(system, options))
