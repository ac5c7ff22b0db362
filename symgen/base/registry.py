"""Registries of kinds: every module of a package folder is one kind, named after its file.

The file ``pin_in_slot.py`` is the kind ``pin-in-slot``. Names are known from the file names alone; a module is imported
when its kind is requested. To add a kind, add a file.
"""

from __future__ import annotations

import importlib
import pkgutil
import re
from collections.abc import Iterator, Mapping
from html import escape
from importlib.util import find_spec
from typing import Generic, TypeVar, cast

from symgen.base.arguments import text
from symgen.base.errors import InputError, quote, suggest
from symgen.base.plugins import load_installed_plugins

T = TypeVar("T")

#: Characters of a list of kinds that is shown beside the nearest spelling.
_LISTED = 400
_NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


class Listing(dict[str, str]):
    """Names with a line about each, which notebooks show as a table."""

    def _repr_html_(self) -> str:
        cells = (f"<tr><td><code>{escape(name)}</code></td><td>{escape(line)}</td></tr>" for name, line in self.items())
        return f"<table>{''.join(cells)}</table>"

    def __str__(self) -> str:
        width = max(map(len, self), default=0)
        return "\n".join(f"{name:<{width}}  {line}" for name, line in self.items())


class Registry(Generic[T]):
    """The kinds that live as modules in one package, plus any registered by hand.

    Parameters
    ----------
    package : str
        Dotted name of the package whose modules are kinds; modules with a leading underscore are not.
    what : str
        Noun for one kind in messages, e.g. ``"joint type"``.
    aliases : mapping of str to str, optional
        Other names of kinds, e.g. ``{"prismatic": "translational"}``.
    attribute : str, optional
        The module's attribute that is the kind.
    beside : str, optional
        Package of a registry whose kinds are easily taken for these, which a message says.
    meant : mapping of str to str, optional
        Words of other programs and of daily life in small letters, each with the kind that a message names for it.
    """

    def __init__(
        self,
        package: str,
        what: str,
        aliases: Mapping[str, str] | None = None,
        attribute: str = "KIND",
        beside: str = "",
        meant: Mapping[str, str] | None = None,
    ) -> None:
        self.beside, self.meant = beside, dict(meant or {})
        self.package, self.what, self.attribute = package, what, attribute
        self.aliases: dict[str, str] = dict(aliases or {})
        self._modules: dict[str, str] | None = None
        self._loaded: dict[str, T] = {}

    def _module_names_by_kind(self) -> dict[str, str]:
        """Return kind name -> module name; the folder is read once."""
        if self._modules is None:
            modules: dict[str, str] = {}
            for module in pkgutil.iter_modules(importlib.import_module(self.package).__path__):
                if not module.name.startswith("_"):
                    modules[self._check_name(module.name.replace("_", "-"), modules)] = module.name
            for alias, target in self.aliases.items():
                self._check_name(alias, modules)
                if target not in modules:
                    raise ValueError(f"{self.what} alias '{alias}' stands for '{target}', which does not exist")
            self._modules = modules
        return self._modules

    def _check_name(self, name: str, kinds: Mapping[str, object]) -> str:
        if not _NAME.fullmatch(name):
            raise ValueError(f"{self.what} '{name}' is not a lower-case name with dashes")
        if name in kinds:
            raise ValueError(f"{self.what} '{name}' is registered twice")
        return name

    def register(self, name: str, kind: T) -> T:
        """Add `kind` under `name` for this process; a name that is taken is an error."""
        self._check_name(name, {**self._module_names_by_kind(), **self.aliases, **self._loaded})
        self._loaded[name] = kind
        return kind

    @property
    def names(self) -> tuple[str, ...]:
        """All kinds in alphabetical order, without aliases."""
        return tuple(sorted({*self._module_names_by_kind(), *self._loaded}))

    def resolve_alias(self, name: str, where: str = "") -> str:
        """Return `name` with an alias resolved, or raise `InputError` naming the nearest spelling."""
        article = "an" if self.what[0] in "aeiou" else "a"
        text(where or self.what, name, f"{article} {self.what}")
        resolved = self.aliases.get(name, name)
        if resolved not in self:
            load_installed_plugins()
        if resolved not in self._loaded and resolved not in self._module_names_by_kind():
            names = (*self.names, *self.aliases)
            word = self.meant.get(name.lower(), "")
            hint = f"did you mean '{word}'?" if word else suggest(name, names)
            if hint.startswith("known"):
                hint = self._hint_beside(name) or hint
            choices = " (known: " + ", ".join(sorted(names)) + ")"
            if not hint.startswith("known") and len(choices) <= _LISTED:  # a longer list buries the hint
                hint += choices
            raise InputError(where or self.what, f"{article} {self.what}", quote(name), hint)
        return resolved

    def _hint_beside(self, name: str) -> str:
        """Return the hint that a name is, or nearly is, one of the registry beside; empty where it is not."""
        if not self.beside:
            return ""
        own = vars(importlib.import_module(self.beside)).values()
        other = next(x for x in own if isinstance(x, Registry) and x.package == self.beside)
        if name in other:
            return f"'{name}' is an {other.what}" if other.what[0] in "aeiou" else f"'{name}' is a {other.what}"
        hint = suggest(name, other.names)
        return "" if hint.startswith("known") else hint.replace("did you mean ", f"did you mean the {other.what} ")

    def get(self, name: str, where: str = "") -> T:
        """Return the kind called `name` (or so by an alias), importing its module if need be."""
        resolved = self.resolve_alias(name, where)
        if resolved not in self._loaded:
            module = importlib.import_module(f"{self.package}.{self._module_names_by_kind()[resolved]}")
            self._loaded[resolved] = cast(T, getattr(module, self.attribute))
        return self._loaded[resolved]

    def summary(self, name: str) -> str:
        """Return the line about a kind: the first one of its module, which is read and not imported, or its own."""
        if name not in self._module_names_by_kind():
            kind = self._loaded[name]
            text = getattr(kind, "summary", None) or kind.__doc__ or ""
            return str(text).strip().partition("\n")[0]
        spec = find_spec(f"{self.package}.{self._module_names_by_kind()[name]}")
        assert spec is not None and spec.origin is not None, "the folder has it"
        with open(spec.origin, encoding="utf-8") as file:
            return file.readline().strip('"\n')

    def listing(self) -> Listing:
        """Return every name with its line, names from installed packages included."""
        load_installed_plugins()
        return Listing((name, self.summary(name).rstrip(".")) for name in self.names)

    def items(self) -> Iterator[tuple[str, T]]:
        """Yield every name and kind in alphabetical order; imports all of them."""
        for name in self.names:
            yield name, self.get(name)

    def __contains__(self, name: object) -> bool:
        return name in self._loaded or name in self._module_names_by_kind() or name in self.aliases

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)
