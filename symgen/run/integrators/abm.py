"""Adams-Bashforth-Moulton with varying steps, of order up to 8."""

from __future__ import annotations

from symgen.run.integrators._adams import Adams

KIND = Adams(
    name="abm",
    order=8,
    reference="Shampine, Gordon, Computer Solution of Ordinary Differential Equations, Freeman, 1975",
    adaptive=True,
    real_boundary=0.5,
)
