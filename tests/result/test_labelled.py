import numpy as np
import pytest

from symgen.base.errors import InputError
from symgen.result.labelled import Labelled
from symgen.result.signals import choose_columns


@pytest.fixture
def table():
    return Labelled(np.arange(6.0).reshape(2, 3), ("crank.x", "crank.y", "rod.x"), ("m", "m", "m"))


def test_columns_by_name_and_by_body(table):
    assert table["crank.y"].tolist() == [1.0, 4.0]
    assert table["crank"].tolist() == [[0.0, 1.0], [3.0, 4.0]]
    assert table.unit("rod.x") == "m"
    assert list(table) == ["crank.x", "crank.y", "rod.x"]
    assert "rod.x" in table and "rod" not in table


def test_array_and_rows(table):
    assert np.asarray(table).shape == (2, 3)
    assert np.asarray(table, dtype=np.float32).dtype == np.float32
    assert table.row() == {"crank.x": 3.0, "crank.y": 4.0, "rod.x": 5.0}
    assert Labelled(np.zeros((0, 1)), ("a",), ("m",)).row() == {}


def test_an_unknown_name_gets_the_nearest_one(table):
    with pytest.raises(InputError, match=r"got 'crank.z'; did you mean 'crank\.[xy]'\?"):
        table["crank.z"]


def test_a_refusal_names_each_quantity_once():
    """Tables, and what names of their columns begin with, may be called the same."""
    known = dict.fromkeys(("energy.total", "energy.drift", "lam.pin.x", "rod.x"), "energy")
    with pytest.raises(InputError) as refused:
        choose_columns(known, ["zzzzzz"], "rods")
    named = str(refused.value).partition("known: ")[2].partition(" and ")[0].split(", ")
    assert {"energy", "lam", "rod"} <= set(named) and len(named) == len(set(named))


def test_labels_must_fit_the_array():
    with pytest.raises(ValueError, match="1 names and 1 units"):
        Labelled(np.zeros((2, 2)), ("a",), ("m",))
