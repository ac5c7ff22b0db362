"""Beams of tests: cantilevers in the plane by their stiffnesses."""

import symgen
from symgen.describe.files.builder import MechanismBuilder


def cantilever(elements, *, axial=1e8, bending=1.0, length=1.0, parameters=None, forces=None, joints=None, **keys):
    """Return a model of one beam `rod` from the origin along x, clamped to the ground unless `clamp` says otherwise."""
    head = {"gravity": keys.pop("gravity")} if "gravity" in keys else {}
    builder = MechanismBuilder("cantilever", **head)
    for name, value in (parameters or {}).items():
        builder.parameter(name, value)
    usual = {"start": (0.0, 0.0), "end": (length, 0.0), "mass": 1.0, "rotary": 1e-8, "clamp": "ground"}
    builder.beam("rod", elements=elements, axial=axial, bending=bending, **{**usual, **keys})
    for name, force in (forces or {}).items():
        builder.force(name, **force)
    for name, joint in (joints or {}).items():
        builder.joint(name, **joint)
    return symgen.Model(builder.build())


def at_end(*force, **keys):
    """Return a force at the end of the beam `rod`."""
    return {"type": "force", "body": "rod", "at": "end", "force": list(force), **keys}
