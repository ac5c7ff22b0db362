"""Measure peers: ``python -m benchmarks.peers --model four-bar --json out.json``."""

from __future__ import annotations

import argparse
import importlib
import json
from collections.abc import Iterable, Sequence
from pathlib import Path

from . import models
from .measure import Measured, Row, fastest, row, table

PEERS = ("casadi", "exudyn", "heyoka", "mujoco")


def collect(model: models.Model, peer: str) -> Iterable[Row]:
    """Measure one peer on one mechanism.

    Parameters
    ----------
    model : Model
        The mechanism.
    peer : str
        One of `PEERS`.

    Returns
    -------
    iterable of Row
        The results; a peer that cannot be imported gives one failed row.
    """
    try:
        module = importlib.import_module(f".{peer}_peer", __package__)
    except ImportError as problem:
        reason = problem

        def missing() -> Measured:
            raise reason

        return [row(peer, "", "import", model.name, missing)]
    result: Iterable[Row] = module.rows(model)
    return result


def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Command-line arguments, those of the process by default.

    Returns
    -------
    int
        Exit status.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.peers", description=__doc__)
    parser.add_argument("--model", action="append", help=f"one of {', '.join(models.NAMES)}; repeatable; default all")
    parser.add_argument("--peers", default=",".join(PEERS), help="comma-separated")
    parser.add_argument("--json", type=Path, help="file for the rows")
    parser.add_argument("--error", type=float, default=1e-6, help="error of the summary, rad")
    options = parser.parse_args(arguments)
    peers = options.peers.split(",")
    for peer in peers:
        if peer not in PEERS:
            parser.error(f"unknown peer {peer!r}; known: {', '.join(PEERS)}")
    results: list[Row] = []
    summary: list[str] = []
    for name in options.model or models.NAMES:
        try:
            model = models.load(name)
        except KeyError as problem:
            parser.error(str(problem.args[0]))
        for peer in peers:
            collected = list(collect(model, peer))
            results += collected
            print("\n".join(table(collected)), flush=True)
            best = fastest(collected, options.error)
            chosen = "not reached" if best is None else f"{best['seconds']:.5f} s with {best['setting']}"
            summary.append(f"{name:15} {peer:8} {chosen}")
            if options.json is not None:
                options.json.write_text(json.dumps(results, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    print(f"\nleast time at an error of {options.error:g} rad:\n" + "\n".join(summary))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
