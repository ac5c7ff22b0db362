"""Runs of a comparison: every method with the integrators that suit it, at every step or tolerance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.base.settings import COORDINATES, Settings
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.method_choice import choose_method, takes_bounded_rows
from symgen.run.integrators import INTEGRATORS
from symgen.run.loops.integrator import chooses_steps

#: Default constant steps of a study, as multiples of the mechanism's own.
STEP_FACTORS = (4.0, 2.0, 1.0, 0.5)
#: Default relative tolerances of adaptive runs; absolute ones are this fraction of them.
RTOLS = (1e-6, 1e-8, 1e-10)
#: Least number of settings a line from which run times at an error are interpolated, and the settings by default.
LEAST_SETTINGS = 6
STEP_FACTORS_AT = (4.0, 2.0, 1.0, 0.5, 0.25, 0.125)
RTOLS_AT = (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12)
ATOL_SHARE = 1e-2
#: Default methods of `compare`: the six of Marques, Souto and Flores (2017).
DEFAULT_METHODS = (
    *("lagrange", "baumgarte", "augmented-lagrangian", "index1-augmented-lagrangian"),
    *("coordinate-partitioning", "direct-correction"),
)
#: Those of them for mechanisms with bounded rows, if they take these.
MODE_METHODS = tuple(name for name in DEFAULT_METHODS if name != "coordinate-partitioning")
#: Default integrators; a method that none of them suits gets its own.
DEFAULT_INTEGRATORS = ("rk4", "dopri5", "dop853")
#: Every method or integrator.
ALL = "all"


@dataclass(frozen=True)
class Combinations:
    """Differences between the runs of a comparison; `symgen.compare` documents them.

    Raises
    ------
    InputError
        If a value has the wrong type.
    """

    methods: Sequence[str] = ()
    integrators: Sequence[str] = ()
    steps: Sequence[float] = ()
    rtols: Sequence[float] = ()
    coordinates: Sequence[str] = ()
    error_at: Sequence[float] = ()
    laws: Sequence[str] = ()
    gradient: Sequence[str] = ()

    def __post_init__(self) -> None:
        words = {
            name: arguments.words(name, getattr(self, name))
            for name in ("methods", "integrators", "coordinates", "laws", "gradient")
        }
        for state in words["coordinates"]:
            arguments.one_word_of("coordinates", state, COORDINATES)
        numbers = {
            name: arguments.numbers(name.removesuffix("s"), getattr(self, name), positive=True)
            for name in ("steps", "rtols", "error_at")
        }
        for name in ("steps", "rtols"):
            if numbers["error_at"] and 0 < len(set(numbers[name])) < LEAST_SETTINGS:
                expected = f"at least {LEAST_SETTINGS} values, between which the run time at an error is interpolated"
                raise InputError(name, expected, f"{len(set(numbers[name]))}", "leave them out: each line gets enough")
        for name, value in (words | numbers).items():
            object.__setattr__(self, name, value)

    def settings(self, base: Settings, own: float, mechanism: Mechanism) -> Iterator[Settings]:
        """Return the settings of all runs.

        Parameters
        ----------
        base : Settings
            Common settings, with the end time.
        own : float
            The mechanism's own step [s].
        mechanism : Mechanism
            What is compared; methods that cannot take its rows with bounds are left out, unless they are named.

        Raises
        ------
        InputError
            If a method or integrator does not exist, or no selected integrator solves a form of a selected method.
        """
        left_out = {*self.left_out, *self.without_modes(mechanism)}
        for state in tuple(dict.fromkeys(self.coordinates)) or COORDINATES[:1]:
            for words in _select_names(self.methods, _methods_by_default(mechanism), METHODS.names):
                method, variant = split_variant(words)
                methods = [split_variant(other)[0] for other in self.methods]
                if method in left_out:
                    continue
                for integrator in _suitable_integrators(method, self.integrators):
                    options = _options_of_pair(base.options, method, methods, integrator, self.integrators)
                    both = {f"{owner}.{name}" for owner in ("method", method) for name in variant}
                    options = {k: x for k, x in options.items() if k not in both}
                    options |= {f"method.{name}": x for name, x in variant.items()}
                    one = replace(base, coordinates=state, method=method, integrator=integrator, options=options)
                    yield from self._settings_by_step(one, own)

    @property
    def left_out(self) -> tuple[str, ...]:
        """Methods of ``all`` with no form that a selected integrator solves; empty if no method would be left."""
        named = {split_variant(words)[0] for words in self.methods}
        if ALL not in named or not self.integrators:
            return ()
        unfit = tuple(n for n in METHODS.names if n not in named and not _fitting_integrators(n, self.integrators))
        return unfit if len(unfit) < len(METHODS.names) else ()

    def without_modes(self, mechanism: Mechanism) -> tuple[str, ...]:
        """Return the methods that cannot take the rows with bounds of a mechanism, but those that are named."""
        named = {split_variant(words)[0] for words in self.methods}
        every = _select_names(self.methods, _methods_by_default(mechanism), METHODS.names)
        free = [name for name in every if split_variant(name)[0] not in named and name not in self.left_out]
        return tuple(name for name in free if not _takes_bounds(name, self.integrators, mechanism))

    def _settings_by_step(self, common: Settings, own: float) -> Iterator[Settings]:
        name = str(common.integrator)
        if chooses_steps(INTEGRATORS.get(name, "integrators"), common.options):
            for rtol in self.rtols or (RTOLS_AT if self.error_at else RTOLS):
                yield replace(common, rtol=rtol, atol=rtol * ATOL_SHARE)
        else:
            assert common.until is not None, "a comparison knows its end"
            factors = STEP_FACTORS_AT if self.error_at else STEP_FACTORS
            for step in self.steps or [h for h in (own * f for f in factors) if h <= common.until] or [common.until]:
                yield replace(common, step=step)


def split_variant(words: str) -> tuple[str, dict[str, str]]:
    """Return the method and the options of ``baumgarte:alpha=5:beta=5``, one line of a study.

    Raises
    ------
    InputError
        If the text has another form.
    """
    method, *parts = words.split(":")
    options = dict[str, str]()
    for part in parts:
        name, equals, value = part.partition("=")
        if not equals or not name or not value or name in options:
            raise InputError("methods", "NAME, or NAME:OPTION=VALUE with each option once", f"'{words}'")
        options[name] = value
    return method, options


def words_of_variant(settings: Settings, common: Settings) -> str:
    """Return the options of a method that differ from other runs of a study, such as ``alpha=5, beta=5``."""
    own = (x for x in settings.options.items() if x[0].startswith("method.") and x not in common.options.items())
    return ", ".join(f"{name.removeprefix('method.')}={value}" for name, value in own)


def _select_names(names: Sequence[str], default: Sequence[str], everything: Sequence[str]) -> tuple[str, ...]:
    """Return the selected names, each once; ``all`` selects every one."""
    selection = [name for g in names or default for name in (everything if g == ALL else (g,))]
    return tuple(dict.fromkeys(selection))


def _suitable_integrators(method: str, integrators: Sequence[str]) -> tuple[str, ...]:
    """Return the integrators that solve a form of the method.

    Raises
    ------
    InputError
        If none of the selected integrators does.
    """
    chosen, fit = METHODS.get(method, "methods"), _fitting_integrators(method, integrators)
    if fit or not integrators:
        return fit or (chosen.default_integrator,)
    forms = ", ".join(chosen.forms)
    raise InputError("integrators", f"one that solves a form of {method} ({forms})", f"'{', '.join(integrators)}'")


def _methods_by_default(mechanism: Mechanism) -> tuple[str, ...]:
    return MODE_METHODS if mechanism.bounded else DEFAULT_METHODS


def _takes_bounds(method: str, integrators: Sequence[str], mechanism: Mechanism) -> bool:
    """Return whether a method takes the rows with bounds of a mechanism, in all forms that its integrators solve."""
    fit = _suitable_integrators(method, integrators)
    implicit = {not EXPLICIT_FORMS & set(INTEGRATORS.get(name, "integrators").forms) for name in fit}
    return all(takes_bounded_rows(choose_method(method, None, each), mechanism) for each in sorted(implicit))


def _fitting_integrators(method: str, integrators: Sequence[str]) -> tuple[str, ...]:
    forms = set(METHODS.get(method, "methods").forms)
    named = _select_names(integrators, DEFAULT_INTEGRATORS, INTEGRATORS.names)
    return tuple(name for name in named if forms & set(INTEGRATORS.get(name, "integrators").forms))


def _options_of_pair(
    options: Mapping[str, str | float], method: str, methods: Sequence[str], integrator: str, integrators: Sequence[str]
) -> dict[str, str | float]:
    """Return the options for this method and integrator, without those for others in the study."""
    others = {*(methods or METHODS.names), *(integrators or INTEGRATORS.names)} - {method, integrator}
    return {key: value for key, value in options.items() if key.partition(".")[0] not in others}
