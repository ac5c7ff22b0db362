"""Stress cells: tables count the outcomes of a record, and a family measured again has them."""

import json
from itertools import groupby
from random import Random

import pytest

from benchmarks import stress_cells
from benchmarks.page_tables import KEPT
from benchmarks.stress_cells import Job, again, causes, families, jobs, methods, models

CELLS = {"lagrange rk4": {"ok": 3, "inaccurate": 1, "refused": 1}, "auto auto": {"ok": 2}}
WHY = "nothing estimates the error of a constant step"


@pytest.fixture
def four_bar(tmp_path, monkeypatch):
    """A record of all families of the four-bar, and of one of another model."""
    monkeypatch.setattr("benchmarks.records.FOLDER", tmp_path)
    monkeypatch.setattr(stress_cells, "MODELS", ("four-bar", "andrews"))
    jobs_of_it = [*(job for job in jobs() if job.model == "four-bar"), Job("andrews", "gravity")]
    rows = [job._asdict() | {"cells": CELLS, "false": {"lagrange rk4": 1}, "causes": {WHY: 1}} for job in jobs_of_it]
    (tmp_path / "stress_cells.jsonl").write_text("\n".join(map(json.dumps, rows)), encoding="utf-8")


def test_every_family_stands_once_for_each_model_and_those_of_their_own_once():
    found = list(jobs())
    assert len(found) == len(set(found)) == 12 + len(stress_cells.MODELS) * 17
    together = [model for model, _ in groupby(job.model for job in found)]
    assert together == [stress_cells.OWN, *stress_cells.MODELS]


def test_tables_count_outcomes_and_say_how_many_families_there_are(four_bar):
    def row(name, share, lines):
        counts = (7 * lines, 5 * lines, lines, 0, 0, 0, 0, 0, lines, 0)
        return [name, share, *map(str, counts)]

    assert models().measured() == [
        row("`four-bar`", "17 of 17", 17),
        row("`andrews`", "1 of 17", 1),
        row("all", "18 of 46", 18),
    ]
    by_family = {row[0]: row[1:] for row in families().measured()}
    assert by_family["gravity"] == ["2 of 2", "6 of 8", "0 of 0", "0 of 0", "4 of 4"]
    assert by_family["length-ratio"] == ["0 of 1", *["0 of 0"] * 4]
    by_method = {row[0]: row[1:] for row in methods().measured()}
    assert by_method["`lagrange`"] == [KEPT, *["3 of 4; 1 inaccurate"] * 3]
    ((why, count, listed),) = causes().measured()
    assert (why, count) == (WHY, "18") and "gravity 2" in listed


def test_sentences_count_what_the_tables_do(four_bar):
    assert list(models().claims()) == [
        "False successes of `auto`: none in 36 cells; 36 ok.",
        "Of 75 cells of named methods 18 (24 percent) are false successes.",
    ]
    assert list(families().claims())[1] == "Least often accurate [percent]: `lagrange` with `rk4` 75."
    assert list(methods().claims()) == ["Of these 21 cells 3 are false successes: `lagrange` with `rk4` 3."]


def test_what_verify_leaves_is_said_where_it_is_known(four_bar, tmp_path):
    path = tmp_path / "stress_cells.jsonl"
    lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    known = [line | {"verified": {"penalty rk4": k}} for k, line in enumerate(lines[:3])] + lines[3:]
    path.write_text("\n".join(map(json.dumps, known)), encoding="utf-8")
    assert list(models().claims())[2:] == ["With `--verify` are left: 3 of 3 on `four-bar` (3 families)."]


def test_the_picture_has_a_column_for_each_model(four_bar, tmp_path):
    stress_cells.picture(tmp_path / "shares.svg")
    assert "<svg" in (tmp_path / "shares.svg").read_text(encoding="utf-8")


def test_other_outcomes_than_the_stored_ones_differ(monkeypatch):
    line = {"model": "four-bar", "family": "redundancy", "cells": {"lagrange rk4": {"ok": 2}, "auto auto": {"ok": 2}}}
    for count, agree in (({"ok": 2}, True), ({"ok": 1, "inaccurate": 1}, False)):
        monkeypatch.setattr(stress_cells, "examine", lambda job, chosen, c=count: {"cells": {f"{chosen[0]} rk4": c}})
        assert [pair.agree for pair in again(line, Random(1))] == [agree]
