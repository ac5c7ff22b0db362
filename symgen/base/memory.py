"""Numbers of processors and amounts of free memory and disk.

Requests that exceed memory or disk are refused before anything is allocated.
"""

from __future__ import annotations

import gc
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from symgen.base.errors import InputError

#: Fraction of the free amount that one request may take: code, copies and other programs need room as well.
SHARE = 0.8
#: Requests below this are not checked [bytes]: the check would take longer than they are worth.
SMALL = 1e8
_GROUPS = Path("/sys/fs/cgroup")


def processor_count() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def without_garbage_collection() -> Iterator[None]:
    """Suspend garbage collection while many objects are created that all stay alive."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


def require_memory(where: str, what: str, size: float) -> None:
    """Refuse a request that exceeds the free memory.

    Parameters
    ----------
    where : str
        The argument to be made smaller, for the message.
    what : str
        What needs it, in words, such as ``"1e+07 outputs"``.
    size : float
        Its size [bytes].

    Raises
    ------
    InputError
        If it is too much. Where the free amount is unknown, nothing is refused.
    """
    free = available_bytes() if size > SMALL else None
    if free is not None and size > SHARE * free:
        expected = f"no more than {SHARE:.0%} of the free memory, {SHARE * free / 1e9:.3g} GB"
        raise InputError(where, expected, f"{what}, about {size / 1e9:.3g} GB")


def require_disk(where: str, folder: Path, what: str, size: float) -> None:
    """Refuse a request that exceeds the free disk space.

    Raises
    ------
    InputError
        If it is too much.
    """
    with suppress(OSError):
        free = shutil.disk_usage(folder).free
        if size > free:
            raise InputError(
                where, f"no more than the disk has, {free / 1e9:.3g} GB", f"{what}, about {size / 1e9:.3g} GB"
            )


def available_bytes() -> float | None:
    """Return the number of bytes that this process may still allocate, None if unknown.

    The least of what is free in the machine, what control groups (containers) leave, and the limit of the address
    space.
    """
    return min((*_free_memory_of_machine(), *_free_memory_of_control_groups(), *_free_address_space()), default=None)


def _free_memory_of_machine() -> Iterator[float]:
    with suppress(OSError, ValueError):
        for line in Path("/proc/meminfo").read_text().splitlines():
            if line.startswith("MemAvailable:"):
                yield 1024.0 * int(line.split()[1])
                return
    with suppress(OSError, ValueError, AttributeError):  # all there is, where nothing says what is free
        yield float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))


def _free_memory_of_control_groups() -> Iterator[float]:
    """Yield the free memory of every control group of this process, for both versions of the interface."""
    with suppress(OSError, ValueError):
        for line in Path("/proc/self/cgroup").read_text().splitlines():
            _, kinds, path = line.split(":", 2)
            if kinds not in ("", "memory"):
                continue
            root = _GROUPS if kinds == "" else _GROUPS / "memory"
            names = ("memory.max", "memory.current") if kinds == "" else _OLD
            group = root / path.lstrip("/")
            # in a container the path may be that of the host: the group is then mounted as the root
            for folder in {group, *group.parents, root}:
                if folder == root or root in folder.parents:
                    yield from _memory_left_in_group(folder, *names)


_OLD = ("memory.limit_in_bytes", "memory.usage_in_bytes")


def _memory_left_in_group(folder: Path, limit: str, used: str) -> Iterator[float]:
    with suppress(OSError, ValueError):  # "max" is no number
        room = int((folder / limit).read_text()) - int((folder / used).read_text())
        for line in (folder / "memory.stat").read_text().splitlines():
            name, _, size = line.partition(" ")
            if name in ("inactive_file", "total_inactive_file"):  # kept from files, and given back when it is needed
                room += int(size)
                break
        yield float(max(room, 0))


def _free_address_space() -> Iterator[float]:
    with suppress(ImportError, OSError, ValueError):
        import resource

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        if limit != resource.RLIM_INFINITY:
            used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
            yield float(max(limit - used, 0))
