"""Smaller mechanisms in which the same thing is still wrong."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator
from typing import Any

from benchmarks.mechanisms.draw import draw
from benchmarks.mechanisms.toml import text
from benchmarks.verification.one import Job, compared

Raw = dict[str, Any]


def shrunk(job: Job) -> str:
    """Return the text of the smallest mechanism found in which a run is still dishonest."""

    def bad(raw: Raw) -> bool:
        try:
            line = compared(raw, job.configurations, job.least)
        except Exception:  # a piece that is no mechanism any more
            return False
        return any(not run["honest"] for run in line.get("runs", ()))

    return text(smallest(draw(job.seed, job.index, job.spatial).raw, bad))


def smallest(raw: Raw, bad: Callable[[Raw], bool]) -> Raw:
    """Return what is left of a file when nothing more can be dropped without losing what is bad about it.

    Parameters
    ----------
    raw : dict
        A file that is bad.
    bad : callable
        Says whether a file still is.
    """
    smaller_one = True
    while smaller_one:
        smaller_one = False
        for smaller in _smaller(raw):
            if bad(smaller):
                raw, smaller_one = smaller, True
                break
    return raw


def _smaller(raw: Raw) -> Iterator[Raw]:
    """Yield the file without one thing: a force, a joint, a body with what hangs on it, a key that may be left out."""
    for section in ("forces", "joints", "tables", "parameters"):
        for name in raw.get(section, {}):
            yield _without(raw, section, name)
    if len(raw["bodies"]) > 1:
        for name in raw["bodies"]:
            yield _without_body(raw, name)
    for section in ("bodies", "forces", "joints"):
        for name, table in raw.get(section, {}).items():
            for key in table:
                if key not in ("type", "mass", "inertia", "between", "at", "body", "joint"):
                    smaller = copy.deepcopy(raw)
                    del smaller[section][name][key]
                    yield smaller
    for name, value in raw.get("parameters", {}).items():
        number = value["value"] if isinstance(value, dict) else value
        yield _inlined(raw, name, number)


def _without(raw: Raw, section: str, name: str) -> Raw:
    smaller = copy.deepcopy(raw)
    del smaller[section][name]
    return smaller


def _without_body(raw: Raw, body: str) -> Raw:
    smaller = _without(raw, "bodies", body)
    for section in ("joints", "forces"):
        for name, table in raw.get(section, {}).items():
            about = [*table.get("between", ()), table.get("body"), table.get("carrier"), table.get("reaction")]
            if body in about or f"{body}." in str(table):
                del smaller[section][name]
    return smaller


def _inlined(raw: Raw, name: str, number: float) -> Raw:
    """Return the file with a parameter's number where the parameter stood alone."""

    def replaced(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: replaced(item) for key, item in value.items()}
        if isinstance(value, list):
            return [replaced(item) for item in value]
        return number if isinstance(value, str) and name in value and "." not in value.replace("1.0", "") else value

    smaller = {section: replaced(content) for section, content in raw.items()}
    del smaller["parameters"][name]
    return smaller
