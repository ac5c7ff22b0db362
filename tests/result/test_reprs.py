"""What public objects show of themselves: one screen in a terminal, a table or a picture in a notebook."""

from typing import Any

import pytest

import symgen
from symgen.describe.facts.digest import mechanism_digest


@pytest.fixture(scope="module")
def objects() -> dict[str, Any]:
    model = symgen.load("four-bar")
    result = model.simulate(until=0.05)
    compiled = model.compile()
    return {
        "model": model,
        "mechanism": model.mechanism,
        "settings": symgen.Settings(),
        "builder": symgen.MechanismBuilder("x").parameter("a", 1.0),
        "compiled": compiled,
        "info": compiled.info,
        "start": model.assemble(compiled),
        "drawing": model.draw(),
        "scene": model.draw().scene,
        "run": model.start(integrator="rk4", step=1e-3),
        "result": result,
        "table": result.q,
        "outcome": result.outcome,
        "forces": result.forces,
        "measured": result.measured,
        "last state": result.last_state,
        "page": result.view(live=False),
        "sweep": symgen.sweep("pendulum", {"bob_mass": [1.0, 2.0]}, until=0.05, step=1e-2),
        "ensemble": symgen.sweep("pendulum", {"bob_mass": [1.0, 2.0]}, until=0.05, step=1e-2).ensemble,
        "study": symgen.compare(
            "pendulum", methods=["lagrange"], integrators=["rk4"], steps=[1e-2], repeat=1, until=0.05, jobs=1
        ),
    }


def test_one_screen(objects: dict[str, Any]) -> None:
    """At most 24 lines of 80 characters; most are one line."""
    for name, each in objects.items():
        text = repr(each)
        assert sum(-(-len(line) // 80) for line in text.splitlines()) <= 24, name
        assert "0x" not in text, name


def test_notebooks_have_tables_and_pictures(objects: dict[str, Any]) -> None:
    for name in ("result", "table", "sweep", "study"):
        html = objects[name]._repr_html_()
        assert html.startswith("<table>") and html.count("<table>") == html.count("</table>") == 1, name
        assert html.count("<tr>") <= 62
    assert "lagrange" in objects["study"]._repr_html_() and "crank.theta" in objects["table"]._repr_html_()
    assert objects["model"]._repr_svg_().startswith("<svg")


def test_identities_do_not_hang_on_what_is_shown(objects: dict[str, Any]) -> None:
    """A mechanism's digest differs where any number does, though what it shows of itself does not."""
    one = symgen.load("pendulum").mechanism
    import msgspec

    other = msgspec.structs.replace(one, defaults=msgspec.structs.replace(one.defaults, until=9.5))
    assert repr(one) == repr(other) and mechanism_digest(one) != mechanism_digest(other)
