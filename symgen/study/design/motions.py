"""Motions of a machine for values of the numbers that vary, with derivatives: driven ones are kept, others are runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.analyses.prescribed.kept_motion import KeptMotion
from symgen.analyses.prescribed.prescribed import NotPrescribed, driver_names
from symgen.analyses.search.free_numbers import FreeNumbers
from symgen.analyses.search.sampled_motions import Motions, NoMotion
from symgen.base.errors import AssemblyError, InputError
from symgen.base.vocabulary.expressions import readings_in
from symgen.base.vocabulary.measures import Integral
from symgen.describe.facts.motion_quantities import MotionQuantity
from symgen.describe.mechanism import Mechanism, Output

if TYPE_CHECKING:
    from symgen.base.settings import Settings

Array = NDArray[np.float64]


def motions_of(
    mechanism: Mechanism, settings: Settings, keys: Sequence[str], until: float, quantities: Sequence[MotionQuantity]
) -> Motions:
    """Return the motions of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
        The description; numbers that vary are parameters of it.
    settings : Settings
        Of its runs.
    keys : sequence of str
        Parameters that vary.
    until : float
        Last time [s].
    quantities : sequence of MotionQuantity
        What is known of a motion.

    Raises
    ------
    InputError
        If the settings, or the motion, allow no derivatives.
    """
    integrals = any(isinstance(r.source, Integral) for q in quantities for r in readings_in(q.formula))
    if driver_names(mechanism) and not integrals and not mechanism.bounded:
        try:
            return DrivenMotions(mechanism, settings, keys, until, quantities)
        except NotPrescribed:
            pass
    return IntegratedMotions(mechanism, settings, keys, quantities)


class DrivenMotions:
    """Motions that drivers prescribe: nothing is integrated, and all preparation is kept."""

    def __init__(
        self,
        mechanism: Mechanism,
        settings: Settings,
        keys: Sequence[str],
        until: float,
        quantities: Sequence[MotionQuantity],
    ) -> None:
        self._kept = KeptMotion("design", mechanism, settings, keys, until)
        formulas = [(q.text, q.formula) for q in quantities]
        self._side, self._quantities = self._kept.side("quantities", formulas), quantities

    def at(self, x: Array, times: Array) -> tuple[Array, Array]:
        """Return quantities and derivatives; see `Motions`."""
        try:
            point = self._kept.at(x, times)
        except (InputError, AssemblyError) as error:
            raise NoMotion(str(error)) from None
        if point.traced.ended:
            raise NoMotion(point.traced.ended)
        return _finite(*point.directions.observe(self._side.function, len(self._quantities)), times, self._quantities)

    def screen(self, xs: Array, times: Array) -> list[Array | str]:
        """Return the quantities for rows of values; see `Motions`."""
        found = list[Array | str]()
        for x in xs:
            try:
                found.append(self.at(x, times)[0])
            except NoMotion as error:
                found.append(str(error))
        return found


class IntegratedMotions:
    """Motions of runs, whose derivatives are carried beside the state."""

    def __init__(
        self, mechanism: Mechanism, settings: Settings, keys: Sequence[str], quantities: Sequence[MotionQuantity]
    ) -> None:
        taken = {output.name for output in mechanism.outputs}
        self._names = [_free_name(f"design_{i}", taken) for i in range(len(quantities))]
        outputs = (Output(name, q.formula) for name, q in zip(self._names, quantities, strict=True))
        self._mechanism = msgspec.structs.replace(mechanism, outputs=(*mechanism.outputs, *outputs))
        self._keys, self._quantities = tuple(keys), quantities
        self._free = FreeNumbers("design", self._mechanism, settings, {key: key for key in keys})

    def at(self, x: Array, times: Array) -> tuple[Array, Array]:
        """Return quantities and derivatives; see `Motions`."""
        return _finite(*self._free.motion(x, times, self._names), times, self._quantities)

    def screen(self, xs: Array, times: Array) -> list[Array | str]:
        """Return the quantities for rows of values by one sweep; see `Motions`."""
        from symgen.study.ensemble.parameter_sweep import sweep

        rows = dict(zip(self._keys, xs.T, strict=True))
        whole = replace(self._free.settings, times=times.tolist(), until=float(times[-1]), verify=None)
        found = sweep(self._mechanism, runs=rows, quantities=self._names, settings=whole, jobs=1)
        if found.interrupted:
            raise KeyboardInterrupt
        values = np.stack([found[name] for name in self._names], axis=-1)
        failed = found.status == "failed"
        return [
            str(found.reason[i]) if failed[i] or not np.isfinite(values[i]).all() else values[i] for i in range(len(xs))
        ]


def _free_name(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    return name


def _finite(values: Array, slopes: Array, times: Array, quantities: Sequence[MotionQuantity]) -> tuple[Array, Array]:
    """Return values and slopes, all of them finite.

    Raises
    ------
    NoMotion
        If one is not.
    """
    good = np.isfinite(values) & np.isfinite(slopes).all(axis=2)
    if not good.all():
        k, i = np.argwhere(~good)[0]
        raise NoMotion(f"{quantities[i].text} is not defined at t = {times[k]:.6g} s")
    return values, slopes
