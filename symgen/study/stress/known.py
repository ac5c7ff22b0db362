"""Models of a study, whose compiled forms are kept by the process that uses them again and again."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from symgen.api import Model
from symgen.describe.digest import digest

if TYPE_CHECKING:
    from symgen.compiling.pipeline import MethodChoice
    from symgen.runtime.compiled import CompiledModel

#: Compiled forms that a process keeps: those of a few models with all methods.
KEPT = 200

_FORMS: OrderedDict[tuple[Any, ...], CompiledModel] = OrderedDict()


@dataclass(frozen=True)
class KnownModel(Model):
    """A model that asks the cache on disk once a process for each of its forms.

    Mechanisms with equal digests share forms: they differ in starts and values, which are not compiled.
    """

    def compiled(self, choice: MethodChoice) -> CompiledModel:
        """Return the emitted functions for a choice of method, options and shape."""
        key = (digest(self.mechanism), choice.stem, choice.shape)
        if key not in _FORMS:
            _FORMS[key] = super().compiled(choice)
            if len(_FORMS) > KEPT:
                _FORMS.popitem(last=False)
        _FORMS.move_to_end(key)
        return _FORMS[key]
