"""Words of commands that are wrong, contradict each other or count for nothing: one sentence, code 2 and no file."""

import pytest

ROD = """[mechanism]
name = "rod"
[run]
until = 0.02
step = 1e-2
[bodies.bar]
mass = 2.0
inertia = 0.1
position = [1.0, 0.0]
[joints.pin]
type = "revolute"
between = ["ground", "bar"]
at = [[0.0, 0.0], [-1.0, 0.0]]
"""
REFUSED = {
    "rnu four-bar": "there is no command 'rnu'; did you mean 'run'?",
    "run": "missing argument 'MODEL'",
    "run four-bra": "model: expected a catalogue name or the path of a file, got 'four-bra'; did you mean",
    "run nowhere/four-bar.toml": "which is no file",
    "run four-bar --stpe 1e-3": "there is no option '--stpe'; did you mean '--step'?",
    "run four-bar --step abc": "'--step': expected a number, got 'abc' (symgen run --help)",
    "run four-bar --step nan": "--step: expected a finite number above 0, got nan",
    "run four-bar --rtol 0": "--rtol: expected a finite number above 0, got 0",
    "run four-bar --integrator rk4 --until 1e12": "at most 2e9 steps",
    "run four-bar --method direct-correctoin": "did you mean 'direct-correction'?",
    "run four-bar --integrator rk5": "did you mean 'rk4'?",
    "run four-bar --set crank_mass": "--set: expected NAME=VALUE, got 'crank_mass'",
    "run four-bar --set crank_mass=nan": "--set crank_mass: expected a finite number, got 'nan'",
    "run four-bar --set crankmass=1": "did you mean 'crank_mass'?",
    "run four-bar --set crank_mass=0": "mass or inertia of crank: expected a value above 0, got 0",
    "run four-bar --option method.wieght=mass": "did you mean 'weight'?",
    "run four-bar --option method.weight=length": "expected one of identity, mass, body, got 'length'",
    "run four-bar --option lagrange.alpha=1": "expected method.NAME or integrator.NAME",
    "run four-bar --save run.xls": "--save: expected a file ending in .nc, .parquet, .csv, got 'run.xls'",
    "run four-bar --plot run.jpg": "--plot: expected a file ending in .png, .svg, .pdf, .pgf, got 'run.jpg'",
    "run four-bar --save nowhere/run.csv": "--save: expected a file in a folder that exists",
    "kinematics driven-four-bar --save k.nc": "--save: expected a file ending in .csv, .parquet, got 'k.nc'",
    "compare pendulum --plot-width 84": "--plot-width: expected --plot FILE, which has the width, got no --plot",
    "compare pendulum --plot a.svg --plot-width 3300": "--plot-width: expected 30 to 1000 mm, got 3300",
    "compare pendulum --csv rows.txt": "--csv: expected a file ending in .csv, got 'rows.txt'",
    "inspect pendulum --option mass.weight=mass": "expected direct-correction.NAME, method.NAME or NAME",
    "inspect pendulum --method baumgarte --option alpha=2": "got 'alpha', a number that runs are given; known:",
    "run four-bar --repeat 0": "repeat: expected a whole number from 1 to 1000, got 0",
    "run four-bar --verify=1": "does not take a value",
    "compare four-bar --steps 1e-3,x": "--steps: expected finite numbers above 0, separated by commas, got 'x'",
    "compare four-bar --methods lagrange,,": "--methods: expected words separated by commas",
    "compare four-bar --methods lagrang": "did you mean 'lagrange'?",
    "compare four-bar --reference scipy-rado": "did you mean 'scipy-radau'?",
    "compare four-bar --csv nowhere/rows.csv": "--csv: expected a file in a folder that exists",
    "inspect four-bar --format pdf": "'pdf' is not one of",
    "cache inof": "there is no command 'inof'; did you mean 'info'?",
    "new Crane": "expected lower-case words joined by dashes",
    "completion csh": "'csh' is not one of",
    "compare pendulum -o report.doc": "--output: expected a file ending in .html, .md, .pdf, .tex, got 'report.doc'",
    "compare pendulum --resume nowhere/rows.journal": "expected a file in a folder that exists",
    "compare pendulum --jobs 0": "--jobs: expected a whole number from 1 to 4096, got 0",
    "compare pendulum --output": "requires an argument",
    "compare pendulum --integrators nope": "expected an integrator, got 'nope'",
    "compare pendulum --methods ggl --integrators rk4": "one that solves a form of ggl",
    "stress five-bar": "model: expected a catalogue name or the path of a file, got 'five-bar'",
    "stress --cases stifness": "got 'stifness'; did you mean 'stiffness'?",
    "stress -o stress.doc": "--output: expected",
    "stress --resume README.md": "expected a journal of symgen, got something else in line 1",
    "run rod.toml --method baumgarte --option method.alpha=5 --option baumgarte.alpha=6": "each option once",
    "inspect rod.toml --option weight=mass --option method.weight=body": "expected each option once",
    "generate rod.toml --method ggl --option method.solver=dense --option ggl.solver=augmented": "expected each",
    "inspect rod.toml --json --format latex": "--json: expected the same as --format json, got --format latex",
    "draw rod.toml --at described --start bar.theta=1": "start: expected a picture of the start",
    "view rod.toml --live -o rod.gif": "--live: expected a page of a run, which alone has equations in it",
    "view rod.toml --live --mode 1": "--live: expected a page of a run",
    "view RUN.NC": "view: expected a file of a result, got 'RUN.NC', which is none",
    "compare rod.toml --csv a.csv --resume ./a.csv": "--csv: expected another file than --resume has",
    "stress rod.toml -o a.html --journal a.html": "--output: expected another file than --resume has",
    "kinematics rod.toml --plot a.svg --curves a.svg": "--curves: expected another file than --plot has",
    "inverse rod.toml --from a.nc --start bar.theta=1": "--start: expected settings of a recorded motion",
    "inverse rod.toml --from a.nc --strict": "--strict: expected settings of a recorded motion",
    "inverse rod.toml --quantity power": "--quantity: expected --save or --plot, where quantities go, got neither",
    "schema --json": "there is no option '--json' (symgen schema --help)",
    "inspect pendulum --select Phi": "--document",
    "inspect pendulum --document": "--format latex",
    "inspect pendulum --format latex --document --select Psi": "nomenclature",
    "inspect pendulum --format latex --document --shape looped": "looped",
    "inspect pendulum -o x.pdf": "ending in .html",
    "inspect pendulum -o x.html --json": "JSON with it",
    "draw pendulum -o x.gif": "ending in .svg",
    "draw pendulum -o no/x.svg": "folder that exists",
    "draw pendulum --at yesterday": "start, described or a time",
    "draw pendulum --view 1": "two angles",
    "view pendulum -o x.pdf": "ending in .html",
    "view pendulum -o no/x.html": "folder that exists",
    "view pendulum --beside a.nc": "two saved results",
    "view pendulum --model pendulum": "a saved result to be viewed",
    "view none.nc": "a file of a result",
    "view a.nc --model pendulum --mode 1": "about whose equilibrium",
    "view pendulum --mode 9": "from 1 to",
    "view pendulum --at start": "asked for with --mode",
    "view pendulum --mode 1 --until 3": "--until: expected settings of a mode shape",
    "run four-bar --coordinates joint --shape looped": "absolute ones for code that is not straight",
    "run four-bar --coordinates joints": "expected one of absolute, joint, auto, got 'joints'; did you mean 'joint'?",
    "generate four-bar --coordinates joint --target cuda": "loops, lanes and CUDA have no joint coordinates",
}


@pytest.mark.parametrize("words", REFUSED)
def test_bad_input_gets_one_sentence_exit_code_2_and_no_file(cli, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    files = {"rod.toml": ROD, "README.md": "# words\n"}
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    code, out, err = cli(*words.split())
    assert (code, out) == (2, "")
    assert REFUSED[words] in err and err.startswith("symgen: ") and err.count("\n") == 1
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == files


WITHOUT_EXTRA = {
    "run four-bar --save x.nc": "data",
    "run four-bar --save x.parquet": "data",
    "run four-bar --plot x.svg": "plot",
    "kinematics driven-four-bar --curves x.svg": "plot",
    "inverse driven-four-bar --save x.parquet": "data",
    "compare four-bar -o x.html": "plot",
    "stress -o x.md": "plot",
    "sweep four-bar --vary crank_mass=lin(1,2,2) -o x.csv --plot x.svg": "plot",
}


@pytest.mark.parametrize(("words", "extra"), WITHOUT_EXTRA.items(), ids=WITHOUT_EXTRA)
def test_a_missing_library_is_named_with_its_extra_before_a_model_is_read(words, extra, cli, tmp_path, monkeypatch):
    """In an installation without extras; a model that is read all the same would have code 70."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("symgen.base.files.find_spec", lambda name: None)
    monkeypatch.setattr("symgen.api.load", None)
    code, out, err = cli(*words.split())
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "got none; pip install 'symgen[" + extra + "]' installs it" in err
    assert list(tmp_path.iterdir()) == []
