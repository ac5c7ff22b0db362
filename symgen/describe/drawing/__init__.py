"""Pictures of mechanisms: a frozen scene of bodies, joints and forces, as SVG or pixels.

In: a mechanism and positions of its bodies.
Out: a scene, and its view as SVG or PNG.
Imports: NumPy; matplotlib for pixels; `describe` and rooms below.
"""

from symgen.describe.drawing.drawing import Drawing, sketch
from symgen.describe.drawing.mechanism_scene import build_scene
from symgen.describe.drawing.paper import View
from symgen.describe.drawing.scene import Scene

__all__ = ["Drawing", "Scene", "View", "build_scene", "sketch"]
