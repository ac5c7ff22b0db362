"""The tables of a mechanism file, except joints and forces, whose kinds describe themselves."""

from __future__ import annotations

from typing import Literal

import msgspec

from symgen.describe.fields import Numbers, Pair, PlainScalar, Points, PositiveNumber, Scalar, Text


class MechanismSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the mechanism is called and where it stands.

    Parameters
    ----------
    name : str
        Lower-case words joined by dashes.
    title, source : str
        One line for people; where the data come from.
    space : str
        ``"planar"``.
    gravity : pair
        Gravitational acceleration in the ground frame [m/s^2]; none unless given.
    """

    name: Text
    title: Text = ""
    source: Text = ""
    space: Literal["planar"] = "planar"
    gravity: Pair = (0.0, 0.0)


class RunSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a run uses where nothing else is asked for; all in seconds.

    Parameters
    ----------
    until, step, output_step : float
        End, step size and distance between outputs.
    predictable_until : float
        How long a chaotic motion can be predicted; absent where it is not chaotic.
    """

    until: PositiveNumber = 10.0
    step: PositiveNumber = 1e-3
    output_step: PositiveNumber | None = None
    predictable_until: PositiveNumber | None = None


class ParameterSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A number that stays adjustable at run time, given as ``name = 2.0`` or with its unit as a table.

    Parameters
    ----------
    value : float or str
        The default; a formula may use numbers only (``"pi/3"``).
    unit, note : str
        For people.
    """

    value: PlainScalar
    unit: Text = ""
    note: Text = ""


class TableSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A function of one argument by linear interpolation, constant beyond its ends; called as ``NAME(x)``.

    Parameters
    ----------
    x, y : list of float
        Points, `x` increasing.
    """

    x: Numbers
    y: Numbers


class BodySection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A rigid body or a point mass.

    Parameters
    ----------
    type : str
        ``"rigid"`` or ``"point"``; a point mass has no inertia, angle or points.
    mass : scalar
        [kg], above 0.
    inertia : scalar
        About the centre of mass [kg m^2], above 0.
    centre_of_mass : pair
        In the body's frame [m]; its origin unless given.
    points : table
        Named points in the body's frame [m].
    position : pair
        Where the origin of the body's frame starts [m]; approximately, as assembly closes the mechanism.
    angle : scalar
        How far the body's frame is turned at the start [rad].
    velocity : pair
        Of the centre of mass at the start [m/s]; completed by assembly unless given.
    angular_velocity : scalar
        At the start [rad/s]; completed by assembly unless given.
    """

    type: Literal["rigid", "point"] = "rigid"
    mass: Scalar
    inertia: Scalar | None = None
    centre_of_mass: Pair | None = None
    points: Points | None = None
    position: Pair = (0.0, 0.0)
    angle: Scalar | None = None
    velocity: Pair | None = None
    angular_velocity: Scalar | None = None


#: Sections whose entries are named tables -> what one entry is called.
NAMED = {"parameters": "parameter", "tables": "table", "bodies": "body", "joints": "joint", "forces": "force"}
#: All sections of a file.
SECTIONS = ("mechanism", "run", *NAMED)
