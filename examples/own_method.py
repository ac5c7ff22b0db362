"""A method of your own: feedback of the velocity violation, compared with one that knows nothing of it."""

import symgen
from symgen.extension import METHODS, MethodParameter, MultiplierMethod


class VelocityFeedback(MultiplierMethod):
    """``D v' = gamma - k (D v - nu)``: velocity violations decay with the rate k."""

    name = "velocity-feedback"
    summary = "velocity violations decay with the rate k"
    reference = "an example"
    parameters = (MethodParameter("k", 10.0, "1/s", "rate; chosen for a mechanism that moves in seconds"),)

    def target(self, system):
        """Return what D v' shall be."""
        return system.gamma - system.parameter("k") * (system.D @ system.v - system.nu)


METHODS.register("velocity-feedback", VelocityFeedback())

if __name__ == "__main__":
    model = symgen.load("pendulum")
    for method in ("lagrange", "velocity-feedback"):
        result = model.simulate(method=method, integrator="rk4", step=5e-3, until=5.0)
        print(f"{method}: velocities violate their constraints by {result.velocity_violation_max:.1e} m/s")
