"""A model's digest: equal for two descriptions exactly when their generated code is the same.

The start (positions, angles, velocities, holds), title, source, run defaults and the values and notes of
parameters stay outside: they can change without compiling again. A number written in place of a parameter is inside.
"""

from __future__ import annotations

import msgspec

from symgen.describe.bounds.bounded_modes import rows_by_family
from symgen.describe.mechanism import Mechanism
from symgen.describe.remembered import compute_once
from symgen.describe.table_functions import Table

#: Raised when the canonical text changes its form, so that no digest is mistaken for one of the old form.
FORM = 1
#: Fields added after the form was fixed: empty ones are left out.
_LATER = (
    *("flexures", "pressed", "across", "speed", "backwards", "exponent", "changing", "resting", "alone", "words"),
    *("about", "edges", "leaving"),
)


def canonical_text(mechanism: Mechanism) -> str:
    """Return the text of all parts of `mechanism` on which the equations depend.

    Bodies, joints, forces, parameters and rows keep the declared order, which is the order of coordinates, multipliers
    and parameters in the generated code; tables and named points are sorted, as their order means nothing.
    """
    bodies = [
        [
            body.name,
            _canonical_value(body.mass),
            _canonical_value(body.inertia),
            _canonical_value(body.centre_of_mass),
            sorted([name, _canonical_value(point)] for name, point in body.points),
            *(_canonical_value(part.equations) for part in (body.modal, body.carried) if part is not None),
        ]
        for body in mechanism.bodies
    ]
    parts = [
        ["form", str(FORM)],
        ["name", mechanism.name],
        ["space", mechanism.space],
        ["gravity", _canonical_value(mechanism.gravity)],
        ["parameters", [[p.name, p.unit, *(["input"] if p.input else [])] for p in mechanism.parameters]],
        ["tables", sorted(_table_content(table) for table in mechanism.tables)],
        ["bodies", bodies],
        ["joints", [_canonical_value(joint) for joint in mechanism.joints]],
        ["forces", [_canonical_value(force) for force in mechanism.forces]],
    ]
    if mechanism.states:
        parts.append(["states", [[x.name, x.unit, _canonical_value(x.rate)] for x in mechanism.states]])
    if mechanism.rotors:
        parts.append(["rotors", [_canonical_value(rotor) for rotor in mechanism.rotors]])
    if mechanism.switchable:
        parts.append(["switchable", sorted(mechanism.switchable)])
    if mechanism.holding:
        parts.append(["holding", [_canonical_value(x) for x in mechanism.holding]])
    for family, rows in rows_by_family(mechanism).items():
        parts.append([family.part, [_canonical_value(row) for row in rows]])
    if mechanism.topology is not None:
        parts.append(["topology", _canonical_value(mechanism.topology)])
    return "\n".join(_canonical_value(part) for part in parts)


@compute_once
def digest(mechanism: Mechanism) -> str:
    """Return the SHA-256 of the canonical text in hexadecimal digits."""
    import hashlib

    return hashlib.sha256(canonical_text(mechanism).encode()).hexdigest()


def mechanism_digest(mechanism: Mechanism) -> str:
    """Return the digest of all of a mechanism: equations, start, values of parameters and defaults.

    Shapes, limits, remarks, author and revision stay outside, as nothing is computed with them, and so do the sources
    of inputs, which are part of forces.
    """
    import hashlib

    plain = msgspec.structs.replace(
        mechanism, shapes=(), limits=(), author="", revision="", input_formulas=(), beams=b"", bounded=(), remarks=()
    )
    # the text of structs, which older folders of sweeps and journals were named by
    text = msgspec.Struct.__repr__(plain).replace(", bounded=()", "").removesuffix(")")
    text += "".join(f", {family.part}={rows!r}" for family, rows in rows_by_family(mechanism).items()) + ")"
    for absent in (
        ", shapes=()",
        ", limits=()",
        ", author=''",
        ", revision=''",
        ", input_formulas=()",
        ", states=()",
        ", rotors=()",
        ", beams=b''",
        ", switchable=()",
        ", holding=()",
        ", remarks=()",
        ", restitution_law='newton'",
        ", pressed=()",
        ", across=()",
        ", speed=None",
        ", backwards=None",
        ", exponent=None",
        ", changing=False",
        ", resting=()",
        ", alone=False",
        ", words=''",
        ", about=None",
        ", edges=()",
        ", leaving=()",
        ", shown=''",
        ", modal=None",
        ", carried=None",
    ):
        text = text.replace(absent, "")
    return hashlib.sha256(text.encode()).hexdigest()


def _table_content(table: Table) -> list[str]:
    """Return the content of a table; a linear one has the content that it had when all tables were linear."""
    how = [] if table.interpolation == "linear" else [table.interpolation, str(table.periodic)]
    how += [_canonical_value(table.slopes)] if table.slopes else []
    return [table.name, _canonical_value(table.x), _canonical_value(table.y), *how]


def _canonical_value(value: object) -> str:
    """Return `value` as text that differs wherever values differ: strings quoted, floats to the last digit."""
    if isinstance(value, msgspec.Struct):
        fields = [field for field in value.__struct_fields__ if field not in _LATER or getattr(value, field)]
        inner = " ".join(f"{field}={_canonical_value(getattr(value, field))}" for field in fields)
        return f"{type(value).__name__}({inner})"
    if isinstance(value, list | tuple):
        return "[" + " ".join(_canonical_value(item) for item in value) + "]"
    if isinstance(value, float):
        # -0.0 equals 0.0 and leads to the same equations.
        return repr(value + 0.0)
    return repr(value)
