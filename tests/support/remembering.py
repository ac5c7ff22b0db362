"""Pairs of methods and integrators that remember something of their past, and some that do not."""

#: A method for each integrator, and methods that remember something beside the state.
PAIRS = [
    *(
        ("direct-correction", name)
        for name in ("euler", "heun", "rk4", "rkmk4", "rkmk4-screws", "abm4", "abm", "dopri5", "dop853", "picard")
    ),
    *(("direct-correction", name) for name in ("sdirk", "rodas", "radau5", "bdf", "trapezoidal", "newmark")),
    *(
        ("ggl", "radau5"),
        ("ggl", "bdf"),
        ("generalized-alpha", "generalized-alpha"),
        ("generalized-alpha", "hht"),
        ("index3-augmented-lagrangian", "trapezoidal"),
    ),
    *((m, i) for m in ("coordinate-partitioning", "null-space") for i in ("rk4", "abm4", "abm", "dop853", "picard")),
    *(("half-explicit", "half-explicit"), ("half-explicit", "phem56"), ("rattle", "rattle")),
    *(("discrete-gradient", "discrete-gradient"), ("symmetric-projection", "gauss")),
    ("implicit-constraint", "symplectic-euler"),
    *(("augmented-hamiltonian", "dopri5"), ("augmented-lagrangian", "rk4")),
]
CONSTANT = {"options": {"integrator.adaptive": "false"}}
