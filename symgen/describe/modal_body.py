"""Modal bodies in a mechanism: modes with their integrals, and interfaces that they carry. Plain numbers, no NumPy."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import Expr

#: Largest number of modes of a body, and the number from which on it costs much more than it is worth.
MOST_MODES, MANY_MODES = 40, 20
#: Prefixes of the coordinates of modes, their velocities and their accelerations.
COORDINATE, SPEED, ACCELERATION = "m", "vm", "am"
PREFIXES = COORDINATE, SPEED, ACCELERATION
UNITS_OF_MODES = {COORDINATE: "m", SPEED: "m/s"}

Numbers = tuple[float, ...]
#: Rows of a square matrix, of one entry in the plane.
Matrix = tuple[Numbers, ...]


class ModalOutline(msgspec.Struct, frozen=True):
    """Lines of a modal body in pictures: points from its origin, how modes move them, and pairs that lines join."""

    points: tuple[Numbers, ...] = ()
    shapes: tuple[tuple[Numbers, ...], ...] = ()
    lines: tuple[tuple[int, int], ...] = ()


class ModalRow(msgspec.Struct, frozen=True):
    """A quantity that is linear in the coordinates of modes, such as a stress.

    Attributes
    ----------
    name, unit : str
        Those of the file.
    number : int
        Of several rows of one name, counted from 1; 0 for a single one.
    factors : Numbers
        By the coordinates of modes.
    """

    name: str
    number: int
    unit: str
    factors: Numbers

    @property
    def label(self) -> str:
        """The name in formulas, without the body's."""
        return f"{self.name}{self.number or ''}"


class HeldStretch(msgspec.Struct, frozen=True):
    """How a body stretches between two interfaces that joints hold: by ``m . growth m`` [m].

    Attributes
    ----------
    ends : tuple of str
        Names of the interfaces, without the body's.
    growth : tuple of Numbers
        By coordinates of modes [1/m].
    stiffness : float
        Along the line between the two [N/m].
    """

    ends: tuple[str, str]
    growth: tuple[Numbers, ...]
    stiffness: float


class PairedCouple(msgspec.Struct, frozen=True):
    """The couple along a body in space from one interface to another, over the stiffness against what it couples.

    Attributes
    ----------
    ends : tuple of str
        Names of the interfaces, without the body's.
    share : tuple of Numbers
        Three rows by coordinates of modes [1/m].
    """

    ends: tuple[str, str]
    share: tuple[Numbers, ...]


class Modal(msgspec.Struct, frozen=True):
    """The modes psi of a body about its centre of mass, which have neither momentum nor angular momentum.

    Their coordinates m1, m2, ... are lengths: the integral of psi_i . psi_j dm is the mass where i = j, else 0. A turn
    has one component in the plane and three in space.

    Attributes
    ----------
    growth : tuple of Matrix
        First derivatives of the inertia about the centre of mass by each coordinate [kg m].
    second : tuple of tuple of Matrix
        Halves of its second derivatives [kg].
    cross : tuple of tuple of Numbers
        Integrals of psi_i x psi_j dm [kg].
    stiffness : Numbers
        Mass times the squares of frequencies [N/m].
    mass : float
        [kg].
    inner : int
        How many modes there are besides those of interfaces.
    rows : tuple of ModalRow
        Quantities that formulas read.
    outline : ModalOutline
        For pictures.
    start : tuple of (str, Expr)
        Coordinates and velocities of modes that the file gives.
    stretches : tuple of HeldStretch
        Between pairs of interfaces.
    couples : tuple of PairedCouple
        Between pairs of interfaces in space.
    softening : Numbers
        Share of the stiffness that an acceleration less gravity takes away, by its components [s^2/m].
    stiffened : bool
        Whether interfaces move at second order in the coordinates of modes too, so that loads change the stiffness.
    """

    growth: tuple[Matrix, ...]
    second: tuple[tuple[Matrix, ...], ...]
    cross: tuple[tuple[Numbers, ...], ...]
    stiffness: Numbers
    mass: float
    inner: int
    rows: tuple[ModalRow, ...] = ()
    outline: ModalOutline = ModalOutline()
    start: tuple[tuple[str, Expr], ...] = ()
    stretches: tuple[HeldStretch, ...] = ()
    couples: tuple[PairedCouple, ...] = ()
    softening: Numbers = ()
    stiffened: bool = False

    @property
    def equations(self) -> tuple[object, ...]:
        """All that equations depend on, besides forces."""
        return self.growth, self.second, self.cross

    def names(self, prefix: str) -> tuple[str, ...]:
        """Return the names of coordinates, velocities or accelerations of modes, without the body's."""
        return names_of_modes(prefix, len(self.stiffness))


class InterfaceLoad(msgspec.Struct, frozen=True):
    """The force on an interface by the motion of its body, and from when on linear modes are in doubt.

    In body axes it is ``elastic m + shifted (r'' - g) + spread : (w'~ + w~ w~) + modal m''``; see
    `symgen.describe.reduction.integrals.Bearing`.
    """

    elastic: tuple[Numbers, ...]
    shifted: tuple[Numbers, ...]
    spread: tuple[tuple[Numbers, ...], ...]
    modal: tuple[Numbers, ...]
    stiffness: float
    length: float


class CarriedInterface(msgspec.Struct, frozen=True):
    """An interface of a modal body: a frame at `place` + `shape` m from the centre of mass, turned by `turn` m.

    Where loads stiffen the body, m . `curve` m is added to the one, and m . `twist` m to the other.
    """

    host: str
    place: Numbers
    shape: tuple[Numbers, ...]  # mode -> displacement
    turn: tuple[Numbers, ...]  # mode -> turn
    load: InterfaceLoad
    curve: tuple[tuple[Numbers, ...], ...] = ()
    twist: tuple[tuple[Numbers, ...], ...] = ()

    @property
    def equations(self) -> tuple[object, ...]:
        """All that equations depend on."""
        return self.host, self.place, self.shape, self.turn, *((self.curve, self.twist) if self.curve else ())


def names_of_modes(prefix: str, count: int) -> tuple[str, ...]:
    """Return the names m1, m2, ... of what modes have."""
    return tuple(f"{prefix}{i}" for i in range(1, count + 1))


def mode_number(label: str) -> int:
    """Return the number of a mode from the name of its coordinate or velocity, 0 where it is none."""
    prefix = label.rstrip("0123456789")
    digits = label[len(prefix) :]
    return int(digits) if prefix in (COORDINATE, SPEED) and digits and digits[0] != "0" else 0
