"""Slips of whoever types a command for the first time: what the sentence lacked, and what it says now.

Each ends with exit code 2, one line, and no file written.
"""

import pytest

from tests.cli.test_words_of_others import CRANE

#: Words after ``symgen`` -> words of an earlier sentence that misled, empty where it named nothing, and those of now.
SLIPS = {
    "run crane.toml --locale german": ("", "did you mean 'de'?"),
    "run crane.toml --locale deutsch": ("", "did you mean 'de'?"),
    "run crane.toml --locale fr-FRA": ("", "did you mean 'fr'?"),
    "run crane.toml --locale English": ("", "did you mean 'en'?"),
    "run crane.toml --set arm=300 mm": ("", "a number and its unit are one word, such as --set arm=300mm"),
    "run crane.toml --until 2 s": ("", "--until and --step are in s without it"),
    "run crane.toml --set arm=300;lift=2": ("a unit such as m", "did you mean --set arm=300 --set lift=2?"),
    "run crane.toml --set arm=300,lift=2": ("a finite number", "did you mean --set arm=300 --set lift=2?"),
    "run crane.toml --set arm==3": ("a finite number", "did you mean arm=3?"),
    "run crane.toml --set until=3": ("makes one", "it is no parameter: did you mean --until?"),
    "run crane.toml --save out": ("", "did you mean 'out.csv'?"),
    "run crane.toml --save out.xlsx": ("", "did you mean 'out.csv'?"),
    "run crane.toml --save out.mat": ("", "did you mean 'out.csv'?"),
    "run crane.toml --save out.h5": ("", "did you mean 'out.nc'?"),
    "run crane.toml --plot height": ("", "did you mean 'height.png'?"),
    "run crane.toml --plot x.png --over time": ("known: a, base", "the time is 't'"),
    "run old.toml": ("model.toml", "did you mean 'name' below the header '[mechanism]'?"),
    "run crane.toml --method newton-euler": ("known: adaptive", "did you mean 'lagrange'?"),
    "run crane.toml --coordinates relative": ("known: absolute", "did you mean 'joint'?"),
    "run crane.toml --coordinates cartesian": ("known: absolute", "did you mean 'absolute'?"),
    "run crane.toml --verify false": ("", "an option that is on or off has no value"),
    "run crane.toml --quiet": ("'--units'", "did you mean '--json'?"),
    "run crane.toml --animate": ("", "did you mean 'symgen view MODEL -o FILE.html'?"),
    "run crane.toml --from rnu.csv": ("", "did you mean 'run.csv'?"),
    "sweep crane.toml --vary arm=100:300": ("values(100, 300)", "did you mean lin(100, 300, 11)?"),
    "sweep crane.toml --vary arm=100:50:300": ("values(100", "did you mean lin(100, 300, 5)?"),
    "sweep crane.toml --vary arm=100..300": ("values(100..300)", "did you mean lin(100, 300, 11)?"),
    "sweep crane.toml --vary arm=lin(100;300;5)": ("finite numbers between", "did you mean lin(100, 300, 5)?"),
    "sweep crane.toml --vary jib.mass=lin(1,2,3)": ("'jib.omega'", "'mass = VALUE' in [parameters] makes one"),
    "sweep crane.toml --vary arm=lin(1,2,3) --keep height": ("", "did you mean '--quantity'?"),
    "report crane.toml --vary arm=lin(100,300,3)": ("'lin(100'", "symgen sweep takes ranges"),
    "report crane.toml --vary lift=1;2;3": ("many values", "did you mean lift=1,2,3?"),
    "report crane.toml --output x.docx": ("", "did you mean 'x.pdf'?"),
    "view crane.toml -o x.avi": ("", "did you mean 'x.html'?"),
    "draw crane.toml -o x.dwg": ("", "did you mean 'x.svg'?"),
    "generate crane.toml --target matlab": ("", "did you mean 'c'?"),
    "linearise crane.toml --inputs torque": ("", "did you mean '--by'?"),
    "inverse crane.toml --motion run.csv": ("", "did you mean '--from'?"),
    "kinematics crane.toml --times 0:1": ("", "did you mean lin(0, 1, 11)?"),
    "synthesize crane.toml": ("as many cells", "expected a CSV file with the columns x and y"),
    "new crane.toml": ("crane-toml", "for example 'crane'"),
    "edit crane": ("begins one", "did you mean 'crane.toml'?"),
    "compare crane.toml --methods lagrange;baumgarte": ("'baumgarte'?", "did you mean lagrange,baumgarte?"),
    "inspect crane.toml --latex": ("", "did you mean '--format latex'?"),
    "cache purge": ("", "did you mean 'clear'?"),
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with a mechanism, a file that lacks its headers, and a table."""
    for name, text in (("crane.toml", CRANE), ("old.toml", 'name = "x"\n'), ("run.csv", "t,jib.x\n0,0.1\n")):
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("words", SLIPS)
def test_a_slip_names_the_nearest_valid_spelling(words, cli, folder):
    before = sorted(folder.iterdir())
    code, out, err = cli(*words.split())
    misled, meant = SLIPS[words]
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert meant in err and (not misled or misled not in err.replace(meant, ""))
    assert sorted(folder.iterdir()) == before
