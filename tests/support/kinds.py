"""What tests of the common machinery try: methods whose law is a formula, and the integrators they are run with.

Methods and integrators beyond these are the concern of tests of their own.
"""

METHODS = ("lagrange", "baumgarte", "direct-correction")
INTEGRATORS = ("rk4", "dopri5", "dop853")
#: Those of the methods that correct positions and velocities after each accepted step.
CORRECTING = ("direct-correction",)
ADAPTIVE = ("dopri5", "dop853")
