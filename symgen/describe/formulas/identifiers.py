"""Names that a file may use: they become identifiers in emitted code, so they are checked where they are typed."""

from __future__ import annotations

import keyword
import re

from symgen.base.errors import InputError, quote
from symgen.base.escapes import printable
from symgen.base.vocabulary.expressions import FUNCTIONS

#: Tree functions that are written as operators, not by name.
OPERATORS = frozenset({"add", "sub", "mul", "div", "pow", "neg", "lt", "le", "gt", "ge", "and", "or", "not", "where"})
OPERATORS |= {"both", "either"}
#: Functions a formula may call.
CALLABLE = frozenset(FUNCTIONS) - OPERATORS | {"piecewise"}
#: Further function in outputs.
INTEGRAL = "integral"
#: Names with a meaning of their own.
RESERVED = frozenset({"ground", "t", "pi"}) | CALLABLE
#: Names of what an effort acts along and of its rate: what formulas read by its name alone has others. Bodies, joints
#: and the like are read with a dot, as ``s.x``.
PLACEHOLDERS = frozenset({"s", "rate"})
#: What formulas read by its name alone.
_READ = frozenset({"parameter", "input", "state", "table"})
LONGEST = 64

_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_KEBAB = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


def one_line(text: str) -> str:
    """Return a text for people on one line and printable: it is shown on terminals and in pages."""
    return printable(" ".join(text.split()))


def check_identifier(name: str, where: str, what: str) -> str:
    """Return `name` if it may name a body, joint, force, parameter, table or point; else raise `InputError`."""
    named = f"{'an' if what[0] in 'aeiou' else 'a'} {what} name"
    if len(name) > LONGEST:
        raise InputError(where, f"{named} of at most {LONGEST} characters", f"{len(name)} characters", "", name)
    if not _IDENTIFIER.fullmatch(name):
        hint = ""
        cured = re.sub(r"[^A-Za-z0-9_]", "_", name).lstrip("_0123456789")
        if cured and not keyword.iskeyword(cured) and cured not in RESERVED | PLACEHOLDERS:
            hint = f"for example '{cured}'"
        raise InputError(where, f"{named} of letters, digits and _, a letter first", quote(name), hint, name)
    if name in RESERVED or keyword.iskeyword(name) or (name in PLACEHOLDERS and what in _READ):
        of_forces = "formulas of forces mean by 's' what they act along, by 'rate' its rate; "
        why = of_forces if name in PLACEHOLDERS else ""
        raise InputError(where, f"{named} that has no meaning of its own", quote(name), f"{why}'{name}_' is free", name)
    return name


def check_mechanism_name(name: str, where: str) -> str:
    """Return `name` if it may name a mechanism: lower-case words joined by dashes."""
    if len(name) > LONGEST or not _KEBAB.fullmatch(name):
        cured = re.sub(r"[^a-z0-9]+", "-", name.lower().removesuffix(".toml")).strip("-0123456789")[:LONGEST].strip("-")
        hint = f"for example '{cured}'" if cured else ""
        raise InputError(where, "lower-case words joined by dashes, such as 'four-bar'", quote(name), hint)
    return name
