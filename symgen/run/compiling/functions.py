"""Functions of the state, compiled: from quantities of a mechanism to calls with arrays.

mechanism, quantity --lower--> block --emit--> source --load--> function --entry--> built-in function of Python
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import refuse_overflow
from symgen.compile.native import types
from symgen.compile.native.array_entry import EntrySlots, array_entry, batch_function, entry_slots, supports_entries
from symgen.compile.native.compiler import is_by_numba
from symgen.compile.store.jit import MachineFunction, object_file
from symgen.compile.store.loaded_modules import load_module
from symgen.run.compiling.side import side_module

if TYPE_CHECKING:
    from symgen.derive.lower.function_programs import StateFunctions, Values
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]


@dataclass(frozen=True)
class StateFunction:
    """A compiled function ``f(x1, ..., p, out)``, with what it needs to be called.

    Attributes
    ----------
    name : str
        Its name.
    function : compiled function
        What the emitted module defines; plain Python where nothing is compiled.
    arguments : tuple of str
        Spaces of its arguments, ``p`` the last.
    lengths : tuple of int
        Their lengths.
    shape : tuple of int
        Shape of the result.
    kernel : compiled function, optional
        ``kernel(sizes, written, out)``, which makes the result of what `function` writes.
    sizes : Array of int64
        For the kernel.
    scratch : int
        Length of the kernel's working memory.
    """

    name: str
    function: Any
    arguments: tuple[str, ...]
    lengths: tuple[int, ...]
    shape: tuple[int, ...]
    kernel: Any = None
    sizes: NDArray[np.int64] = field(default_factory=lambda: np.zeros(1, dtype=np.int64))
    scratch: int = 1

    def with_kernel(
        self, name: str, kernel: object, sizes: NDArray[np.int64], scratch: int, shape: tuple[int, ...]
    ) -> StateFunction:
        """Return the function whose result a kernel makes of what this one writes."""
        return replace(self, name=name, kernel=kernel, sizes=sizes, scratch=max(scratch, self.length), shape=shape)

    @property
    def length(self) -> int:
        """Number of elements of the result."""
        return int(np.prod(self.shape))

    def block(
        self, default: Array, otherwise: Callable[..., Any], views: type[np.ndarray[Any, Any]] = np.ndarray
    ) -> EntrySlots | None:
        """Return the slots of an entry, None where only plain Python can be called; see `entry_slots`."""
        if not isinstance(self.function, MachineFunction) or is_by_numba() or not supports_entries():
            return None
        vector = types.float64[::1]
        address = self.function.address(types.int64(*(vector,) * (len(self.lengths) + 1)))
        kernel = 0
        if self.kernel is not None:
            kernel = self.kernel.address(types.int64(types.int64[::1], vector, vector))
        scratch = np.zeros(self.scratch)
        return entry_slots(address, kernel, self.sizes, scratch, self.lengths, self.shape, default, otherwise, views)

    def entry(self, block: EntrySlots) -> Any:
        """Return the built-in function of a block."""
        return array_entry(block, len(self.lengths), object_file)

    def rows(self, block: EntrySlots | None, arrays: Sequence[Array], out: Array) -> tuple[int, int]:
        """Evaluate many states, each array with one a row, or one for all states.

        Returns
        -------
        int, int
            The first state where something is wrong, and what; -1 and 0 where nothing is.
        """
        count = len(out)
        if block is not None:
            steps = [(a.ctypes.data, 0 if a.ndim == 1 else a.shape[1]) for a in arrays]
            flat = [x for pair in steps for x in pair]
            scratch = np.zeros(self.scratch)
            status = np.zeros(1, dtype=np.int64)
            places = block.ctypes.data, scratch.ctypes.data, count, out.ctypes.data, status.ctypes.data
            return int(batch_function(len(arrays), object_file)(*places, *flat)), int(status[0])
        results = out.reshape(count, -1)
        for k in range(count):
            code = self._evaluate_plainly([a if a.ndim == 1 else a[k] for a in arrays], results[k])
            if code:
                return k, code
        return -1, 0

    def _evaluate_plainly(self, arrays: Sequence[Array], out: Array) -> int:
        """Evaluate one state by plain Python or by a call that unpacks its arguments."""
        with np.errstate(all="ignore"):
            if self.kernel is None:
                return int(self.function(*arrays, out))
            scratch = np.zeros(self.scratch)
            self.function(*arrays, scratch)
            return int(self.kernel(self.sizes, scratch, out))


def compile_function(
    mechanism: Mechanism,
    functions: Callable[[], StateFunctions],
    name: str,
    purpose: str,
    vectors: Sequence[str],
    values: Callable[[StateFunctions], Values],
    identity: Sequence[object] = (),
) -> StateFunction:
    """Return a function of the state, generated only if the cache does not have it.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    functions : callable
        Derives it.
    name, purpose : str
        Of the function; the module has its name.
    vectors : sequence of str
        Its arguments before ``p``.
    values : callable
        Returns its values.
    identity : sequence
        What shapes it besides its name and arguments.

    Raises
    ------
    InputError
        If numbers that meet in a formula overflow.
    """

    def make() -> tuple[str, dict[str, Any]]:
        from symgen.derive.emit.function_modules import emit_function
        from symgen.derive.lower.function_programs import lower_function

        with refuse_overflow(f"mechanism '{mechanism.name}'"):
            program = lower_function(functions(), name, purpose, vectors, values(functions()))
        described = {"lengths": list(program.sizes.values()), "shape": list(program.shape)}
        return emit_function(program, len(mechanism.parameters)), described

    metadata, path = side_module(mechanism, name, (purpose, *vectors, *identity), make)
    function = getattr(load_module(path), name)
    return StateFunction(name, function, (*vectors, "p"), tuple(metadata["lengths"]), tuple(metadata["shape"]))
