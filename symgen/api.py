"""The Python interface: a model, its compiled forms, and runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.evaluate import evaluate
from symgen.describe.mechanism import Mechanism
from symgen.errors import InputError, nearest
from symgen.integrators import INTEGRATORS
from symgen.pipeline import MethodChoice, choose_method, compile_model
from symgen.vocabulary.expressions import Expr

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.runtime.assembly import Start
    from symgen.runtime.run import Array, Outcome
