"""Targets write the code of a mechanism."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.base.settings import Settings

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.planning.package import Package

#: The method of targets with a single method.
USUAL = "direct-correction"


@dataclass(frozen=True)
class Request:
    """A mechanism and the options of its code.

    Attributes
    ----------
    mechanism : Mechanism
        A validated mechanism.
    path : Path
        The folder, or the file of a single-file target.
    methods : tuple of str or None
        Names of methods, None for all that suit the mechanism, the shape and the target.
    options : mapping of str to str
        Options of methods.
    coordinates : {"absolute", "joint", "auto"}
        Coordinates of the state.
    shape : {"straight", "looped"}
        Code for this mechanism alone, or loops over tables.
    fmi : {2, 3}
        Version of the interface of an FMU.
    integrator : str or None
        The integrator of a run that is printed as a whole; None where the target has its own steps.
    rtol, atol : float or None
        Tolerances of its adaptive steps; None for those of runs.
    derivatives : bool
        Whether derivatives are written as well: of functions, or directional ones of an FMU.
    """

    mechanism: Mechanism
    path: Path
    methods: tuple[str, ...] | None = (USUAL,)
    options: Mapping[str, str] | None = None
    coordinates: str = "absolute"
    shape: str = "straight"
    fmi: int = 2
    integrator: str | None = None
    rtol: float | None = None
    atol: float | None = None
    derivatives: bool = False

    def settings(self, target: str) -> Settings:
        """Return the settings of a run by the only method.

        Parameters
        ----------
        target : str
            The target, for messages.

        Raises
        ------
        InputError
            If there are several methods, or the shape is looped.
        """
        from symgen.run.compiling.choices import choose_coordinates

        if self.shape != "straight":
            raise InputError(f"--target {target}", "the straight shape", self.shape)
        if self.methods is None or len(self.methods) != 1:
            raise InputError(f"--target {target}", "one method", ", ".join(self.methods or ("all",)))
        method, integrator = self.methods[0], self.integrator or "rk4"
        owners = ("integrator", integrator) if self.integrator else ()
        options = dict[str, str]()
        for key, text in (self.options or {}).items():
            owner, _, name = key.rpartition(".")
            options[f"{'integrator' if owner in owners else 'method'}.{name}"] = text
        coordinates = choose_coordinates(self.mechanism, self.coordinates, "straight").name
        tolerances: dict[str, Any] = {"rtol": self.rtol, "atol": self.atol}
        return Settings(method, integrator, options=options, shape="straight", coordinates=coordinates, **tolerances)


@dataclass(frozen=True)
class Target:
    """One use of emitted code; the first line of a target's file names it and the requirements of the code.

    Attributes
    ----------
    write : callable
        Writes the files of a request.
    ending : str
        Suffix of the mechanism's name in the default path.
    bounded : bool
        Whether its code may have bounded rows, whose modes are those that callers write.
    runs : bool
        Whether it can print a whole run by a named integrator.
    derivatives : bool
        Whether it can write derivatives as well.
    """

    write: Callable[[Request], Package]
    ending: str = ""
    bounded: bool = False
    runs: bool = False
    derivatives: bool = False

    def check_derivatives(self, target: str, derivatives: object) -> bool:
        """Return whether derivatives are wanted; refuse them of a target that has none."""
        wanted = arguments.truth_value("derivatives", derivatives)
        if wanted and not self.derivatives:
            raise InputError("derivatives", "target 'c-functions' or 'fmu', which write them", f"target '{target}'")
        return wanted

    def check_run(
        self, target: str, integrator: str | None, rtol: float | None, atol: float | None
    ) -> tuple[str | None, float | None, float | None]:
        """Return integrator and tolerances of a whole run, checked.

        Parameters
        ----------
        target : str
            Name of the target, for messages.
        integrator, rtol, atol
            As for a `Request`.

        Raises
        ------
        InputError
            If one is given that the target does not take, or of the wrong kind.
        """
        given = {"integrator": integrator, "rtol": rtol, "atol": atol}
        first = next((name for name, value in given.items() if value is not None), None)
        if first is not None and not self.runs:
            raise InputError(first, "target 'c' or 'fmu', which print a whole run", f"target '{target}'")
        if integrator is None:
            if first is not None:
                raise InputError(first, "an integrator with it, such as 'dop853'", "none")
            return None, None, None
        name = arguments.text("integrator", integrator, "the name of an integrator")
        relative = None if rtol is None else arguments.number("rtol", rtol, positive=True)
        return name, relative, None if atol is None else arguments.number("atol", atol, positive=True)
