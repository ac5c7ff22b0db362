"""Numbers that rounding leaves are shown as 0 wherever people read them, and nowhere else."""

import json
import re

import numpy as np
import pytest

from symgen.api import load
from symgen.base.digits import (
    clean,
    clear_matrix_rounding,
    digits,
    format_column,
    format_complex,
    format_rows,
    scale_of,
)
from symgen.cli import main
from symgen.result.labelled import Labelled, column_texts

#: A number below 1e-13 as text.
ROUNDING = re.compile(r"\de-(1[3-9]|[2-9]\d)")


def test_numbers_are_judged_beside_their_column() -> None:
    assert format_column([1.0, -3e-13, 2e-12, -0.0]) == ["1", "0", "2e-12", "0"]
    assert format_column([1e-20, 3e-21]) == ["1e-20", "3e-21"]  # a length of nothing but small numbers
    assert format_column([1e-20, 3e-21], "rad") == ["0", "0"]  # nobody turns by that
    assert format_column([1e-9, 1e-22], "m") == ["1e-09", "0"]
    assert format_column([float("nan"), float("inf"), 1e-9]) == ["nan", "inf", "1e-09"]
    assert digits(-1e-18, 0.0) == "-1e-18" and digits(1.0 / 3.0, 1.0, 3) == "0.333"
    assert scale_of([], "m") == 0.0 and format_column([]) == []
    assert format_complex(-1e-17 + 6j) == ("0", "+6") and format_complex(2 + 1e-15j) == ("2", "")
    np.testing.assert_array_equal(clean(np.array([1.0, -1e-15, np.nan]), 1.0), [1.0, 0.0, np.nan])


def test_columns_of_a_matrix_that_are_rounding_throughout() -> None:
    """By one part in 1e14 of the whole: small entries of a column with a unit of its own stay."""
    assert format_rows([[1e-17, 30.0], [2e-16, 1e-15]]) == [["0", "30"], ["0", "0"]]
    assert format_rows([[1e-9, 1e3], [-2e-11, 1.0]]) == [["1e-09", "1000"], ["-2e-11", "1"]]


def test_entries_that_rounding_leaves_of_a_sum() -> None:
    """Of both their row and their column: a row or a column of small numbers has a unit of its own."""
    np.testing.assert_array_equal(
        clear_matrix_rounding(np.array([[-4.9e-17, 1.0, 1e-15], [-4.9, 3e-16, 1e-20], [1e-15, 1e-15, 1e-20]])),
        [[0.0, 1.0, 0.0], [-4.9, 0.0, 0.0], [0.0, 0.0, 0.0]],
    )
    small = np.array([[1e3, 1e-9], [1.0, 1e-12]])
    np.testing.assert_array_equal(clear_matrix_rounding(small), small)
    assert clear_matrix_rounding(np.zeros((0, 3))).shape == (0, 3)


@pytest.mark.parametrize("name", ["pendulum", "four-bar", "heavy-top"])
def test_a_linear_system_has_zeros_for_rounding(name: str) -> None:
    """In Python and JSON alike; -4.9e-17 stood in A."""
    system = load(name).linearise()
    for matrix in (system.A, system.B, system.C, system.D):
        sizes = np.abs(matrix[matrix != 0.0])
        assert not sizes.size or sizes.min() > 1e-13 * sizes.max()
    assert system.to_dict()["A"] == system.A.tolist()


@pytest.mark.slow
def test_a_quantity_alone_is_judged_beside_its_motion(capsys: pytest.CaptureFixture[str]) -> None:
    """The ram is guided level and does not turn: its columns are rounding throughout."""
    main(["run", "shaper", "--quantity", "ram"])
    rows = [line.split() for line in capsys.readouterr().out.split("quantity ")[-1].splitlines()[1:]]
    shown = {row[0]: row[1:4] for row in rows if row}
    assert shown["ram.x"] != ["0"] * 3
    assert all(shown[f"ram.{name}"] == ["0"] * 3 for name in ("theta", "vy", "omega", "ay", "alpha"))


@pytest.mark.slow_cases("run bicycle --until 0.3")
@pytest.mark.parametrize(
    "command",
    [
        *("linearise cart-pole", "linearise bicycle --at start --states lean,steer", "equilibrium slider-crank"),
        *("run slider-crank --until 0.5", "run bicycle --until 0.3"),
    ],
)
def test_tables_of_the_command_show_no_rounding(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The same numbers are in the JSON with all their digits."""
    assert main(command.split()) == 0
    shown = [
        line
        for line in capsys.readouterr().out.splitlines()
        if not line.startswith(("violations", "energy error")) and "not balanced" not in line
    ]
    assert len(shown) > 4 and not [line for line in shown if ROUNDING.search(line)]
    assert main([*command.split(), "--json"]) == 0
    text = capsys.readouterr().out
    assert re.search(r"\d\.\d{10}", text) and json.loads(text)


@pytest.mark.fast("driven-four-bar-crank.omega,crank.alpha")
@pytest.mark.parametrize(
    ("model", "quantities"), [("stewart-platform", "q"), ("driven-four-bar", "crank.omega,crank.alpha")]
)
def test_prescribed_motions_show_no_rounding(model: str, quantities: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Cosines beside 1, and an acceleration that is 0 beside those of the other bodies."""
    command = ["kinematics", model, "--times", "lin(0,0.5,11)", "--quantity", quantities]
    assert main(command) == 0
    assert not ROUNDING.search(capsys.readouterr().out)
    assert main([*command, "--json"]) == 0
    assert ROUNDING.search(capsys.readouterr().out)  # data keep all digits


@pytest.mark.slow
def test_notebooks_show_no_rounding_and_the_table_keeps_it() -> None:
    values = np.array([[1.0, 2e-17, 5e-18], [2.0, -1e-16, 1e-17]])
    shown = Labelled(values, ("a.x", "a.y", "a.theta"), ("m", "m", "rad"))
    assert column_texts(shown) == {"a.x": "2", "a.y": "0", "a.theta": "0"} and "e-1" not in shown._repr_html_()
    assert shown.row()["a.y"] == -1e-16
    result = load("bricard").simulate(until=0.5)
    assert ROUNDING.search(str(result.q.row())) and not ROUNDING.search(result.q._repr_html_())
