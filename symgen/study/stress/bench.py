"""Stressed mechanisms: a base model with parameters that are varied at run time, one module for many cases.

Compilation is the main cost: a spring-damper, a factor on a body's mass and a factor on gravity are added as parameters
with neutral defaults, and starts may change freely, since they are outside the digest.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from symgen.base.errors import InputError, SymgenError
from symgen.base.settings import Settings
from symgen.describe.files.load import read_raw
from symgen.describe.files.validate import validate
from symgen.describe.forces import FORCES
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import Mechanism
from symgen.describe.modal.modal_file import with_whole_paths

#: Handles of a stressed mechanism and their neutral values.
STIFFNESS, DAMPING, FREE_LENGTH = "stress_stiffness", "stress_damping", "stress_free_length"
MASS, INERTIA, GRAVITY = "stress_mass", "stress_inertia", "stress_gravity"
HANDLES: Mapping[str, tuple[float, str]] = {
    STIFFNESS: (0.0, "N/m"),
    DAMPING: (0.0, "N s/m"),
    FREE_LENGTH: (1.0, "m"),
    MASS: (1.0, "1"),
    INERTIA: (1.0, "1"),
    GRAVITY: (1.0, "1"),
}
#: Nominal runs last this many of the mechanism's own steps.
NOMINAL_STEPS = 1000
#: Standard gravity where a base has none [m/s^2].
STANDARD_GRAVITY = 9.81


class NotApplicable(SymgenError):
    """A family has no case for a base model; the text is the reason."""


@dataclass(frozen=True)
class Level:
    """One case of a family, to be run with many methods.

    Attributes
    ----------
    label : str
        The case in words.
    values : tuple of float
        Varied quantity: one number, or two for a plane.
    mechanism : Mechanism
        The mechanism.
    parameters : mapping
        Values that differ from the mechanism's own.
    until, step : float
        End, and step of integrators with constant steps [s].
    outputs : int
        Output times after the start.
    options : mapping
        Options of methods and integrators, ``method.penalty`` and the like.
    methods : tuple of str or None
        Only these; None for all.
    pairs : tuple of (str, str) or None
        Only these methods with these integrators.
    constant_steps : bool
        Only integrators with constant steps: the step is varied.
    spring_end : tuple of float or None
        Index of the first coordinate of the body, and the fixed end [m], of a spring that is unloaded at the start.
    watched : bool
        Whether the run watches its own violations and energy; off for tests of stability alone.
    length : float or None
        Length of which errors are shares [m], None for the mechanism's.
    closed : str or None
        Closed form for comparison: a catalogue entry, or ``"parallelogram"``.
    accelerations : tuple of float or None
        Constant accelerations of the coordinates from rest, which are a closed form too.
    family, model : str
        Names of the family and of the base model, ``-`` for a mechanism of the family's own.
    plain : Mechanism or None
        Mechanism of the same motion without rows that repeat others, None for the mechanism itself: dependent rows make
        a reference slow and less accurate.
    """

    label: str
    values: tuple[float, ...]
    mechanism: Mechanism
    until: float
    step: float
    parameters: Mapping[str, float] = field(default_factory=dict)
    outputs: int = 50
    options: Mapping[str, float | str] = field(default_factory=dict)
    methods: tuple[str, ...] | None = None
    pairs: tuple[tuple[str, str], ...] | None = None
    constant_steps: bool = False
    spring_end: tuple[float, ...] | None = None
    watched: bool = True
    length: float | None = None
    closed: str | None = None
    accelerations: tuple[float, ...] | None = None
    family: str = ""
    model: str = "-"
    plain: Mechanism | None = None

    @property
    def of_reference(self) -> Mechanism:
        """The mechanism whose motion judges the case."""
        return self.mechanism if self.plain is None else self.plain


@dataclass(frozen=True)
class Base:
    """A model of the catalogue or of a file as the origin of stressed mechanisms.

    Attributes
    ----------
    name : str
        As typed.
    raw : dict
        Its description as nested tables.
    """

    name: str
    raw: dict[str, Any]

    @classmethod
    def of_mechanism(cls, model: str | Path) -> Base:
        """Read a catalogue entry or a file.

        Raises
        ------
        InputError
            If the model does not exist or is wrong.
        """
        raw, source = read_raw(model)
        return cls(str(model), with_whole_paths(raw, source))

    def without_events(self, but: Collection[str] = ()) -> Base:
        """Return the base without its events, but for events of some actions."""
        kept = {event.name for event in self.mechanism.events if event.action in but}
        events = {name: table for name, table in self.raw.get("events", {}).items() if name in kept}
        rest = {key: value for key, value in self.raw.items() if key != "events"}
        return Base(self.name, rest | ({"events": events} if events else {}))

    @cached_property
    def mechanism(self) -> Mechanism:
        """The base itself."""
        return validate(self.raw, self.name)

    @cached_property
    def stressed(self) -> Mechanism:
        """The base with all handles."""
        return self.build({})

    @property
    def step(self) -> float:
        """Step of the base [s]."""
        return self.mechanism.defaults.step

    @property
    def nominal_values(self) -> float:
        """Length of a nominal run [s]."""
        defaults = self.mechanism.defaults
        return min(defaults.until, defaults.predictable_until or math.inf, NOMINAL_STEPS * defaults.step)

    @cached_property
    def rate(self) -> float | None:
        """Rate rms(v') / rms(v) of the first second [1/s], None where nothing moves."""
        from symgen.run.compiling.pipeline import straight_alone
        from symgen.run.planning.prepare import first_rate

        mechanism = self.without_events().mechanism
        shape = "straight" if straight_alone(mechanism) else "looped"
        return first_rate(mechanism, Settings(until=self.nominal_values, shape=shape))[0]

    @cached_property
    def closed(self) -> str | None:
        """The base's own name if its motion has a closed form."""
        from symgen.study.references.closed_forms import closed_form

        return self.name if closed_form(self.mechanism) is not None else None

    @property
    def middle(self) -> str:
        """The body in the middle of the list: it carries the spring and the factor on its mass.

        Modal bodies have their masses from files, and no material at their centres.
        """
        names = [body.name for body in self.mechanism.bodies if body.modal is None and body.carried is None]
        if not names:
            raise InputError(self.name, "a body that is not modal, which stress can change", "modal bodies alone")
        return names[len(names) // 2]

    def build_level(self, label: str, *values: float, **changes: object) -> Level:
        """Return a case: the stressed mechanism, nominal length and step, but for `changes`."""
        settings: dict[str, Any] = {
            "mechanism": self.stressed,
            "until": self.nominal_values,
            "step": self.step,
        } | changes
        return Level(label, values, **settings)

    def build(self, change: Mapping[str, Any], suffix: str = "stressed") -> Mechanism:
        """Return the stressed mechanism with further entries.

        Parameters
        ----------
        change : mapping
            Section -> name -> table, merged into the description; keys of a table that is there are replaced, and None
            takes a key away.
        suffix : str
            Suffix of the name; mechanisms with other equations need other names.
        """
        raw = copy.deepcopy(self.raw)
        raw["mechanism"]["name"] = f"{raw['mechanism']['name']}-{suffix}"
        raw.setdefault("parameters", {}).update(
            {name: {"value": value, "unit": unit} for name, (value, unit) in HANDLES.items()}
        )
        own = self.middle in raw.get("bodies", {})
        heavy = raw["bodies"][self.middle] if own else raw["beams"][self.middle.rpartition(".")[0]]
        for key in ("mass", "inertia" if own else "rotary"):
            value, factor = heavy.get(key, 0.0), MASS if key == "mass" else f"{MASS}*{INERTIA}"
            if isinstance(value, list):  # the inertia of a spatial body
                heavy[key] = [f"({_formula_text(x)})*{factor}" if x != 0.0 else 0.0 for x in value]
            elif value != 0.0:
                heavy[key] = f"({_formula_text(value)})*{factor}"
        dimensions = len(self.anchor)
        gravity = raw["mechanism"].get("gravity", [0.0] * dimensions)
        if any(component != 0.0 for component in gravity):
            raw["mechanism"]["gravity"] = [f"({_formula_text(g)})*{GRAVITY}" if g != 0.0 else 0.0 for g in gravity]
        else:
            raw["parameters"][GRAVITY]["value"] = 0.0
            raw["mechanism"]["gravity"] = [0.0, f"-{STANDARD_GRAVITY}*{GRAVITY}", 0.0][:dimensions]
        if self.has_spring:
            raw.setdefault("forces", {})["stress_spring"] = {
                "type": "spring-damper",
                "between": ["ground", self.middle],
                "at": [self.anchor, "centre"],
                "stiffness": STIFFNESS,
                "damping": DAMPING,
                "free_length": FREE_LENGTH,
            }
        for section, entries in change.items():
            for name, table in entries.items():
                merged = {**raw.setdefault(section, {}).get(name, {}), **table}
                raw[section][name] = {key: value for key, value in merged.items() if value is not None}
        return validate(raw, f"{self.name} ({suffix})")

    # -- numbers of the base -------------------------------------------------------------------------------------------

    @cached_property
    def values(self) -> dict[str, float]:
        """Values of the base's own parameters."""
        return {p.name: p.value for p in self.mechanism.parameters}

    @cached_property
    def size(self) -> float:
        """Half of the largest distance between bodies and points at the start [m], at least 1e-3."""
        from symgen.describe.facts.lengths import own_length

        places = [self.centre_of_body(body.name) for body in self.mechanism.bodies]
        spread = max(math.dist(a, b) for a in [*places, (0.0,) * len(places[0])] for b in places)
        return max(1e-3, spread / 2.0, *(own_length(body, self.values) for body in self.mechanism.bodies))

    def centre_of_body(self, body: str) -> tuple[float, ...]:
        """Return about where a body starts [m]: its centre of mass if its frame were not turned."""
        b = self.mechanism.body(body)
        pairs = zip(b.position, b.centre_of_mass, strict=True)
        return tuple(evaluate_formula(x, self.values, body) + evaluate_formula(c, self.values, body) for x, c in pairs)

    @cached_property
    def anchor(self) -> list[float]:
        """Fixed end of the spring: from the body's centre along the diagonal, as far as the mechanism is large [m]."""
        return [round(x + self.size, 6) for x in self.centre_of_body(self.middle)]

    @property
    def has_spring(self) -> bool:
        """Whether a spring-damper can act in the space of the base."""
        return self.mechanism.space in FORCES.get("spring-damper").SPACES

    def need_spring(self) -> None:
        """Raise `NotApplicable` where no spring-damper can act."""
        if not self.has_spring:
            raise NotApplicable(f"there is no spring-damper in {self.mechanism.space} mechanisms")

    @property
    def spring_end(self) -> tuple[float, ...]:
        """Index of the first coordinate of the middle body, and the spring's fixed end [m]."""
        first = 0
        for body in self.mechanism.bodies:
            if body.name == self.middle:
                break
            first += len(body.coordinates)
        return first, *self.anchor

    @cached_property
    def gravity(self) -> float:
        """Acceleration of gravity where its factor is 1 [m/s^2]."""
        components = [evaluate_formula(e, self.values, "gravity") for e in self.mechanism.gravity]
        return math.hypot(*components) or STANDARD_GRAVITY


def _formula_text(value: Any) -> str:
    return value if isinstance(value, str) else repr(float(value))
