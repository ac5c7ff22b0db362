"""The settings of a run: one table of names, kinds, defaults, units and words.

Python's arguments, the options of every command and the tables of the documentation are made from it or checked
against it. Nothing is imported here, since ``--help`` needs this module.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import partial
from typing import Any, cast

from symgen.base import arguments
from symgen.base.errors import InputError, suggest

SHAPES = ("auto", "straight", "looped")
COORDINATES = ("absolute", "joint", "auto")
#: Words of textbooks and of other programs for them.
COORDINATES_MEANT = {
    **dict.fromkeys(("relative", "minimal", "reduced", "generalized", "generalised", "joints", "tree"), "joint"),
    **dict.fromkeys(("cartesian", "maximal", "redundant", "global", "bodies", "body", "natural"), "absolute"),
}


@dataclass(frozen=True)
class About:
    """Facts about a setting apart from its name and default.

    Attributes
    ----------
    text : str
        One sentence, with ``{unit}`` where its unit belongs.
    kind : type
        Of its values: float, int, str, bool, dict (values by name), tuple (numbers) or list (texts).
    check : callable
        (where, value) -> the value as a run takes it, or `InputError`.
    unit : str
        Its unit, empty where it has none.
    flag : str
        The option of commands; ``--name`` by default.
    metavar : str
        Placeholder of a value in the help of commands.
    otherwise : str
        Behaviour without a value, if there is no plain default.
    """

    text: str
    kind: type
    check: Callable[[str, Any], Any]
    unit: str = ""
    flag: str = ""
    metavar: str = ""
    otherwise: str = ""

    @property
    def help(self) -> str:
        """The sentence with its unit."""
        return self.text.format(unit=f" [{self.unit}]" if self.unit else "")


_positive = partial(arguments.number, positive=True)
_name = partial(arguments.text, expected="a name")
_repeat = partial(arguments.whole_number, least=1, most=1000)
_shape, _coordinates = (
    partial(arguments.one_word_of, candidates=SHAPES),
    partial(arguments.one_word_of, candidates=COORDINATES, meant=COORDINATES_MEANT),
)


def _check_values(where: str, value: object) -> dict[str, float]:
    values = arguments.mapping(where, value, "numbers by the names of parameters")
    return {name: arguments.number(f"{where} '{name}'", item) for name, item in values.items()}


def _check_start(where: str, value: object) -> Mapping[str, float]:
    # the last state of another run is checked where it is used
    if value is not None and not isinstance(value, Mapping) and hasattr(value, "last_state"):
        return value  # type: ignore[return-value]  # a result
    values = arguments.mapping(where, value, "values by the names of coordinates and velocities, or a result")
    return {name: arguments.number(f"{where} '{name}'", item) for name, item in values.items()}


def _check_inputs(where: str, value: object) -> dict[str, Any]:
    # the values are checked where the mechanism is known
    return arguments.mapping(where, value, "numbers, formulas or data by the names of inputs")


def _check_conditions(where: str, value: object) -> tuple[str, ...]:
    return tuple(arguments.text(where, x, "a condition such as 'ball.y < 0.1'") for x in arguments.words(where, value))


def _check_events(where: str, value: object) -> dict[str, dict[str, Any]]:
    expected = "tables by the names of events, such as {'low': {'when': 'ball.y < 0.1'}}"
    tables = arguments.mapping(where, value, expected)
    return {name: arguments.mapping(f"{where} '{name}'", table, expected) for name, table in tables.items()}


def _check_options(where: str, value: object) -> dict[str, str | float]:
    values = arguments.mapping(where, value, "values by the names of options, such as 'method.alpha'")
    return {k: v if isinstance(v, str) else arguments.number(f"{where} '{k}'", v) for k, v in values.items()}


def _check_times(where: str, value: object) -> Sequence[float]:
    # an array is checked where it is created; it may be long
    return value if hasattr(value, "dtype") else arguments.numbers(where, value)  # type: ignore[return-value]  # an array is numbers


def _declare_setting(default: object, text: str, kind: type, check: Callable[[str, Any], Any], **further: str) -> Any:
    about = {"about": About(text, kind, check, **further)}
    if isinstance(default, dict):
        return field(default_factory=dict, metadata=about)
    return field(default=default, metadata=about)


_number = partial(_declare_setting, kind=float, check=_positive)
_switch = partial(_declare_setting, kind=bool, check=arguments.truth_value)


@dataclass(frozen=True)
class Settings:
    """Settings of a run; `Model.simulate` describes each of them.

    Raises
    ------
    InputError
        If a value is of the wrong kind or out of its range.
    """

    method: str = _declare_setting("direct-correction", "Constraint stabilisation method, or auto.", str, _name)
    integrator: str | None = _declare_setting(
        None,
        "Integrator, or auto.",
        str,
        _name,
        otherwise="of the mechanism; the method's own, mostly picard or dop853",
    )
    step: float | None = _number(
        None,
        "Step{unit}: constant, or the first one of an adaptive integrator.",
        unit="s",
        otherwise="of the mechanism; chosen",
    )
    rtol: float | None = _number(None, "Relative tolerance of an adaptive integrator.", otherwise="1e-8")
    atol: float | None = _number(None, "Absolute tolerance of an adaptive integrator.", otherwise="1e-10")
    until: float | None = _number(None, "End time{unit}.", unit="s", otherwise="of the mechanism")
    output_step: float | None = _number(
        None,
        "Time between outputs{unit}.",
        unit="s",
        otherwise="of the mechanism; every step, or 1001 times of an adaptive run",
    )
    times: Sequence[float] | None = _declare_setting(
        None, "Output times{unit}.", tuple, _check_times, unit="s", metavar="T,T,..."
    )
    parameters: Mapping[str, float] = _declare_setting(
        {}, "Value of a parameter of the mechanism.", dict, _check_values, flag="--set", metavar="NAME=VALUE"
    )
    inputs: Mapping[str, Any] = _declare_setting(
        {},
        "Input: a number, a formula of t, parameters and state, or FILE.csv:COLUMN[:hold|linear|cubic|pchip].",
        dict,
        _check_inputs,
        flag="--input",
        metavar="NAME=VALUE",
    )
    start: Mapping[str, float] = _declare_setting(
        {},
        "Coordinate or velocity that the start keeps, such as crank.theta=0.5.",
        dict,
        _check_start,
        metavar="NAME=VALUE",
    )
    options: Mapping[str, str | float] = _declare_setting(
        {},
        "Option of the method or integrator, such as method.alpha=5.",
        dict,
        _check_options,
        flag="--option",
        metavar="KEY=VALUE",
    )
    stop_when: Sequence[str] = _declare_setting(
        (),
        "Condition at which the run ends, such as 'crank.theta > 2*pi'.",
        list,
        _check_conditions,
        metavar="CONDITION",
    )
    record_when: Sequence[str] = _declare_setting(
        (), "Condition at which time and state are recorded.", list, _check_conditions, metavar="CONDITION"
    )
    events: Mapping[str, Mapping[str, Any]] = _declare_setting(
        {}, "Events in addition to those of the mechanism, as tables by name.", dict, _check_events
    )
    strict: bool = _switch(False, "Refuse an inconsistent start.")
    verify: bool | None = _switch(
        None,
        "Estimate the error by a second run with finer steps, and settle doubts by it.",
        otherwise="of the mechanism; adaptive runs with default tolerances, of long ones a first part",
    )
    max_violation: float = _number(
        1e-6, "Largest violation of positions and of velocities, as fractions of the mechanism's length and speed."
    )
    max_energy_error: float = _number(
        0.05, "Largest energy error that is tolerated, as a fraction of the energy in motion."
    )
    max_step: float | None = _number(
        None,
        "Largest step{unit} of an adaptive integrator.",
        unit="s",
        otherwise="of the mechanism; none, or a thousandth of the run where formulas of t may have short features",
    )
    max_attempts: float | None = _number(
        None,
        "Attempts at steps after which a run ends as failed; constant steps that would be more are refused.",
        otherwise="1e8 adaptive, 2e9 constant",
    )
    repeat: int = _declare_setting(1, "Time this many runs after a warm-up.", int, _repeat, metavar="N")
    shape: str = _declare_setting("auto", "Shape of the code: auto, straight or looped.", str, _shape)
    coordinates: str = _declare_setting(
        "absolute",
        "Coordinates of the state: absolute (of bodies), joint (of the joints of a tree) or auto.",
        str,
        _coordinates,
    )

    def __post_init__(self) -> None:
        for f in fields(self):
            value = getattr(self, f.name)
            if value is not None or f.name in ("parameters", "inputs", "start", "options") or f.default is not None:
                object.__setattr__(self, f.name, setting_description(f.name).check(f.name, value))


def setting_description(name: str) -> About:
    """Return the description of the setting called `name`."""
    return _ABOUT[name]


def setting_names() -> tuple[str, ...]:
    """Return the names of all settings, in the order of the table."""
    return tuple(_ABOUT)


def default_of_setting(name: str) -> Any:
    """Return the default of a setting."""
    return getattr(Settings(), name)


def differs_from_default(settings: Settings, name: str) -> bool:
    """Whether a setting differs from its default."""
    value, usual = getattr(settings, name), default_of_setting(name)
    return bool(value is not None if usual is None else value != usual)  # an array of times has no one truth


def command_flag(name: str) -> str:
    """Return the option of commands that is the setting called `name`."""
    return setting_description(name).flag or f"--{name.replace('_', '-')}"


def change_settings(settings: Settings | None, changes: Mapping[str, object]) -> Settings:
    """Return settings, the defaults if None, with some replaced.

    Raises
    ------
    InputError
        If a name is not a setting (says the nearest one), or a value is of the wrong kind.
    """
    for name in changes:
        if name not in _ABOUT:
            hint = _ELSEWHERE.get(name) or suggest(name, _ABOUT)
            raise InputError("settings", "the name of a setting", f"'{name}'", hint)
    base = Settings() if settings is None else arguments.instance("settings", settings, Settings, "Settings")
    return replace(base, **cast(dict[str, Any], dict(changes)))


#: Arguments of single runs that are not among their settings, and what to do.
_ELSEWHERE = {
    "sensitivities": "single runs have them: simulate(settings, sensitivities=...), rows by Sweep.sensitivities(...)",
}
_ABOUT: dict[str, About] = {f.name: f.metadata["about"] for f in fields(Settings)}
