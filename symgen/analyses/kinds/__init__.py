"""Kinds of analyses with their commands, one file each: methods of models, options, and what the command prints.

The first line of a file's docstring is the line of its command in ``symgen --help``. Files import nothing heavy before
an analysis is made, as ``symgen modes --help`` imports them; methods of every file are those of `symgen.api.Model`.

In: a model, and the options of a command.
Out: a result with its tables.
Imports: NumPy; rooms beside and streets below.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any, Literal

from symgen.base.errors import InputError
from symgen.base.keywords import DrivenKeywords, PlaceKeywords, StateKeywords, keyword_names
from symgen.base.registry import Registry
from symgen.base.settings import Settings, change_settings

#: Settings of analyses about a state, and of motions that drivers prescribe.
OF_STATES, OF_MOTIONS = keyword_names(StateKeywords), keyword_names(DrivenKeywords)
#: Those of them that count where drivers say the motion, not where it was recorded.
OF_DRIVEN = ("start", "strict")

Kind = Literal[
    "text", "texts", "columns", "whole", "switch", "words", "numbers", "range", "times", "place", "plot", "tables"
]


@dataclass(frozen=True)
class Option:
    """An option of a command.

    Attributes
    ----------
    name : str
        The option, such as ``--count``, or the name of a setting, whose values arrive in the settings.
    help : str
        What the help says of it; for a setting, by default what the table of settings says.
    kind : str
        Of its value: ``text``, ``texts`` (given several times), ``columns`` (``A,B``, given several times), ``whole``,
        ``switch``, ``words`` (``A,B``), ``numbers`` (``A=1``, given several times), ``range`` (``A=lin(0,1,5)``),
        ``times``, ``place`` (a word or ``A=0,B=1``), or a file to write: ``plot``, ``tables``.
    metavar : str
        Placeholder of a value in the help.
    argument : str
        Name of the argument that takes the value; that of the option by default.
    default : str, optional
        Default value.
    """

    name: str
    help: str = ""
    kind: Kind = "text"
    metavar: str = ""
    argument: str = ""
    default: str | None = None

    def __post_init__(self) -> None:
        if not self.argument:
            object.__setattr__(self, "argument", self.name.lstrip("-").replace("-", "_"))

    @property
    def is_setting(self) -> bool:
        """Whether it is a setting."""
        return not self.name.startswith("-")


#: Settings of analyses about a state.
STATE = tuple(Option(name) for name in ("parameters", "start", "coordinates", "shape"))
#: These, and which state it is; further options arrive as arguments ``at``, ``states`` and ``cyclic``.
PLACE = (
    *STATE,
    Option(
        "--at",
        "The state: equilibrium, start, steady, a time of a run [s], or an equilibrium by coordinates: A=0,B=1.",
        "place",
        "PLACE",
        default="equilibrium",
    ),
    Option("--states", "Quantities that are the states.  [default: automatic]", "words", "NAME,NAME"),
    Option("--cyclic", "With --at steady: coordinates that keep turning.  [default: automatic]", "words", "NAME,NAME"),
)


def motion_settings(start: str) -> tuple[Option, ...]:
    """Return the settings of a motion that drivers prescribe; `start` is what the help says of ``--start``."""
    names = ("parameters", "inputs", "start", "strict", "shape")
    return tuple(Option(name, start if name == "start" else "") for name in names)


def table_options(shown: str, drawn: str) -> tuple[Option, ...]:
    """Return the options of what is done with tables over time: what ``--quantity`` names and ``--plot`` draws."""
    return (
        Option("--quantity", shown, "columns", "NAME,NAME", "quantities"),
        Option("--save", "Write tables to FILE: .csv, with units, or .parquet.", "tables", "FILE"),
        Option("--plot", f"Draw {drawn} into FILE: .png, .svg, .pdf or .pgf.", "plot", "FILE"),
        Option("--over", "Draw over NAME, such as crank.theta.  [default: t]", metavar="NAME"),
    )


def check_over(over: str | None, plot: Path | None) -> None:
    """Refuse ``--over`` without a plot."""
    if over is not None and plot is None:
        raise InputError("--over", "--plot FILE, which draws over it", "no --plot")


@dataclass(frozen=True)
class AnalysisTable:
    """Table shown by a command.

    Attributes
    ----------
    headings : sequence of str
        Of its columns.
    rows : sequence of sequence of str
        Their cells.
    left : sequence of str
        Headings of left-aligned columns, such as words.
    """

    headings: Sequence[str]
    rows: Sequence[Sequence[str]]
    left: Sequence[str] = ()


@dataclass(frozen=True)
class AnalysisOutput:
    """Output of a command.

    Attributes
    ----------
    json : mapping
        With ``--json``.
    shown : iterable
        Without: lines, tables, or mappings, which are extremes of quantities by name.
    notes : iterable of str
        Sentences on standard error.
    ended : str
        Reason why the analysis did not finish, empty if it did.
    files : mapping
        Path -> what writes it; None is a file that is not wanted.
    """

    json: Mapping[str, Any]
    shown: Iterable[str | AnalysisTable | Mapping[str, Mapping[str, Any]]]
    notes: Iterable[str] = ()
    ended: str = ""
    files: Mapping[Path | None, Callable[[Path], object]] = field(default_factory=dict)


@dataclass(frozen=True)
class Analysis:
    """An analysis and its command.

    Attributes
    ----------
    methods : tuple of callables
        Functions of a model that become its methods, by their names.
    command : callable
        (load, settings, arguments of the options) -> `AnalysisOutput`. It calls ``load()`` for the model as soon as it
        has checked what needs no model; its docstring is the text of the command's help.
    options : tuple of Option
        In the order of the help.
    examples : tuple of str
        Lines that can be typed as they are.
    lines : mapping
        Class of a result, by its name -> its lines and tables, for the command and for notebooks.
    """

    methods: tuple[Callable[..., Any], ...]
    command: Callable[..., AnalysisOutput]
    options: tuple[Option, ...]
    examples: tuple[str, ...]
    lines: Mapping[str, Callable[[Any], Iterable[str | AnalysisTable]]] = field(default_factory=dict)


def change_settings_checked(
    where: str, settings: Settings | None, changes: Mapping[str, object], counting: Sequence[str] = OF_STATES
) -> Settings:
    """Replace single settings.

    Raises
    ------
    InputError
        If a single one would count for nothing; of settings that are given all at once, those are of no account.
    """
    whole = change_settings(settings, changes)
    for name in changes:
        if name not in counting:
            raise InputError(f"{where}: {name}", f"one of {', '.join(counting)}", "a setting of runs")
    return whole


def settings_about_place(where: str, settings: Settings | None, changes: Mapping[str, object], at: object) -> Settings:
    """Return settings of an analysis about a place; settings of a run count where a run leads there."""
    counting = OF_STATES if isinstance(at, str | Mapping) else keyword_names(PlaceKeywords)
    return change_settings_checked(where, settings, changes, counting)


ANALYSES: Registry[Analysis] = Registry(__name__, "analysis")


def notebook_html(kind: str, result: object, notes: Iterable[str] = ()) -> str:
    """Return a result as a notebook shows it: the lines and tables that the command of its kind prints."""
    from symgen.result.labelled import notebook_table

    lines = [*ANALYSES.get(kind).lines[type(result).__name__](result), *(f"note: {note}" for note in notes)]
    return "\n".join(
        f"<p>{escape(x)}</p>" if isinstance(x, str) else notebook_table(x.headings, x.rows, most=40) for x in lines
    )
