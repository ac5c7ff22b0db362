"""symgen: a symbolic code-generating formulation compiler for constrained multibody systems.

    import symgen

    model = symgen.load("four-bar")
    result = model.simulate(method="direct-correction", integrator="rk4", until=10.0)
    result["crank.theta"], result.status, result.energy_drift_max

All names are imported at their first use, so that ``import symgen`` costs nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from symgen.base.version import __version__

if TYPE_CHECKING:
    from pathlib import Path

    from symgen.api import Model as _Model
    from symgen.api import simulate as simulate
    from symgen.base.errors import AssemblyError, InputError, SimulationError, StepError, SymgenError
    from symgen.base.plugins import load_plugin
    from symgen.base.settings import Settings
    from symgen.derive.methods import list_methods
    from symgen.describe.files.builder import MechanismBuilder
    from symgen.describe.mechanism import Mechanism
    from symgen.describe.reduction.reduction import reduced
    from symgen.result.labelled import Labelled
    from symgen.result.result import Result
    from symgen.result.stepping.stepped_run import SteppedRun
    from symgen.run.integrators import list_integrators
    from symgen.study.comparison.compare_models import Study
    from symgen.study.comparison.compare_models import compare as compare
    from symgen.study.design.designing import design as design
    from symgen.study.design.found import Design
    from symgen.study.ensemble.parameter_sweep import sweep as sweep
    from symgen.study.ensemble.sweep_study import Sweep
    from symgen.study.report.write import write_report

    _compare, _design, _sweep = compare, design, sweep

    class Model(_Model):
        """`symgen.api.Model` with its studies, which are found by their names when they are first called."""

        compare, design, sweep = _compare, _design, _sweep

    def load(model: str | Path | Mechanism | _Model) -> Model:
        """Return a model; see `symgen.api.load`."""


#: Public name -> its module.
_WHERE = {
    "AssemblyError": "symgen.base.errors",
    "Design": "symgen.study.design.found",
    "InputError": "symgen.base.errors",
    "Labelled": "symgen.result.labelled",
    "Mechanism": "symgen.describe.mechanism",
    "MechanismBuilder": "symgen.describe.files.builder",
    "Model": "symgen.api",
    "Result": "symgen.result.result",
    "Settings": "symgen.base.settings",
    "SimulationError": "symgen.base.errors",
    "StepError": "symgen.base.errors",
    "SteppedRun": "symgen.result.stepping.stepped_run",
    "Study": "symgen.study.comparison.compare_models",
    "Sweep": "symgen.study.ensemble.sweep_study",
    "SymgenError": "symgen.base.errors",
    "compare": "symgen.study.comparison.compare_models",
    "design": "symgen.study.design.designing",
    "list_integrators": "symgen.run.integrators",
    "list_methods": "symgen.derive.methods",
    "load": "symgen.api",
    "load_plugin": "symgen.base.plugins",
    "reduced": "symgen.describe.reduction.reduction",
    "simulate": "symgen.api",
    "sweep": "symgen.study.ensemble.parameter_sweep",
    "write_report": "symgen.study.report.write",
}

__all__ = [
    "AssemblyError",
    "Design",
    "InputError",
    "Labelled",
    "Mechanism",
    "MechanismBuilder",
    "Model",
    "Result",
    "Settings",
    "SimulationError",
    "StepError",
    "SteppedRun",
    "Study",
    "Sweep",
    "SymgenError",
    "__version__",
    "compare",
    "design",
    "list_integrators",
    "list_methods",
    "load",
    "load_plugin",
    "reduced",
    "simulate",
    "sweep",
    "write_report",
]


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name not in _WHERE:
        raise AttributeError(f"module 'symgen' has no attribute '{name}'")
    value = getattr(import_module(_WHERE[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
