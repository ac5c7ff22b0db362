"""The version of the package; this module imports nothing, so that every module may import it."""

__version__ = "0.9.0"
