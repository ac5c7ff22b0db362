"""Options of a run, by the names of the method and the integrator that they belong to."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from symgen.base.arguments import kind_of_value
from symgen.base.errors import InputError, suggest
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.run.compiling.method_choice import MethodChoice, choose_method
from symgen.run.loops.integrator import can_choose_steps

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.run.loops.integrator import Integrator


def split_options(s: Settings, tableau: Integrator) -> tuple[MethodChoice, dict[str, float], dict[str, str]]:
    """Return the method with structural options, its numeric parameters, and the integrator's options.

    Keys are ``method.NAME`` or the method's own name, ``integrator.NAME`` or the integrator's own name.
    """
    base = choose_method(s.method).method
    numeric = {p.name: p for p in base.parameters}
    structural: dict[str, str] = {}
    parameters: dict[str, float] = {}
    integrator: dict[str, str] = {}
    options = set[tuple[bool, str]]()
    for key, value in s.options.items():
        owner, _, name = key.partition(".")
        one = owner in ("method", base.name), name
        if one in options:
            raise InputError(f"option {key}", "each option once", f"{name} by two names of its owner")
        options.add(one)
        if one[0]:
            if name in numeric:
                parameters[name] = _number(key, value)
                if parameters[name] < numeric[name].minimum:
                    raise InputError(f"option {key}", f"at least {numeric[name].minimum:g}", f"{value}")
            else:
                structural[name] = str(value)
        elif owner in ("integrator", tableau.name):
            integrator[name] = _integrator_option(key, name, value, tableau)
        else:
            own = [f"method.{name}" for name in (*numeric, *(o.name for o in base.options))]
            own += [f"integrator.{p.name}" for p in tableau.parameters]
            owners = ("method", base.name, "integrator", tableau.name)
            bare = [full for full in own if full.partition(".")[2] == key]
            hint = f"did you mean '{bare[0]}'?" if bare else suggest(owner, owners) if name else suggest(key, own)
            raise InputError(f"option {key}", "method.NAME or integrator.NAME", f"'{key}'", hint)
    return choose_method(s.method, structural, not EXPLICIT_FORMS & set(tableau.forms)), parameters, integrator


def _integrator_option(key: str, name: str, value: str | float, integrator: Integrator) -> str:
    """Return the checked text of an integrator's option: a switch or a number."""
    numeric = {q.name: q for q in integrator.parameters}
    if name in numeric:
        q, number = numeric[name], _number(key, value)
        if not q.minimum <= number <= q.maximum or (q.whole and not number.is_integer()):
            what = "a whole number from" if q.whole else "from"
            raise InputError(f"option {key}", f"{what} {q.minimum:g} to {q.maximum:g}", f"{value}")
        return repr(number)
    if can_choose_steps(integrator) and name == "adaptive" and str(value).lower() in ("true", "false"):
        return str(value).lower()
    names = [*numeric, *(("adaptive=true", "adaptive=false") if can_choose_steps(integrator) else ())]
    raise InputError(
        f"option {key}",
        f"an option of {integrator.name}",
        f"'{name}={value}'",
        suggest(name, names) if names else "it has none",
    )


def _number(key: str, value: str | float) -> float:
    """Return the number of an option, which a command gives as text."""
    try:
        number = float(value)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise InputError(f"option {key}", "a finite number", kind_of_value(value))
    return number
