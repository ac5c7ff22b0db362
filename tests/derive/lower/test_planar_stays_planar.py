"""Nothing of three dimensions is left in a planar module: no name, no function, no operation."""

import re

import pytest
from support.emitted import mechanism_of
from support.models import EVERYTHING
from support.twin import spatial_twin

from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.model import lower_model
from symgen.describe.catalogue import raw
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import generate

SPATIAL_WORDS = re.compile(
    r"\b(e[0-3]|w[xyz]|vz|z)\b|\w_(e[0-3]|w[xyz]|vz|z)\b|normalise|\bturn\b|\bmove\b|winding|math\.floor|math\.atan2"
)


@pytest.mark.slow_cases("everything")
@pytest.mark.parametrize("description", [EVERYTHING, raw("four-bar")], ids=["everything", "four-bar"])
def test_no_word_of_space(description):
    choices = tuple(choose_method(m, None) for m in ("lagrange", "baumgarte", "direct-correction"))
    for stem, (source, info) in generate(mechanism_of(description), choices).modules.items():
        code = source.split('"""', 2)[2]  # the header may say that it was left out
        found = [line for line in code.splitlines() if SPATIAL_WORDS.search(line)]
        assert not found, (stem, found[:3])
        if stem == "model":
            assert info["windings"] == 0 and not info["spins"]
            assert all(name not in source.split('"""')[1] for name in (".z ", ".e0", ".wx"))


def test_the_words_are_those_of_spatial_modules():
    twin = spatial_twin(raw("four-bar"), {})
    code = generate(mechanism_of(twin), (choose_method("lagrange", None),)).modules["model"][0].split('"""', 2)[2]
    for word in ("normalise", "turn", "move", "winding", "math.floor", "math.atan2"):
        assert SPATIAL_WORDS.search(word) and word in code, word


def test_planar_operations():
    """The four-bar's Phi, D, gamma and f cost what a hand count of the plane gives, far below their twin in space."""
    planar = raw("four-bar")
    flat, deep = (
        formulate(mechanism_of(m)) for m in (planar, spatial_twin(planar, {"B": "spherical", "C": "cylindrical"}))
    )

    def operations(e, nodes):
        return sum(e.graph.nodes[n][0] not in ("const", "input") for n in e.graph.required_nodes(nodes))

    # 6 pins' arms of one nonzero coordinate: c d and s d each; cos and sin of 3 angles; 8 rows of sums
    phi = operations(flat, [row.phi for row in flat.rows])
    assert phi <= 6 + 12 + 8 * 3 + 1
    assert operations(flat, flat.q_rates) == 0
    assert operations(flat, [n for row in flat.rows for _, n in row.entries]) <= 6 + 12 + 8
    for flat_nodes, deep_nodes in (
        ([row.phi for row in flat.rows], [row.phi for row in deep.rows]),
        ([row.gamma for row in flat.rows], [row.gamma for row in deep.rows]),
    ):
        assert operations(flat, flat_nodes) * 3 < operations(deep, deep_nodes)
    sizes = [sum(b.operations for b in lower_model(e, "").blocks) for e in (flat, deep)]
    assert sizes[0] * 4 < sizes[1]
