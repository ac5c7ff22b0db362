"""Drawn problems of rows with bounds, solved by symgen and by other means.

    python -m benchmarks.bounded.laws --count 10000

Faults are ``missed`` (a motion exists and none is found), ``wrong`` (the forces break a law), ``several`` (there are,
and one is said) and ``one`` (there is, and several are said), each with the seed of its problem.
"""

from __future__ import annotations

import argparse
import sys

from benchmarks.bounded.laws.compare import compare


def main() -> int:
    """Run what the command line asks for; return the number of faults."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=0, help="of the first problem")
    options = parser.parse_args()
    verdicts = compare(range(options.seed, options.seed + options.count))
    print(", ".join(f"{count} {what}" for what, count in verdicts.counts.items()))
    for seed, what in verdicts.faults:
        print(f"{what}: {seed}")
    return len(verdicts.faults)


if __name__ == "__main__":
    sys.exit(min(main(), 1))
