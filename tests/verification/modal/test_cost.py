"""How many operations a right-hand side of a modal body takes, beside one of beam elements."""

import pytest
from support.modal_machines import arc, machine

import symgen

PIN = (
    '[joints.pin]\ntype = "revolute"\nbetween = ["ground", "{}"]\nat = [[0.0, 0.0, 0.0], {}]\naxis = [0.0, 1.0, 0.0]\n'
)
BEAMS = (
    "[beams.rod]\nstart = [0.0, 0.0, 0.0]\nend = [1.0, 0.0, 0.0]\nelements = 8\n"
    "section = { width = 0.02, height = 0.02 }\nmaterial = { young = 2e9, poisson = 0.3, density = 1000.0 }\n"
)
#: Modes -> microseconds that a trial took, where eight beam elements took 1.7.
MICROSECONDS = {2: 0.28, 4: 0.41, 8: 0.85, 12: 2.0}


def hanging(folder, text):
    """A model of a body that hangs by a pin."""
    return machine(folder, text, "spatial", "[0.0, 0.0, -9.81]", until=2e-4, output_step=1e-4)


def operations(model):
    """Operations of a right-hand side."""
    facts = model.inspect(method="direct-correction", coordinates="absolute", shape="straight").facts
    return facts["method"]["functions"]["rhs"]["after"]


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_modes_cost_less_than_beam_elements_up_to_eight(tmp_path):
    """Within 1.2 times the shares of eight beam elements in that time."""
    beams = operations(hanging(tmp_path, BEAMS + PIN.format("rod", '"start"')))
    mesh = arc()
    for count, micro in MICROSECONDS.items():
        symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, {"root": mesh.start}, inner=count).save(tmp_path / "arm.npz")
        text = '[bodies.arm]\ntype = "modal"\nfile = "arm.npz"\n' + PIN.format("arm.root", "[0.0, 0.0, 0.0]")
        assert operations(hanging(tmp_path, text)) < 1.2 * micro / 1.7 * beams, count
