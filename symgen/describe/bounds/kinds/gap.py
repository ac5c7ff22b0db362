"""The section ``stops`` of files: gaps that formulas describe."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import ZERO
from symgen.base.vocabulary.measures import FormulaMeasure
from symgen.describe.bounds.elastic_stop import ElasticStop
from symgen.describe.bounds.end_stop import STOPS, EndStop, pieces_of
from symgen.describe.bounds.keys import SectionOfFiles
from symgen.describe.bounds.kinds.stop import read_stop
from symgen.describe.formulas.least import least_of
from symgen.describe.formulas.readings import is_angle
from symgen.describe.parts.fields import Scalar, StateFunction, read_table
from symgen.describe.parts.scope import Scope


class GapSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A gap that does not become negative: of a rope, of a follower on its cam, of a body over a floor.

    Parameters
    ----------
    gap : str
        An expression of t, parameters, inputs, smooth tables, coordinates of bodies, points and axes of them and
        coordinates of joints, such as ``"2.0 - sqrt(load.x**2 + load.y**2)"``. The force, which only pushes, is along
        its derivatives by the coordinates. The least of several gaps, as ``min(a, b)`` or ``a - abs(b)``, pushes along
        each of them.
    restitution : scalar
        Rate of the gap after an impact over that before, from 0 to 1; 0 by default.
    stiffness, damping : scalar
        Of an elastic stop, force over the depth beyond the gap [N/m or N m/rad], and over the rate of that
        [N s/m or N m s/rad].
    """

    gap: StateFunction
    restitution: Scalar | None = None
    stiffness: Scalar | None = None
    damping: Scalar | None = None


def read_gap(scope: Scope, raw: object) -> tuple[EndStop | ElasticStop, ...]:
    """Return the stop that a table of the section ``stops`` describes; of a rigid one a row for each piece of its gap.

    Parameters
    ----------
    scope : Scope
        The table's place.
    raw : object
        The table.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    section = read_table(GapSection, raw, scope.where(""))
    of = scope.of_row("gap", section.gap, speeds=False, inputs=True)
    unit = "rad" if is_angle(of) else "m"
    timely = ("t", *scope.context.values, *scope.context.inputs)
    stop = read_stop(scope, "", scope.name, scope.name, FormulaMeasure(of), ZERO, unit, section)
    return pieces_of(stop, least_of(of, timely)) if isinstance(stop, EndStop) else (stop,)


KIND = SectionOfFiles("stops", STOPS, GapSection, read_gap)
