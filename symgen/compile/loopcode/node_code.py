"""The functions of `symgen.compile.loopcode.nodes` in vectors of eight numbers, written with the builder of llvmlite.

Each takes a builder and the arguments, arrays as addresses, and returns the result.
"""

from __future__ import annotations

from llvmlite import ir

from symgen.compile.loopcode.nodes import CORRECTIONS, DOUBLED, INTEGRALS, PLACES, POINTS, TERMS
from symgen.compile.loopcode.vector_code import (
    I32,
    I64,
    VECTOR,
    ZERO,
    add_product,
    fold_vector,
    load_vector,
    make_variable,
    repeat_over,
    spread_number,
    store_vector,
)
from symgen.compile.native.types import NODES


def _element_at(builder: ir.IRBuilder, data: ir.Value, index: ir.Value) -> ir.Value:
    """Return an element of an array."""
    return builder.load(builder.gep(data, [index]))


def _index_of_vector(builder: ir.IRBuilder, index: ir.Value) -> ir.Value:
    return builder.mul(index, I64(NODES))


def _table_rows(builder: ir.IRBuilder, data: ir.Value, begin: int) -> list[ir.Value]:
    """Return rows of a table, kept in registers."""
    return [load_vector(builder, data, I64(begin + NODES * p)) for p in range(POINTS)]


def _sum_of_products(builder: ir.IRBuilder, factors: list[ir.Value], vectors: list[ir.Value]) -> ir.Value:
    """Return the sum of products of factors and vectors."""
    total: ir.Value = None
    for factor, vector in zip(factors, vectors, strict=True):
        total = builder.fmul(vector, factor) if total is None else add_product(builder, vector, factor, total)
    return total


def _rates_of_element(builder: ir.IRBuilder, i: ir.Value, first: ir.Value, rates: ir.Value) -> list[ir.Value]:
    """Return the rates of an element at the start and at the nodes, as vectors of equal numbers."""
    numbers = [_element_at(builder, first, i)]
    numbers += [_element_at(builder, rates, builder.add(_index_of_vector(builder, i), I64(p))) for p in range(NODES)]
    return [spread_number(builder, number) for number in numbers]


def _coordinate(builder: ir.IRBuilder, rows: ir.Value, c: ir.Value) -> ir.Value:
    """Return the coordinate whose rate is an unknown element, and whether it exists."""
    q = _element_at(builder, rows, builder.add(c, _element_at(builder, rows, I64(0))))
    return q, builder.icmp_signed(">=", q, I64(0))


def place(
    builder: ir.IRBuilder,
    h: ir.Value,
    rows: ir.Value,
    y: ir.Value,
    first: ir.Value,
    rates: ir.Value,
    table: ir.Value,
    out: ir.Value,
) -> None:
    """Write `symgen.compile.loopcode.nodes.place`."""
    h_all, h_square = spread_number(builder, h), spread_number(builder, builder.fmul(h, h))
    places = load_vector(builder, table, I64(PLACES))
    once, twice = _table_rows(builder, table, INTEGRALS), _table_rows(builder, table, DOUBLED)
    with _each_row(builder, rows) as c:
        i = _element_at(builder, rows, c)
        numbers, begin = _rates_of_element(builder, i, first, rates), _element_at(builder, y, i)
        moved = add_product(builder, h_all, _sum_of_products(builder, numbers, once), spread_number(builder, begin))
        store_vector(builder, moved, out, _index_of_vector(builder, i))
        q, is_velocity = _coordinate(builder, rows, c)
        with builder.if_then(is_velocity):
            way = add_product(
                builder,
                places,
                spread_number(builder, builder.fmul(h, begin)),
                spread_number(builder, _element_at(builder, y, q)),
            )
            moved = add_product(builder, h_square, _sum_of_products(builder, numbers, twice), way)
            store_vector(builder, moved, out, _index_of_vector(builder, q))


def _each_row(builder: ir.IRBuilder, rows: ir.Value) -> ir.Value:
    """Return a loop over the unknown rates; its variable counts them."""
    return repeat_over(builder, I64(1), builder.add(_element_at(builder, rows, I64(0)), I64(1)), 1)


def extrapolate(
    builder: ir.IRBuilder,
    rows: ir.Value,
    degree: ir.Value,
    ratio: ir.Value,
    places: ir.Value,
    coefficients: ir.Value,
    out: ir.Value,
) -> None:
    """Write `symgen.compile.loopcode.nodes.extrapolate`."""
    one = ir.Constant(VECTOR, [1.0] * NODES)
    twice = spread_number(builder, builder.fmul(ratio, ir.Constant(ir.DoubleType(), 2.0)))
    x = add_product(builder, twice, load_vector(builder, places, I64(0)), one)
    polynomials = [one, x]
    for p in range(2, POINTS):
        up, down = (ir.Constant(VECTOR, [f] * NODES) for f in ((2 * p - 1) / p, -(p - 1) / p))
        before, here = polynomials[-2:]
        polynomials.append(add_product(builder, builder.fmul(up, x), here, builder.fmul(down, before)))
    for p in range(2, POINTS):
        within = builder.icmp_signed("<=", I64(p), degree)
        polynomials[p] = builder.select(within, polynomials[p], ZERO)
    with _each_row(builder, rows) as c:
        i = _element_at(builder, rows, c)
        first = builder.mul(i, I64(2 * NODES))
        factors = [
            spread_number(builder, _element_at(builder, coefficients, builder.add(first, I64(p))))
            for p in range(POINTS)
        ]
        store_vector(builder, _sum_of_products(builder, factors, polynomials), out, _index_of_vector(builder, i))


def distance(
    builder: ir.IRBuilder, rows: ir.Value, weights: ir.Value, share: ir.Value, rates: ir.Value, before: ir.Value
) -> ir.Value:
    """Write `symgen.compile.loopcode.nodes.distance`."""
    total = make_variable(builder, ZERO)
    with _each_row(builder, rows) as c:
        i = _element_at(builder, rows, c)
        at = _index_of_vector(builder, i)
        difference = builder.fsub(load_vector(builder, rates, at), load_vector(builder, before, at))
        weighted = builder.fmul(difference, spread_number(builder, _element_at(builder, weights, i)))
        builder.store(add_product(builder, weighted, difference, builder.load(total)), total)
    return fold_vector(builder, builder.fmul(builder.load(total), load_vector(builder, share, I64(0))), builder.fadd)


def expand(
    builder: ir.IRBuilder,
    rows: ir.Value,
    weights: ir.Value,
    first: ir.Value,
    rates: ir.Value,
    table: ir.Value,
    out: ir.Value,
    squares: ir.Value,
) -> None:
    """Write `symgen.compile.loopcode.nodes.expand`."""
    sums = [make_variable(builder, ZERO) for _ in range(2)]
    halves = [
        [load_vector(builder, table, I64(2 * NODES * p + half * NODES)) for p in range(POINTS)]
        for half in range(len(sums))
    ]
    with _each_row(builder, rows) as c:
        i = _element_at(builder, rows, c)
        numbers, weight = (
            _rates_of_element(builder, i, first, rates),
            spread_number(builder, _element_at(builder, weights, i)),
        )
        for half, (sum_of_squares, vectors) in enumerate(zip(sums, halves, strict=True)):
            total = _sum_of_products(builder, numbers, vectors)
            store_vector(builder, total, out, builder.add(builder.mul(i, I64(2 * NODES)), I64(half * NODES)))
            weighted = builder.fmul(total, weight)
            builder.store(add_product(builder, weighted, total, builder.load(sum_of_squares)), sum_of_squares)
    for half, sum_of_squares in enumerate(sums):
        store_vector(builder, builder.load(sum_of_squares), squares, I64(half * NODES))


def refine(
    builder: ir.IRBuilder, rows: ir.Value, table: ir.Value, coefficients: ir.Value, more: ir.Value, out: ir.Value
) -> None:
    """Write `symgen.compile.loopcode.nodes.refine`."""
    polynomials, minus = _table_rows(builder, table, 0), ir.Constant(VECTOR, [-1.0] * NODES)
    undefined = ir.Constant(VECTOR, ir.Undefined)
    halves = [
        [load_vector(builder, table, I64(CORRECTIONS + p * TERMS + half)) for p in range(NODES)] for half in (0, NODES)
    ]
    with _each_row(builder, rows) as c:
        i = _element_at(builder, rows, c)
        first = builder.mul(i, I64(TERMS))
        numbers = _spread_numbers(builder, coefficients, first, 0, POINTS)
        left = add_product(
            builder,
            minus,
            _sum_of_products(builder, numbers, polynomials),
            load_vector(builder, more, _index_of_vector(builder, i)),
        )
        each = [
            builder.shuffle_vector(left, undefined, ir.Constant(ir.VectorType(I32, NODES), [p] * NODES))
            for p in range(NODES)
        ]
        for half, vectors in zip((0, NODES), halves, strict=True):
            at = builder.add(first, I64(half))
            total = load_vector(builder, coefficients, at)
            for number, vector in zip(each, vectors, strict=True):
                total = add_product(builder, vector, number, total)
            store_vector(builder, total, out, at)


def _spread_numbers(builder: ir.IRBuilder, data: ir.Value, first: ir.Value, start: int, stop: int) -> list[ir.Value]:
    """Return elements of an array after its index `first`, as vectors of equal numbers."""
    return [spread_number(builder, _element_at(builder, data, builder.add(first, I64(k)))) for k in range(start, stop)]


def integrate_legendre(builder: ir.IRBuilder, terms: ir.Value, x: ir.Value, once: ir.Value, twice: ir.Value) -> None:
    """Write `symgen.compile.loopcode.nodes.integrate_legendre`: for the polynomials of a step, and for more."""
    place = load_vector(builder, x, I64(0))
    z = add_product(builder, _all(2.0), place, _all(-1.0))
    values, integrals = [_all(1.0), z], [place]
    store_vector(builder, place, once, I64(0))
    store_vector(builder, builder.fmul(builder.fmul(_all(0.5), place), place), twice, I64(0))

    def up_to(last: int) -> None:
        for k in range(len(integrals), last + 1):
            lower, here = values[-2:]
            falling = builder.fmul(_all(-k / (k + 1)), lower)
            values.append(add_product(builder, builder.fmul(_all((2 * k + 1) / (k + 1)), z), here, falling))
            integrals.append(builder.fmul(builder.fsub(values[-1], lower), _all(1 / (4 * k + 2))))
            if k < TERMS:
                store_vector(builder, integrals[k], once, I64(k * NODES))
            if k > 1:
                doubled = builder.fmul(builder.fsub(integrals[k], integrals[k - 2]), _all(1 / (4 * k - 2)))
                store_vector(builder, doubled, twice, I64((k - 1) * NODES))

    up_to(POINTS)
    with builder.if_then(builder.icmp_signed(">", terms, I64(POINTS))):
        up_to(TERMS)


def _all(number: float) -> ir.Value:
    return ir.Constant(VECTOR, [number] * NODES)


def sum_up(
    builder: ir.IRBuilder,
    h: ir.Value,
    terms: ir.Value,
    x: ir.Value,
    rows: ir.Value,
    y: ir.Value,
    coefficients: ir.Value,
    once: ir.Value,
    twice: ir.Value,
    out: ir.Value,
) -> None:
    """Write `symgen.compile.loopcode.nodes.sum_up`."""
    h_all, h_square = spread_number(builder, h), spread_number(builder, builder.fmul(h, h))
    way = builder.fmul(h_all, load_vector(builder, x, I64(0)))
    tables = [[load_vector(builder, table, I64(k * NODES)) for k in range(POINTS)] for table in (once, twice)]

    def series(which: int, first: ir.Value) -> ir.Value:
        total = make_variable(
            builder, _sum_of_products(builder, _spread_numbers(builder, coefficients, first, 0, POINTS), tables[which])
        )
        with repeat_over(builder, I64(POINTS), terms, 1) as k:
            number = spread_number(builder, _element_at(builder, coefficients, builder.add(first, k)))
            vector = load_vector(builder, (once, twice)[which], _index_of_vector(builder, k))
            builder.store(add_product(builder, vector, number, builder.load(total)), total)
        return builder.load(total)

    with _each_row(builder, rows) as c:
        i = _element_at(builder, rows, c)
        first, begin = builder.mul(i, I64(TERMS)), spread_number(builder, _element_at(builder, y, i))
        store_vector(builder, add_product(builder, h_all, series(0, first), begin), out, _index_of_vector(builder, i))
        q, is_velocity = _coordinate(builder, rows, c)
        with builder.if_then(is_velocity):
            moved = add_product(builder, way, begin, spread_number(builder, _element_at(builder, y, q)))
            store_vector(
                builder, add_product(builder, h_square, series(1, first), moved), out, _index_of_vector(builder, q)
            )
