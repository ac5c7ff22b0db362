"""Words of other programs, files of the folder and units of the file: the sentence names what was meant."""

import pytest

import symgen
from symgen.base.errors import InputError
from symgen.base.units import known_unit, read_unit, unit_of
from symgen.cli import COMMANDS
from symgen.cli._meant import COMMANDS_MEANT, OPTIONS_MEANT
from symgen.derive.methods import MEANT as METHODS_MEANT
from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS, MEANT

CRANE = """\
[mechanism]
name = "crane"
gravity = [0.0, -9.81]
[run]
until = 0.02
[parameters]
arm = { value = 250, unit = "mm" }
lift = 1.0
[bodies.jib]
mass = 3.0
inertia = 0.07
points = { root = ["-arm", 0.0], hook = ["arm", 0.0] }
position = ["arm", 0.0]
[joints.base]
type = "revolute"
between = ["ground", "jib"]
at = [[0.0, 0.0], "root"]
[outputs]
height = "lift*jib.hook.y"
"""
#: Words after ``symgen`` in a folder with `crane.toml`, and a part of the sentence.
SLIPS = {
    # commands
    "simulate crane.toml": "did you mean 'run'?",
    "Solve crane.toml": "did you mean 'run'?",
    "RUN crane.toml": "did you mean 'run'?",
    "plot crane.toml": "did you mean 'symgen run MODEL --plot FILE.svg'?",
    "animate crane.toml": "did you mean 'view'?",
    "optimize crane.toml": "did you mean 'design'?",
    "eigenvalues crane.toml": "did you mean 'modes'?",
    "export crane.toml": "did you mean 'generate'?",
    "help": "did you mean 'symgen --help'?",
    # options
    "run crane.toml -o x.csv": "there is no option '-o'; did you mean '--save'?",
    "run crane.toml --output x.csv": "did you mean '--save'?",
    "run crane.toml --tend 3": "did you mean '--until'?",
    "run crane.toml --columns height": "did you mean '--quantity'?",
    "view crane.toml --save x.html": "did you mean '--output'?",
    "generate crane.toml --target python": "did you mean 'cpu'?",
    "generate crane.toml --target c++": "did you mean 'c'?",
    "generate crane.toml --target FMI": "did you mean 'fmu'?",
    "inspect crane.toml --format tex": "did you mean 'latex'?",
    # integrators, methods, axes
    "run crane.toml --integrator ode45": "did you mean 'dopri5'?",
    "run crane.toml --integrator RK45": "did you mean 'dopri5'?",
    "run crane.toml --integrator LSODA": "did you mean 'bdf'?",
    "run crane.toml --integrator RADAU5": "did you mean 'radau5'?",
    "run crane.toml --method KKT": "did you mean 'lagrange'?",
    "run crane.toml --method index-3": "did you mean 'generalized-alpha'?",
    "sweep crane.toml --vary lift=linspace(1,2,3)": "did you mean 'lin'?",
    # files
    "run crane": "got 'crane'; did you mean 'crane.toml'?",
    "run crane.TOML": "got 'crane.TOML'; did you mean 'crane.toml'?",
    "run Crane": "did you mean 'crane.toml'?",
    "run .": "got '.'; did you mean 'crane.toml'?",
    "run carne.toml": "did you mean 'crane.toml'?",
    "run sub/lfit.toml": "did you mean 'sub/lift.toml'?",
    "run sub/": "did you mean 'sub/lift.toml'?",
    "run empty": "it is a folder without a .toml file",
    "run four-bar.toml": "did you mean 'four-bar' of the catalogue?",
    # numbers and quantities
    "run crane.toml --set mass=2": "'mass = VALUE' in [parameters] makes one, and mass = \"mass\" in",
    "run crane.toml --set ARM=2": "did you mean 'arm'?",
    "run crane.toml --start jib.angle=30deg": "did you mean 'jib.theta'?",
    "run crane.toml --quantity hook": "did you mean 'jib.hook'?",
    "run crane.toml --quantity hook.y": "did you mean 'jib.hook.y'?",
    "run crane.toml --quantity jib.angle": "did you mean 'jib.theta'?",
    "run crane.toml --quantity jib.position": "jib has ",
    "run crane.toml --quantity Height": "did you mean 'height'?",
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with files of mechanisms, in which commands run."""
    for name in ("crane.toml", "sub/lift.toml"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(CRANE)
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("words", SLIPS)
def test_a_slip_gets_one_sentence_with_what_was_meant(words, cli, folder):
    code, out, err = cli(*words.split())
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert SLIPS[words] in err


def test_a_folder_with_many_files_names_the_first_ones_and_counts_the_others(cli, folder):
    for i in range(5):
        (folder / f"winch{i}.toml").write_text(CRANE)
    _, _, err = cli("run", ".")
    assert "it is a folder with 'crane.toml', 'winch0.toml', 'winch1.toml' and 3 more" in err


def test_words_of_others_lead_to_what_there_is():
    """Every word of the tables is none of symgen's own, and what it leads to exists."""
    for meant, registry in ((MEANT, INTEGRATORS), (METHODS_MEANT, METHODS)):
        assert set(meant.values()) <= set(registry.names) and not set(meant) & set(registry.names)
        assert all(word == word.lower() for word in meant)
    own = set(COMMANDS) | {"--help", "--version"}
    assert {meant.split()[0] for meant in COMMANDS_MEANT.values()} <= own and not set(COMMANDS_MEANT) & own
    assert all(meant and word not in meant for word, meant in OPTIONS_MEANT.items() if word != "--output")


@pytest.mark.parametrize(
    ("typed", "note"),
    [
        ("arm=300", "symgen: --set arm=300 is 300 mm, the unit of the file; arm=300m is in m\n"),
        ("arm=300mm", ""),
        ("arm=0.3m", ""),
        ("lift=2", ""),
    ],
)
def test_a_number_without_a_unit_says_which_one_it_took(typed, note, cli, folder):
    code, _, err = cli("run", "crane.toml", "--set", typed, "--json")
    assert (code, err) == (0, note)


@pytest.mark.parametrize(
    ("quantity", "written"),
    [
        ("kg m^2", "kg m^2"),
        ("kg m^2", "g cm^2"),
        ("kg m^2", "kg mm^2"),
        ("N s/m", "kN s/mm"),
        ("N m s/rad", "N m s/rad"),
        ("N m s/rad", "kN mm s/deg"),
    ],
)
def test_symbols_without_blanks_are_told_apart_by_the_quantity(quantity, written):
    """The spelling that is named is a unit of the quantity, as large as the one that was run together."""
    run_together = written.replace(" ", "").replace("^", "")
    with pytest.raises(InputError) as caught:
        unit_of(run_together, "here", quantity=quantity)
    named = read_unit(caught.value.hint.rpartition("did you mean '")[2].removesuffix("'?"))
    assert named.fits(known_unit(quantity)) and named.factor == read_unit(written).factor


@pytest.mark.parametrize("word", ["angle", "phi", "angular_velocity", "xdot"])
def test_outputs_by_words_of_textbooks_and_of_the_file_name_the_coordinate(word, folder):
    meant = {"angular_velocity": "omega", "xdot": "vx"}.get(word, "theta")
    (folder / "slip.toml").write_text(CRANE.replace("jib.hook.y", f"jib.{word}"))
    with pytest.raises(InputError, match=f"did you mean 'jib.{meant}'"):
        symgen.load("slip.toml")
