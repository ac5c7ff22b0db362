"""Scales of a mechanism, which make all decisions of a run independent of the units of length, mass and time.

Angles are compared with lengths by the lengths of bodies: twice the distance of a body's joints from its centre of
mass, the length of a bar with joints at its ends. The section ``gauge`` of w holds 1 for translations and 1 / l^2 for
rotations, so that D diag(gauge) D^T, which decides rank, has one unit in every row.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.exact import exact
from symgen.compile.loopcode.loop_instances import viewing
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.records import Run, Sizes, Span
from symgen.run.layout.start_records import Instant, Layout, Work

#: Least length of a body over that of the longest one, so that rounding does not decide.
LEAST_LENGTH = 1e-2
#: Least length of a row over a usual one, squared.
LEAST_ROW = 1e-2
#: Rows below this part of a usual one, squared, have vanished: their entries are rounding. A row of D in joint
#: coordinates is a sum of products of size 1 along a chain, of which rounding leaves some 1e-16.
VANISHED = 1e-18
#: Where nothing but places tells a length, it is looked for between these [m]; nearer places are one.
SHORTEST, LONGEST = 1e-12, 1e12
#: Bodies whose distances, squared, are below this part of a radius of gyration, squared, are in one place.
TOGETHER = 1e-6
#: A row has turned enough to be measured when it has turned by this [rad].
TURNED = 0.1
#: Rounding of a number of order 1.
ROUNDING = 2.0**-52
#: Speeds below this fraction of the scale of speeds are rest, whatever the tolerances are.
LEAST_SPEED = 1e-9
#: Error of speeds over their tolerance: the errors of many steps add up.
_ADDED_UP = 1e3


@exact()
def larger_number(a: float, b: float) -> float:
    """Return the larger of two numbers, `a` where one is nan: the same compiled and interpreted."""
    return b if b > a else a


@exact()
def entry_of(layout: Layout, w: Array, k: int) -> float:
    """Return structural entry `k` of D: a constant, or computed by ``geometry`` in the scratch array."""
    slot = layout.entries[3 * k + 2]
    return layout.constants[k] if slot < 0 else w[layout.jacobian + slot]  # type: ignore[no-any-return]  # arrays


@exact(entry=True)
def fill_jacobian(layout: Layout, w: Array, rows: Array) -> int:
    """Write the dense D, row after row, from the results of ``geometry``; return its number of rows."""
    for i in range(layout.m * layout.nv):
        rows[i] = 0.0
    for k in range(layout.constants.shape[0]):
        rows[layout.entries[3 * k] * layout.nv + layout.entries[3 * k + 1]] = entry_of(layout, w, k)
    return int(layout.m)


@exact()
def measure_lengths(geometry: abi.Measure, layout: Layout, now: Instant, work: Work) -> None:
    """Set the section ``gauge``, and the scales of lengths and masses, from D at the described positions.

    A body's length is twice the norm of the derivative of a joint's rows in metres by the body's angles, the largest
    over its joints; a body whose joints are all at its centre of mass has the length of the mechanism. Without such
    lengths the mechanism has the length by which rows turn (`turning_length`), else the distances of its bodies,
    or a radius of gyration where they are in one place.
    """
    w, spin, lengths, sums = now.w, layout.spin, work.x, work.scale
    entries, constants, rows = layout.entries, layout.constants, layout.rows
    for j in range(layout.nv):
        w[layout.gauge + j] = 1.0
        lengths[j] = sums[j] = 0.0
    geometry(layout.t, now.y, now.p, w)
    joint, longest = -1, 0.0
    for k in range(constants.shape[0] + 1):
        here = -2 if k == constants.shape[0] else rows[2 * entries[3 * k]]
        if here != joint:
            for j in range(layout.nv):
                lengths[j] = 4.0 * sums[j] if 4.0 * sums[j] > lengths[j] else lengths[j]
                longest = lengths[j] if lengths[j] > longest else longest
                sums[j] = 0.0
            joint = here
        if here >= 0 and rows[2 * entries[3 * k] + 1] == 1 and spin[entries[3 * k + 1]] >= 0:
            value = entry_of(layout, w, k)
            if math.isfinite(value):
                sums[spin[entries[3 * k + 1]]] += value * value
    extent = extent_of(layout, now.y)
    longest = longest if longest > 0.0 else turning_length(geometry, layout, now, work) ** 2
    apart, gyration = extent * extent, gyration_of(layout, w)
    longest = longest if longest > 0.0 else (apart if apart > TOGETHER * gyration else gyration)
    longest = longest if longest > SHORTEST * SHORTEST else 1.0
    least = LEAST_LENGTH * LEAST_LENGTH * longest
    for j in range(layout.nv):
        if spin[j] >= 0:
            square = lengths[spin[j]]
            square = longest if square == 0.0 else square
            w[layout.gauge + j] = 1.0 / (square if square > least else least)
    w[abi.LENGTH] = larger_number(math.sqrt(longest), extent)
    w[abi.MEAN_MASS] = mean_mass(layout, w)


@exact()
def mean_mass(layout: Layout, w: Array) -> float:
    """Return the average mass of a velocity; moments of inertia count over the square of a length.

    Without masses it is arbitrary: it weighs rows against M, which is 0.
    """
    total = 0.0
    for j in range(layout.nv):
        total += w[layout.mass + j] * w[layout.gauge + j]
    return float(total / max(1, layout.nv)) if total != 0.0 else 1.0


@exact()
def square_rows(layout: Layout, w: Array, squares: Array) -> None:
    """Set `squares` to the square of each row of D G^1/2 at the present position."""
    for i in range(layout.m):
        squares[i] = 0.0
    for k in range(layout.constants.shape[0]):
        value = entry_of(layout, w, k)
        squares[layout.entries[3 * k]] += value * value * w[layout.gauge + layout.entries[3 * k + 1]]


@exact()
def weigh_rows(layout: Layout, now: Instant) -> None:
    """Set the section ``row_weight`` to the inverse of the square of each row of D G^1/2 at the start.

    Rows that are short already there count as a tenth of a usual one.
    """
    w, weights = now.w, layout.row_weight
    square_rows(layout, w, part(w, weights, layout.m))
    for i in range(layout.m):
        usual = LEAST_ROW / (row_weight(layout, w, i) * row_weight(layout, w, i))
        w[weights + i] = 1.0 / larger_number(w[weights + i], usual)


@exact()
def extent_of(layout: Layout, y: Array) -> float:
    """Return the largest finite distance of a body from the mechanism's datum along an axis, 0 without bodies.

    Distances are not measured from the origin: decisions do not depend on where it lies.
    """
    largest = 0.0
    for i in range(layout.nq):
        away = abs(y[i] - layout.datum[i])
        if layout.lengths[i] != 0.0 and away > largest and math.isfinite(away):
            largest = away
    return largest


@exact()
def coarseness_of(layout: Layout, y: Array) -> float:
    """Return the largest finite coordinate that is a length: its rounding is what positions can resolve."""
    largest = 0.0
    for i in range(layout.nq):
        if layout.lengths[i] != 0.0 and abs(y[i]) > largest and math.isfinite(y[i]):
            largest = abs(y[i])
    return largest


@exact()
def turning_length(geometry: abi.Measure, layout: Layout, now: Instant, work: Work) -> float:
    """Return the way along which rows in metres turn by about 1 rad: of a rod its length; 0 where rows stay the same.

    Bodies are moved, each its own way, by more and more until a row has turned enough to be measured. `work.y` and
    `work.w` are overwritten.
    """
    y, w, other, there, entries = now.y, now.w, work.y, work.w, layout.entries
    count, step = layout.constants.shape[0], larger_number(SHORTEST, 8.0 * ROUNDING * coarseness_of(layout, now.y))
    for i in range(w.shape[0] if count > 0 and layout.m > 0 else 0):
        there[i] = w[i]
    while count > 0 and step < LONGEST:
        j = 0
        for i in range(layout.nq, y.shape[0]):
            other[i] = y[i]  # rows may read states of the file
        for i in range(layout.nq):
            other[i] = y[i]
            if layout.lengths[i] != 0.0:
                while layout.spin[j] >= 0:
                    j += 1
                other[i] += step * math.cos(j + 1.0)
                j += 1
        geometry(layout.t, other, now.p, there)
        row, way, size, change, length = -1, 0.0, 0.0, 0.0, 0.0
        for k in range(count + 1):
            here = -2 if k == count else entries[3 * k]
            if here != row:
                if change >= TURNED * TURNED * size and size > 0.0:
                    length = larger_number(length, math.sqrt(way * size / change))
                row, way, size, change = here, 0.0, 0.0, 0.0
            if here >= 0 and layout.rows[2 * here + 1] == 1 and layout.spin[entries[3 * k + 1]] < 0:
                before, after = entry_of(layout, w, k), entry_of(layout, there, k)
                way += (step * math.cos(entries[3 * k + 1] + 1.0)) ** 2
                size += before * before
                change += (after - before) ** 2
        if length > 0.0:
            return length if math.isfinite(length) else 0.0
        step *= 4.0
    return 0.0


@exact()
def gyration_of(layout: Layout, w: Array) -> float:
    """Return the square of the largest radius of gyration, 0 where no body turns."""
    largest = 0.0
    for j in range(1, layout.nv):
        first = layout.spin[j]
        if first > 0 and w[layout.mass + first - 1] > 0.0:
            largest = larger_number(largest, w[layout.mass + j] / w[layout.mass + first - 1])
    return largest


@exact()
def free_scale(layout: Layout, w: Array, j: int) -> float:
    """Return the scale of a velocity in the metric of shortest changes: a length, or an angle."""
    return float(w[abi.LENGTH] * math.sqrt(w[layout.gauge + j]))


@exact()
def size_of_change(layout: Layout, w: Array, change: Array) -> float:
    """Return the largest component of a change: angles in radians, lengths over the scale of lengths."""
    largest = 0.0
    for j in range(layout.nv):
        size = abs(change[j]) if layout.spin[j] >= 0 else abs(change[j]) / w[abi.LENGTH]
        largest = size if size > largest else largest
    return largest


@exact()
def speed_of(layout: Layout, w: Array, v: Array) -> float:
    """Return the largest speed: angular velocities count as speeds of points at the body's length."""
    largest = 0.0
    for j in range(layout.nv):
        size = abs(v[j]) / math.sqrt(w[layout.gauge + j])
        largest = size if size > largest else largest
    return largest


@exact()
def row_weight(layout: Layout, w: Array, i: int) -> float:
    """Return the factor that makes a row of Phi a length: 1, or the scale of lengths for an angle or a number."""
    return 1.0 if layout.rows[2 * i + 1] == 1 else float(w[abi.LENGTH])


def settle_scales(sizes: Sizes, span: Span, run: Run) -> None:
    """Set the scales of a run's states at its beginning, from the lengths computed at its start.

    `run.metric` converts coordinates and velocities to lengths and speeds (0 for angles, and for all after the
    velocities); `run.scales` converts them to numbers of order 1. A motion that begins at rest is taken to cross the
    mechanism in the time `span.duration`. The energy in motion is at least that of speeds within the tolerances: a
    motion that begins at rest, without a force, has no other energy to which errors could be compared.

    After the factors of both are the places that coordinates are measured from, as in `run.share`.
    """
    w, nq, width = run.w, sizes.nq, sizes.width
    for i in range(nq):
        run.metric[width + i] = run.scales[width + i] = run.share[width + i]
    for j in range(sizes.nv):
        run.metric[nq + j] = 1.0 / math.sqrt(w[sizes.gauge + j])
    length = w[abi.LENGTH]
    speed = max(w[abi.SPEED], length / span.duration)
    w[abi.SPEED] = speed
    for i in range(nq):
        run.scales[i] = 1.0 / length if run.metric[i] != 0.0 else 1.0
    for j in range(sizes.nv):
        run.scales[nq + j] = run.metric[nq + j] / speed
    open_speed = speed_within_tolerance(span, speed)
    run.gauges[abi.ENERGY_SCALE] = w[abi.MEAN_MASS] * open_speed * open_speed


def speed_within_tolerance(span: Span, speed: float) -> float:
    """Return the speed within the tolerances [m/s], at a scale of speeds [m/s]."""
    tolerance = span.atol * speed if span.relative != 0.0 else span.atol
    return _ADDED_UP * max(tolerance, LEAST_SPEED * speed)


@viewing
def weights_of(span: Span, run: Run) -> Array:
    """Return the factors of the elements of a state for their tolerances."""
    return run.scales if span.relative != 0.0 else run.share


def is_at_rest(sizes: Sizes, span: Span, run: Run) -> bool:
    """Return whether no velocity is more than its tolerance at the beginning or at the end of a step.

    What is left of the velocities of a mechanism that is held at rest is rounding, and so is the work of its forces.
    """
    weights, largest = weights_of(span, run), 0.0
    for i in range(sizes.nq, sizes.nq + sizes.nv):
        largest = max(largest, weights[i] * max(abs(run.y[i]), abs(run.trial[i])))
    return bool(largest <= tolerance_at_rest(span)) and not is_carried(span, run)


def is_carried(span: Span, run: Run) -> bool:
    """Return whether bodies move, as drivers of a tree move them whose coordinates are none of the state."""
    return bool(run.w[abi.KINETIC] > span.rtol * run.gauges[abi.ENERGY_SCALE])


def tolerance_at_rest(span: Span) -> float:
    """Return the tolerance of velocities at rest, over the factors of `weights_of`."""
    return float(max(span.atol, LEAST_SPEED) if span.relative != 0.0 else span.atol)


def error_with_work(sizes: Sizes, span: Span, run: Run, error: float, others: float) -> float:
    """Return the larger of two errors over their tolerances: of the work, and of all other elements of a state.

    The error of the work is relative to the energy in motion. The work enters no rate, but the balance of energy, and
    where drivers prescribe the whole motion nothing else is integrated.
    """
    at, least = sizes.nq + sizes.nv, span.atol
    if span.relative != 0.0:
        least *= run.w[abi.KINETIC] + abs(run.w[abi.POTENTIAL])
    allowed = least + span.rtol * max(run.gauges[abi.ENERGY_SCALE], abs(run.y[at]), abs(run.trial[at]))
    ratio = abs(error) / allowed if allowed > 0.0 else 0.0
    if ratio > others and is_at_rest(sizes, span, run):
        ratio = 0.0
    return ratio if ratio > others else others  # nan of the others stays nan
