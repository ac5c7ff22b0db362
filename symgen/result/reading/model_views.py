"""Views of a model: its equations, a picture, a page of its motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Unpack

import numpy as np

from symgen.base import arguments
from symgen.base.errors import AssemblyError, InputError
from symgen.base.keywords import RunKeywords, make_entry
from symgen.base.settings import Settings, change_settings, default_of_setting
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from symgen.run.single.run import Array

if TYPE_CHECKING:
    from symgen.describe.drawing import Drawing, View
    from symgen.describe.mechanism import Mechanism
    from symgen.result.player.motion_page import Page
    from symgen.result.reading.inspection import Inspection
    from symgen.result.reading.symbolic_equations import SymbolicEquations
    from symgen.result.result import Result


class Shown:
    """A model that can be looked at; the class that inherits it has a mechanism and runs it."""

    if TYPE_CHECKING:

        @property
        def mechanism(self) -> Mechanism:
            """The validated description."""

        def parameters(self, changed: Mapping[str, float] | None = None) -> dict[str, float]:
            """Return all parameter values."""

        def initial_state(self, parameters: Mapping[str, float]) -> tuple[Array, list[float | None]]:
            """Return q and v as described."""

        def simulate(self, settings: Settings | None = None) -> Result:
            """Run it."""

    @cached_property
    def equations(self) -> SymbolicEquations:
        """The derived equations in coordinates of bodies as SymPy matrices and symbols: those that are compiled.

        `equations_in` has them in the coordinates of joints.
        """
        return self.equations_in("absolute")

    def equations_in(self, coordinates: str) -> SymbolicEquations:
        """Return the derived equations in some coordinates as SymPy matrices and symbols.

        Parameters
        ----------
        coordinates : {"absolute", "joint"}
            Those of bodies, or of the joints of a tree.

        Raises
        ------
        InputError
            If there are no such coordinates.
        """
        from symgen.result.reading.symbolic_equations import SymbolicEquations
        from symgen.run.compiling.choices import mechanism_on_tree

        kind = arguments.one_word_of("coordinates", coordinates, ("absolute", "joint"))
        return SymbolicEquations(mechanism_on_tree(self.mechanism) if kind == "joint" else self.mechanism)

    def draw(
        self,
        parameters: Mapping[str, float] | None = None,
        start: Mapping[str, float] | None = None,
        *,
        at: str = "start",
        q: Sequence[float] | Array | None = None,
        view: View | None = None,
    ) -> Drawing:
        """Return a picture of the mechanism, shown by notebooks and written by ``.save("x.svg")``.

        If the mechanism cannot be assembled, the picture shows where that stopped, with the joints that stay open
        marked and the reason below it.

        Parameters
        ----------
        parameters : mapping, optional
            Values of parameters that differ from the described ones.
        start : mapping, optional
            Values of coordinates that the start keeps, as for `simulate`.
        at : {"start", "described"}
            The assembled start, or the described one, which may be open.
        q : array, shape (nq,), optional
            Coordinates of all bodies, in place of a start.
        view : View, optional
            From where a mechanism in space is seen.
        """
        from symgen.describe.drawing.drawing import Drawing
        from symgen.describe.drawing.paper import View

        if view is not None:
            arguments.instance("view", view, View, "a symgen.describe.drawing.View")
        values = self.parameters(parameters)
        described = self.initial_state(values)[0]
        placed = arguments.one_word_of("at", at, ("start", "described")) == "described" or q is not None
        if placed and start:
            raise InputError("start", "a picture of the start", "one of other coordinates, which are kept as they are")
        if q is None and placed:
            q = described
        if q is not None:
            q = arguments.numbers("q", list(q) if isinstance(q, np.ndarray) else q)
            return Drawing.of_mechanism(self.mechanism, q, values, view=view)
        try:
            settings = Settings(start=start or {}, parameters=parameters or {})
            closed_start = prepare(self.mechanism, settings, Purpose.STATE).start
        except AssemblyError as error:
            q = error.q or described
            scene = Drawing.of_mechanism(self.mechanism, q, values).scene
            limit = 1e-3 * scene.unit
            wide = [item.name for item, gap in zip(scene.pins, scene.gaps(q), strict=True) if gap > limit]
            return Drawing.of_mechanism(
                *(self.mechanism, q, values),
                open_joints=tuple(dict.fromkeys((*error.joints, *wide))),
                view=view,
                caption=str(error),
            )
        closed, words = closed_start.y[: len(described)], closed_start.warnings
        ghosts = [described.tolist()] if words else []
        return Drawing.of_mechanism(self.mechanism, closed, values, view=view, ghosts=ghosts, caption="; ".join(words))

    def _repr_svg_(self) -> str:
        return self.draw().svg

    def inspect(
        self,
        method: str | None = None,
        options: Mapping[str, str] | None = None,
        *,
        coordinates: str = "absolute",
        shape: str = "auto",
        parameters: Mapping[str, float] | None = None,
    ) -> Inspection:
        """Return the derived equations, sizes and counts of operations; printed, it is the text of ``symgen inspect``.

        Parameters
        ----------
        method : str, optional
            A method whose emitted functions are counted as well.
        options : mapping, optional
            Its structural options, e.g. ``{"weight": "mass"}``.
        coordinates, shape, parameters
            As for `simulate`.

        Raises
        ------
        InputError
            If an argument is wrong.
        AssemblyError
            If the mechanism cannot be closed.
        """
        from symgen.result.reading.inspection import Inspection, equation_facts

        own = {f"method.{name}": x for name, x in arguments.mapping("options", options, "texts by name").items()}
        settings = Settings(
            method or default_of_setting("method"),
            options=own,
            coordinates=coordinates,
            shape=shape,
            parameters=parameters or {},
        )
        return Inspection(self.mechanism, settings, equation_facts(self.mechanism, settings, method is not None))

    @make_entry
    def view(self, settings: Settings | None = None, *, live: bool = True, **changes: Unpack[RunKeywords]) -> Page:
        """Run the model and return a page that plays its motion, which notebooks show and ``.save("x.html")`` writes.

        Parameters
        ----------
        settings : Settings, optional
            All settings at once.
        live : bool
            Whether the page has the equations, so that its sliders change the motion.
        **changes
            Single settings by name, as listed above.

        Raises
        ------
        InputError
            If a setting is wrong, or the run has no outputs.
        """
        return self.simulate(change_settings(settings, changes)).view(live=live)
