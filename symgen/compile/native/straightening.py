"""Straight functions with the statements of functions that repeat some: what an adjoint is taken of.

A correction of a state, and rates of the state by iteration, pass through a loop until something has converged. With a
number of passes that is given they are straight.
"""

from __future__ import annotations

import msgspec

from symgen.compile.native import language as lang
from symgen.compile.native.accesses import array_accesses
from symgen.compile.native.read_values import Foreign


def with_fixed_passes(function: lang.Function, rounds: int) -> tuple[lang.Function, str]:
    """Return a function with a number of passes, and the array that it is for.

    Parameters
    ----------
    function : Function
        Rates of the state by iteration, or ``accept``.
    rounds : int
        Passes through the iteration, or those of a correction before its last one.

    Raises
    ------
    Foreign
        If it is of another form.
    """
    if any(p.name == "ydot" for p in function.parameters):
        return iterated_rates(function, rounds), "ydot"
    return straight_correction(function, rounds), "y"


def has_early_end(function: lang.Function) -> bool:
    """Whether a function has a loop that ends before all its passes."""
    return any(isinstance(x, lang.For) and any(map(_leaves_loop, x.body)) for x in function.body)


def _leaves_loop(statement: lang.Statement) -> bool:
    return isinstance(statement, lang.If) and any(isinstance(x, lang.Leave) for x in statement.then)


def iterated_rates(rates: lang.Function, rounds: int) -> lang.Function:
    """Return rates of the state after a number of iterations, as a straight function.

    Parameters
    ----------
    rates : Function
        Functions that it calls, with a loop among them that ends where a test is true.
    rounds : int
        Number of iterations; where they have converged, further ones change nothing but digits beyond the last.

    Raises
    ------
    Foreign
        If it is of another form.
    """
    kept = list[lang.Statement]()
    for statement in rates.body:
        if isinstance(statement, lang.For):
            kept += [
                each for x in statement.body if _stores_in_arrays(x, "w") for each in _statement_without_result(x)
            ] * rounds
        elif isinstance(statement, lang.Return):
            kept.append(statement)
        elif _stores_in_arrays(statement, "w", "ydot"):
            kept += _statement_without_result(statement)
    return msgspec.structs.replace(rates, body=tuple(kept))


def _stores_in_arrays(statement: lang.Statement, *arrays: str) -> bool:
    """Whether a statement stores in some arrays."""
    return any(array in arrays for array, _ in array_accesses((statement,)).stored)


def straight_correction(accept: lang.Function, rounds: int) -> lang.Function:
    """Return what ``accept`` does to a state in a number of rounds, as a straight function.

    Parameters
    ----------
    accept : Function
        Functions that it calls, then a loop whose last pass is the one in which a variable is true, then measures.
    rounds : int
        Number of passes before the last one.

    Raises
    ------
    Foreign
        If it is of another form.
    """
    kept, behind = list[lang.Statement](), False
    for statement in accept.body:
        if not _stores_in_arrays(statement, "y", "w"):
            continue
        if behind and _stores_in_arrays(statement, "y"):
            raise Foreign("a correction behind another one")
        if isinstance(statement, lang.For) and not behind:
            kept += [*_pass_of_correction(statement.body, False) * rounds, *_pass_of_correction(statement.body, True)]
            behind = True
        elif not behind:
            kept += _statement_without_result(statement)
    return msgspec.structs.replace(accept, body=tuple(kept))


def _statement_without_result(statement: lang.Statement) -> list[lang.Statement]:
    """Return a statement that stores floats, without its result."""
    if isinstance(statement, lang.Assign) and isinstance(statement.value, lang.FunctionCall):
        return [lang.Evaluate(statement.value)]
    if isinstance(statement, lang.Evaluate | lang.Store | lang.For):
        return [statement]
    raise Foreign("a correction that depends on the state")


def _pass_of_correction(body: tuple[lang.Statement, ...], last: bool) -> list[lang.Statement]:
    """Return the statements of a pass through the rounds of a correction that store floats."""
    kept, tests = list[lang.Statement](), set[str]()
    for statement in body:
        if isinstance(statement, lang.If):
            if not isinstance(statement.test, lang.Variable):
                raise Foreign("a correction with tests of other things than its last pass")
            tests.add(statement.test.name)
            for each in statement.then if last else statement.otherwise:
                if isinstance(each, lang.Leave):
                    return kept
                kept += _statement_without_result(each)
        elif _stores_in_arrays(statement, "y", "w"):
            kept += _statement_without_result(statement)
    if last or len(tests) > 1:
        raise Foreign("a correction without a last pass")
    return kept
