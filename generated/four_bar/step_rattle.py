"""One step of the scheme `rattle`: Andersen, J. Comput. Phys. 52 (1983) 24-34, doi 10.1016/0021-9991(83)90014-1.

Written by symgen from the source of its own loops.
"""

import math
from collections import namedtuple as record

from numba import njit

Sizes = record("Sizes", 'nq nv m ny width controlled unknowns pivots multipliers mask change gauge row_weight jacobian auxiliary states')
Span = record("Span", 'step largest until end duration rtol atol relative safety most pause turn')
Run = record("Run", 'y trial p w iw clock gauges control passages memory share metric scales room')
ModelSystem = record("ModelSystem", 'sizes rhs confirm accept turn residual tangent')
ConstrainedStages = record("ConstrainedStages", 'a c stages spins nonholonomic slopes numbers plan')

COLUMNS = 7
DIVERGED = -1.0
ENTRIES = 1
EVALUATIONS = 3
FACTORISED = 6
FACTORS = 12
JACOBIANS = 8
LENGTH = 6
MULTIPLIER = -2
NEWTON_ITERATIONS = 9
ORDER = 10
OWN = 18
PLACES = 9
POOL = 20
PREFERRED = 0.001
PROBING = 5
ROOM = 5
ROWS = 8
SIZE = 0
SKIPPED = 1e-13
SLOTS = 11
SOURCES = 13
STEP_STATUS = 12
TERMS = 2
THRESHOLD = 0.0001
TOO_LARGE = -2.0
WORK = 19
_END = 3
_LOWER = 2
_MARK = 5
_MOST_ITERATIONS = 50
_NEXT = 7
_PIVOT_ROW = 8
_PLACE = 0
_REACHED = 4
_STACK = 6
_TOO_SMALL = -1
_UPPER = 1

@njit(error_model="numpy")
def prepare(system, scheme, span, run):
    for i in range(system.sizes.nv + system.sizes.m):
        run.memory[i] = 0.0

@njit(error_model="numpy")
def part(array, first, size):
    return array[first:first + size]

@njit(error_model="numpy")
def step_parts(sizes, room):
    n, unknowns, width = (sizes.nv + sizes.m, sizes.unknowns, sizes.width)
    right, x, factors = (part(room, 0, n), part(room, n, n), part(room, 2 * n, 2))
    at = 2 * n + 2
    k, rest = (part(room, at, unknowns), part(room, at + unknowns, unknowns + sizes.m))
    at += 2 * unknowns + sizes.m
    held, moved, end = (part(room, at, width), part(room, at + width, sizes.nv), at + width + sizes.nv)
    return (right, x, factors, k, rest, held, moved, part(room, end, room.shape[0] - end))

@njit(error_model="numpy")
def copied(width, array, out):
    for i in range(width):
        out[i] = array[i]

@njit(error_model="numpy")
def advance_coordinates(system, run, delta, trial):
    nq, nv, change = (system.sizes.nq, system.sizes.nv, system.sizes.change)
    if nq == nv:
        for i in range(nq):
            trial[i] = run.y[i] + delta[i]
        return
    for i in range(nq):
        trial[i] = run.y[i]
    for j in range(nv):
        run.w[change + j] = delta[j]
    system.turn(trial, run.w)

@njit(error_model="numpy")
def slopes_at(system, scheme, run, t, y, k, place):
    count = scheme.slopes.shape[0] // 2
    system.tangent(t, y, k, run.p, run.w, part(scheme.slopes, place * count, count))

@njit(error_model="numpy")
def assemble_matrix(plan, sources, coefficients, numbers):
    slots, factors = (part(plan, plan[SLOTS], plan[TERMS]), part(plan, plan[FACTORS], plan[TERMS]))
    origin = part(plan, plan[SOURCES], plan[TERMS])
    for i in range(plan[ENTRIES]):
        numbers[i] = 0.0
    for i in range(plan[TERMS]):
        numbers[slots[i]] += coefficients[factors[i]] * sources[origin[i]]

@njit(error_model="numpy")
def factorise_again(plan, numbers):
    n, size, work, room = (plan[SIZE], plan[ENTRIES], plan[WORK], plan[ROOM])
    columns, places = (part(plan, plan[COLUMNS], n + 1), part(plan, plan[PLACES], size))
    upper, lower = (part(plan, work + _UPPER * n, n), part(plan, work + _LOWER * n, n))
    end = part(plan, work + _END * n, n)
    positions = part(plan, plan[POOL], room)
    values, inverse, x = (part(numbers, 0, size), part(numbers, size + 2 * n, n), part(numbers, size + 3 * n, n))
    least, pool = (part(numbers, size + 4 * n, n), part(numbers, size + 5 * n, room))
    for k in range(n):
        for i in range(columns[k], columns[k + 1]):
            x[places[i]] = values[i]
        for i in range(upper[k], lower[k]):
            j = positions[i]
            u = x[j]
            x[j] = 0.0
            pool[i] = u
            for e in range(lower[j], end[j]):
                x[positions[e]] -= pool[e] * u
        pivot, largest = (x[k], 0.0)
        x[k] = 0.0
        reciprocal = 1.0 / pivot if pivot != 0.0 else 0.0
        for e in range(lower[k], end[k]):
            entry = x[positions[e]]
            x[positions[e]] = 0.0
            largest = max(largest, abs(entry))
            pool[e] = entry * reciprocal
        if not (abs(pivot) > least[k] and abs(pivot) >= THRESHOLD * largest):
            return False
        inverse[k] = reciprocal
    return True

@njit(error_model="numpy")
def filled_rows(plan, k):
    n, work = (plan[SIZE], plan[WORK])
    columns, rows, positions = (plan[COLUMNS], plan[ROWS], plan[POOL])
    place, lower = (part(plan, work + _PLACE * n, n), part(plan, work + _LOWER * n, n))
    end = part(plan, work + _END * n, n)
    reached, mark = (part(plan, work + _REACHED * n, n), part(plan, work + _MARK * n, n))
    stack, following = (part(plan, work + _STACK * n, n), part(plan, work + _NEXT * n, n))
    top = n
    for i in range(plan[columns + k], plan[columns + k + 1]):
        if mark[plan[rows + i]] == k:
            continue
        depth = 0
        stack[0] = plan[rows + i]
        following[0] = 0
        mark[stack[0]] = k
        while depth >= 0:
            j = place[stack[depth]]
            deeper = False
            if j >= 0:
                e = lower[j] + following[depth]
                while e < end[j] and (not deeper):
                    row = plan[positions + e]
                    e += 1
                    if mark[row] != k:
                        mark[row] = k
                        following[depth] = e - lower[j]
                        depth += 1
                        stack[depth] = row
                        following[depth] = 0
                        deeper = True
            if not deeper:
                top -= 1
                reached[top] = stack[depth]
                depth -= 1
    return int(top)

@njit(error_model="numpy")
def factorise_anew(plan, numbers):
    n, size, work, room = (plan[SIZE], plan[ENTRIES], plan[WORK], plan[ROOM])
    columns, rows = (part(plan, plan[COLUMNS], n + 1), part(plan, plan[ROWS], size))
    order, places = (part(plan, plan[ORDER], n), part(plan, plan[PLACES], size))
    upper, lower = (part(plan, work + _UPPER * n, n), part(plan, work + _LOWER * n, n))
    end = part(plan, work + _END * n, n)
    place, pivot_row = (part(plan, work + _PLACE * n, n), part(plan, work + _PIVOT_ROW * n, n))
    reached, mark = (part(plan, work + _REACHED * n, n), part(plan, work + _MARK * n, n))
    positions = part(plan, plan[POOL], room)
    values, inverse, x = (part(numbers, 0, size), part(numbers, size + 2 * n, n), part(numbers, size + 3 * n, n))
    least, pool = (part(numbers, size + 4 * n, n), part(numbers, size + 5 * n, room))
    plan[FACTORISED] = 0
    for i in range(n):
        place[i] = pivot_row[i] = mark[i] = -1
    used, skipped = (0, 0)
    for k in range(n):
        top = filled_rows(plan, k)
        if used + n - top > room:
            return -1
        for f in range(top, n):
            x[reached[f]] = 0.0
        for i in range(columns[k], columns[k + 1]):
            x[rows[i]] = values[i]
        upper[k] = used
        for f in range(top, n):
            j = place[reached[f]]
            if j >= 0:
                u = x[reached[f]]
                positions[used] = j
                pool[used] = u
                used += 1
                for e in range(lower[j], end[j]):
                    x[positions[e]] -= pool[e] * u
        lower[k] = used
        best, diagonal, at = (0.0, 0.0, -1)
        for f in range(top, n):
            r = reached[f]
            if place[r] < 0:
                if abs(x[r]) > best:
                    best, at = (abs(x[r]), r)
                if r == order[k]:
                    diagonal = abs(x[r])
        if best <= least[k]:
            used = lower[k] = end[k] = upper[k]
            inverse[k] = 0.0
            skipped += 1
        else:
            if diagonal >= PREFERRED * best:
                at = order[k]
            inverse[k] = 1.0 / x[at]
            place[at] = k
            pivot_row[k] = at
            for f in range(top, n):
                if place[reached[f]] < 0:
                    positions[used] = reached[f]
                    pool[used] = x[reached[f]] * inverse[k]
                    used += 1
            end[k] = used
        for f in range(top, n):
            x[reached[f]] = 0.0
    free = 0
    for i in range(n):
        if place[i] < 0:
            while pivot_row[free] >= 0:
                free += 1
            place[i] = free
            pivot_row[free] = i
    for k in range(n):
        for e in range(lower[k], end[k]):
            positions[e] = place[positions[e]]
    for i in range(size):
        places[i] = place[rows[i]]
    plan[FACTORISED] = 1 if skipped == 0 else 0
    return skipped

@njit(error_model="numpy")
def factorise(plan, numbers):
    n, size = (plan[SIZE], plan[ENTRIES])
    columns, rows, work = (part(plan, plan[COLUMNS], n + 1), part(plan, plan[ROWS], size), plan[WORK])
    values, row_scale = (part(numbers, 0, size), part(numbers, size, n))
    column_scale, least = (part(numbers, size + n, n), part(numbers, size + 4 * n, n))
    own = part(plan, plan[OWN], n)
    total, unit = (0.0, 0.0)
    for k in range(n):
        row_scale[k] = 0.0
        if own[k] >= 0:
            unit = max(unit, abs(values[own[k]]))
    for k in range(n):
        column_scale[k] = unit if own[k] == MULTIPLIER and 0.0 < unit < math.inf else 1.0
        for i in range(columns[k], columns[k + 1]):
            values[i] *= column_scale[k]
            entry = abs(values[i])
            row_scale[rows[i]] = max(row_scale[rows[i]], entry)
            total += entry
    if not math.isfinite(total):
        inverse = part(numbers, size + 2 * n, n)
        for k in range(n):
            inverse[k] = math.nan
            plan[work + _PLACE * n + k] = plan[work + _PIVOT_ROW * n + k] = k
            plan[work + _UPPER * n + k] = plan[work + _LOWER * n + k] = plan[work + _END * n + k] = 0
        plan[FACTORISED] = 0
        return 0
    for i in range(n):
        row_scale[i] = 1.0 / row_scale[i] if row_scale[i] > 0.0 else 0.0
    for k in range(n):
        largest = 0.0
        for i in range(columns[k], columns[k + 1]):
            values[i] *= row_scale[rows[i]]
            largest = max(largest, abs(values[i]))
        scale = 1.0 / largest if largest > 0.0 else 0.0
        column_scale[k] *= scale
        for i in range(columns[k], columns[k + 1]):
            values[i] *= scale
        mass = abs(values[own[k]]) if own[k] >= 0 else 0.0
        least[k] = SKIPPED * (mass if mass > 0.0 else 1.0)
    if plan[FACTORISED] == 1 and factorise_again(plan, numbers):
        return 0
    return int(factorise_anew(plan, numbers))

@njit(error_model="numpy")
def prepare_pattern(plan, sources, coefficients, numbers):
    assemble_matrix(plan, sources, coefficients, numbers)
    skipped = factorise(plan, numbers)
    if skipped < 0:
        plan[FACTORISED] = _TOO_SMALL
    return int(skipped)

@njit(error_model="numpy")
def factorise_stage(scheme, factors):
    factors[0] = 1.0
    return prepare_pattern(scheme.plan, scheme.slopes, factors, scheme.numbers) >= 0

@njit(error_model="numpy")
def solve(plan, numbers, right, x):
    n, size, work, room = (plan[SIZE], plan[ENTRIES], plan[WORK], plan[ROOM])
    upper, lower = (part(plan, work + _UPPER * n, n), part(plan, work + _LOWER * n, n))
    end, pivot_row = (part(plan, work + _END * n, n), part(plan, work + _PIVOT_ROW * n, n))
    order = part(plan, plan[ORDER], n)
    positions = part(plan, plan[POOL], room)
    row_scale, column_scale = (part(numbers, size, n), part(numbers, size + n, n))
    inverse, y = (part(numbers, size + 2 * n, n), part(numbers, size + 3 * n, n))
    pool = part(numbers, size + 5 * n, room)
    for k in range(n):
        y[k] = right[pivot_row[k]] * row_scale[pivot_row[k]]
    for k in range(n):
        for e in range(lower[k], end[k]):
            y[positions[e]] -= pool[e] * y[k]
    for k in range(n - 1, -1, -1):
        y[k] *= inverse[k]
        for i in range(upper[k], lower[k]):
            y[positions[i]] -= pool[i] * y[k]
    for k in range(n):
        x[order[k]] = y[k] * column_scale[k]
        y[k] = 0.0

@njit(error_model="numpy")
def solve_stage(system, scheme, run, right, x):
    sizes = system.sizes
    for c in range(sizes.m):
        if run.w[sizes.mask + c] > 0.0:
            right[sizes.nv + c] = 0.0
    solve(scheme.plan, scheme.numbers, right, x)

@njit(error_model="numpy")
def relative_change(sizes, run, change, h):
    size, total = (0.0, 0.0)
    for i in range(sizes.nv):
        size += (run.metric[sizes.nq + i] * change[i]) ** 2
    for i in range(sizes.nq):
        total += (run.scales[i] * run.trial[i]) ** 2
    return float(0.5 * h * h * math.sqrt(size) / (run.w[LENGTH] * (1.0 + math.sqrt(total))))

@njit(error_model="numpy")
def auxiliary_rates(system, run, rest, rates):
    sizes = system.sizes
    for i in range(rates.shape[0]):
        if 0 < i <= sizes.states:
            rates[i] = -rest[sizes.unknowns - sizes.states + i - 1]
        else:
            rates[i] = run.w[sizes.auxiliary + (i - sizes.states if i > 0 else 0)]

@njit(error_model="numpy")
def carry_slopes(scheme):
    count = scheme.slopes.shape[0] // 2
    for i in range(count):
        scheme.slopes[i] = scheme.slopes[count + i]

@njit(error_model="numpy")
def attempt(system, scheme, span, run, t, following, h, between):
    sizes = system.sizes
    nq, nv, m, n, first, width = (sizes.nq, sizes.nv, sizes.m, sizes.unknowns, sizes.nq + sizes.nv, sizes.width)
    right, x, factors, k, rest, held, moved, further = step_parts(sizes, run.room)
    change, beginning = (part(further, 0, nv + m), part(further, nv + m, width))
    copied(width, run.y, held)
    copied(width, run.y, run.trial)
    for i in range(n):
        k[i] = 0.0
    for i in range(nv + m):
        x[i] = run.memory[i]
    last, fresh, converged = (math.inf, True, False)
    for _ in range(_MOST_ITERATIONS):
        for i in range(nv):
            held[nq + i] = run.trial[nq + i] = run.y[nq + i] + 0.5 * h * x[i]
            moved[i] = h * held[nq + i]
            k[nq + i] = x[i]
        for c in range(m):
            k[first + c] = x[nv + c]
        advance_coordinates(system, run, moved, run.trial)
        if fresh:
            slopes_at(system, scheme, run, t, held, k, 0)
            slopes_at(system, scheme, run, following, run.trial, k, 1)
            if not factorise_stage(scheme, factors):
                return TOO_LARGE
            run.control[JACOBIANS] += 1
            fresh = False
        system.residual(following, run.trial, k, run.p, run.w, rest)
        for c in range(m):
            right[nv + c] = rest[first + c] / h if scheme.nonholonomic[c] > 0.0 else 2.0 / (h * h) * rest[first + c]
        system.residual(t, held, k, run.p, run.w, rest)
        for i in range(nv):
            right[i] = rest[nq + i]
        for c in range(m):
            if scheme.nonholonomic[c] > 0.0:
                right[nv + c] += rest[first + c] / h
        run.control[EVALUATIONS] += 2
        solve_stage(system, scheme, run, right, change)
        run.control[NEWTON_ITERATIONS] += 1
        for i in range(nv + m):
            x[i] -= change[i]
        size = relative_change(sizes, run, change, h)
        if not math.isfinite(size):
            break
        if size < 1e-17 or (size > 0.5 * last and size < 1e-12):
            converged = True
            break
        fresh, last = (size > 0.05 * last, size)
    if not converged:
        return DIVERGED
    auxiliary_rates(system, run, rest, part(beginning, first, sizes.ny - first))
    for i in range(first, sizes.ny):
        run.trial[i] = run.y[i] + h * beginning[i]
    for i in range(nv):
        run.trial[nq + i] = run.y[nq + i] + 0.5 * h * x[i]
        moved[i] = h * run.trial[nq + i]
    advance_coordinates(system, run, moved, run.trial)
    for i in range(n):
        k[i] = 0.0
    slopes_at(system, scheme, run, following, run.trial, k, 1)
    carry_slopes(scheme)
    if not factorise_stage(scheme, factors):
        return TOO_LARGE
    run.control[JACOBIANS] += 1
    system.residual(following, run.trial, k, run.p, run.w, rest)
    for i in range(nv):
        right[i] = -rest[nq + i]
    for c in range(m):
        right[nv + c] = -2.0 / h * rest[n + c]
    solve_stage(system, scheme, run, right, x)
    for i in range(nv):
        k[nq + i] = x[i]
    for c in range(m):
        k[first + c] = x[nv + c]
    system.residual(following, run.trial, k, run.p, run.w, rest)
    run.control[EVALUATIONS] += 2
    ended = part(held, first, sizes.ny - first)
    auxiliary_rates(system, run, rest, ended)
    for i in range(first, sizes.ny):
        run.trial[i] = run.y[i] + 0.5 * h * (beginning[i] + ended[i - first])
    for i in range(nv):
        run.trial[nq + i] += 0.5 * h * x[i]
    return 0.0

@njit(error_model="numpy")
def renew(system, scheme, span, run, t, changed):
    for i in range(system.sizes.nv + system.sizes.m):
        run.memory[i] = run.room[i]

@njit(error_model="numpy")
def correct(system, run, t, y, between):
    run.iw[PROBING] = 1 if between else 0
    bits = system.accept(t, y, run.p, run.w, run.iw)
    run.iw[PROBING] = 0
    return int(bits)

@njit(error_model="numpy")
def note_step(run, h):
    run.w[STEP_STATUS] = h
