"""Digests of texts and files.

Nothing here depends on memory addresses, on the order of sets or on time stamps, so a digest is the same in every
process that would compile the same function.
"""

from __future__ import annotations

import functools
import hashlib
import linecache
from pathlib import Path


def combined_digest(*parts: str | bytes) -> str:
    """Return the SHA-256 of the parts in hexadecimal; boundaries of parts matter."""
    result = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        result.update(b"%d:" % len(data))
        result.update(data)
    return result.hexdigest()


def file_content(path: str) -> bytes:
    """Return the content of a source file, or of a cell of a notebook, which is no file; empty if missing."""
    try:
        return Path(path).read_bytes()
    except OSError:
        return "".join(linecache.getlines(path)).encode()


@functools.cache
def file_digest(path: str) -> str:
    """Return the digest of a file's content at the first request, at the latest when it was loaded."""
    return combined_digest(file_content(path))
