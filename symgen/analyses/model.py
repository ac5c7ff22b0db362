"""What a model is asked for beside its motion: the methods of `symgen.api.Model` that are analyses."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen import arguments
from symgen.errors import InputError
from symgen.settings import Settings, changed

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from symgen.analyses.equilibrium import Equilibrium
    from symgen.analyses.inverse import Inverse
    from symgen.analyses.kinematics import Kinematics
    from symgen.analyses.linearise import LinearSystem
    from symgen.analyses.locus import Locus
    from symgen.analyses.modes import Modes
    from symgen.describe.mechanism import Mechanism
    from symgen.player.page import Page
    from symgen.result.result import Result

    Array = NDArray[np.float64]

#: Settings that count for analyses about a state, and for motions that drivers prescribe.
OF_STATES = ("parameters", "inputs", "start", "coordinates", "shape")
OF_MOTIONS = ("parameters", "inputs", "start", "strict", "shape")
#: Those of them that count where drivers say the motion, not where it was recorded.
OF_DRIVEN = ("start", "strict")
#: And beside those of states for a run that leads to one.
OF_RUNS = (*OF_STATES, "options", "events", "strict", "max_violation", "max_energy_error", "max_steps")


def _settings(where: str, settings: Settings | None, changes: Mapping[str, object], known: Sequence[str]) -> Settings:
    """Return settings with single ones replaced.

    Raises
    ------
    InputError
        If a single one would count for nothing; of settings that are given all at once, those are of no account.
    """
    found = changed(settings, changes)
    for name in changes:
        if name not in known:
            raise InputError(f"{where}: {name}", f"one of {', '.join(known)}", "a setting of runs")
    return found


def _at_place(where: str, settings: Settings | None, changes: Mapping[str, object], at: str | float) -> Settings:
    """Return settings of an analysis about a place; those of a run count where one leads there."""
    return _settings(where, settings, changes, OF_STATES if isinstance(at, str) else OF_RUNS)


class Analysed:
    """A model that can be analysed; who inherits it has a mechanism and runs it."""

    if TYPE_CHECKING:

        @property
        def mechanism(self) -> Mechanism:
            """The validated description."""

        def simulate(self, settings: Settings | None = None) -> Result:
            """Run it."""

    def equilibrium(self, settings: Settings | None = None, **changes: object) -> Equilibrium:
        """Return the equilibrium that the start leads to: the one it is near to, or a stable one further away.

        Parameters
        ----------
        settings : Settings, optional
            All settings at once; ``parameters``, ``inputs``, ``start``, ``coordinates`` and ``shape`` are looked at:
            looped code, and any mechanism with more than 300 coordinates, is searched with sparse matrices.
        **changes
            Single settings among these; others are refused. Drivers hold what they drive where it is at the time 0.

        Raises
        ------
        AnalysisError
            If none is found.
        """
        from symgen.analyses.asked import asked_equilibrium

        return asked_equilibrium(self.mechanism, _settings("equilibrium", settings, changes, OF_STATES))

    def equilibria(
        self, scan: tuple[str, Sequence[float] | Array], settings: Settings | None = None, **changes: object
    ) -> tuple[Equilibrium, ...]:
        """Return all equilibria that are found over a range of a coordinate.

        Parameters
        ----------
        scan : (str, sequence of float)
            The coordinate and its values, such as ``("crank.theta", numpy.linspace(0, 6.28, 25))``.
        settings, **changes
            As for `equilibrium`.

        Raises
        ------
        AnalysisError
            If none is found.
        """
        from symgen.analyses.asked import scanned

        return scanned(self.mechanism, _settings("equilibria", settings, changes, OF_STATES), scan)

    def steady(self, settings: Settings | None = None, *, cyclic: Sequence[str] = (), **changes: object) -> Equilibrium:
        """Return the steady motion that the start leads to: cyclic coordinates turn on, everything else stays.

        Parameters
        ----------
        settings, **changes
            As for `equilibrium`; coordinates are those of joints. Cyclic coordinates keep their speeds of the start,
            and drivers move.
        cyclic : sequence of str
            Coordinates of joints that turn on; those that nothing depends on by default.

        Raises
        ------
        AnalysisError
            If none is found.
        """
        from symgen.analyses.asked import asked_steady

        return asked_steady(self.mechanism, _settings("steady", settings, changes, OF_STATES), cyclic)

    def modes(
        self,
        settings: Settings | None = None,
        *,
        at: str | float = "equilibrium",
        states: Sequence[str] = (),
        cyclic: Sequence[str] = (),
        count: int | None = None,
        **changes: object,
    ) -> Modes:
        """Return eigenvalues, frequencies, damping and shapes about a state of rest or of steady motion.

        Parameters
        ----------
        settings : Settings, optional
            As for `equilibrium`.
        at : {"equilibrium", "start", "steady"} or float
            About what: the equilibrium that the start leads to, the start itself, the steady motion that the start
            leads to, or the state at a time of a run [s].
        states, cyclic
            As for `linearise`.
        count : int, optional
            Only that many of the lowest modes, without dampers, about the equilibrium near the start: by sparse
            matrices from looped code, for mechanisms of any size.
        **changes
            Single settings among these; with a time also those that a run to it has: ``options``, ``events``,
            ``strict``, ``max_violation``, ``max_energy_error``, ``max_steps``.

        Raises
        ------
        InputError
            If the motion is neither at rest nor steady.
        AnalysisError
            If no equilibrium is found.
        """
        from symgen.analyses.asked import Asked, asked_modes

        asked = Asked(self.mechanism, _at_place("modes", settings, changes, at), at, self.simulate, cyclic)
        return asked_modes(asked, states, count)

    def view_mode(
        self,
        number: int,
        settings: Settings | None = None,
        *,
        at: str | float = "equilibrium",
        **changes: object,
    ) -> Page:
        """Return a page that plays a mode shape, with the state that it is about drawn faintly behind.

        Parameters
        ----------
        number : int
            Which shape of `modes`, from 1 on.
        settings : Settings, optional
            As for `modes`.
        at : {"equilibrium", "start"} or float
            As for `modes`; in a steady motion shapes are not those of bodies.
        **changes
            Single settings among these; with a time also those that a run to it has: ``options``, ``events``,
            ``strict``, ``max_violation``, ``max_energy_error``, ``max_steps``.

        Raises
        ------
        InputError
            If there is no such mode.
        AnalysisError
            If no equilibrium is found.
        """
        from symgen.analyses.shown import mode_page

        asked = _at_place("view_mode", settings, changes, at)
        number = arguments.whole("number", number, 1, 10**6)
        return mode_page(self.mechanism, self.modes(asked, at=at), number, asked.parameters)

    def linearise(
        self,
        settings: Settings | None = None,
        *,
        at: str | float = "equilibrium",
        states: Sequence[str] = (),
        cyclic: Sequence[str] = (),
        instantaneous: bool = False,
        by: Sequence[str] = (),
        **changes: object,
    ) -> LinearSystem:
        """Return the linear system x' = A x + B u, y = C x + D u about a state of rest or of steady motion.

        Parameters
        ----------
        settings, at, **changes
            As for `modes`.
        states : sequence of str
            Which quantities are the states: coordinates of bodies and joints, velocities, outputs of the file, and
            ``NAME.rate`` of any of these; rates of coordinates are added. Found by default.
        cyclic : sequence of str
            With ``at="steady"``, the coordinates of joints that turn on; found by default.
        instantaneous : bool
            Whether a motion that is not steady has the system of the instant.
        by : sequence of str
            Parameters that are inputs as well: constants, changed once and for all while the states stay.

        Raises
        ------
        InputError
            If the motion is not steady, or a name means nothing.
        AnalysisError
            If no equilibrium is found.
        """
        from symgen.analyses.asked import Asked, asked_system

        asked = Asked(self.mechanism, _at_place("linearise", settings, changes, at), at, self.simulate, cyclic)
        return asked_system(asked, states, instantaneous, by)

    def locus(
        self,
        over: tuple[str, Sequence[float] | Array],
        settings: Settings | None = None,
        *,
        at: str | float = "equilibrium",
        states: Sequence[str] = (),
        cyclic: Sequence[str] = (),
        **changes: object,
    ) -> Locus:
        """Return how the eigenvalues move with a parameter.

        Parameters
        ----------
        over : (str, sequence of float)
            The parameter and its values.
        settings, at, states, cyclic, **changes
            As for `modes`.
        """
        from symgen.analyses.asked import Asked
        from symgen.analyses.locus import locus

        asked = Asked(self.mechanism, _at_place("locus", settings, changes, at), at, self.simulate, cyclic)
        return locus(asked, over, states)

    def kinematics(
        self,
        times: ArrayLike | None = None,
        settings: Settings | None = None,
        transmission: Sequence[str] = (),
        **changes: object,
    ) -> Kinematics:
        """Return the motion of a mechanism whose freedom is all driven, without integrating; see `docs/kinematics.md`.

        Parameters
        ----------
        times : array, optional
            Increasing, of any sign [s]; those of the outputs of a run of the file by default.
        settings : Settings, optional
            All settings at once.
        transmission : sequence of str
            Pins whose transmission angles are wanted, such as ``"C"`` or ``"C(B, D)"``.
        **changes
            Single settings that mean something here: ``parameters``, ``inputs``, ``start``, ``strict``, ``shape``. Of
            several ways to close the mechanism that nearest to a start such as ``{"rocker.theta": -1.5}`` is taken.

        Raises
        ------
        InputError
            If freedom is left that no driver drives, or is driven twice; if an argument is wrong.
        AssemblyError
            If the mechanism cannot be closed.
        """
        from symgen.analyses.kinematics import kinematics

        return kinematics(self.mechanism, _settings("kinematics", settings, changes, OF_MOTIONS), times, transmission)

    def inverse(
        self,
        motion: Result | Kinematics | str | Path | None = None,
        settings: Settings | None = None,
        times: ArrayLike | None = None,
        actuators: Sequence[str] = (),
        weights: Mapping[str, float] | None = None,
        **changes: object,
    ) -> Inverse:
        """Return the efforts that a motion needs; see `docs/inverse.md`.

        Parameters
        ----------
        motion : Result, Kinematics or path, optional
            A recorded motion, or the file that one was saved to; what the drivers prescribe by default.
        settings : Settings, optional
            All settings at once.
        times : array, optional
            Of a motion that drivers prescribe [s].
        actuators : sequence of str
            What exerts the motion: drivers, joints, forces and inputs; all drivers by default.
        weights : mapping of str to float, optional
            Of efforts that are not unique: the sum of (weight effort)^2 is smallest. 1 / N, or 1 / (N m) times the
            length of the mechanism, by default.
        **changes
            Single settings that mean something here: ``parameters``, ``inputs``, ``strict``, ``shape``.

        Raises
        ------
        InputError
            If an argument is wrong; without a motion, if freedom is left that no driver drives.
        AssemblyError
            If the mechanism cannot be closed.
        """
        from symgen.analyses.inverse import inverse

        known = OF_MOTIONS if motion is None else [name for name in OF_MOTIONS if name not in OF_DRIVEN]
        return inverse(
            self.mechanism, _settings("inverse", settings, changes, known), motion, times, actuators, weights
        )
