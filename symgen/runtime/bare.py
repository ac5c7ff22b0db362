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
def _bare(typing_context: Any, value: Any) -> Any:
    """Return the same array, or record of arrays and numbers, without references to objects that own memory."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return _stripped(context, builder, signature.args[0], args[0])

    return value(value), codegen


def _stripped(context: Any, builder: Any, kind: Any, value: Any) -> Any:
    if isinstance(kind, types.BaseTuple):
        fields = zip(kind, cgutils.unpack_tuple(builder, value), strict=True)
        return context.make_tuple(builder, kind, [_stripped(context, builder, *field) for field in fields])
    if not isinstance(kind, types.Array):
        return value
    view = context.make_array(kind)(context, builder, value)
    view.meminfo = view.meminfo.type(None)
    view.parent = view.parent.type(None)
    item = context.get_abi_sizeof(context.get_data_type(kind.dtype))
    view.itemsize = view.itemsize.type(item)  # known, so that no call has to fetch it
    if kind.layout == "C":
        *outer, inner = cgutils.unpack_tuple(builder, view.strides)
        view.strides = cgutils.pack_array(builder, [*outer, inner.type(item)])
    return view._getvalue()


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


def plain_bare(value: Any) -> Any:
    """Return the value: what `bare` is where nothing is compiled."""
    return value


def plain_part(array: Any, first: int, size: int) -> Any:
    """Return a view: what `part` is where nothing is compiled."""
    return array[first : first + size]


#: Under NUMBA_DISABLE_JIT the loops are plain Python and views do.
bare: Any = plain_bare if config.DISABLE_JIT else _bare
part: Any = plain_part if config.DISABLE_JIT else _part
