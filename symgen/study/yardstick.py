"""The method beside which studies set the others."""

#: Ratios of run time and of errors are to this method, with the same integrator and the same step or tolerance.
YARDSTICK = "lagrange"
