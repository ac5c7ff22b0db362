"""The page of names that are bound late is what the program makes, and no name means two functions by default."""

import types
from collections.abc import Iterator

from benchmarks import late_names
from symgen.compile.loopcode.loop_instances import Meanings
from symgen.run.loops import unbound


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
    found = {name: places for name, places in late_names.defaults().items() if name.islower()}
    assert {name: places for name, places in found.items() if len(places) != 1} == {}


def test_functions_that_do_nothing_are_in_one_file_and_name_the_page() -> None:
    """A jump to the definition of a name ends there."""
    own = {name: f for name, f in vars(unbound).items() if getattr(f, "__module__", "") == unbound.__name__}
    functions = {name: f for name, f in own.items() if isinstance(f, types.FunctionType)}
    assert set(functions) <= {name for name in late_names.meanings()} and len(functions) > 30
    for name, function in functions.items():
        assert "``docs/development/late-names.md`` says who means it when." in str(function.__doc__), name
    by_default = {name for name, places in late_names.defaults().items() if ("loops/unbound.py", name) in places}
    assert by_default == set(functions)


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
    assert {"modes/turn_meanings.py STRIKING", "rows/rows.py EVENTS"} <= found
    assert all(isinstance(names, Meanings) and names.when for names in late_names.dictionaries().values())
