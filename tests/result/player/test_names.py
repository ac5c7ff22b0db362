"""Names in pages: a page may hold each once, whatever the tables of a file are called."""

import re

from support.emitted import mechanism_of

from symgen.compile.native.javascript_code import javascript_functions
from symgen.run.compiling.checked import check_kernels
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model


def test_arrays_of_tables_and_functions_have_names_of_their_own() -> None:
    """Points of a table `a` would be called as the function of a table `a_points_a` is."""
    names = ("a", "a_points_a", "a_values_a", "a_points_a_2")
    table = {"x": [0.0, 0.3, 1.0], "y": [0.0, 1.0, 4.0]}
    raw = {
        "mechanism": {"name": "names"},
        "tables": {name: table for name in names},
        "bodies": {"ball": {"type": "point", "mass": 1.0, "position": [0.2, 0.0]}},
        "forces": {
            "push": {"type": "force", "body": "ball", "force": [" + ".join(f"{name}(ball.x)" for name in names), 0.0]}
        },
    }
    text = javascript_functions(check_kernels(compile_model(mechanism_of(raw), choose_method("lagrange"))))
    arrays = re.findall(r"^const (\w+) = \[", text, re.MULTILINE)
    defined = [*arrays, *re.findall(r"^function (\w+)\(", text, re.MULTILINE)]
    assert len(arrays) == 2 * len(names) and len(defined) > 3 * len(names)
    assert len(defined) == len(set(defined))
    assert set(re.findall(r"\b(table_\w+)\[", text)) == set(arrays)
