"""Settings as keyword arguments: their types for editors and type checkers, and the signatures that notebooks show.

Names, defaults and sentences are those of the table in `symgen.base.settings`; a test compares names and types with it.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Protocol, TypedDict, TypeVar

from symgen.base import settings as table
from symgen.base.plugins import explain_plugin_errors

F = TypeVar("F", bound=Callable[..., Any])


class EndedRun(Protocol):
    """A run that another one continues: a result."""

    @property
    def last_state(self) -> Any:
        """Its last state."""


class DrivenKeywords(TypedDict, total=False):
    """Settings of motions that drivers prescribe."""

    parameters: Mapping[str, float]
    inputs: Mapping[str, Any]
    start: Mapping[str, float] | EndedRun
    strict: bool
    shape: str


class StateKeywords(TypedDict, total=False):
    """Settings of analyses about a state."""

    parameters: Mapping[str, float]
    inputs: Mapping[str, Any]
    start: Mapping[str, float] | EndedRun
    coordinates: str
    shape: str


class PlaceKeywords(StateKeywords, total=False):
    """Settings of analyses about a state that a run leads to."""

    options: Mapping[str, str | float]
    events: Mapping[str, Mapping[str, Any]]
    strict: bool
    max_violation: float
    max_energy_error: float
    max_step: float | None
    max_attempts: float | None


class RunKeywords(PlaceKeywords, total=False):
    """Settings of runs: all settings."""

    method: str
    integrator: str | None
    step: float | None
    rtol: float | None
    atol: float | None
    until: float | None
    output_step: float | None
    times: Iterable[float] | None
    stop_when: str | Sequence[str]
    record_when: str | Sequence[str]
    verify: bool | None
    repeat: int


def keyword_names(keywords: type) -> tuple[str, ...]:
    """Return the settings that a class of keywords has, in the order of the table."""
    return tuple(name for name in table.setting_names() if name in keywords.__annotations__)


def make_entry(function: F) -> F:
    """Make a function one of the package's entries.

    An error inside a plugin leaves it as one sentence. Signature and docstring list the settings that its ``**changes``
    unpack, if it has such.
    """
    *_, last = inspect.signature(function).parameters.values()
    keywords = globals().get(str(last.annotation).removeprefix("Unpack[").removesuffix("]"))
    function = explain_plugin_errors(function)
    if last.kind is not last.VAR_KEYWORD or keywords is None:
        return function
    listed = {name: table.default_of_setting(name) for name in keyword_names(keywords)}
    spell_out_keywords(function, keywords, listed)
    lines = [
        f"{name} : {_kind_in_words(name)}\n    {table.setting_description(name).help}{_default_in_words(name)}\n"
        for name in listed
    ]
    text = inspect.cleandoc(function.__doc__ or "")
    function.__doc__ = text.replace("**changes\n", f"{''.join(lines)}**changes\n", 1)
    return function


def spell_out_keywords(
    function: Callable[..., Any], keywords: type, defaults: Mapping[str, Any], others: bool = False
) -> None:
    """Give a function a signature with names in place of its ``**`` parameter.

    Parameters
    ----------
    function : callable
        The function.
    keywords : type
        The typed dictionary of the names.
    defaults : mapping
        Default of each name.
    others : bool
        Whether other names are accepted.
    """
    kinds = {name: getattr(kind, "__forward_arg__", kind) for name, kind in keywords.__annotations__.items()}
    usual = inspect.signature(function)
    *own, rest = usual.parameters.values()
    own += [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=value, annotation=kinds[name])
        for name, value in defaults.items()
    ]
    own += [rest] * others
    function.__signature__ = usual.replace(parameters=own)  # type: ignore[attr-defined]  # what inspect looks for


def _kind_in_words(name: str) -> str:
    kind: str = table.setting_description(name).kind.__name__
    return {"dict": "mapping", "tuple": "sequence of float", "list": "sequence of str"}.get(kind, kind)


def _default_in_words(name: str) -> str:
    otherwise = table.setting_description(name).otherwise
    return f" By default: {otherwise}." if otherwise else ""
