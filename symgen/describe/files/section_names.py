"""Names of the sections of a mechanism file."""

from symgen.describe.bounds.keys import sections_of_files

#: Sections whose entries are named tables -> name of one entry.
NAMED = {
    "parameters": "parameter",
    "inputs": "input",
    "tables": "table",
    "bodies": "body",
    "beams": "beam",
    "joints": "joint",
    "forces": "force",
    "states": "state",
    "outlines": "outline",
    **{section: kind.family.one for section, kind in sections_of_files().items()},
    "outputs": "output",
    "events": "event",
}
#: All sections of a file.
SECTIONS = ("mechanism", "run", *NAMED)
