"""Runs of a chunk on a CUDA device: what fits into its memory goes there, is run by one thread each, and comes back."""

from __future__ import annotations

import importlib.util
import threading
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.arguments import one_word_of
from symgen.base.errors import InputError, SimulationError
from symgen.base.ir.program import TARGETS
from symgen.compile.loopcode.padding import padded
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.single.new_state import metric_of, model_sizes, share_of

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import Span
    from symgen.run.layout.scheme_records import TableauRecord
    from symgen.run.layout.start_records import Instant
    from symgen.run.loops.integrator import Setup
    from symgen.run.rows.device import Need
    from symgen.study.ensemble.chunks import Results, Rows

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Threads of a block: few, as each needs many registers, so that small chunks reach all multiprocessors too.
BLOCK = 64
#: Local memory that a thread can have, by CUDA's compute capabilities, less what calls and spilled registers need [B].
LOCAL_BYTES = 512 * 1024 - 16 * 1024
#: Part of a device's free memory that arrays may take.
_SHARE = 0.6
#: A device is used by one thread at a time; the simulator knows no other way.
_lock = threading.Lock()


def check_target(target: str, scheduler: object = None) -> None:
    """Refuse a target that does not exist or cannot be used here.

    Raises
    ------
    InputError
        If the target or the device does not exist, or is requested on a cluster.
    """
    one_word_of("target", target, TARGETS)
    if target != "cuda":
        return
    if scheduler is not None:
        raise InputError("target 'cuda'", "the device of this machine", "a scheduler as well")
    if not is_device_usable():
        expected = "a CUDA device that Numba can use (pip install 'symgen[cuda]'), or its simulator"
        raise InputError("target 'cuda'", f"{expected} (NUMBA_ENABLE_CUDASIM=1)", "neither")


def can_compile_kernels() -> bool:
    """Return whether kernels can be compiled for devices.

    Numba's own CUDA target fails on ``max`` of two numbers (0.68.1), so the package ``numba-cuda``, which replaces it,
    is needed.
    """
    if importlib.util.find_spec("numba_cuda") is None:
        return False
    from numba.cuda.cudadrv import nvvm

    return bool(nvvm.is_available())


def is_device_usable() -> bool:
    """Return whether there is a device with what it needs, or the simulator."""
    from symgen.run.rows.device import is_simulated

    if is_simulated():
        return True
    if not can_compile_kernels():
        return False
    from numba import cuda

    return bool(cuda.is_available())


def kernel_sizes(compiled: CompiledModel, setup: Setup, adaptive: bool, wants: set[int]) -> Need:
    """Return the sizes that shape the kernel of a law.

    Parameters
    ----------
    compiled : CompiledModel
        The law.
    setup : Setup
        Arguments of the integrator's loop.
    adaptive : bool
        Whether its steps are.
    wants : set of int
        Sources of the quantities that are kept, as in `symgen.run.layout.ensemble_abi`.

    Raises
    ------
    InputError
        If a run needs more memory than a thread of a device can have, or the integrator is of another family.
    """
    from symgen.run.layout.scheme_records import TableauRecord
    from symgen.run.rows.device import Need

    if not isinstance(setup.scheme, TableauRecord):
        raise InputError("target 'cuda'", "an explicit Runge-Kutta scheme", "an integrator with a loop of its own")
    info, law = compiled.info, compiled.law
    need = Need(
        width=padded(info.ny),
        n_p=max(1, law.parameter_offset + len(law.parameters) + law.hoisted),
        nw=max(1, law.nw),
        memory=setup.memory,
        room=setup.room,
        rows=info.observed if e.JOINT in wants else 0,
        adaptive=adaptive,
        rates=bool(wants & {e.ACCELERATION, e.MULTIPLIER, e.JOINT}),
        joints=e.JOINT in wants,
    )
    if need.local_bytes > LOCAL_BYTES:
        least, most = need.local_bytes / 1024, LOCAL_BYTES / 1024
        raise InputError("target 'cuda'", f"runs that need at most {most:.0f} KiB each", f"{least:.0f} KiB")
    return need


class DeviceRuns:
    """Runs rows of one law on the device; compiled when it is first used.

    Parameters
    ----------
    compiled : CompiledModel
        Modules emitted for CUDA.
    need : Need
        From `kernel_sizes`.
    scheme, span : record
        As for the loops on a processor.
    limits : Array
        As in `symgen.run.layout.records.Chunk`.
    times : Array
        Output times [s].
    picks : Array of int
        (source, column) of each quantity, flat.
    """

    def __init__(
        self,
        compiled: CompiledModel,
        need: Need,
        scheme: TableauRecord,
        span: Span,
        limits: Array,
        times: Array,
        picks: Integers,
        datum: tuple[float, ...],
    ) -> None:
        self.compiled, self.need, self.scheme, self.span = compiled, need, scheme, span
        self.sizes = model_sizes(compiled)
        self.constants = limits, share_of(self.sizes, datum), metric_of(compiled.info, self.sizes), picks, times
        self.times, self.quantities = len(times), len(picks) // 2

    @cached_property
    def _kernel(self) -> Any:
        from numba import cuda

        from symgen.run.rows.device import SIGNATURE, ForgivingMath, is_simulated, make_kernel

        law, model = self.compiled.law_module, self.compiled.model
        if is_simulated():
            for module in (law, model):
                vars(module)["math"] = ForgivingMath()
        return cuda.jit(SIGNATURE)(make_kernel(law, model, self.need))

    @cached_property
    def _on_device(self) -> tuple[Any, ...]:
        """The scheme, and what all runs share."""
        from numba import cuda

        def copy_to_device(array: Any) -> Any:
            # empty arrays on a device have strides of their own
            return cuda.to_device(np.ascontiguousarray(array if len(array) else np.zeros(1, dtype=array.dtype)))

        scheme = type(self.scheme)(*(copy_to_device(x) if isinstance(x, np.ndarray) else x for x in self.scheme))
        return scheme, *(copy_to_device(array) for array in self.constants)

    @cached_property
    def shapes(self) -> Mapping[str, tuple[int, ...]]:
        """Shapes of the outputs of one run, in the order of the kernel's arguments."""
        info, need, k = self.compiled.info, self.need, self.times
        rates, joints = k if need.rates else 1, k if need.joints else 1
        shapes = {
            "states": (k, info.ny),
            "status": (k, abi.N_STATUS + info.kept),
            "accelerations": (rates, info.nv if need.rates else 1),
            "multipliers": (rates, info.m if need.rates else 1),
            "observed": (joints, need.rows),
            "values": (self.quantities * k,),
            "summary": (e.N_SUMMARY,),
        }
        # empty arrays on a device have strides of their own
        return {name: tuple(max(1, size) for size in shape) for name, shape in shapes.items()}

    @property
    def run_bytes(self) -> int:
        """Global memory of a run."""
        numbers = self.sizes.ny + self.need.n_p + self.need.nw + sum(int(np.prod(s)) for s in self.shapes.values())
        return 8 * numbers

    def _runs_at_once(self) -> int:
        """Return how many runs fit into the device's memory at once.

        Raises
        ------
        SimulationError
            If not even one does.
        """
        from numba import cuda

        from symgen.run.rows.device import is_simulated

        if is_simulated():
            return 1 << 30
        context, device = cuda.current_context(), cuda.get_current_device()
        # local memory is there for every thread that could be resident
        threads = device.MULTIPROCESSOR_COUNT * device.MAX_THREADS_PER_MULTIPROCESSOR
        free = _SHARE * context.get_memory_info().free - threads * self.need.local_bytes
        most = int(free / self.run_bytes)
        if most < 1:
            demand = threads * self.need.local_bytes + self.run_bytes
            raise SimulationError(f"the CUDA device has too little free memory: runs need {demand / 1e9:.3g} GB")
        return most

    def run(self, rows: Rows, starts: Instant, selected: Integers, out: Results, control: Integers) -> bool:
        """Run selected rows; return whether all are done. Between launches the flag that stops is looked at.

        Parameters
        ----------
        rows, starts, selected, out, control
            As for `symgen.study.ensemble.loop_runs.LoopRuns.run`.

        Raises
        ------
        SimulationError
            If the device reports an error, or has too little memory.
        """
        (ys, ps, ws), values, summary = starts, out.values, out.summary
        with _lock, _error_of_device():
            most = self._runs_at_once()
            for first in range(0, len(selected), most):
                if control[abi.STOP] != 0:
                    return False
                part = selected[first : first + most]
                values[part], summary[part] = self._launch_kernel(ys[part], ps[part], ws[part], summary[part])
                control[e.RUNS_DONE] += len(part)
        return True

    def compile(self) -> None:
        """Compile the kernel, and bring what all runs share to the device.

        Raises
        ------
        SimulationError
            If the device reports an error.
        """
        with _lock, _error_of_device():
            _ = self._kernel, self._on_device

    def _launch_kernel(self, ys: Array, ps: Array, ws: Array, summary: Array) -> tuple[Array, Array]:
        """Run rows that fit into the device's memory; return their quantities and numbers."""
        from numba import cuda

        from symgen.run.rows.device import DeviceResults, Starts, is_simulated

        k = len(ys)
        inputs = [cuda.to_device(np.ascontiguousarray(array.T)) for array in (ys, ps, ws)]
        shapes = [(*shape, k) for name, shape in self.shapes.items() if name != "summary"]
        outputs = [cuda.device_array(shape, dtype=np.float64) for shape in shapes]
        outputs.append(cuda.to_device(np.ascontiguousarray(summary.T)))
        block = min(BLOCK, k) if is_simulated() else BLOCK
        with warnings.catch_warnings():
            if is_simulated():  # plain Python warns of what compiled code does in silence
                warnings.simplefilter("ignore", RuntimeWarning)
            else:  # few runs leave the device idle, which is no fault
                warnings.filterwarnings("ignore", message=".*Grid size.*")
            scheme, *shared = self._on_device
            arguments = scheme, self.sizes, self.span, Starts(*inputs, *shared), DeviceResults(*outputs)
            self._kernel[-(-k // block), block](*arguments)
            values, numbers = outputs[-2].copy_to_host(), outputs[-1].copy_to_host()
        size = self.quantities * self.times
        return values.T[:, :size].reshape(k, self.quantities, self.times), numbers.T


@contextmanager
def _error_of_device() -> Iterator[None]:
    """Turn what a device or its compiler reports into one sentence."""
    try:
        yield
    except Exception as error:
        if type(error).__module__.partition(".")[0] not in ("numba", "cuda"):
            raise
        report = " ".join(str(error).split())[:300]
        raise SimulationError(f"the CUDA device reports {type(error).__name__}: {report}") from error
