"""The functions of `symgen.compile.loopcode.vectors` in vectors of eight numbers, written with llvmlite's builder.

Each takes a builder and the arguments, arrays as addresses, and returns the result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

from llvmlite import ir

from symgen.compile.loopcode.padding import BLOCK

F64, I32, I64 = ir.DoubleType(), ir.IntType(32), ir.IntType(64)
VECTOR, _INDICES, _PAIR = ir.VectorType(F64, BLOCK), ir.VectorType(I64, BLOCK), ir.VectorType(F64, 2)
ZERO = ir.Constant(VECTOR, [0.0] * BLOCK)
#: Largest width up to which numbers just written one by one are read one by one.
_SMALL = 4 * BLOCK
#: Multiplication and addition may be contracted, as everywhere in compiled code; nothing else is allowed.
_FLAGS = ("contract",)


def load_vector(builder: ir.IRBuilder, data: ir.Value, at: ir.Value) -> ir.Value:
    """Return eight numbers of an array."""
    return builder.load(builder.bitcast(builder.gep(data, [at]), VECTOR.as_pointer()), align=8)


def store_vector(builder: ir.IRBuilder, vector: ir.Value, data: ir.Value, at: ir.Value) -> None:
    """Write eight numbers of an array."""
    builder.store(vector, builder.bitcast(builder.gep(data, [at]), VECTOR.as_pointer()), align=8)


def spread_number(builder: ir.IRBuilder, number: ir.Value, kind: ir.Type = VECTOR) -> ir.Value:
    """Return a vector of equal numbers."""
    undefined = ir.Constant(kind, ir.Undefined)
    one = builder.insert_element(undefined, number, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(one, undefined, ir.Constant(ir.VectorType(ir.IntType(32), BLOCK), [0] * BLOCK))


def _magnitude(builder: ir.IRBuilder, vector: ir.Value) -> ir.Value:
    kind, name = ir.FunctionType(VECTOR, [VECTOR]), f"llvm.fabs.v{BLOCK}f64"
    return builder.call(_declare_function(builder, kind, name), [vector])


def add_product(builder: ir.IRBuilder, a: ir.Value, b: ir.Value, c: ir.Value) -> ir.Value:
    """Return a b + c, contracted wherever the processor can: results do not depend on optimisation to the bit."""
    kind = ir.FunctionType(a.type, [a.type] * 3)
    name = f"llvm.fmuladd.v{a.type.count}f64"
    return builder.call(_declare_function(builder, kind, name), [a, b, c])


def _greater(builder: ir.IRBuilder, a: ir.Value, b: ir.Value) -> ir.Value:
    """Return the greater of two, element by element; b where one is nan."""
    return builder.select(builder.fcmp_ordered(">", a, b), a, b)


def fold_vector(builder: ir.IRBuilder, vector: ir.Value, join: Callable[[ir.Value, ir.Value], ir.Value]) -> ir.Value:
    """Return one number from the elements of a vector, joined in halves."""
    numbers = [builder.extract_element(vector, ir.Constant(ir.IntType(32), i)) for i in range(BLOCK)]
    while len(numbers) > 1:
        half = len(numbers) // 2
        numbers = [join(a, b) for a, b in zip(numbers[:half], numbers[half:], strict=True)]
    return numbers[0]


def _declare_function(builder: ir.IRBuilder, kind: ir.Type, name: str) -> ir.Value:
    """Return the declaration of an LLVM function."""
    return builder.module.globals.get(name) or ir.Function(builder.module, kind, name)


def make_variable(builder: ir.IRBuilder, begin: ir.Value) -> ir.Value:
    """Return memory for a value, set to an initial one."""
    with builder.goto_entry_block():
        place = builder.alloca(begin.type)
    builder.store(begin, place)
    return place


@contextmanager
def repeat_over(builder: ir.IRBuilder, start: ir.Value, stop: ir.Value, step: int) -> Iterator[ir.Value]:
    """Repeat the instructions written inside for each index of a range."""
    counter = make_variable(builder, start)
    test, body, end = (builder.append_basic_block(name) for name in ("test", "body", "end"))
    builder.branch(test)
    builder.position_at_end(test)
    index = builder.load(counter)
    builder.cbranch(builder.icmp_signed("<", index, stop), body, end)
    builder.position_at_end(body)
    yield index
    builder.store(builder.add(index, I64(step)), counter)
    builder.branch(test)
    builder.position_at_end(end)


def _each_block(builder: ir.IRBuilder, width: ir.Value) -> ir.Value:
    """Return a loop over blocks, whose variable is the index of a block."""
    return repeat_over(builder, I64(0), width, BLOCK)


def _blocks(
    builder: ir.IRBuilder, width: ir.Value, begin: ir.Value, block: Callable[[ir.Value, ir.Value], ir.Value]
) -> ir.Value:
    """Return a vector that is carried from block to block: ``carried = block(index, carried)``, from `begin` on."""
    carried = make_variable(builder, begin)
    with _each_block(builder, width) as i:
        builder.store(block(i, builder.load(carried)), carried)
    return builder.load(carried)


def combine(
    builder: ir.IRBuilder,
    width: ir.Value,
    h: ir.Value,
    first: ir.Value,
    last: ir.Value,
    column: ir.Value,
    value: ir.Value,
    rows: ir.Value,
    base: ir.Value,
    out: ir.Value,
) -> None:
    """Write `symgen.compile.loopcode.vectors.combine`."""
    _write_combine(builder, (width, h, first, last, column, value, rows), base, out, _last_whole)


def follow(
    builder: ir.IRBuilder,
    width: ir.Value,
    h: ir.Value,
    first: ir.Value,
    last: ir.Value,
    column: ir.Value,
    value: ir.Value,
    rows: ir.Value,
    base: ir.Value,
    out: ir.Value,
) -> None:
    """Write `symgen.compile.loopcode.vectors.follow`."""
    _write_combine(builder, (width, h, first, last, column, value, rows), base, out, _last_as_written)


def _write_combine(
    builder: ir.IRBuilder, table: tuple[ir.Value, ...], base: ir.Value, out: ir.Value, last_row: Callable[..., None]
) -> None:
    """Write `combine` with one of two functions that add the last row."""
    width, h, first, last, column, value, rows = table
    with builder.if_else(builder.icmp_signed("<", first, last)) as (some, none):
        with some:
            end = builder.sub(last, I64(1))
            row = builder.mul(builder.load(builder.gep(column, [end])), width)
            factor = spread_number(builder, builder.fmul(h, builder.load(builder.gep(value, [end])), flags=_FLAGS))
            for i, sum_of_rows in _sums(builder, (width, h, first, end, column, value, rows)):
                before = add_product(builder, spread_number(builder, h), sum_of_rows, load_vector(builder, base, i))
                rate, to = builder.gep(rows, [builder.add(row, i)]), builder.gep(out, [i])
                last_row(builder, width, before, factor, rate, to)
        with none, _each_block(builder, width) as i:
            store_vector(builder, load_vector(builder, base, i), out, i)


def _last_whole(
    builder: ir.IRBuilder, width: ir.Value, before: ir.Value, factor: ir.Value, rate: ir.Value, out: ir.Value
) -> None:
    """Write a block of a state: its part without the last row, plus the block of that row."""
    store_vector(builder, add_product(builder, factor, load_vector(builder, rate, I64(0)), before), out, I64(0))


def _last_as_written(
    builder: ir.IRBuilder, width: ir.Value, before: ir.Value, factor: ir.Value, rate: ir.Value, out: ir.Value
) -> None:
    """Write a block as `_last_whole` does where an emitted function has just written the row."""

    def small() -> None:
        undefined = ir.Constant(VECTOR, ir.Undefined)
        for k, pair in _pairs(builder, rate):
            places = ir.Constant(ir.VectorType(I32, 2), [k, k + 1])
            mine, weight = (builder.shuffle_vector(vector, undefined, places) for vector in (before, factor))
            builder.store(add_product(builder, weight, pair, mine), _pair_at(builder, out, I64(k)), align=8)

    _as_written(builder, width, small, partial(_last_whole, builder, width, before, factor, rate, out))


# -- what emitted functions have just written --------------------------------------------------------------------------
#
# They write number by number, and a vector cannot be loaded before all its numbers have left the store buffer; single
# numbers can. Large states are read as vectors all the same, as they have too many numbers.


def _as_written(builder: ir.IRBuilder, width: ir.Value, small: Callable[[], None], large: Callable[[], None]) -> None:
    """Write one of two versions of a block, by the width of the state."""
    with builder.if_else(builder.icmp_signed("<=", width, I64(_SMALL))) as (then, otherwise):
        with then:
            small()
        with otherwise:
            large()


def _pairs(builder: ir.IRBuilder, data: ir.Value) -> Iterator[tuple[int, Any]]:
    """Yield the pairs of a block with their positions; the compiler does not join atomic loads."""
    for k in range(0, BLOCK, 2):
        pair: ir.Value = ir.Constant(_PAIR, ir.Undefined)
        for i in range(2):
            where = builder.bitcast(builder.gep(data, [I64(k + i)]), I64.as_pointer())
            number = builder.bitcast(builder.load_atomic(where, "unordered", 8), F64)
            pair = builder.insert_element(pair, number, I32(i))
        yield k, pair


def _pair_at(builder: ir.IRBuilder, data: ir.Value, at: ir.Value) -> ir.Value:
    return builder.bitcast(builder.gep(data, [at]), _PAIR.as_pointer())


def total(
    builder: ir.IRBuilder,
    width: ir.Value,
    h: ir.Value,
    first: ir.Value,
    last: ir.Value,
    column: ir.Value,
    value: ir.Value,
    rows: ir.Value,
    out: ir.Value,
) -> None:
    """Write `symgen.compile.loopcode.vectors.total`."""
    factor = spread_number(builder, h)
    for i, sum_of_rows in _sums(builder, (width, h, first, last, column, value, rows)):
        store_vector(builder, builder.fmul(factor, sum_of_rows), out, i)


def _sums(builder: ir.IRBuilder, table: tuple[ir.Value, ...]) -> Iterator[tuple[Any, Any]]:
    """Yield each block's index and its sum of values times rows, inside the loop over blocks."""
    width, _, first, last, column, value, rows = table
    with _each_block(builder, width) as i:
        total = make_variable(builder, ZERO)
        with repeat_over(builder, first, last, 1) as k:
            row = builder.mul(builder.load(builder.gep(column, [k])), width)
            weight = spread_number(builder, builder.load(builder.gep(value, [k])))
            rate = load_vector(builder, rows, builder.add(row, i))
            builder.store(add_product(builder, weight, rate, builder.load(total)), total)
        yield i, builder.load(total)


def copied(builder: ir.IRBuilder, width: ir.Value, array: ir.Value, out: ir.Value) -> None:
    """Write `symgen.compile.loopcode.vectors.copied`."""
    with _each_block(builder, width) as i:
        store_vector(builder, load_vector(builder, array, i), out, i)


def received(builder: ir.IRBuilder, width: ir.Value, array: ir.Value, out: ir.Value) -> None:
    """Write `symgen.compile.loopcode.vectors.received`."""

    def small(i: ir.Value) -> None:
        for k, pair in _pairs(builder, builder.gep(array, [i])):
            builder.store(pair, _pair_at(builder, out, builder.add(i, I64(k))), align=8)

    def large(i: ir.Value) -> None:
        store_vector(builder, load_vector(builder, array, i), out, i)

    with _each_block(builder, width) as i:
        _as_written(builder, width, partial(small, i), partial(large, i))


def weigh(
    builder: ir.IRBuilder,
    width: ir.Value,
    error: ir.Value,
    share: ir.Value,
    y: ir.Value,
    new: ir.Value,
    rtol: ir.Value,
    atol: ir.Value,
) -> ir.Value:
    """Write `symgen.compile.loopcode.vectors.weigh`."""
    relative, absolute = spread_number(builder, rtol), spread_number(builder, atol)

    def block(i: ir.Value, total: ir.Value) -> ir.Value:
        place = load_vector(builder, share, builder.add(width, i))
        sizes = (_magnitude(builder, builder.fsub(load_vector(builder, x, i), place)) for x in (y, new))
        larger = _greater(builder, *sizes)
        weight = load_vector(builder, share, i)
        larger = builder.fmul(weight, larger)
        scale = builder.fadd(absolute, builder.fmul(relative, larger, flags=_FLAGS), flags=_FLAGS)
        error_here = builder.fmul(weight, load_vector(builder, error, i))
        none = builder.fcmp_ordered("==", error_here, ZERO)
        part = builder.select(none, ZERO, builder.fdiv(error_here, scale))
        return builder.fadd(total, builder.fmul(part, part, flags=_FLAGS), flags=_FLAGS)

    return fold_vector(builder, _blocks(builder, width, ZERO, block), builder.fadd)


def largest(
    builder: ir.IRBuilder, width: ir.Value, array: ir.Value, weights: ir.Value, first: ir.Value, last: ir.Value
) -> ir.Value:
    """Write `symgen.compile.loopcode.vectors.largest`."""
    low, high = spread_number(builder, first, _INDICES), spread_number(builder, last, _INDICES)

    def block(i: ir.Value, largest: ir.Value) -> ir.Value:
        index = builder.add(spread_number(builder, i, _INDICES), ir.Constant(_INDICES, list(range(BLOCK))))
        inside = builder.and_(builder.icmp_signed(">=", index, low), builder.icmp_signed("<", index, high))
        away = builder.fsub(load_vector(builder, array, i), load_vector(builder, weights, builder.add(width, i)))
        size = builder.fmul(_magnitude(builder, away), load_vector(builder, weights, i))
        size = builder.select(inside, size, ZERO)
        return _greater(builder, size, largest)

    return fold_vector(builder, _blocks(builder, width, ZERO, block), partial(_greater, builder))


def finite(builder: ir.IRBuilder, width: ir.Value, array: ir.Value) -> ir.Value:
    """Write `symgen.compile.loopcode.vectors.finite`."""

    def block(i: ir.Value, total: ir.Value) -> ir.Value:
        vector = load_vector(builder, array, i)
        return builder.fadd(total, builder.fsub(vector, vector))

    total = _blocks(builder, width, ZERO, block)
    return builder.fcmp_ordered("==", fold_vector(builder, total, builder.fadd), ir.Constant(F64, 0.0))
