"""Nested dictionary to `Mechanism`: the one validator behind files, catalogue and builder."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import msgspec

from symgen.describe.bodies import planar_body, spatial_body
from symgen.describe.bounds import DEEPEST
from symgen.describe.evaluate import evaluate
from symgen.describe.fields import PlainScalar, found, read, read_value
from symgen.describe.mechanism import Defaults, Force, Joint, Mechanism, Parameter, Table
from symgen.describe.names import check_identifier, check_mechanism_name, check_unit, line
from symgen.describe.parser import Names, parse
from symgen.describe.scope import Model, Scope
from symgen.describe.sections import (
    NAMED,
    SECTIONS,
    MechanismSection,
    ParameterSection,
    RunSection,
    TableSection,
)
from symgen.errors import InputError, nearest, quoted

Raw = Mapping[str, Any]


def validate(raw: Raw, source: str) -> Mechanism:
    """Return the mechanism that the nested dictionary `raw` describes.

    Parameters
    ----------
    raw : mapping
        Sections as in a mechanism file.
    source : str
        File name or other origin, with which every message begins.

    Raises
    ------
    InputError
        At the first thing that is wrong.
    """
    return _Validator(raw, source).mechanism()


class _Validator:
    """One description being read, section by section; joints may refer to each other and are resolved on demand."""

    def __init__(self, raw: Raw, source: str) -> None:
        self.raw, self.source = raw, source
        self._joints: dict[str, Joint | None] = {}
        self._open = 0  # joints being resolved, each because the one before refers to it

    def where(self, path: str) -> str:
        return f"{self.source}: {path}"

    def mechanism(self) -> Mechanism:
        for key in self.raw:
            if key not in SECTIONS:
                expected = f"the sections {', '.join(SECTIONS)}"
                raise InputError(self.source, expected, f"the unknown section {quoted(key)}", nearest(key, SECTIONS))
        if "mechanism" not in self.raw:
            raise InputError(self.where("mechanism"), "a section [mechanism] with a name", "no such section")
        head = read(MechanismSection, self.raw["mechanism"], self.where("mechanism"))
        check_mechanism_name(head.name, self.where("mechanism.name"))
        self.unique()
        parameters = tuple(self.parameter(name, value) for name, value in self.entries("parameters"))
        tables = tuple(self.table(name, value) for name, value in self.entries("tables"))
        self.model = Model(
            self.source,
            {p.name: p.value for p in parameters},
            tuple(t.name for t in tables),
            {},
            self.joint,
            head.space,
            frozenset(name for name, _ in self.entries("joints")),
        )
        scope = Scope(self.model, "mechanism")
        gravity = scope.vector("gravity", (0.0,) * scope.dimension if head.gravity is None else head.gravity)
        read_body = spatial_body if head.space == "spatial" else planar_body
        bodies = tuple(read_body(Scope(self.model, f"bodies.{n}", n), value) for n, value in self.entries("bodies"))
        if not bodies:
            raise InputError(self.where("bodies"), "at least one body, [bodies.NAME]", "none")
        self.model = msgspec.structs.replace(self.model, bodies={body.name: body for body in bodies})
        return Mechanism(
            name=head.name,
            title=line(head.title),
            space=head.space,
            gravity=gravity,
            parameters=parameters,
            tables=tables,
            bodies=bodies,  # type: ignore[arg-type]  # all of one space
            joints=tuple(self.joint(name, self.where("joints")) for name, _ in self.entries("joints")),
            forces=tuple(self.force(name, value) for name, value in self.entries("forces")),
            defaults=self.defaults(line(head.source)),
        )

    # Names ---------------------------------------------------------------------------------------------------------

    def entries(self, section: str) -> Iterator[tuple[str, Any]]:
        """Yield name and content of a section's entries, names checked."""
        content = self.raw.get(section, {})
        if not isinstance(content, Mapping):
            raise InputError(self.where(section), f"a table of {section}, one entry a name", found(content))
        for name, value in content.items():
            yield check_identifier(name, self.where(section), NAMED[section]), value

    def unique(self) -> None:
        """Refuse one name for two things whose results would carry the same label, or that a formula may confuse."""
        for group in (("bodies", "joints", "forces"), ("parameters", "tables")):
            seen: dict[str, str] = {}
            for section in group:
                for name, _ in self.entries(section):
                    if name in seen:
                        got = f"'{name}', which is a {NAMED[seen[name]]} already"
                        raise InputError(self.where(f"{section}.{name}"), "a name used once", got)
                    seen[name] = section

    # Sections ------------------------------------------------------------------------------------------------------

    def defaults(self, source: str) -> Defaults:
        where = self.where("run")
        run = read(RunSection, self.raw.get("run", {}), where)
        for key in ("until", "step", "output_step", "predictable_until"):
            value = getattr(run, key)
            if value is not None and not math.isfinite(value):
                raise InputError(f"{where}.{key}", "a finite number", str(value))
        if run.step > run.until:
            raise InputError(f"{where}.step", f"at most until = {run.until!r}", repr(run.step))
        return Defaults(run.until, run.step, run.output_step, run.predictable_until, source)

    def parameter(self, name: str, raw: object) -> Parameter:
        where = self.where(f"parameters.{name}")
        if isinstance(raw, Mapping):
            section = read(ParameterSection, raw, where)
        else:
            section = ParameterSection(value=read_value(PlainScalar, raw, where))
        value = section.value
        if isinstance(value, str):
            value = evaluate(parse(value, Names("a number or an expression of numbers"), where), {}, where)
        if not math.isfinite(value):
            raise InputError(where, "a finite number", str(value))
        return Parameter(name, float(value), check_unit(section.unit, f"{where}.unit"), line(section.note))

    def table(self, name: str, raw: object) -> Table:
        where = self.where(f"tables.{name}")
        section = read(TableSection, raw, where)
        if len(section.x) < 2:
            raise InputError(f"{where}.x", "two numbers or more", str(len(section.x)))
        if len(section.y) != len(section.x):
            raise InputError(f"{where}.y", f"as many numbers as x has, {len(section.x)}", str(len(section.y)))
        for key in ("x", "y"):
            for value in getattr(section, key):
                if not math.isfinite(value):
                    raise InputError(f"{where}.{key}", "finite numbers", str(value))
        for left, right in zip(section.x, section.x[1:], strict=False):
            if not left < right:
                raise InputError(f"{where}.x", "increasing numbers", f"{right!r} after {left!r}")
        return Table(name, section.x, section.y)

    # Joints and forces ---------------------------------------------------------------------------------------------

    def split(self, path: str, raw: object, what: str) -> tuple[str, dict[str, Any]]:
        """Return the type of a joint or force and its other keys."""
        where = self.where(path)
        if not isinstance(raw, Mapping):
            raise InputError(where, "a table", found(raw))
        kind = raw.get("type")
        if not isinstance(kind, str):
            got = "no such key" if kind is None else found(kind)
            raise InputError(f"{where}.type", f"a {what}", got)
        return kind, {key: value for key, value in raw.items() if key != "type"}

    def joint(self, name: str, where: str) -> Joint:
        """Return the joint `name`, resolved now if another one asks for it first."""
        from symgen.joints import JOINTS

        if name not in self.raw.get("joints", {}):
            got = f"the unknown joint {quoted(name)}"
            raise InputError(where, "the name of a joint", got, nearest(name, self.raw.get("joints", {})))
        if name in self._joints:
            known = self._joints[name]
            if known is None:
                raise InputError(where, "a joint that stands by itself", f"'{name}', which leads back to this one")
            return known
        self._joints[name] = None
        self._open += 1
        if self._open > DEEPEST:
            raise InputError(where, f"joints that refer to each other in at most {DEEPEST} steps", "more")
        path = f"joints.{name}"
        kind, table = self.split(path, self.raw["joints"][name], "joint type")
        struct = JOINTS.get(kind, self.where(f"{path}.type"))
        scope = Scope(self.model, path, name, JOINTS.canonical(kind))
        scope.check_space(struct.SPACES)
        joint = read(struct, table, self.where(path), ("type",)).build(scope)
        self._joints[name] = joint
        self._open -= 1
        return joint

    def force(self, name: str, raw: object) -> Force:
        from symgen.forces import FORCES

        path = f"forces.{name}"
        kind, table = self.split(path, raw, "force type")
        struct = FORCES.get(kind, self.where(f"{path}.type"))
        scope = Scope(self.model, path, name, FORCES.canonical(kind))
        scope.check_space(struct.SPACES)
        return read(struct, table, self.where(path), ("type",)).build(scope)
