"""Beams in a file: their table, and stiffness and mass by length from section and material."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, call, difference, literal_of, product, sum_of_terms
from symgen.describe.formulas.formula_text import file_value
from symgen.describe.parts.fields import (
    Across,
    Counts,
    Flag,
    Held,
    Scalar,
    Sides,
    StateVector,
    Vector,
    Vertices,
    value_in_words,
)
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.strain_times import StrainTimes


class ProfileSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The cross section of a beam: a rectangle, a circle or a tube.

    Parameters
    ----------
    width, height : scalar
        Of a rectangle [m]: across the plane of motion, and in it; in space along z and along y of the section.
    diameter : scalar
        Of a circle or a tube, from outside [m].
    thickness : scalar
        Of a tube's wall [m].
    """

    width: Scalar | None = None
    height: Scalar | None = None
    diameter: Scalar | None = None
    thickness: Scalar | None = None


class MaterialSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The material of a beam.

    Parameters
    ----------
    young : scalar
        Young's modulus [Pa].
    poisson : scalar
        Poisson's ratio; 0.3 by default.
    density : scalar
        [kg/m^3].
    """

    young: Scalar
    poisson: Scalar = 0.3
    density: Scalar


class BeamSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A beam: as many bodies as it has nodes, and beam elements between them.

    Parameters
    ----------
    start, end : vector
        Its ends without load, in the ground frame [m].
    line : list of vectors
        In place of them, the vertices of a line of straight segments that are joined rigidly [m].
    arc : scalar
        Angle by which the unloaded beam turns from start to end, to the left, in space towards `y_axis` [rad]; 0, a
        straight line, by default.
    y_axis : vector
        In space, a direction on the side of y of the section, or one for each segment; ``[0, 1, 0]`` by default.
    elements : int or list of int
        How many, spread over the segments by their lengths, or how many of each segment; compiled in, while all else
        may be expressions of parameters.
    section, material : table
        Cross section and material; or these stiffnesses and masses:
    axial, bending, torsion : scalar
        E A [N], E I [N m^2], in space one value or two, about y and z of the section, and G J [N m^2] in space.
    shear : scalar
        k G A [N], in space one value or two, along y and z; rigid by default. A beam with section and material has it.
    mass, rotary : scalar
        rho A [kg/m] and rho I [kg m], in space rho I about x, y and z.
    cable : bool
        Whether it neither bends nor pushes: nodes are point masses, and elements pull where they are longer than
        unloaded. It has `axial` and `mass`, or section and material; false by default.
    length : scalar
        Of a cable, its length without load [m]; that of its line by default.
    damping : scalar, or table
        Time of a Kelvin-Voigt material [s], or times by strain, ``{ axial, shear, torsion, bending }``; 0 by default.
    load : vector of functions of state
        Force by length in ground axes [N/m], where ``x``, ``y`` and ``z`` are the coordinates of the place.
    clamp : body name, or two
        Bodies that the start, or the start and the end are part of, where both are described; ``""`` for a free end.
    velocity, angular_velocity : vector, scalar
        Of the start, and of the whole beam as if it were rigid, at the start, in ground axes; completed by assembly by
        default.
    hold : bool, str or list of str
        As of a body.
    """

    start: Vector | None = None
    end: Vector | None = None
    line: Vertices | None = None
    arc: Scalar | None = None
    y_axis: Sides | None = None
    elements: Counts
    section: ProfileSection | None = None
    material: MaterialSection | None = None
    axial: Scalar | None = None
    shear: Across | None = None
    torsion: Scalar | None = None
    bending: Across | None = None
    mass: Scalar | None = None
    rotary: Across | None = None
    cable: Flag = False
    length: Scalar | None = None
    damping: Scalar | StrainTimes = 0.0
    load: StateVector | None = None
    clamp: str | tuple[str, ...] = ""
    velocity: Vector | None = None
    angular_velocity: Across | None = None
    hold: Held = False


@dataclass(frozen=True)
class Properties:
    """Keys of the elements of a beam, mass by length, and rotary inertia by length: one, in space about x, y and z."""

    stiffness: dict[str, Any]
    mass: Expr
    rotary: tuple[Expr, ...]


def section_properties(scope: Scope, beam: BeamSection) -> Properties:
    """Return stiffnesses and masses of a beam by its length.

    Raises
    ------
    InputError
        If a key is missing, duplicated or meaningless.
    """
    direct = ("axial", "shear", "torsion", "bending", "mass", "rotary")
    _refuse_keys_of_others(scope, beam)
    named = [key for key in direct if getattr(beam, key) is not None]
    if (beam.section is None) != (beam.material is None):
        missing = "section" if beam.section is None else "material"
        raise scope.error(missing, "a table, as section and material belong together", "no such key")
    if beam.section is not None and beam.material is not None:
        if named:
            raise scope.error(
                named[0], "no such key beside section and material", value_in_words(getattr(beam, named[0]))
            )
        whole = _properties_of_material(scope, beam.section, beam.material)
        return _without_bending(whole, len(whole.rotary)) if beam.cable else whole
    bends = () if beam.cable else ("bending", *(("torsion",) if scope.spatial else ()))
    for key in ("axial", *bends[:1], "mass", *bends[1:]):
        if getattr(beam, key) is None:
            raise scope.error(key, "a value, or the tables section and material", "no such key")
    keys = {key: getattr(beam, key) for key in direct[:4] if getattr(beam, key) is not None}
    assert beam.mass is not None, "the loop above requires it"
    mass = scope.constant("mass", beam.mass, positive=True)
    if beam.cable:
        return _without_bending(Properties(keys, mass, ()), 3 if scope.spatial else 1)
    return Properties(keys, mass, _rotary_inertias(scope, beam))


def _refuse_keys_of_others(scope: Scope, beam: BeamSection) -> None:
    """Refuse what a cable has not, and what a cable alone has."""
    keys = ("shear", "torsion", "bending", "rotary") if beam.cable else ("length",)
    for key in keys:
        if (value := getattr(beam, key)) is not None:
            beside = "beside" if beam.cable else "without"
            raise scope.error(key, f"no such key {beside} cable = true", value_in_words(value))
    if beam.cable and isinstance(beam.damping, StrainTimes):
        raise scope.error("damping", "one time, as a cable has one strain", "a table")


def _without_bending(properties: Properties, axes: int) -> Properties:
    """Return stiffness and mass of a cable."""
    return Properties({"axial": properties.stiffness["axial"]}, properties.mass, (ZERO,) * axes)


def _rotary_inertias(scope: Scope, beam: BeamSection) -> tuple[Expr, ...]:
    """Return rotary inertias; without them nodes would turn without a mass."""
    result = () if beam.rotary is None else scope.several("rotary", beam.rotary, 3 if scope.spatial else 1)
    if not all(scope.value(inertia, "rotary") > 0.0 for inertia in result or (ZERO,)):
        hint = "rho I of the section, density times second moment of area, makes the nodes' turns a motion"
        got = "no such key" if beam.rotary is None else value_in_words(beam.rotary)
        raise scope.error("rotary", "a rotary inertia by length above 0", got, hint)
    return result


def _properties_of_material(scope: Scope, section: ProfileSection, material: MaterialSection) -> Properties:
    young, density = (
        scope.constant(f"material.{k}", getattr(material, k), positive=True) for k in ("young", "density")
    )
    poisson = scope.constant("material.poisson", material.poisson)
    if not -1.0 < scope.value(poisson, "material.poisson") <= 0.5:
        raise scope.error("material.poisson", "a ratio above -1, at most 0.5", value_in_words(material.poisson))
    keys = {key: getattr(section, key) for key in section.__struct_fields__ if getattr(section, key) is not None}
    sizes = {key: scope.constant(f"section.{key}", value, positive=True) for key, value in keys.items()}
    if sizes.keys() == {"width", "height"}:
        area, moments, torsion = _rectangle_moments(sizes["width"], sizes["height"])
        factor = _shear_factor(poisson, (10.0, 10.0), (12.0, 11.0))
    elif sizes.keys() == {"diameter"}:
        area, moments, torsion = _ring_moments(sizes["diameter"], ZERO)
        factor = _shear_factor(poisson, (6.0, 6.0), (7.0, 6.0))
    elif sizes.keys() == {"diameter", "thickness"}:
        inner = difference(sizes["diameter"], product(literal_of(2.0), sizes["thickness"]))
        if not scope.value(inner, "section.thickness") >= 0.0:
            raise scope.error("section.thickness", "at most half of the diameter", value_in_words(section.thickness))
        area, moments, torsion = _ring_moments(sizes["diameter"], inner)
        factor = _shear_factor(poisson, (2.0, 2.0), (4.0, 3.0))
    else:
        expected = "width and height, diameter, or diameter and thickness"
        raise scope.error("section", expected, " and ".join(sizes) or "an empty table")
    modulus = call("div", young, product(literal_of(2.0), sum_of_terms(ONE, poisson)))
    about_y, about_z = moments
    shear = product(factor, product(modulus, area))
    bending = [file_value(product(young, about_y)), file_value(product(young, about_z))]
    stiffness: dict[str, Any] = {
        "axial": file_value(product(young, area)),
        "shear": file_value(shear),
        "bending": bending[1],
    }
    rotary: tuple[Expr, ...] = (product(density, about_z),)
    if scope.spatial:
        stiffness |= {"bending": bending, "torsion": file_value(product(modulus, torsion))}
        rotary = product(density, sum_of_terms(about_y, about_z)), product(density, about_y), product(density, about_z)
    return Properties(stiffness, product(density, area), rotary)


def _rectangle_moments(width: Expr, height: Expr) -> tuple[Expr, tuple[Expr, Expr], Expr]:
    """Return area, second moments about y and z, and the torsion constant (Saint-Venant's series)."""
    area, ratio = product(width, height), call("div", width, height)
    about_y = product(area, product(width, width), literal_of(1.0 / 12.0))
    about_z = product(area, product(height, height), literal_of(1.0 / 12.0))
    terms = [
        product(call("tanh", call("div", literal_of(0.5 * math.pi * k), ratio)), literal_of(k**-5.0))
        for k in range(1, 14, 2)
    ]
    sunk = product(literal_of(64.0 / math.pi**5), ratio, sum_of_terms(*terms))
    torsion = product(area, product(width, width), difference(literal_of(1.0 / 3.0), sunk))
    return area, (about_y, about_z), torsion


def _ring_moments(outer: Expr, inner: Expr) -> tuple[Expr, tuple[Expr, Expr], Expr]:
    """Return area, second moments and torsion constant of a circle with a hole."""
    squares = [product(d, d) for d in (outer, inner)]
    area = product(literal_of(0.25 * math.pi), difference(*squares))
    moment = product(area, sum_of_terms(*squares), literal_of(1.0 / 16.0))
    return area, (moment, moment), product(literal_of(2.0), moment)


def _shear_factor(poisson: Expr, above: tuple[float, float], below: tuple[float, float]) -> Expr:
    """Return the shear coefficient of a section (Cowper, J. Appl. Mech. 33 (1966) 335-340)."""
    first, second = (sum_of_terms(literal_of(a), product(literal_of(b), poisson)) for a, b in (above, below))
    return call("div", first, second)
