"""Generic code of the looped shape: calls of kernels, products with D and M, factorisations. Emitted by symgen; do not edit.

format 3, generator of-golden-trees

Nothing here knows a mechanism. Sizes, offsets and index lists are read from tables that stand at the end of `w` as
unsigned 32-bit numbers; the first of them, at the places named here, are sizes and offsets. The last element of `w`
says, as an integer, where they begin.
"""

import math

import numpy as np
from numba import config, njit, types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.arrayobj import populate_array

# NumPy's integers, since the compiler would take Python's for literals and compile callees anew for each of them
NQ = np.int64(0)
NV = np.int64(1)
M = np.int64(2)
METHOD_PARAMETERS = np.int64(3)
MASS_DIAGONAL = np.int64(4)
INVERSE_MASS = np.int64(5)
GRAM_BASE = np.int64(6)
MULTIPLIERS = np.int64(7)
MASK = np.int64(8)
SAVED = np.int64(9)
RESIDUAL = np.int64(10)
NU = np.int64(11)
PIVOT = np.int64(12)
CHANGE = np.int64(13)
MASS = np.int64(14)
GAUGE = np.int64(15)
ROW_WEIGHT = np.int64(16)
JACOBIAN = np.int64(17)
LOWER = np.int64(18)
RECORDS = np.int64(19)
FORCE = np.int64(20)
GAMMA = np.int64(21)
PHI = np.int64(22)
LEFT = np.int64(23)
DIAGONAL = np.int64(24)
PANEL = np.int64(25)
KEPT_ROWS = np.int64(26)
STAGE = np.int64(27)
UNKNOWNS = np.int64(28)
EQUATIONS = np.int64(29)
VECTORS = np.int64(30)
VECTOR_SIZE = np.int64(31)
FRAMES = np.int64(32)
SPEEDS = np.int64(33)
RATES = np.int64(34)
MOVE = np.int64(35)
TURN = np.int64(36)
NORMALISE = np.int64(37)
WIND = np.int64(38)
GEOMETRY = np.int64(39)
MOTION = np.int64(40)
FULL = np.int64(41)
ENERGY = np.int64(42)
REPORT = np.int64(43)
RESIDUALS = np.int64(44)
SLOPES = np.int64(45)
JACOBIAN_ROWS = np.int64(46)
JACOBIAN_COLUMNS = np.int64(47)
JACOBIAN_SIZE = np.int64(48)
ANGULAR_ROWS = np.int64(49)
WEIGHTS = np.int64(50)
MASS_BLOCKS = np.int64(51)
GRAM_TERMS = np.int64(52)
GRAM_FACTOR = np.int64(53)
GRAM_SIZE = np.int64(54)
AUGMENTED_TERMS = np.int64(55)
AUGMENTED_FACTOR = np.int64(56)
AUGMENTED_SIZE = np.int64(57)
DRIVEN = np.int64(58)
JOINT_COORDINATES = np.int64(59)
TABLES = np.int64(60)
GENERIC = np.int64(61)

RANK_FACTOR, MASKED_FACTOR, KEPT_FACTOR, PLAIN_FACTOR = np.int64(0), np.int64(1), np.int64(2), np.int64(3)

_A, _T, _I = types.float64[::1], types.uint32[::1], types.int64
_KERNEL = (types.float64, _A, _A, _A, _T, types.uint32, _A)
_GENERIC = (_T, _A, _A, _I, _I, _I, types.float64)
KERNELS = []  # where nothing is compiled, an address is an index in this list


def _call(context, builder, signature, arguments):
    """Lower a call of the function at an address: the first argument; its errors are status codes, not exceptions."""
    convention, parameters = context.call_conv, signature.args[1:]
    function = convention.get_function_type(types.int64, parameters).as_pointer()
    _, result = convention.call_function(
        builder, builder.inttoptr(arguments[0], function), types.int64, parameters, arguments[1:]
    )
    return result


@intrinsic
def _compiled_kernel(typing_context, address, t, y, p, w, T, at, out):
    """Call the kernel at an address."""
    return types.int64(_I, *_KERNEL), _call


@intrinsic
def _compiled_code(typing_context, address, T, p, w, i, j, k, value):
    """Call the generic code at an address."""
    return types.int64(_I, *_GENERIC), _call


@intrinsic
def _compiled_bits(typing_context, x):
    """Return the integer that stands in the place of a number."""

    def lower(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], context.get_value_type(types.int64))

    return types.int64(types.float64), lower


@intrinsic
def _compiled_tables(typing_context, w):
    """Return the tables, as an array without an owner: `w` outlives every call that reads them."""

    def lower(context, builder, signature, arguments):
        source = context.make_array(signature.args[0])(context, builder, arguments[0])
        integer = context.get_value_type(types.int64)
        count = builder.extract_value(source.shape, 0)
        last = builder.load(builder.gep(source.data, [builder.sub(count, integer(1))]))
        start = builder.bitcast(last, integer)
        data = builder.gep(source.data, [start])
        view = context.make_array(signature.return_type)(context, builder)
        populate_array(
            view,
            data=builder.bitcast(data, view.data.type),
            shape=cgutils.pack_array(builder, [builder.mul(builder.sub(count, start), integer(2))]),
            strides=cgutils.pack_array(builder, [integer(4)]),
            itemsize=integer(4),
            meminfo=None,
        )
        return view._getvalue()

    return _T(w), lower


def _interpreted_tables(w):
    """Return the tables."""
    return w[w.view(np.int64)[-1] :].view(np.uint32)


def _interpreted(address, *arguments):
    """Call the function that an address stands for where nothing is compiled."""
    return KERNELS[address](*arguments)


def _interpreted_bits(x):
    """Return the integer that stands in the place of a number."""
    return np.float64(x).view(np.int64)


call_kernel = _interpreted if config.DISABLE_JIT else _compiled_kernel
call_code = _interpreted if config.DISABLE_JIT else _compiled_code
tables = _interpreted_tables if config.DISABLE_JIT else _compiled_tables
bits = _interpreted_bits if config.DISABLE_JIT else _compiled_bits


@njit(error_model="numpy", fastmath={"contract"})
def run(stage, t, y, p, w, T, out):
    """Call all kernels of a stage."""
    addresses, at = np.int64(T[TABLES]), T[stage]
    for k in range(np.int64(T[at])):
        call_kernel(bits(w[addresses + T[at + 1 + 2 * k]]), t, y, p, w, T, T[at + 2 + 2 * k], out)


@njit(error_model="numpy", fastmath={"contract"})
def offset(x):
    """Return x in a form that the compiler knows not to be negative: negative indices need care, others do not."""
    return np.int64(np.uint32(x))


# -- products --------------------------------------------------------------------------------------------------------


@njit(error_model="numpy", fastmath={"contract"})
def rows_times_code(T, p, w, x, result, k, value):
    """Section `result` = D times section `x`."""
    x, result = offset(x), offset(result)
    at, d = T[JACOBIAN_ROWS], np.int64(T[JACOBIAN])
    classes = np.int64(T[at])
    at = np.uint32(at + 1)
    for _ in range(classes):
        blocks, width, count = np.int64(T[at]), np.int64(T[at + 1]), np.int64(T[at + 2])
        at = np.uint32(at + 3)
        if width == 3 and blocks == 2:
            for _ in range(count):
                r, e = result + T[at], d + T[at + 1]
                v, u = x + T[at + 2], x + T[at + 3]
                at = np.uint32(at + 4)
                total = w[e] * w[v] + w[e + 1] * w[v + 1] + w[e + 2] * w[v + 2]
                w[r] = total + w[e + 3] * w[u] + w[e + 4] * w[u + 1] + w[e + 5] * w[u + 2]
        else:
            for _ in range(count):
                r, e = result + T[at], d + T[at + 1]
                at = np.uint32(at + 2)
                total = 0.0
                for _ in range(blocks):
                    v, size = x + T[at], width
                    at = np.uint32(at + 1)
                    if width == 0:
                        size = np.int64(T[at])
                        at = np.uint32(at + 1)
                    for j in range(size):
                        total += w[e + j] * w[v + j]
                    e += size
                w[r] = total
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def columns_times_code(T, p, w, x, result, k, value):
    """Section `result` = D^T times section `x`."""
    x, result = offset(x), offset(result)
    at, d = T[JACOBIAN_COLUMNS], np.int64(T[JACOBIAN])
    bodies = np.int64(T[at])
    at = np.uint32(at + 1)
    for _ in range(bodies):
        v, width, count = result + T[at], np.int64(T[at + 1]), np.int64(T[at + 2])
        at = np.uint32(at + 3)
        if width == 3:
            a = b = c = 0.0
            for _ in range(count):
                factor, e = w[x + T[at]], d + T[at + 1]
                at = np.uint32(at + 2)
                a += w[e] * factor
                b += w[e + 1] * factor
                c += w[e + 2] * factor
            w[v] = a
            w[v + 1] = b
            w[v + 2] = c
        else:
            for j in range(width):
                w[v + j] = 0.0
            for _ in range(count):
                factor, e = w[x + T[at]], d + T[at + 1]
                at = np.uint32(at + 2)
                for j in range(width):
                    w[v + j] += w[e + j] * factor
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def blocks_times_code(T, p, w, inverse, x, result, value):
    """Section `result` = M times section `x`, or M^-1 where `inverse` is 1."""
    x, result = offset(x), offset(result)
    diagonal = np.int64(T[MASS_DIAGONAL])
    if inverse == 1:
        diagonal = np.int64(T[INVERSE_MASS])
    for j in range(np.int64(T[NV])):
        w[result + j] = p[diagonal + j] * w[x + j]
    at = T[MASS_BLOCKS]
    count = np.int64(T[at])
    at = np.uint32(at + 1)
    for _ in range(count):
        size, first = np.int64(T[at]), np.int64(T[at + 1])
        entry = np.int64(T[at + 2]) + inverse * size * size
        at = np.uint32(at + 3)
        for i in range(size):
            total = 0.0
            for j in range(size):
                total += p[entry + size * i + j] * w[x + first + j]
            w[result + first + i] = total
    return 0


# -- matrices --------------------------------------------------------------------------------------------------------


@njit(error_model="numpy", fastmath={"contract"})
def weigh_code(T, p, w, i, j, k, value):
    """Section `left` = D M^-1, where products with entries that vary are made of it."""
    diagonal, d, left = np.int64(T[INVERSE_MASS]), np.int64(T[JACOBIAN]), np.int64(T[LEFT])
    at = T[WEIGHTS]
    count = np.int64(T[at])
    at = np.uint32(at + 1)
    for _ in range(count):
        e = np.int64(T[at])
        w[left + e] = w[d + e] * p[diagonal + T[at + 1]]
        at = np.uint32(at + 2)
    count = np.int64(T[at])
    at = np.uint32(at + 1)
    for _ in range(count):
        size, e, entry = np.int64(T[at]), np.int64(T[at + 1]), np.int64(T[at + 2])
        at = np.uint32(at + 3)
        for j in range(size):
            total = 0.0
            for i in range(size):
                total += w[d + e + i] * p[entry + size * i + j]
            w[left + e + j] = total
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def gauge_code(T, p, w, i, j, k, value):
    """Section `left` = D G, G being the diagonal matrix of section `gauge`."""
    d, left, weights = np.int64(T[JACOBIAN]), np.int64(T[LEFT]), np.int64(T[GAUGE])
    at = T[JACOBIAN_COLUMNS]
    bodies = np.int64(T[at])
    at = np.uint32(at + 1)
    for _ in range(bodies):
        v, width, count = weights + T[at], np.int64(T[at + 1]), np.int64(T[at + 2])
        at = np.uint32(at + 3)
        for _ in range(count):
            e = np.int64(T[at + 1])
            at = np.uint32(at + 2)
            for j in range(width):
                w[left + e + j] = w[d + e + j] * w[v + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def gram_code(T, p, w, weight, result, k, value):
    """Section `result` = D W D^T, where the factorisation wants its entries.

    W is the identity (`weight` 0), M^-1 (1; `weigh` before) or G (2; `gauge` before).
    """
    result = offset(result)
    d, base, size = np.int64(T[JACOBIAN]), np.int64(T[GRAM_BASE]), np.int64(T[GRAM_SIZE])
    left = d
    if weight != 0:
        left = np.int64(T[LEFT])
    if weight == 1:
        base += size
    for k in range(size):
        w[result + k] = p[base + k]
    at = T[GRAM_TERMS]
    classes = np.int64(T[at])
    at = np.uint32(at + 1)
    for _ in range(classes):
        width, count = np.int64(T[at]), np.int64(T[at + 1])
        at = np.uint32(at + 2)
        if width == 0:  # products of two entries with two others
            for _ in range(count):
                f, g = w[left + T[at]], w[left + T[at + 1]]
                x, z = w[d + T[at + 2]], w[d + T[at + 3]]
                w[result + T[at + 4]] += f * x
                w[result + T[at + 5]] += f * z
                w[result + T[at + 6]] += g * x
                w[result + T[at + 7]] += g * z
                at = np.uint32(at + 8)
        elif width == 1:
            for _ in range(count):
                w[result + T[at + 2]] += w[left + T[at]] * w[d + T[at + 1]]
                at = np.uint32(at + 3)
        elif width == 3:
            for _ in range(count):
                a, b = left + T[at], d + T[at + 1]
                w[result + T[at + 2]] += w[a] * w[b] + w[a + 1] * w[b + 1] + w[a + 2] * w[b + 2]
                at = np.uint32(at + 3)
        else:
            for _ in range(count):
                a, b = left + T[at], d + T[at + 1]
                total = 0.0
                for j in range(width):
                    total += w[a + j] * w[b + j]
                w[result + T[at + 2]] += total
                at = np.uint32(at + 3)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def augment_code(T, p, w, penalties, result, k, value):
    """Section `result` = M + D^T a D, a in section `penalties`, where the factorisation wants its entries."""
    penalties, result = offset(penalties), offset(result)
    d, diagonal = np.int64(T[JACOBIAN]), np.int64(T[MASS_DIAGONAL])
    for k in range(np.int64(T[AUGMENTED_SIZE])):
        w[result + k] = 0.0
    at = T[AUGMENTED_TERMS]
    for j in range(np.int64(T[NV])):
        w[result + T[at]] = p[diagonal + j]
        at = np.uint32(at + 1)
    beside = np.int64(T[at])
    at = np.uint32(at + 1)
    for _ in range(beside):
        w[result + T[at + 1]] = p[T[at]]
        at = np.uint32(at + 2)
    for r in range(np.int64(T[M])):
        count, a = np.int64(T[at]), w[penalties + r]
        slots = np.uint32(at + 1)
        at = np.uint32(at + 1 + count)
        for i in range(count):
            x = a * w[d + T[slots + i]]
            for j in range(i + 1):
                w[result + T[at]] += x * w[d + T[slots + j]]
                at = np.uint32(at + 1)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def factorise_code(T, p, w, table, lower, mode, value):
    """Factorise L D L^T in place; return whether a pivot is suspicious.

    Modes: rank decided and noted; rows masked by the runtime left out; rows kept that the rank kept; none left out.
    Where `value` is not 0 it is a section, of which the first half of `solve` is done on the way.
    """
    lower, y = offset(lower), offset(value)
    mask, pivots, kept = np.int64(T[MASK]), np.int64(T[PIVOT]), np.int64(T[KEPT_ROWS])
    panel, diagonal = np.int64(T[PANEL]), np.int64(T[DIAGONAL])
    suspicious = False
    smallest, rank = 1.0, 0.0
    at = T[table]
    nodes, size = np.int64(T[at]), np.int64(T[at + 1])
    at = np.uint32(at + 2)
    for r in range(size):
        w[diagonal + r] = w[lower + T[at + r]]
    at = np.uint32(at + size + nodes)
    for _ in range(nodes):
        c, below, first = np.int64(T[at]), np.int64(T[at + 1]), lower + T[at + 2]
        rows = np.uint32(at + 3)
        targets = np.uint32(rows + c + below)
        if c == 2:
            row = np.int64(T[rows])
            pivot = w[first]
            if mode == MASKED_FACTOR:
                masked = pivot + w[mask + row]
                suspicious |= masked < 1e-6 * w[diagonal + row]
                one = 1.0 / masked
            elif mode == PLAIN_FACTOR:
                one = 1.0 / pivot
            elif mode == KEPT_FACTOR:
                one = 1.0 / pivot if w[kept + row] != 0.0 else 0.0
            else:
                relative = pivot / w[diagonal + row]
                w[pivots + row] = relative
                smallest = min(smallest, relative + w[mask + row])
                one = 0.0
                w[kept + row] = 0.0
                if pivot > 1e-12 * w[diagonal + row] + w[mask + row]:
                    w[kept + row] = 1.0
                    rank += 1.0
                    one = 1.0 / pivot
            w[first] = one  # the pivot itself is not wanted again
            x = w[first + 2]
            middle = x * one
            w[first + 2] = middle
            row = np.int64(T[rows + 1])
            pivot = w[first + 3] - x * middle
            if mode == MASKED_FACTOR:
                masked = pivot + w[mask + row]
                suspicious |= masked < 1e-6 * w[diagonal + row]
                two = 1.0 / masked
            elif mode == PLAIN_FACTOR:
                two = 1.0 / pivot
            elif mode == KEPT_FACTOR:
                two = 1.0 / pivot if w[kept + row] != 0.0 else 0.0
            else:
                relative = pivot / w[diagonal + row]
                w[pivots + row] = relative
                smallest = min(smallest, relative + w[mask + row])
                two = 0.0
                w[kept + row] = 0.0
                if pivot > 1e-12 * w[diagonal + row] + w[mask + row]:
                    w[kept + row] = 1.0
                    rank += 1.0
                    two = 1.0 / pivot
            w[first + 3] = two  # the pivot itself is not wanted again
            e = first + 4
            if y > 0:
                y0 = w[y + T[rows]]
                y1 = w[y + T[rows + 1]] - middle * y0
                w[y + T[rows + 1]] = y1
            if below == 2:
                x0 = w[e + 0]
                z0 = w[e + 1] - x0 * middle
                x1 = w[e + 2]
                z1 = w[e + 3] - x1 * middle
                a0, b0 = x0 * one, z0 * two
                w[e + 0] = a0
                w[e + 1] = b0
                w[lower + T[targets + 0]] -= a0 * x0 + b0 * z0
                a1, b1 = x1 * one, z1 * two
                w[e + 2] = a1
                w[e + 3] = b1
                w[lower + T[targets + 1]] -= a1 * x0 + b1 * z0
                w[lower + T[targets + 2]] -= a1 * x1 + b1 * z1
                if y > 0:
                    w[y + T[rows + 2]] -= a0 * y0 + b0 * y1
                    w[y + T[rows + 3]] -= a1 * y0 + b1 * y1
                targets = np.uint32(targets + 3)
            elif below == 4:
                x0 = w[e + 0]
                z0 = w[e + 1] - x0 * middle
                x1 = w[e + 2]
                z1 = w[e + 3] - x1 * middle
                x2 = w[e + 4]
                z2 = w[e + 5] - x2 * middle
                x3 = w[e + 6]
                z3 = w[e + 7] - x3 * middle
                a0, b0 = x0 * one, z0 * two
                w[e + 0] = a0
                w[e + 1] = b0
                w[lower + T[targets + 0]] -= a0 * x0 + b0 * z0
                a1, b1 = x1 * one, z1 * two
                w[e + 2] = a1
                w[e + 3] = b1
                w[lower + T[targets + 1]] -= a1 * x0 + b1 * z0
                w[lower + T[targets + 2]] -= a1 * x1 + b1 * z1
                a2, b2 = x2 * one, z2 * two
                w[e + 4] = a2
                w[e + 5] = b2
                w[lower + T[targets + 3]] -= a2 * x0 + b2 * z0
                w[lower + T[targets + 4]] -= a2 * x1 + b2 * z1
                w[lower + T[targets + 5]] -= a2 * x2 + b2 * z2
                a3, b3 = x3 * one, z3 * two
                w[e + 6] = a3
                w[e + 7] = b3
                w[lower + T[targets + 6]] -= a3 * x0 + b3 * z0
                w[lower + T[targets + 7]] -= a3 * x1 + b3 * z1
                w[lower + T[targets + 8]] -= a3 * x2 + b3 * z2
                w[lower + T[targets + 9]] -= a3 * x3 + b3 * z3
                if y > 0:
                    w[y + T[rows + 2]] -= a0 * y0 + b0 * y1
                    w[y + T[rows + 3]] -= a1 * y0 + b1 * y1
                    w[y + T[rows + 4]] -= a2 * y0 + b2 * y1
                    w[y + T[rows + 5]] -= a3 * y0 + b3 * y1
                targets = np.uint32(targets + 10)
            else:
                for i in range(below):
                    e = first + 4 + 2 * i
                    x = w[e]
                    z = w[e + 1] - x * middle
                    w[panel + 2 * i] = x
                    w[panel + 2 * i + 1] = z
                    x *= one
                    z *= two
                    w[e] = x
                    w[e + 1] = z
                    for j in range(i + 1):
                        w[lower + T[targets]] -= x * w[panel + 2 * j] + z * w[panel + 2 * j + 1]
                        targets = np.uint32(targets + 1)
                    if y > 0:
                        w[y + T[rows + 2 + i]] -= x * y0 + z * y1
        else:
            row = np.int64(T[rows])
            pivot = w[first]
            if mode == MASKED_FACTOR:
                masked = pivot + w[mask + row]
                suspicious |= masked < 1e-6 * w[diagonal + row]
                one = 1.0 / masked
            elif mode == PLAIN_FACTOR:
                one = 1.0 / pivot
            elif mode == KEPT_FACTOR:
                one = 1.0 / pivot if w[kept + row] != 0.0 else 0.0
            else:
                relative = pivot / w[diagonal + row]
                w[pivots + row] = relative
                smallest = min(smallest, relative + w[mask + row])
                one = 0.0
                w[kept + row] = 0.0
                if pivot > 1e-12 * w[diagonal + row] + w[mask + row]:
                    w[kept + row] = 1.0
                    rank += 1.0
                    one = 1.0 / pivot
            w[first] = one  # the pivot itself is not wanted again
            y0 = w[y + T[rows]] if y > 0 else 0.0
            for i in range(below):
                x = w[first + 1 + i]
                w[panel + i] = x
                x *= one
                w[first + 1 + i] = x
                for j in range(i + 1):
                    w[lower + T[targets]] -= x * w[panel + j]
                    targets = np.uint32(targets + 1)
                if y > 0:
                    w[y + T[rows + 1 + i]] -= x * y0
        at = np.uint32(targets)
    if mode == RANK_FACTOR:
        w[4] = smallest
        w[5] = rank
    return int(suspicious)


@njit(error_model="numpy", fastmath={"contract"})
def solve_code(T, p, w, table, lower, x, value):
    """Solve with a factor, in place in section `x`."""
    lower, x = offset(lower), offset(x)
    start = T[table]
    nodes, size = np.int64(T[start]), np.int64(T[start + 1])
    starts = np.uint32(start + 2 + size)
    # where `value` is not 0 the factorisation has done this half
    for s in range(nodes if value == 0.0 else 0):
        at = np.uint32(start + np.int64(T[starts + s]))
        c, below, first = np.int64(T[at]), np.int64(T[at + 1]), lower + T[at + 2]
        at = np.uint32(at + 3)
        if c == 2:
            one, row = w[x + T[at]], x + T[at + 1]
            two = w[row] - w[first + 2] * one
            w[row] = two
            if below == 2:
                w[x + T[at + 2]] -= w[first + 4] * one + w[first + 5] * two
                w[x + T[at + 3]] -= w[first + 6] * one + w[first + 7] * two
            elif below == 4:
                w[x + T[at + 2]] -= w[first + 4] * one + w[first + 5] * two
                w[x + T[at + 3]] -= w[first + 6] * one + w[first + 7] * two
                w[x + T[at + 4]] -= w[first + 8] * one + w[first + 9] * two
                w[x + T[at + 5]] -= w[first + 10] * one + w[first + 11] * two
            else:
                for i in range(below):
                    w[x + T[at + 2 + i]] -= w[first + 4 + 2 * i] * one + w[first + 5 + 2 * i] * two
        else:
            one = w[x + T[at]]
            for i in range(1, 1 + below):
                w[x + T[at + i]] -= w[first + i] * one
    for s in range(nodes - 1, -1, -1):
        at = np.uint32(start + np.int64(T[starts + s]))
        c, below, first = np.int64(T[at]), np.int64(T[at + 1]), lower + T[at + 2]
        at = np.uint32(at + 3)
        if c == 2:
            row, other = np.int64(T[at]), np.int64(T[at + 1])
            one, two = w[x + row] * w[first], w[x + other] * w[first + 3]
            if below == 2:
                v0, v1 = w[x + T[at + 2]], w[x + T[at + 3]]
                one -= w[first + 4] * v0 + w[first + 6] * v1
                two -= w[first + 5] * v0 + w[first + 7] * v1
            elif below == 4:
                v0 = w[x + T[at + 2]]
                v1 = w[x + T[at + 3]]
                v2 = w[x + T[at + 4]]
                v3 = w[x + T[at + 5]]
                one -= (w[first + 4] * v0 + w[first + 6] * v1) + (w[first + 8] * v2 + w[first + 10] * v3)
                two -= (w[first + 5] * v0 + w[first + 7] * v1) + (w[first + 9] * v2 + w[first + 11] * v3)
            else:
                for i in range(below):
                    value = w[x + T[at + 2 + i]]
                    one -= w[first + 4 + 2 * i] * value
                    two -= w[first + 5 + 2 * i] * value
            w[x + other] = two
            w[x + row] = one - w[first + 2] * two
        else:
            row = np.int64(T[at])
            total = w[x + row] * w[first]
            for i in range(1, 1 + below):
                total -= w[first + i] * w[x + T[at + i]]
            w[x + row] = total

    return 0


# -- calls -----------------------------------------------------------------------------------------------------------
# Generic code is reached through the tables like kernels: it is compiled once, not anew into everything that calls it.


@njit(error_model="numpy", fastmath={"contract"})
def rows_times(T, p, w, x, result):
    """Section `result` = D times `x`."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 0]
    return call_code(bits(address), T, p, w, x, result, 0, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def columns_times(T, p, w, x, result):
    """`result` = D^T times `x`."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 1]
    return call_code(bits(address), T, p, w, x, result, 0, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def mass_times(T, p, w, x, result):
    """`result` = M times `x`."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 2]
    return call_code(bits(address), T, p, w, 0, x, result, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def inverse_mass_times(T, p, w, x, result):
    """`result` = M^-1 `x`."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 2]
    return call_code(bits(address), T, p, w, 1, x, result, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def weigh(T, p, w):
    """Section `left` = D M^-1."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 3]
    return call_code(bits(address), T, p, w, 0, 0, 0, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def gauge(T, p, w):
    """Section `left` = D G."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 4]
    return call_code(bits(address), T, p, w, 0, 0, 0, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def gram(T, p, w, weight, result):
    """`result` = D W D^T."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 5]
    return call_code(bits(address), T, p, w, weight, result, 0, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def augment(T, p, w, penalties, result):
    """`result` = M + D^T a D."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 6]
    return call_code(bits(address), T, p, w, penalties, result, 0, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def factorise(T, p, w, table, lower, mode):
    """L D L^T in place."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 7]
    return call_code(bits(address), T, p, w, table, lower, mode, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def solve(T, p, w, table, lower, x):
    """Solve in place in section `x`."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 8]
    return call_code(bits(address), T, p, w, table, lower, x, 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def factorise_forward(T, p, w, table, lower, mode, x):
    """L D L^T in place, and the first half of `solve` for section `x`."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 7]
    return call_code(bits(address), T, p, w, table, lower, mode, float(x))


@njit(error_model="numpy", fastmath={"contract"})
def solve_rest(T, p, w, table, lower, x):
    """The second half of `solve` in section `x`."""
    address = w[np.int64(T[TABLES]) + T[GENERIC] + 8]
    return call_code(bits(address), T, p, w, table, lower, x, 1.0)
