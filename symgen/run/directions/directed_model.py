"""Code with directions: a compiled model whose arrays have room for derivatives after them.

The arrays are longer: ``y`` is followed by L directions of each of its elements, and so are the parameters ``p`` and
the scratch ``w``. Emitted functions have a form with directions (`symgen.compile.native.tangents`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.ir.program import SLOPES
from symgen.compile.native.compiler import is_by_numba
from symgen.compile.store.emitted import EmittedFunction, TangentFunction, with_directions
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

Array = NDArray[np.float64]

#: Numbers of directions that code is made for.
LANES = (2, 4, 8)
#: Most directions of code in one pass over a step: more of them leave too few registers.
MOST_LANES = 12
#: Functions of a model and of a law that have a form with directions in a run, and their types.
_MODEL = {"prepare": e.PREPARE, "masses": abi.MOVE, "geometry": abi.MEASURE}
_LAW = {"prepare": e.PREPARE, "rhs": abi.RHS, "confirm": abi.RHS, "accept": abi.ACCEPT, "rates": abi.RHS}


@dataclass(frozen=True)
class Seeds:
    """Directions at the start.

    Attributes
    ----------
    y, p : Array, shapes (ny, n), (np, n)
        Of the state and of the parameters, one column each.
    """

    y: Array
    p: Array

    @property
    def count(self) -> int:
        """Number of directions."""
        return int(self.y.shape[1])

    def seeds_of_part(self, first: int, lanes: int) -> Seeds:
        """Return `lanes` directions from one on, zeros where there are no more."""
        parts = [np.zeros((len(a), lanes)) for a in (self.y, self.p)]
        for room, array in zip(parts, (self.y, self.p), strict=True):
            seeds = array[:, first : first + lanes]
            room[:, : seeds.shape[1]] = seeds
        return Seeds(*parts)


class DirectedModel:
    """A compiled model and its form with directions.

    Parameters
    ----------
    plain : CompiledModel
        The model, of straight code.
    lanes : int
        Number L of directions.

    Attributes
    ----------
    plain, lanes
        As above.
    whole : CompiledModel
        The same model with a longer state, longer parameters and a longer scratch array.
    """

    def __init__(self, plain: CompiledModel, lanes: int) -> None:
        self.plain, self.lanes = plain, lanes
        law, own = plain.law, plain.info.ny
        self.sizes = {
            "y": own,
            "ydot": own,
            "p": max(1, law.parameter_offset + len(law.parameters) + law.hoisted),
            "w": max(1, law.nw),
        }
        longer = {name: size * (1 + lanes) for name, size in self.sizes.items()}
        hoisted = longer["p"] - law.parameter_offset - len(law.parameters)
        modules = self._module(plain.model, _MODEL), self._module(plain.law_module, _LAW)
        self.whole: CompiledModel = plain.longer(own * lanes, hoisted, longer["w"], *modules)

    def _module(self, module: object, names: dict[str, Any]) -> Any:
        functions = {name: self.function(form_for_derivatives(module, name)) for name in names if hasattr(module, name)}
        return SimpleNamespace(**{**vars(module), **functions})

    def function(self, function: object, length: int = 0, timed: bool = False) -> TangentFunction:
        """Return the form of an emitted function with directions.

        Parameters
        ----------
        function : EmittedFunction
            The function.
        length : int
            Length of its array ``out``, if it has one.
        timed : bool
            Whether time has directions, which follow those of ``w``.

        Raises
        ------
        InputError
            Where nothing is compiled.
        """
        if is_by_numba():
            raise InputError("sensitivities", "symgen's own compiler, which derives functions", "SYMGEN_COMPILER=numba")
        if not isinstance(function, EmittedFunction):
            raise InputError("sensitivities", "compiled functions", "NUMBA_DISABLE_JIT, where plain Python runs")
        places = self.sizes | {"out": length}
        if timed:
            places["t"] = self.sizes["w"] * (1 + self.lanes)
        return with_directions(function, self.lanes, tuple(sorted(places.items())))

    def room_with_directions(self, array: Array, name: str, directions: Array | None = None) -> Array:
        """Return an array with room for its directions, zeros if not given, shape (n, L)."""
        size = self.sizes[name]
        room, own = np.zeros(size * (1 + self.lanes)), array[:size]
        room[: len(own)] = own
        if directions is not None:
            room[size:] = directions.ravel()
        return room

    def directions_after(self, array: Array, name: str) -> Array:
        """Return the directions after an array, or after those in rows, shape (..., n, L)."""
        size = self.sizes[name]
        return array[..., size : size * (1 + self.lanes)].reshape(*array.shape[:-1], size, self.lanes)

    def parameters(self, p: Array, directions: Array) -> Array:
        """Return parameters with directions, and the numbers that follow them."""
        longer = self.room_with_directions(p, "p", directions)
        self.whole.prepare(longer)
        return longer

    def scratch(self, p: Array, w: Array) -> Array:
        """Return scratch with directions: masses follow parameters with directions."""
        longer = self.room_with_directions(w, "w")
        self.caller("masses", self.whole.model.masses)(p, longer)
        return longer

    @staticmethod
    def caller(name: str, function: TangentFunction) -> Callable[..., Any]:
        """Return a function of model or law for calls from Python."""
        return function.caller((_MODEL | _LAW)[name].signature.arguments)


def form_for_derivatives(module: object, name: str) -> Any:
    """Return the function of a module under a name, or its form whose derivatives take the fewest operations."""
    return getattr(module, name + SLOPES, getattr(module, name))


def lanes_for_directions(count: int) -> int:
    """Return the number of directions that code is made for, for a number of them."""
    return next((lanes for lanes in LANES if lanes >= count), LANES[-1])


def lanes_of_few_passes(count: int) -> int:
    """Return the number of directions of code that goes over a step as seldom as can be, for a number of them."""
    if count <= LANES[0]:
        return LANES[0]
    passes = -(-count // MOST_LANES)
    return -(-count // (4 * passes)) * 4
