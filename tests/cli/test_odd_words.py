"""Words of commands that contradict each other, or that would count for nothing: each is refused in one sentence."""

import math

import pytest

import symgen
from symgen.base.errors import InputError
from tests.cli.test_refusals import ROD


@pytest.fixture
def said(cli, tmp_path, monkeypatch):
    """The command line, in a folder with a mechanism."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rod.toml").write_text(ROD, encoding="utf-8")
    return cli


@pytest.mark.slow_cases(
    "compare rod.toml --methods lagrange --integrators rk4 --rtols 1e-3---rtols counted for nothing"
)
@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("compare rod.toml --methods lagrange --integrators rk4 --rtols 1e-3", "--rtols counted for nothing"),
        ("compare rod.toml --methods lagrange --integrators dopri5 --steps 1e-3", "--steps counted for nothing"),
        ("draw rod.toml --view 30,20", "--view counts for nothing: rod is planar"),
    ],
)
def test_what_counts_for_nothing_but_means_no_harm_is_told(said, words, sentence):
    """Scripts give such words to all runs alike: they go on, and whoever asked for digits reads that there are none."""
    code, out, err = said(*words.split())
    assert code == 0 and out and sum(sentence in line for line in err.splitlines()) == 1


def test_names_that_are_wrong_are_told_before_efforts_are_shown(said):
    code, out, err = said(
        *("inverse", "driven-four-bar", "--times", "0,0.1", "--quantity", "nope", "--save", "a.csv"),
    )
    assert code == 2 and out == "" and "quantity 'nope'" in err


def test_a_file_may_begin_with_a_mark_of_its_encoding(said, tmp_path):
    (tmp_path / "marked.toml").write_bytes(b"\xef\xbb\xbf" + ROD.replace("\n", "\r\n").encode())
    assert said("check", "marked.toml") == said("check", "rod.toml")


def test_a_scan_without_any_force_says_nothing_of_its_arithmetic(said):
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        code, _, err = said("equilibrium", "rod.toml", "--scan", "bar.theta=lin(6,0,7)")
    assert code == 0 and err == ""


@pytest.mark.parametrize("written", ["-1.5e2 deg", "30°", "60 rpm", "36 km/h"])
def test_a_number_with_a_unit_of_something_else_is_answered_with_units(said, tmp_path, written):
    (tmp_path / "rod.toml").write_text(ROD.replace("[1.0, 0.0]", f"['{written}', 0.0]", 1), encoding="utf-8")
    code, _, err = said("check", "rod.toml")
    unit = written.lstrip("-0123456789.e ")
    assert (
        code == 2
        and err.count("\n") == 1
        and err.endswith(f"expected a unit such as m, mm, cm, km, in, got '{unit}'\n")
    )


def test_a_unit_in_a_formula_is_answered_with_a_hint(said, tmp_path):
    (tmp_path / "rod.toml").write_text(ROD.replace("[1.0, 0.0]", "['2*3 mm', 0.0]", 1), encoding="utf-8")
    code, _, err = said("check", "rod.toml")
    assert code == 2 and err.count("\n") == 1 and err.endswith("make the number in mm a parameter\n")


def test_a_text_that_is_no_number_with_a_unit_has_no_such_hint(said, tmp_path):
    for written in ("3 furlongs", "3 +", "2 x"):
        (tmp_path / "rod.toml").write_text(ROD.replace("[1.0, 0.0]", f"['{written}', 0.0]", 1), encoding="utf-8")
        code, _, err = said("check", "rod.toml")
        assert code == 2 and "SI units" not in err


def test_a_file_without_rows_is_said_to_have_none(said, tmp_path):
    (tmp_path / "a.csv").write_text("t,bar.x\n", encoding="utf-8")
    code, _, err = said("run", "rod.toml", "--from", "a.csv")
    assert code == 2 and "which cannot be read as one (it has no rows)" in err


@pytest.mark.slow
def test_sweeps_may_ask_for_the_start(said):
    code, out, _ = said("sweep", "rod.toml", "--vary", "bar.omega=lin(1,2,2)", "--times", "0,0.02", "--json")
    assert code == 0 and '"runs"' in out


def test_the_line_to_try_can_be_typed(said):
    assert said("new", "crane", "-o", "my crane.toml")[1].endswith("try: symgen run 'my crane.toml'\n")
    assert said("new", "crane", "-o", "-crane.toml")[1].endswith("try: symgen run ./-crane.toml\n")


@pytest.mark.parametrize(("alpha", "beta"), [(1e308, 1.0), (1e308, 1e308), (5.0, 1e308), (3.0, 1.0), (5.0, 5.0)])
def test_steps_of_huge_gains_are_those_of_their_roots(alpha, beta):
    from decimal import Decimal

    from symgen.derive.methods import METHODS

    a, b = Decimal(alpha), Decimal(beta)
    root = a + (a * a - b * b).sqrt() if a >= b else b
    found = METHODS.get("baumgarte").largest_step({"alpha": alpha, "beta": beta}, 2.785)
    assert math.isclose(found, float(Decimal("2.785") / root), rel_tol=1e-14)


def test_a_picture_of_given_coordinates_has_no_start():
    model = symgen.load("pendulum")
    with pytest.raises(InputError, match="start: expected a picture of the start"):
        model.draw(start={"bob.x": 1.0}, q=[1.0, 0.0])


LONG = "x" * 300


@pytest.mark.parametrize(
    "words",
    [
        f"run rod.toml --from {LONG}.nc",
        f"view {LONG}.nc",
        f"generate rod.toml --method lagrange -o {LONG}",
        f"sweep rod.toml --vary bar.omega=lin(0,1,2) -o {LONG}",
        f"compare rod.toml --journal {LONG}",
        f"run rod.toml --save {LONG}.nc",
        f"inverse rod.toml --from {LONG}.csv",
        # a link to a file in a folder that is not there: found before the run, not after it
        "run rod.toml --save link.csv",
        # refused after the journal was opened
        "compare rod.toml --set nothing=1 --journal rows.journal",
    ],
)
def test_names_that_no_file_can_have_are_refused_and_nothing_is_written(said, tmp_path, words):
    (tmp_path / "link.csv").symlink_to("nowhere/x.csv")
    code, out, err = said(*words.split())
    assert code == 2 and out == "" and err.count("\n") == 1
    assert sorted(p.name for p in tmp_path.iterdir()) == ["link.csv", "rod.toml"]


def test_words_that_are_no_text_do_not_keep_a_file_from_being_written(tmp_path):
    from symgen.base.files import write_whole

    assert write_whole(tmp_path / "a.html", "made by symgen run \udcff.toml").read_text() == "made by symgen run ?.toml"
