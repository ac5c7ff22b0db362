"""Stress studies in joint coordinates: the same cases, judged by the same references, kept apart in journals."""

import pytest

from symgen.errors import InputError
from symgen.study.journal import Journal
from symgen.study.stress.study import stress

ASKED = {"models": ("four-bar",), "cases": ("mass-ratio",), "methods": ("lagrange",), "quick": True}


def test_runs_in_joint_coordinates_are_judged_by_the_references_of_bodies(tmp_path):
    with Journal(tmp_path / "cells") as journal:
        bodies = stress(**ASKED, journal=journal)
        joints = stress(**ASKED, journal=journal, coordinates="joint")
        again = stress(**ASKED, journal=journal, coordinates="joint")
    assert [(r.case, r.method) for r in joints.rows] == [(r.case, r.method) for r in bodies.rows] != []
    assert all(row.outcome == "ok" and row.error < 1e-8 for row in joints.rows)
    assert joints.rows == again.rows
    # not the cells of bodies: other equations round otherwise
    assert all(a.error != b.error for a, b in zip(bodies.rows, joints.rows, strict=True))
    assert (bodies.to_json()["coordinates"], joints.to_json()["coordinates"]) == ("absolute", "joint")
    assert {*bodies.to_json()["rows"][0]} == {*joints.to_json()["rows"][0]}


def test_other_coordinates_are_refused():
    with pytest.raises(InputError, match="coordinates: expected"):
        stress(**ASKED, coordinates="joints")
