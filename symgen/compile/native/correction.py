"""The correction of a state as a straight function, which has an adjoint."""

from __future__ import annotations

import msgspec

from symgen.compile.native import language as lang
from symgen.compile.native.accesses import accesses
from symgen.compile.native.read_values import Foreign


def correction(accept: lang.Function, rounds: int) -> lang.Function:
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
        own = accesses((statement,))
        if not any(array in ("y", "w") for array, _ in own.stored):
            continue
        if behind and any(array == "y" for array, _ in own.stored):
            raise Foreign("a correction behind another one")
        if isinstance(statement, lang.For) and not behind:
            kept += [*_pass(statement.body, False) * rounds, *_pass(statement.body, True)]
            behind = True
        elif not behind:
            kept += _acting(statement)
    return msgspec.structs.replace(accept, body=tuple(kept))


def _acting(statement: lang.Statement) -> list[lang.Statement]:
    """Return a statement that stores floats, without its result."""
    if isinstance(statement, lang.Assign) and isinstance(statement.value, lang.FunctionCall):
        return [lang.Evaluate(statement.value)]
    if isinstance(statement, lang.Evaluate | lang.Store | lang.For):
        return [statement]
    raise Foreign("a correction that depends on the state")


def _pass(body: tuple[lang.Statement, ...], last: bool) -> list[lang.Statement]:
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
                kept += _acting(each)
        elif any(array in ("y", "w") for array, _ in accesses((statement,)).stored):
            kept += _acting(statement)
    if last or len(tests) > 1:
        raise Foreign("a correction without a last pass")
    return kept
