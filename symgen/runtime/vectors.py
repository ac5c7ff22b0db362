"""Arithmetic on whole states in vectors of eight numbers.

Arrays are as long as `symgen.runtime.blocks` says, filled up with zeros, so no loop has a remainder; and vectors are
written as such, because compilers that have to find them by themselves first ask at run time whether arrays overlap,
which takes as long as the work on a small state. Processors with shorter vectors do a block in several parts.

Where nothing is compiled, and on CUDA devices, plain loops stand in: the functions of `PLAIN`, by name.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

from llvmlite import ir
from numba import config, types
from numba.core import cgutils
from numba.extending import intrinsic

from symgen.runtime.blocks import BLOCK

_F64, _I32, _I64 = ir.DoubleType(), ir.IntType(32), ir.IntType(64)
_VECTOR, _INDICES, _PAIR = ir.VectorType(_F64, BLOCK), ir.VectorType(_I64, BLOCK), ir.VectorType(_F64, 2)
_ZERO = ir.Constant(_VECTOR, [0.0] * BLOCK)
#: Up to this width numbers that were just written one by one are read one by one.
_SMALL = 4 * BLOCK
#: Multiplication and addition may be contracted, as everywhere in compiled code; nothing else is allowed.
_FLAGS = ("contract",)


# -- plain loops -------------------------------------------------------------------------------------------------------


def _combine(
    width: int, h: float, first: int, last: int, column: Any, value: Any, rows: Any, base: Any, out: Any
) -> None:
    """Set out = base + h sum of value times row, over the entries from `first` to `last` of a packed table.

    Parameters
    ----------
    width : int
        Length of `base`, `out` and each row: a multiple of `BLOCK`.
    h : float
        Factor of the sum.
    column, value : Array
        Row and coefficient of each entry.
    rows : Array
        One row after the other.
    base, out : Array, shape (width,)
        May be the same.
    """
    for i in range(width):
        out[i] = base[i]
    for k in range(first, last):
        factor, at = h * value[k], column[k] * width
        for i in range(width):
            out[i] += factor * rows[at + i]


def _total(width: int, h: float, first: int, last: int, column: Any, value: Any, rows: Any, out: Any) -> None:
    """Set out = h sum of value times row; as `_combine`."""
    for i in range(width):
        out[i] = 0.0
    for k in range(first, last):
        factor, at = h * value[k], column[k] * width
        for i in range(width):
            out[i] += factor * rows[at + i]


def _copied(width: int, array: Any, out: Any) -> None:
    """Set `out` to an array."""
    for i in range(width):
        out[i] = array[i]


def _weigh(width: int, error: Any, share: Any, y: Any, new: Any, rtol: float, atol: float) -> float:
    """Return the sum of the squares of share times error over ``atol + rtol share max(|y|, |new|)``; 0 / 0 counts 0."""
    total = 0.0
    for i in range(width):
        allowed = atol + rtol * (share[i] * max(abs(y[i]), abs(new[i])))
        if share[i] * error[i] != 0.0:
            total += (share[i] * error[i] / allowed) ** 2
    return total


def _largest(width: int, array: Any, weights: Any, first: int, last: int) -> float:
    """Return the largest weighted magnitude of the elements from `first` to `last`, at least 0; nan is passed over."""
    largest = 0.0
    for i in range(first, last):
        if abs(array[i]) * weights[i] > largest:
            largest = abs(array[i]) * weights[i]
    return largest


def _finite(width: int, array: Any) -> bool:
    """Return whether all elements are finite."""
    total = 0.0
    for i in range(width):
        total += array[i] - array[i]
    return total == 0.0


PLAIN: dict[str, Callable[..., Any]] = {
    "combine": _combine,
    "follow": _combine,
    "total": _total,
    "copied": _copied,
    "received": _copied,
    "weigh": _weigh,
    "largest": _largest,
    "finite": _finite,
}


# -- the same as vectors -----------------------------------------------------------------------------------------------


def _data(context: Any, builder: Any, signature: Any, arguments: Any, *which: int) -> list[Any]:
    """Return where the data of some array arguments begin."""
    return [context.make_array(signature.args[i])(context, builder, arguments[i]).data for i in which]


def _load(builder: Any, data: Any, at: Any) -> Any:
    return builder.load(builder.bitcast(builder.gep(data, [at]), _VECTOR.as_pointer()), align=8)


def _store(builder: Any, vector: Any, data: Any, at: Any) -> None:
    builder.store(vector, builder.bitcast(builder.gep(data, [at]), _VECTOR.as_pointer()), align=8)


def _spread(builder: Any, number: Any, kind: Any = _VECTOR) -> Any:
    """Return a vector of equal numbers."""
    undefined = ir.Constant(kind, ir.Undefined)
    one = builder.insert_element(undefined, number, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(one, undefined, ir.Constant(ir.VectorType(ir.IntType(32), BLOCK), [0] * BLOCK))


def _magnitude(builder: Any, vector: Any) -> Any:
    kind, name = ir.FunctionType(_VECTOR, [_VECTOR]), f"llvm.fabs.v{BLOCK}f64"
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), [vector])


def _added(builder: Any, a: Any, b: Any, c: Any) -> Any:
    """Return a b + c, contracted wherever the processor can: which is left to no optimisation, and so is every bit."""
    kind = ir.FunctionType(a.type, [a.type] * 3)
    name = f"llvm.fmuladd.v{a.type.count}f64"
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), [a, b, c])


def _greater(builder: Any, a: Any, b: Any) -> Any:
    """Return the greater of two, element by element; b where they cannot be compared."""
    return builder.select(builder.fcmp_ordered(">", a, b), a, b)


def _folded(builder: Any, vector: Any, join: Callable[[Any, Any], Any]) -> Any:
    """Return one number from the elements of a vector, joined in halves."""
    numbers = [builder.extract_element(vector, ir.Constant(ir.IntType(32), i)) for i in range(BLOCK)]
    while len(numbers) > 1:
        half = len(numbers) // 2
        numbers = [join(a, b) for a, b in zip(numbers[:half], numbers[half:], strict=True)]
    return numbers[0]


def _each_block(builder: Any, width: Any) -> Any:
    """Return a loop over blocks, whose variables are the index of a block and its number."""
    return cgutils.for_range_slice(builder, _I64(0), width, _I64(BLOCK), _I64, inc=True)


def _blocks(builder: Any, width: Any, begin: Any, block: Callable[[Any, Any], Any]) -> Any:
    """Return a vector that is carried from block to block: ``carried = block(index, carried)``, from `begin` on."""
    carried = cgutils.alloca_once_value(builder, begin)
    with _each_block(builder, width) as (i, _):
        builder.store(block(i, builder.load(carried)), carried)
    return builder.load(carried)


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _vector_combine(
    typing: Any, width: Any, h: Any, first: Any, last: Any, column: Any, value: Any, rows: Any, base: Any, out: Any
) -> Any:
    return types.void(*_TABLE, column, value, rows, base, out), _combining(_last_whole)


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _vector_follow(
    typing: Any, width: Any, h: Any, first: Any, last: Any, column: Any, value: Any, rows: Any, base: Any, out: Any
) -> Any:
    return types.void(*_TABLE, column, value, rows, base, out), _combining(_last_as_written)


def _combining(last_row: Callable[..., None]) -> Callable[..., Any]:
    """Return what writes `combine`, with one of two ways to add the last row."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        width, h, first, last = arguments[:4]
        column, value, rows, base, out = _data(context, builder, signature, arguments, 4, 5, 6, 7, 8)
        with builder.if_else(builder.icmp_signed("<", first, last)) as (some, none):
            with some:
                end = builder.sub(last, _I64(1))
                row = builder.mul(builder.load(builder.gep(column, [end])), width)
                factor = _spread(builder, builder.fmul(h, builder.load(builder.gep(value, [end])), flags=_FLAGS))
                for i, total in _sums(context, builder, signature, (*arguments[:3], end, *arguments[4:])):
                    before = _added(builder, _spread(builder, h), total, _load(builder, base, i))
                    rate, to = builder.gep(rows, [builder.add(row, i)]), builder.gep(out, [i])
                    last_row(builder, width, before, factor, rate, to)
            with none, _each_block(builder, width) as (i, _):
                _store(builder, _load(builder, base, i), out, i)
        return context.get_dummy_value()

    return generate


def _last_whole(builder: Any, width: Any, before: Any, factor: Any, rate: Any, out: Any) -> None:
    """Write a block of a state, from it without the last row and the block of that row."""
    _store(builder, _added(builder, factor, _load(builder, rate, _I64(0)), before), out, _I64(0))


def _last_as_written(builder: Any, width: Any, before: Any, factor: Any, rate: Any, out: Any) -> None:
    """Do the same where an emitted function has just written the row."""

    def small() -> None:
        undefined = ir.Constant(_VECTOR, ir.Undefined)
        for k, pair in _pairs(builder, rate):
            places = ir.Constant(ir.VectorType(_I32, 2), [k, k + 1])
            mine, weight = (builder.shuffle_vector(vector, undefined, places) for vector in (before, factor))
            builder.store(_added(builder, weight, pair, mine), _pair_at(builder, out, _I64(k)), align=8)

    _as_written(builder, width, small, partial(_last_whole, builder, width, before, factor, rate, out))


# -- what emitted functions have just written --------------------------------------------------------------------------
#
# They write number by number, and a vector of numbers that still wait to be written is not to be had before they are;
# each by itself is. Large states are read as vectors all the same, as there are too many numbers.


def _as_written(builder: Any, width: Any, small: Callable[[], None], large: Callable[[], None]) -> None:
    """Write one of two ways to do a block, by the width of the state."""
    with builder.if_else(builder.icmp_signed("<=", width, _I64(_SMALL))) as (then, otherwise):
        with then:
            small()
        with otherwise:
            large()


def _pairs(builder: Any, data: Any) -> Iterator[tuple[int, Any]]:
    """Give a block in pairs, and where they stand in it; loads that are atomic are not joined by the compiler."""
    for k in range(0, BLOCK, 2):
        pair: Any = ir.Constant(_PAIR, ir.Undefined)
        for i in range(2):
            where = builder.bitcast(builder.gep(data, [_I64(k + i)]), _I64.as_pointer())
            number = builder.bitcast(builder.load_atomic(where, "unordered", 8), _F64)
            pair = builder.insert_element(pair, number, _I32(i))
        yield k, pair


def _pair_at(builder: Any, data: Any, at: Any) -> Any:
    return builder.bitcast(builder.gep(data, [at]), _PAIR.as_pointer())


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _vector_total(
    typing: Any, width: Any, h: Any, first: Any, last: Any, column: Any, value: Any, rows: Any, out: Any
) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        (out,) = _data(context, builder, signature, arguments, 7)
        h = _spread(builder, arguments[1])
        for i, total in _sums(context, builder, signature, arguments):
            _store(builder, builder.fmul(h, total), out, i)
        return context.get_dummy_value()

    return types.void(*_TABLE, column, value, rows, out), generate


#: Types of width, h, first and last.
_TABLE = types.int64, types.float64, types.int64, types.int64


def _sums(context: Any, builder: Any, signature: Any, arguments: Any) -> Iterator[tuple[Any, Any]]:
    """Give each block's index and its sum of values times rows, inside the loop over blocks."""
    width, _, first, last = arguments[:4]
    column, value, rows = _data(context, builder, signature, arguments, 4, 5, 6)
    with _each_block(builder, width) as (i, _):
        total = cgutils.alloca_once(builder, _VECTOR)
        builder.store(_ZERO, total)
        with cgutils.for_range_slice(builder, first, last, _I64(1), _I64, inc=True) as (k, _):
            row = builder.mul(builder.load(builder.gep(column, [k])), width)
            weight = _spread(builder, builder.load(builder.gep(value, [k])))
            rate = _load(builder, rows, builder.add(row, i))
            builder.store(_added(builder, weight, rate, builder.load(total)), total)
        yield i, builder.load(total)


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _vector_copied(typing: Any, width: Any, array: Any, out: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data, to = _data(context, builder, signature, arguments, 1, 2)
        with _each_block(builder, arguments[0]) as (i, _):
            _store(builder, _load(builder, data, i), to, i)
        return context.get_dummy_value()

    return types.void(types.int64, array, out), generate


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _vector_received(typing: Any, width: Any, array: Any, out: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data, to = _data(context, builder, signature, arguments, 1, 2)

        def small(i: Any) -> None:
            for k, pair in _pairs(builder, builder.gep(data, [i])):
                builder.store(pair, _pair_at(builder, to, builder.add(i, _I64(k))), align=8)

        def large(i: Any) -> None:
            _store(builder, _load(builder, data, i), to, i)

        with _each_block(builder, arguments[0]) as (i, _):
            _as_written(builder, arguments[0], partial(small, i), partial(large, i))
        return context.get_dummy_value()

    return types.void(types.int64, array, out), generate


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _vector_weigh(typing: Any, width: Any, error: Any, share: Any, y: Any, new: Any, rtol: Any, atol: Any) -> Any:
    signature = types.float64(types.int64, error, share, y, new, types.float64, types.float64)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        error, share, y, new = _data(context, builder, signature, arguments, 1, 2, 3, 4)
        rtol, atol = _spread(builder, arguments[5]), _spread(builder, arguments[6])

        def block(i: Any, total: Any) -> Any:
            larger = _greater(
                builder, _magnitude(builder, _load(builder, y, i)), _magnitude(builder, _load(builder, new, i))
            )
            weight = _load(builder, share, i)
            larger = builder.fmul(weight, larger)
            scale = builder.fadd(atol, builder.fmul(rtol, larger, flags=_FLAGS), flags=_FLAGS)
            error_here = builder.fmul(weight, _load(builder, error, i))
            none = builder.fcmp_ordered("==", error_here, _ZERO)
            part = builder.select(none, _ZERO, builder.fdiv(error_here, scale))
            return builder.fadd(total, builder.fmul(part, part, flags=_FLAGS), flags=_FLAGS)

        total = _blocks(builder, arguments[0], _ZERO, block)
        return _folded(builder, total, builder.fadd)

    return signature, generate


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _vector_largest(typing: Any, width: Any, array: Any, weights: Any, first: Any, last: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        width, _, _, first, last = arguments
        data, factors = _data(context, builder, signature, arguments, 1, 2)
        low, high = _spread(builder, first, _INDICES), _spread(builder, last, _INDICES)

        def block(i: Any, largest: Any) -> Any:
            index = builder.add(_spread(builder, i, _INDICES), ir.Constant(_INDICES, list(range(BLOCK))))
            inside = builder.and_(builder.icmp_signed(">=", index, low), builder.icmp_signed("<", index, high))
            size = builder.fmul(_magnitude(builder, _load(builder, data, i)), _load(builder, factors, i))
            size = builder.select(inside, size, _ZERO)
            return _greater(builder, size, largest)

        found = _blocks(builder, width, _ZERO, block)
        return _folded(builder, found, lambda a, b: _greater(builder, a, b))

    return types.float64(types.int64, array, weights, types.int64, types.int64), generate


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _vector_finite(typing: Any, width: Any, array: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        (data,) = _data(context, builder, signature, arguments, 1)

        def block(i: Any, total: Any) -> Any:
            vector = _load(builder, data, i)
            return builder.fadd(total, builder.fsub(vector, vector))

        total = _blocks(builder, arguments[0], _ZERO, block)
        return builder.fcmp_ordered("==", _folded(builder, total, builder.fadd), ir.Constant(_F64, 0.0))

    return types.boolean(types.int64, array), generate


follow: Any = _combine if config.DISABLE_JIT else _vector_follow
total: Any = _total if config.DISABLE_JIT else _vector_total
copied: Any = _copied if config.DISABLE_JIT else _vector_copied
received: Any = _copied if config.DISABLE_JIT else _vector_received
combine: Any = _combine if config.DISABLE_JIT else _vector_combine
weigh: Any = _weigh if config.DISABLE_JIT else _vector_weigh
largest: Any = _largest if config.DISABLE_JIT else _vector_largest
finite: Any = _finite if config.DISABLE_JIT else _vector_finite
