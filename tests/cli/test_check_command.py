"""Errors of mechanism files on the command line: with their lines, all at once by check."""

import json

import pytest

WRONG = """[mechanism]
name = "rod"

[parameters]
length = "width"

[bodies.rod]
mass = 1.0
inertia = -1.0

[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "top"]
friction = { sliding = "length" }

[outputs]
"up" = "rod.y"
far = "rods.y"

[run]
util = 1.0
"""
ERRORS = [
    (5, "parameters.length: expected a number or an expression of parameters, got the unknown name 'width'"),
    (9, "bodies.rod.inertia: expected a value above 0, got -1.0"),
    (19, "outputs.far: expected a number or an expression of t, parameters and what is known of the motion, got the"),
    (22, "run: got the unknown key 'util'; did you mean 'until'? (expected the keys integrator, until, step, output_"),
]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("options", [(), ("--json",)])
def test_check_names_all_errors(cli, folder, options):
    (folder / "rod.toml").write_text(WRONG)
    code, out, err = cli("check", "rod.toml", *options)
    assert code == 2
    lines = err.splitlines()
    assert len(lines) == len(ERRORS)
    assert all(line.startswith(f"rod.toml:{at}: {words}") for line, (at, words) in zip(lines, ERRORS, strict=True))
    if not options:
        assert out == ""
        return
    errors = json.loads(out)["errors"]
    assert [set(error) for error in errors] == [{"line", "where", "expected", "got", "hint"}] * len(ERRORS)
    assert [error["line"] for error in errors] == [line for line, _ in ERRORS]
    last = errors[-1]
    assert (last["where"], last["got"], last["hint"]) == ("run", "the unknown key 'util'", "did you mean 'until'?")


def test_the_path_of_the_file_is_as_it_was_given(cli, folder):
    (folder / "machines").mkdir()
    (folder / "machines" / "rod.toml").write_text(WRONG)
    _, _, err = cli("check", "machines/rod.toml")
    assert err.startswith("machines/rod.toml:5: parameters.length: ")


def test_check_shows_a_hundred_errors_at_most_and_json_has_all(cli, folder):
    wrong = "".join(f"p{i} = true\n" for i in range(150))
    (folder / "many.toml").write_text(f"[mechanism]\nname = 'many'\n[parameters]\n{wrong}")
    code, out, err = cli("check", "many.toml", "--json")
    assert (code, len(json.loads(out)["errors"])) == (2, 150)
    assert err.count("\n") == 101 and err.endswith("many.toml: 50 more\n")


@pytest.mark.parametrize("words", ["run rod.toml", "inspect rod.toml", "inspect rod.toml --format latex"])
def test_other_commands_name_the_line_of_the_first_error(cli, folder, words):
    (folder / "rod.toml").write_text(WRONG)
    code, out, err = cli(*words.split())
    line, sentence = ERRORS[0]
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert err.startswith(f"symgen: rod.toml:{line}: {sentence}")


@pytest.mark.parametrize("command", ["check", "run"])
def test_syntax_errors_have_their_line(cli, folder, command):
    (folder / "rod.toml").write_text(WRONG.replace("inertia = -1.0", "inertia"))
    code, out, err = cli(command, "rod.toml")
    assert (code, out, err.count("\n")) == (2, "", 1)
    sentence = "rod.toml:9: expected a TOML file, got a syntax error: expected '=' after a key"
    assert err.startswith(sentence if command == "check" else f"symgen: {sentence}")


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"\xff", "symgen: rod.toml: expected text in UTF-8"),
        (b"[mechanism]\nname = 'a'\n", "symgen: rod.toml: bodies: expected at least one body"),
    ],
)
def test_errors_about_no_line_have_none(cli, folder, content, sentence):
    (folder / "rod.toml").write_bytes(content)
    code, _, err = cli("run", "rod.toml")
    assert code == 2 and err.startswith(sentence)
