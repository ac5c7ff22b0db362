"""``python -m symgen``: the command line by the interpreter that has it, whatever the path says."""

from __future__ import annotations

import sys

from symgen.cli import main

if __name__ == "__main__":
    sys.exit(main())
