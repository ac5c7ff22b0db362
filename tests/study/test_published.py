"""Problems of a library of benchmarks beside what others published."""

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.processes import symgen

from symgen.api import load
from symgen.base.settings import Settings
from symgen.study.comparison.published import BENCHMARKS

#: Read once more from the figures and the texts of the publication: largest error of the energy [J], run time [s].
PUBLISHED = {"A01": (4e-11, 0.637), "A02": (3e-7, 0.455), "A03": (3.4e-7, 0.384), "A04": (9.1e-7, 0.258)}


@pytest.mark.slow
def test_the_problems_of_iftomm_run_beside_published_numbers():
    done = symgen(["compare", "--benchmark", "iftomm", "--repeat", "1", "--json"])
    assert done.returncode == 0, done.stderr
    rows = {row["problem"]: row for row in json.loads(done.stdout)["rows"]}
    assert list(rows) == ["A01", "A01, 2000 s", "A02", "A02, N = 40", "A03", "A04", "A05"]
    for row in rows.values():
        assert row["status"] == "ok" and row["error"] < 1e-4 and row["seconds"] > 0.0
    for problem, (error, seconds) in PUBLISHED.items():
        assert rows[problem]["published_error"] == error and rows[problem]["published_seconds"] == seconds
        assert rows[problem]["error"] < error
    assert (rows["A05"]["published_error"], rows["A05"]["published_seconds"]) == (None, 0.233)
    assert any("singular" in warning for warning in rows["A02"]["warnings"])


def test_the_pendulum_of_2000_seconds_ends_where_its_equation_does():
    problem = next(x for x in BENCHMARKS["iftomm"].problems if x.problem == "A01, 2000 s")
    result = load(problem.model).simulate(Settings(until=100.0, **problem.settings))
    angle = solve_ivp(
        lambda t, y: (y[1], -9.81 * np.sin(y[0])), (0.0, 100.0), (-np.pi / 2, 0.0), "DOP853", rtol=1e-13, atol=1e-13
    ).y[0, -1]
    np.testing.assert_allclose(result["bob.x"][-1], np.sin(angle), atol=1e-8)
    np.testing.assert_allclose(result["bob.y"][-1], -np.cos(angle), atol=1e-8)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--benchmark", "iftom"], "the name of a library of problems, got 'iftom'; did you mean 'iftomm'?"),
        (
            ["four-bar", "--benchmark", "iftomm"],
            "only --repeat and --json beside it: its settings are its own, got MODEL",
        ),
        (["--benchmark", "iftomm", "--rtols", "1e-3"], "its settings are its own, got --rtols"),
        ([], "MODEL: expected the mechanisms to compare, or --benchmark NAME, got neither"),
    ],
)
def test_what_is_no_library_ends_with_a_sentence(cli, words, sentence):
    code, out, err = cli("compare", *words)
    assert code == 2 and out == "" and sentence in err
