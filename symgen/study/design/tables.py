"""Tables of an answer, for the command and for reports: cells as text."""

from __future__ import annotations

from symgen.analyses.kinds import AnalysisTable
from symgen.base.units import known_unit
from symgen.study.design.found import Design, KeptLimit


def sentence_of_aim(found: Design) -> str:
    """Return what the aim was and is, and how many motions that took."""
    unit = f" {found.unit}".rstrip()
    change = f"{found.before:.6g}{unit} before, {found.after:.6g}{unit} after"
    return f"{found.mechanism}: {found.aim}: {change}, {found.runs} motions"


def table_of_values(found: Design) -> AnalysisTable:
    """Return the numbers that varied, in the units of the file."""
    own = {p.name: p.own_unit for p in found.first_model.mechanism.parameters}
    rows = []
    for name, value in found.values.items():
        unit = own.get(name, known_unit(""))
        numbers = (found.start_values[name], value, *found.ranges[name])
        rows.append((name, *(f"{unit.from_si(x):.6g}" for x in numbers), unit.text or found.units[name]))
    return AnalysisTable(("number", "before", "after", "least", "most", "unit"), rows, ("number", "unit"))


def table_of_limits(found: Design) -> AnalysisTable:
    """Return the limits with what they reached."""
    rows = [
        (each.text, f"{each.before:.6g}", f"{each.after:.6g}", time_in_words(each), state_of_limit(each), price(each))
        for each in found.limits
    ]
    return AnalysisTable(("limit", "before", "after", "at t [s]", "", "price"), rows, ("limit", "", "price"))


def time_in_words(each: KeptLimit) -> str:
    """Return when a limit was reached, empty for a mean."""
    return "" if each.t is None else f"{each.t:.4g}"


def state_of_limit(each: KeptLimit) -> str:
    """Return whether a limit is missed, active or kept."""
    return "missed" if not each.is_met else "active" if each.active else "kept"


def price(each: KeptLimit) -> str:
    """Return what a unit of a limit costs of the aim; of a length, a millimetre."""
    if not each.active or not each.is_met:
        return ""
    if each.price is None:
        return "not known"
    unit, cost = each.price_unit, each.price
    if unit.endswith("/m"):
        unit, cost = f"{unit[:-2]}/mm", cost / 1000.0
    return f"{cost:.4g} {unit}".rstrip()


def table_of_starts(found: Design) -> AnalysisTable:
    """Return the searches."""
    rows = [
        (each.whence, f"{each.before:.6g}", f"{each.after:.6g}", "yes" if each.is_within else "no", f"{each.runs}")
        for each in found.starts
    ]
    return AnalysisTable(("start", "before", "after", "within limits", "motions"), rows, ("start", "within limits"))


def table_of_failures(found: Design) -> AnalysisTable:
    """Return why candidates did not move."""
    rows = [(reason, f"{count}") for reason, count in found.failed.items()]
    return AnalysisTable(("candidates without a motion", "number"), rows, ("candidates without a motion",))
