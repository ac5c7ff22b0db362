"""The page of names that are bound late is what the program makes, and no name means two functions by default."""

import types
from collections.abc import Iterator

from benchmarks import late_names
from symgen.compile.loopcode.loop_instances import Meanings


def test_the_page_is_made_from_the_code() -> None:
    assert late_names.PAGE.read_text(encoding="utf-8") == late_names.page(), "run python -m benchmarks.late_names"


def test_each_name_is_on_the_page_with_its_meanings() -> None:
    rows = late_names.PAGE.read_text(encoding="utf-8").count("\n| `") - len(late_names.dictionaries())
    assert rows == len(late_names.meanings())
    attempts = {meaning.binder for meaning in late_names.meanings()["attempt"]}
    assert len(attempts) > 15 and {"loops/schemes/rattle.py", "rows/lanes.py _MEANINGS"} <= attempts


def test_a_bound_name_is_used_by_a_copied_function() -> None:
    """Else nobody would notice that it means nothing."""
    assert set(late_names.meanings()) <= set(late_names.users())


def test_a_name_means_one_function_by_default() -> None:
    """Else a scheme that binds it would replace the other one as well; constants may have copies."""
    found = {name: {file for file, _ in places} for name, places in late_names.defaults().items() if name.islower()}
    assert found.pop("integrate") == {"printed/kept_run.py", "rows/rows.py"}, "the place of the loop"
    assert {name: files for name, files in found.items() if len(files) != 1} == {}


def tables_of_functions() -> Iterator[str]:
    """Yield the module variables of `run` that are dictionaries of functions by names that copied functions use."""
    for module in late_names.modules():
        for name in late_names.assigned(module.__name__):
            value = getattr(module, name)
            if isinstance(value, dict) and value and set(map(str, value)) <= set(late_names.users()):
                if any(isinstance(function, types.FunctionType) for function in value.values()):
                    yield f"{late_names.file_of(module.__name__)} {name}"


def test_dictionaries_of_meanings_say_when_they_hold() -> None:
    found = set(tables_of_functions())
    assert {name for name in found - set(late_names.dictionaries()) if not name.startswith("loops/schemes/")} == set()
    assert {"modes/turn.py STRIKING", "rows/rows.py EVENTS"} <= found
    assert all(isinstance(names, Meanings) and names.when for names in late_names.dictionaries().values())
