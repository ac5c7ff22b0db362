"""M at a state, with all that is off its diagonal, and the velocities nearest to given ones in its metric.

Formulas give entries of bodies, then the rates of rotors, then their inertias: accelerations, impulses and starts have
one M. Where it is diagonal, none of this is compiled.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.exact import copy_numbers, exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.redundancy import is_off
from symgen.run.layout.scales import fill_jacobian
from symgen.run.layout.start_records import Instant, Layout, MassTable, Work
from symgen.run.starts.impulse import Impulse, sizes_of_impulse, smallest_impulse

if TYPE_CHECKING:
    from collections.abc import Sequence


class Masses(NamedTuple):
    """What formulas say of an M that is not diagonal, in coordinates of bodies.

    Attributes
    ----------
    formulas : emitted function
        Entries of bodies, rates of rotors, inertias of rotors.
    entries : sequence of (int, int)
        Row and column of each entry.
    rotors : int
        Number of rotors.
    """

    formulas: Any
    entries: Sequence[tuple[int, int]]
    rotors: int


def room_of_masses(layout: Layout, masses: Masses) -> tuple[int, int]:
    """Return the numbers and the integers that `project_velocities` works on."""
    n, k = layout.nv, layout.m + layout.nv
    return sum(sizes_of_impulse(n, k)) + len(masses.entries) + (3 + n) * masses.rotors, max(n, k)


@exact()
def put_entries(n: int, places: Integers, values: Array, mass: Array) -> None:
    """Write entries of a symmetric M at their places, pairs of a row and a column."""
    for e in range(places.shape[0] // 2):
        row, column = places[2 * e], places[2 * e + 1]
        mass[row * n + column] = mass[column * n + row] = values[e]


@exact()
def add_rotors(n: int, turning: Array, inertias: Array, mass: Array) -> None:
    """Add J r^T r of each rotor of inertia J and rate r v."""
    for r in range(inertias.shape[0]):
        for i in range(n):
            for j in range(n):
                mass[i * n + j] += inertias[r] * (turning[r * n + i] * turning[r * n + j])


@exact()
def fill_mass(
    formulas: abi.Observe,
    masses: MassTable,
    layout: Layout,
    now: Instant,
    work: Work,
    room: Array,
    mass: Array,
) -> None:
    """Write M at a state. The rates of rotors are linear in v: differences of values at unit velocities and at rest.

    `work.y`, `work.w` and `work.direction` are overwritten.
    """
    n, nq, rotors, entries, w = layout.nv, layout.nq, masses.rotors, masses.places.shape[0] // 2, now.w
    out, other = part(room, 0, entries + 2 * rotors), work.y
    turning, still = part(room, entries + 2 * rotors, rotors * n), part(room, entries + (2 + n) * rotors, rotors)
    copy_numbers(now.y, other, layout.ny)
    copy_numbers(w, work.w, work.w.shape[0])
    for i in range(layout.ny):
        work.direction[i] = 0.0
    for column in range(-1, n if rotors > 0 else 0):
        for j in range(n):
            other[nq + j] = 1.0 if j == column else 0.0
        formulas(layout.t, other, now.p, work.w, work.direction, out)
        for r in range(rotors):
            if column < 0:
                still[r] = out[entries + r]
            else:
                turning[r * n + column] = out[entries + r] - still[r]
    for j in range(n * n):
        mass[j] = 0.0
    for j in range(n):
        mass[j * n + j] = w[layout.mass + j]
    put_entries(n, masses.places, out, mass)
    add_rotors(n, turning, part(out, entries + rotors, rotors), mass)


@exact(entry=True)
def project_velocities(formulas: abi.Observe, masses: MassTable, layout: Layout, now: Instant, work: Work) -> int:
    """Set the velocities to the nearest ones with D v = nu, in the metric of M; return 1 if there are none.

    That is what the smallest impulse does. Velocities that must not change are rows of their own.
    """
    n, nq, m, numbers, w = layout.nv, layout.nq, layout.m, work.numbers, now.w
    k = most = m + n
    at = n * n
    mass, rows, values = part(numbers, 0, at), part(numbers, at, k * n), part(numbers, at + k * n, k)
    at += k * n + k
    unit, scale, after = part(numbers, at, n), part(numbers, at + n, k), part(numbers, at + n + k, n)
    at += 2 * n + k
    impulses, change, basis = part(numbers, at, k), part(numbers, at + k, n), part(numbers, at + k + n, n * n)
    at += k + n + n * n
    matrix, right, x = (
        part(numbers, at, most * n),
        part(numbers, at + most * n, most),
        part(numbers, at + most * n + most, most),
    )
    at += most * n + 2 * most
    room, left = part(numbers, at, most * n + 2 * most), at + most * n + 2 * most
    impulse = Impulse(
        mass, rows, values, unit, scale, after, impulses, change, basis, matrix, right, x, room, work.order
    )
    fill_mass(formulas, masses, layout, now, work, part(numbers, left, numbers.shape[0] - left), mass)
    fill_jacobian(layout, w, rows)
    for i in range(m):
        off = is_off(layout, i, w)
        values[i] = 0.0 if off else w[layout.nu + i]
        for j in range(n if off else 0):
            rows[i * n + j] = 0.0
    k = m
    for j in range(n):
        work.x[j] = now.y[nq + j]
        if layout.unchanged[j] != 0:
            values[k] = work.x[j]
            for i in range(n):
                rows[k * n + i] = 1.0 if i == j else 0.0
            k += 1
    code = smallest_impulse(n, k, work.x, impulse)
    for j in range(n):
        now.y[nq + j] = after[j]
    return int(code)


@exact(entry=True)
def project_nothing(formulas: abi.Observe, masses: MassTable, layout: Layout, now: Instant, work: Work) -> int:
    """Replace `project_velocities` where M is diagonal, so that it is not compiled."""
    return 0
