"""Which mechanism file a word means that is the path of none: a folder, another ending, a slip of spelling."""

from __future__ import annotations

from pathlib import Path

from symgen.base.errors import MOST_COMPARED, enumeration, quote, suggest

#: Files at most that a hint offers.
MOST_OFFERED = 3


def hint_on_files(path: Path) -> str:
    """Return the hint on the mechanism files that a path may mean, empty where it means none."""
    if path.name in ("", "..") or _is_folder(path):
        files = _files_in(path)
        listed = [quote(str(path / name)) for name in files[:MOST_OFFERED]]
        if len(files) <= MOST_OFFERED:
            return f"did you mean {enumeration(listed, 'or')}?" if files else "it is a folder without a .toml file"
        return f"it is a folder with {', '.join(listed)} and {len(files) - MOST_OFFERED} more"
    files = _files_in(path.parent)
    hint = suggest(path.name if path.suffix else f"{path.name}.toml", files)
    near = hint.removeprefix("did you mean '").removesuffix("'?")
    # of a bare word the stem counts, as it may as well be a name of the catalogue
    wanted, found = path.name.casefold(), near.casefold()
    if not hint.startswith("did") or (not path.suffix and found.removesuffix(".toml") != wanted):
        return ""
    return f"did you mean {quote(str(path.parent / near))}?"


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except (OSError, ValueError):  # a name too long for the system, or with a null character
        return False


def _files_in(folder: Path) -> list[str]:
    """Return the names of the mechanism files in a folder; none where it cannot be read."""
    try:
        return sorted(each.name for each in folder.iterdir() if each.suffix.lower() == ".toml")[:MOST_COMPARED]
    except (OSError, ValueError):
        return []
