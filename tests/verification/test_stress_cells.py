"""Stress cells: tables count the outcomes of a record, and a family measured again has them."""

import json
from random import Random

import pytest

from benchmarks import stress_cells
from benchmarks.page_tables import KEPT
from benchmarks.stress_cells import Job, again, examine, families, jobs, methods, models


def stored(folder, lines):
    rows = [{"model": model, "family": family, "cells": cells, "false": false} for model, family, cells, false in lines]
    (folder / "stress_cells.jsonl").write_text("\n".join(map(json.dumps, rows)), encoding="utf-8")


def test_every_family_stands_once_for_each_model_and_those_of_their_own_once():
    found = list(jobs())
    assert len(found) == len(set(found)) == 2 + len(stress_cells.MODELS) * 14
    assert {job.family for job in found[:5]} <= set(stress_cells.CASES)


def test_tables_count_outcomes_and_keep_what_is_not_whole(tmp_path, monkeypatch):
    monkeypatch.setattr("benchmarks.records.FOLDER", tmp_path)
    monkeypatch.setattr(stress_cells, "MODELS", ("four-bar",))
    cells = {"lagrange rk4": {"ok": 3, "inaccurate": 1, "refused": 1}, "auto auto": {"ok": 2}}
    lines = [("four-bar", family, cells, {"lagrange rk4": 1}) for model, family in jobs() if model == "four-bar"]
    stored(tmp_path, lines)
    own, four_bar, whole = models().measured()
    assert set(own[1:]) == set(whole[1:]) == {KEPT}
    assert four_bar == ["`four-bar`", "98", "70", "14", "0", "0", "0", "0", "0", "14", "0"]
    by_family = {row[0]: row[1:] for row in families().measured()}
    assert by_family["gravity"] == ["3 of 4", "0 of 0", "0 of 0", "2 of 2"]
    assert by_family["length-ratio"] == [KEPT] * 4
    by_method = {row[0]: row[1:] for row in methods().measured()}
    assert by_method["`lagrange`"] == [KEPT, *["3 of 4; 1 inaccurate"] * 3]


@pytest.mark.slow  # compiles four pairs, twice
def test_a_family_measured_again_has_the_outcomes():
    job = Job("four-bar", "redundancy")
    line = json.loads(json.dumps(job._asdict() | examine(job, ["lagrange"])))
    assert all(pair.agree for pair in again(line, Random(1))) and line["cells"]["lagrange dop853"] == {"ok": 2}


def test_other_outcomes_than_the_stored_ones_differ(monkeypatch):
    line = {"model": "four-bar", "family": "redundancy", "cells": {"lagrange rk4": {"ok": 2}, "auto auto": {"ok": 2}}}
    for count, agree in (({"ok": 2}, True), ({"ok": 1, "inaccurate": 1}, False)):
        monkeypatch.setattr(stress_cells, "examine", lambda job, chosen, c=count: {"cells": {f"{chosen[0]} rk4": c}})
        assert [pair.agree for pair in again(line, Random(1))] == [agree]
