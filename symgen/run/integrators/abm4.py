"""Adams-Bashforth-Moulton of order 4 with constant steps, started by the classical Runge-Kutta scheme."""

from __future__ import annotations

from symgen.run.integrators._adams import Adams

KIND = Adams(
    name="abm4",
    order=4,
    reference="Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, Springer 1993, section III.1",
    adaptive=False,
    real_boundary=1.28,
)
