"""The commented file that ``symgen new`` writes: a mechanism that runs as it is, and every key a file may have."""

from __future__ import annotations

import textwrap
from importlib.resources import files

from symgen.describe.formulas.identifiers import check_mechanism_name
from symgen.describe.parts.kinds import FORCES, JOINTS


def new_file_text(name: str = "my-mechanism", space: str = "planar") -> str:
    """Return the text of a new mechanism file.

    Parameters
    ----------
    name : str
        Name of the mechanism: lower-case words joined by dashes.
    space : {"planar", "spatial"}
        Space of the mechanism.
    """
    check_mechanism_name(name, "name")
    joints = _list_in_comments([k for k, kind in JOINTS.items() if space in kind.SPACES and k != "revolute"])
    forces = _list_in_comments(
        [k for k, kind in FORCES.items() if space in kind.SPACES and k != "torsional-spring-damper"]
    )
    text, common = (files(__package__).joinpath(f"new_{part}.toml").read_text("utf-8") for part in (space, "common"))
    text = text.replace("# COMMON\n", common).replace("NAME", name, 1)
    return text.replace("JOINTS", joints).replace("FORCES", forces)


def _list_in_comments(kinds: list[str]) -> str:
    """Return names with commas, in lines of comments where one line cannot hold them."""
    return "\n".join(textwrap.wrap(", ".join(kinds), 74, break_on_hyphens=False)).replace("\n", "\n" + " " * 42 + "# ")
