"""The Python interface: a model, its compiled forms, and runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np

from symgen.analyses.model_methods import Analysed
from symgen.base import arguments
from symgen.base.errors import InputError, suggest
from symgen.base.keywords import RunKeywords, make_entry
from symgen.base.plugins import explain_plugin_errors
from symgen.base.settings import COORDINATES, SHAPES, Settings, change_settings, differs_from_default
from symgen.describe.bounds.bounded_modes import refuse_bounds
from symgen.describe.files.load import load_mechanism
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.describe.formulas.start import described_start
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.holds import read_holds
from symgen.result.reading.model_views import Shown
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model
from symgen.run.layout.compiled import CompiledModel
from symgen.run.planning.prepare import Prepared, prepare
from symgen.run.planning.starts import start_in_bodies
from symgen.run.single.run import Array

if TYPE_CHECKING:
    from symgen.analyses.functions.body_frame import Frame
    from symgen.analyses.functions.model_functions import Functions
    from symgen.result.result import Result
    from symgen.result.stepping.stepped_run import SteppedRun
    from symgen.run.compiling.method_choice import MethodChoice
    from symgen.run.planning.package import Package
    from symgen.run.starts.assembly import Start
    from symgen.run.starts.held import Held

#: Functions of the package that are methods of models as well.
STUDIES = ("compare", "design", "sweep")


@explain_plugin_errors
def load(model: str | Path | Mechanism | Model) -> Model:
    """Return a model by catalogue name (``"n-four-bar:40"``), path of a TOML file, or from a `Mechanism`.

    A `Model` is returned as it is.

    Raises
    ------
    InputError
        If the model does not exist or the file is invalid.
    """
    if isinstance(model, Model):
        return model
    return Model(model if isinstance(model, Mechanism) else load_mechanism(model))


@make_entry
def simulate(
    model: str | Path | Mechanism | Model,
    settings: Settings | None = None,
    progress: Callable[[float], None] | None = None,
    sensitivities: Sequence[str] = (),
    **changes: Unpack[RunKeywords],
) -> Result:
    """Load and run a model.

    Parameters
    ----------
    model
        As for `load`.
    settings, progress, sensitivities
        As for `Model.simulate`.
    **changes
        Single settings by name, as listed above.
    """
    return load(model).simulate(settings, progress, sensitivities, **changes)


@dataclass(frozen=True, repr=False)
class Model(Analysed, Shown):
    """A mechanism that can be compiled and run.

    Attributes
    ----------
    mechanism : Mechanism
        The validated description.
    """

    mechanism: Mechanism

    def __post_init__(self) -> None:
        arguments.instance("mechanism", self.mechanism, Mechanism, "a Mechanism; symgen.load takes names and paths")

    @property
    def name(self) -> str:
        """Name of the mechanism."""
        return self.mechanism.name

    @property
    def remarks(self) -> tuple[str, ...]:
        """What a reader of any result has to know of the model; all results repeat it."""
        return self.mechanism.remarks

    def parameters(self, changed: Mapping[str, float] | None = None) -> dict[str, float]:
        """Return the values of all parameters; values in `changed` replace the described ones.

        Raises
        ------
        InputError
            If a name is not a parameter or a value is not finite.
        """
        return parameter_values(self.mechanism, changed)

    @explain_plugin_errors
    def compile(
        self, method: str = "direct-correction", options: Mapping[str, str] | None = None, shape: str = "straight"
    ) -> CompiledModel:
        """Return the emitted functions for one method, from the cache or newly generated.

        Parameters
        ----------
        method : str
            Name of the method.
        options : mapping, optional
            Its structural options, e.g. ``{"weight": "mass"}``.
        shape : {"straight", "looped"}
            Code for this mechanism alone, or loops over tables that all mechanisms share.
        """
        values = arguments.mapping("options", options, "texts by the names of options")
        texts = {name: arguments.text(f"option '{name}'", value) for name, value in values.items()}
        shape = arguments.one_word_of("shape", shape, SHAPES[1:])
        return self.compiled(replace(choose_method(method, texts), shape=shape))

    def compiled(self, choice: MethodChoice) -> CompiledModel:
        """Return the emitted functions for a choice of method, options and shape, from the cache if it has them."""
        return compile_model(self.mechanism, choice)

    @explain_plugin_errors
    def functions(self, coordinates: str = "auto", parameters: Mapping[str, float] | None = None) -> Functions:
        """Return the dynamics as compiled functions: `symgen.analyses.functions.model_functions.Functions`.

        Parameters
        ----------
        coordinates : {"absolute", "joint", "auto"}
            Coordinates of the state.
        parameters : mapping, optional
            Numbers that differ from the described ones: of parameters, inputs, own states and the time ``t``.
        """
        from symgen.analyses.functions.model_functions import Functions

        return Functions(self.mechanism, coordinates, parameters)

    @explain_plugin_errors
    def frame(self, name: str, coordinates: str = "auto", parameters: Mapping[str, float] | None = None) -> Frame:
        """Return a frame on a body: its pose, velocity and Jacobian as compiled functions.

        Parameters
        ----------
        name : str
            A body, or a point such as ``arm.tip``, or ``tip`` where one body has such a point.
        coordinates, parameters
            As for `functions`.
        """
        return self.functions(coordinates, parameters).frame(name)

    def initial_state(self, parameters: Mapping[str, float]) -> tuple[Array, list[float | None]]:
        """Return q as described (not yet closed) and the described velocities, None where not set.

        Parameters
        ----------
        parameters : mapping
            Values of all parameters.
        """
        q, v = described_start(self.mechanism, scalar_values(parameters))
        return np.array(q), v

    @explain_plugin_errors
    def assemble(
        self,
        compiled: CompiledModel,
        parameters: Mapping[str, float] | None = None,
        method_parameters: Mapping[str, float] | None = None,
        strict: bool = False,
        held: Held | Mapping[str, float] | None = None,
        ask_light: bool = False,
    ) -> Start:
        """Return the consistent start of a run; see `symgen.run.planning.starts.start_in_bodies`.

        Parameters
        ----------
        compiled : CompiledModel
            From `compile`.
        parameters, method_parameters : mapping, optional
            Values that differ from the described ones, and from the method's defaults.
        strict : bool
            Refuse a start that is not consistent instead of changing it.
        held : mapping, optional
            Values of coordinates and velocities to keep, by name, as in the setting ``start``.
        ask_light : bool
            Whether the start reports bodies that are too light for the law's solver.

        Raises
        ------
        AssemblyError
            If the mechanism cannot be closed.
        """
        arguments.instance("compiled", compiled, CompiledModel, "what Model.compile returned")  # type: ignore[type-abstract]  # a type, not an instance
        values = self.parameters(parameters)
        if compiled.info.name != self.name or [p.name for p in compiled.info.parameters] != list(values):
            raise InputError("compiled", f"compiled code of {self.name}", f"that of {compiled.info.name}")
        own = {name for name, _ in compiled.law.parameters}
        for name, value in arguments.mapping("method_parameters", method_parameters, "numbers by name").items():
            arguments.number(f"method_parameters '{name}'", value)
            if name not in own:
                expected = f"a parameter of {compiled.law.method}"
                raise InputError("method_parameters", expected, f"'{name}'", suggest(name, own) or "it has none")
        strict = arguments.truth_value("strict", strict)
        if held is None or isinstance(held, Mapping):
            settings = Settings(start=held or {}).start
            held = read_holds(self.mechanism, "start", settings)  # type: ignore[assignment]  # of names, by index later
        # the checker does not follow that names became indices in `held`
        return start_in_bodies(self.mechanism, compiled, parameters, method_parameters, strict, held, ask_light)  # type: ignore[arg-type]

    def __repr__(self) -> str:
        return repr(self.mechanism).replace("<Mechanism", "<Model", 1)

    @explain_plugin_errors
    def generate(
        self,
        path: str | Path | None = None,
        methods: str | Sequence[str] | None = "direct-correction",
        options: Mapping[str, str] | None = None,
        *,
        coordinates: str = "absolute",
        shape: str = "straight",
        target: str = "cpu",
        fmi: int = 2,
        integrator: str | None = None,
        rtol: float | None = None,
        atol: float | None = None,
        derivatives: bool = False,
    ) -> Package:
        """Write the emitted code into a folder: readable modules and a script that simulates the mechanism.

        Parameters
        ----------
        path : path, optional
            The folder, created if missing, or the FMU; by default named after the mechanism.
        methods : str or sequence of str, optional
            Methods, one module each; None: all that suit the mechanism, the shape and the target.
        options : mapping, optional
            Their structural options, e.g. ``{"direct-correction.weight": "mass"}``.
        coordinates : {"absolute", "joint", "auto"}
            Coordinates of the state.
        shape : {"straight", "looped"}
            Code for this mechanism alone, or loops over tables that all mechanisms share.
        target : str
            Target of the code, one of `symgen.result.targets`: ``cpu``, ``lanes``, ``cuda``, ``javascript``, ``c``,
            ``fmu``.
        fmi : {2, 3}
            Version of FMI of an FMU.
        integrator : str, optional
            Of C and FMUs: the explicit Runge-Kutta scheme of a run that is printed as a whole, with its error control,
            events and limits, such as ``dop853``; its options are ``integrator.NAME``. By default steps are those of
            the classical scheme.
        rtol, atol : float, optional
            Tolerances of its adaptive steps; by default those of `simulate`.
        derivatives : bool
            Of ``c-functions``: whether derivatives of the functions and of a step are written as well. Of FMUs for
            model exchange: whether they have directional derivatives.

        Returns
        -------
        Package
            The folder and its files.

        Raises
        ------
        InputError
            If an argument is wrong, or the folder cannot be written.
        """
        from symgen.result.targets import TARGETS, Request

        kind = TARGETS.get(arguments.text("target", target, "the name of a target"), "target")
        if not kind.bounded:
            refuse_bounds(f"target '{target}'", self.mechanism)
        texts = {
            name: arguments.text(f"option '{name}'", value)
            for name, value in arguments.mapping("options", options, "texts by the names of options").items()
        }
        request = Request(
            self.mechanism,
            arguments.path_argument("path", self.name + kind.ending if path is None else path),
            None if methods is None else arguments.words("methods", methods),
            texts,
            arguments.one_word_of("coordinates", coordinates, COORDINATES),
            arguments.one_word_of("shape", shape, SHAPES[1:]),
            fmi,
            *kind.check_run(target, integrator, rtol, atol),
            kind.check_derivatives(target, derivatives),
        )
        return kind.write(request)

    @make_entry
    def simulate(
        self,
        settings: Settings | None = None,
        progress: Callable[[float], None] | None = None,
        sensitivities: Sequence[str] = (),
        **changes: Unpack[RunKeywords],
    ) -> Result:
        """Run the model.

        Parameters
        ----------
        settings : Settings, optional
            All settings at once.
        progress : callable, optional
            Called with the time reached, about ten times a second.
        sensitivities : sequence of str
            Numbers that the motion is differentiated by: parameters, numbers written in the file by their paths, such
            as ``bodies.crank.mass`` and ``bodies.crank.points.B[0]``, values of the start such as ``crank.omega``, and
            ``method.NAME``. `Result.gradient` returns the derivatives.
        **changes
            Single settings by name, as listed above.

        Returns
        -------
        Result
            Also of a failed or interrupted run, with status and reason.
        """
        from symgen.result.reruns.verified_result import run_and_verify

        arguments.callable_or_none("progress", progress)
        settings = change_settings(settings, changes)
        return run_and_verify(self.mechanism, settings, progress, arguments.words("sensitivities", sensitivities))

    @make_entry
    def start(self, settings: Settings | None = None, **changes: Unpack[RunKeywords]) -> SteppedRun:
        """Return a run at its start, to be advanced step by step.

        Parameters
        ----------
        settings : Settings, optional
            All settings at once.
        **changes
            Single settings by name, as listed above. ``until`` does not end the run; it sets the time scale
            of a motion that starts at rest. In joint coordinates the state has the names of the tree's joints, and
            `SteppedRun.bodies` has the places of bodies. With an integrator of constant steps and no ``step``, each
            call of `SteppedRun.step` is one step. Settings of outputs, of repetitions
            and of second runs mean nothing here and are refused.

        Raises
        ------
        InputError
            If a setting is wrong.
        AssemblyError
            If the mechanism cannot be closed.
        StepError
            If the start violates a limit of the run.
        """
        from symgen.result.stepping.stepped_run import SteppedRun

        settings = change_settings(settings, changes)
        for name in ("output_step", "times", "verify", "repeat"):
            if differs_from_default(settings, name):
                raise InputError(f"start: {name}", "settings of a run without outputs", f"one with {name}")
        settings = replace(settings, times=())

        def begun(start: Any) -> Prepared:
            return prepare(self.mechanism, replace(settings, start=start))

        return SteppedRun(begun(settings.start), begun)


class _OfPackage:
    """A function of the package as a method; its module imports this one, so it is imported at its first use."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __get__(self, model: object, owner: type) -> Any:
        setattr(owner, self.name, getattr(import_module("symgen"), self.name))
        return getattr(owner if model is None else model, self.name)


for _name in STUDIES:  # type checkers see them in `symgen.Model`
    setattr(Model, _name, _OfPackage(_name))
