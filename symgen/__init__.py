"""symgen: a symbolic code-generating formulation compiler for constrained multibody systems."""

__version__ = "0.1.0"
