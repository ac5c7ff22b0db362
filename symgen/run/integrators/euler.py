"""The explicit Euler scheme, for teaching."""

from __future__ import annotations

import numpy as np

from symgen.run.integrators._tableau import Tableau

KIND = Tableau(
    name="euler",
    order=1,
    reference="Euler, Institutionum calculi integralis, vol. I, 1768",
    a=np.zeros((1, 1)),
    b=np.array([1.0]),
    c=np.zeros(1),
    real_boundary=2.0,
)
