"""Arrays without ownership, for calls of emitted functions.

Numba counts references to an array's memory whenever a function hands the array on, with atomic operations that cost
more than a quarter of a small right-hand side. A bare array has no owner to count for. The memory must outlive it:
loops only make bare what their caller holds.
"""

from __future__ import annotations

from typing import Any

from numba import config, types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.arrayobj import populate_array


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _bare(typing_context: Any, array: Any) -> Any:
    """Return the same array without a reference to the object that owns its memory."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        view = context.make_array(signature.args[0])(context, builder, args[0])
        view.meminfo = view.meminfo.type(None)
        view.parent = view.parent.type(None)
        return view._getvalue()

    return array(array), codegen


@intrinsic  # type: ignore[untyped-decorator]  # Numba is untyped
def _part(typing_context: Any, array: Any, first: Any, size: Any) -> Any:
    """Return `size` elements of a one-dimensional array from index `first` on, as a bare array; nothing is checked."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        source = context.make_array(signature.args[0])(context, builder, args[0])
        view = context.make_array(signature.return_type)(context, builder)
        populate_array(
            view,
            data=builder.gep(source.data, [args[1]]),
            shape=cgutils.pack_array(builder, [args[2]]),
            strides=source.strides,
            itemsize=source.itemsize,
            meminfo=None,
        )
        return view._getvalue()

    return array(array, types.int64, types.int64), codegen


def _same(array: Any) -> Any:
    return array


def _slice(array: Any, first: int, size: int) -> Any:
    return array[first : first + size]


#: Under NUMBA_DISABLE_JIT the loops are plain Python and views do.
bare: Any = _same if config.DISABLE_JIT else _bare
part: Any = _slice if config.DISABLE_JIT else _part
