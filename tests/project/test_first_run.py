"""The page of what a first run enters is what the program makes, and names functions as they are."""

import pytest

from benchmarks import first_run

PACKAGE = first_run.ROOT / "symgen"
ANEW = "run python -m benchmarks.first_run"


def test_the_page_names_functions_that_exist_with_their_docstrings() -> None:
    text = first_run.PAGE.read_text(encoding="utf-8")
    rows = list(first_run.named(text))
    assert len(rows) == text.count("\n| `") and {"cli/run.py", "run/compiling/pipeline.py"} <= {row[0] for row in rows}
    for file, name, said in rows:
        assert said == first_run.table_text(first_run.docstrings(PACKAGE / file)[name]), f"{file}: {name}; {ANEW}"


def test_each_stage_takes_a_screen() -> None:
    _, *parts = first_run.PAGE.read_text(encoding="utf-8").split("\n## ")
    assert [part.partition("\n")[0] for part in parts] == list(first_run.STAGES)
    assert all(1 <= part.count("\n| `") <= first_run.SCREEN for part in parts)


def test_stages_are_the_streets_of_functions() -> None:
    """Functions of `base` belong to the stage that enters them first."""
    files = {"derive/emit/emit.py": "cli/run.py", "base/files.py": "derive/emit/emit.py", "run/compiling/looped.py": ""}
    entered = [first_run.Entered(file, "f", 1, caller, 0) for file, caller in files.items()]
    found = {
        stage: [f.file for f in functions] for stage, functions in first_run.by_stage(entered).items() if functions
    }
    assert found == {"Derive": ["derive/emit/emit.py", "base/files.py"], "Compile": ["run/compiling/looped.py"]}


@pytest.mark.slow
def test_the_page_is_what_a_first_run_enters() -> None:
    _, entered = first_run.trace(first_run.ROOT)
    assert first_run.PAGE.read_text(encoding="utf-8") == first_run.page(entered), ANEW
