"""What a right-hand side of a modal body costs, beside beam elements in the same process."""

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
#: Modes -> microseconds, where eight beam elements take 1.7.
MICROSECONDS = {2: 0.28, 4: 0.41, 8: 0.85, 12: 2.0}


def hanging(folder, text):
    """A model of a body that hangs by a pin, for 2,000 steps."""
    return machine(folder, text, "spatial", "[0.0, 0.0, -9.81]", until=2e-4, output_step=1e-4)


def seconds(model):
    """Processor time of the shortest of some runs."""
    settings = {"integrator": "rk4", "step": 1e-7, "shape": "straight", "coordinates": "absolute", "verify": False}
    return model.simulate(repeat=5, max_energy_error=1e9, **settings).seconds.run


def ratio(model, other):
    """Time of a model over that of another, in turns: other work of the machine meets both."""
    turns = [(seconds(model), seconds(other)) for _ in range(5)]
    return min(own for own, _ in turns) / min(beside for _, beside in turns)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_modes_cost_less_than_beam_elements_up_to_eight(tmp_path):
    """Within 1.2 times the shares of eight beam elements."""
    beams = hanging(tmp_path, BEAMS + PIN.format("rod", '"start"'))
    mesh = arc()
    for count, micro in MICROSECONDS.items():
        symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, {"root": mesh.start}, inner=count).save(tmp_path / "arm.npz")
        text = '[bodies.arm]\ntype = "modal"\nfile = "arm.npz"\n' + PIN.format("arm.root", "[0.0, 0.0, 0.0]")
        assert ratio(hanging(tmp_path, text), beams) < 1.2 * micro / 1.7, count
