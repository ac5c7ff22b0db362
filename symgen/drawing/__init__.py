"""Pictures of mechanisms: a frozen scene of bodies, joints and forces, seen from somewhere, written as SVG or PNG."""

from symgen.drawing.drawing import Drawing, sketch
from symgen.drawing.mechanism_scene import build_scene
from symgen.drawing.paper import View
from symgen.drawing.scene import Scene

__all__ = ["Drawing", "Scene", "View", "build_scene", "sketch"]
