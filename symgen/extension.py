"""Imports for plugins: registries, and the parts of methods, integrators, joints and forces.

Worked examples are the guides "own method", "own joint" and "own integrator"; the classes are described in
``docs/extending.md``.
"""

from symgen.analyses.kinds import ANALYSES, Analysis, AnalysisOutput, AnalysisTable, Option
from symgen.base.ir.program import Correction
from symgen.base.plugins import load_plugin
from symgen.base.registry import Registry
from symgen.base.vocabulary.expressions import ONE, ZERO, call
from symgen.base.vocabulary.expressions import literal_of as number
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    Bearing,
    BladeSpeed,
    Component,
    Direction,
    Distance,
    Dot,
    Effort,
    Holonomic,
    LinkStretch,
    Marker,
    Nonholonomic,
    PointSpeed,
    RimHeight,
    RollingSpeed,
    Spin,
    Sum,
    Turn,
    axes,
)
from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.padding import padded
from symgen.compile.loopcode.vectors import copied
from symgen.compile.native import types
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import (
    Acceleration,
    Descriptor,
    Iteration,
    Method,
    MethodOption,
    MethodParameter,
    MultiplierMethod,
    augmented_iteration,
    multiplier_law,
)
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Matrix as FormulaMatrix
from symgen.derive.methods._tape import Scalar as FormulaScalar
from symgen.derive.methods._tape import Vector as FormulaVector
from symgen.describe.forces import FORCES
from symgen.describe.joints import JOINTS
from symgen.describe.mechanism import Force, Joint
from symgen.describe.parts.fields import (
    Axis,
    AxisPair,
    BodyName,
    BodyPair,
    Point,
    PointPair,
    Scalar,
    StateFunction,
    Text,
    TimeFunction,
    Vector,
)
from symgen.describe.parts.scope import Scope
from symgen.describe.spanning_tree import Articulation
from symgen.run.integrators import INTEGRATORS
from symgen.run.integrators._tableau import Tableau
from symgen.run.layout import abi
from symgen.run.layout.records import Sizes, Span, State
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import evaluate
from symgen.run.loops.integrator import Integrator, IntegratorParameter, Setup, law_functions

__all__ = [
    "ANALYSES",
    "FORCES",
    "GROUND",
    "INTEGRATORS",
    "JOINTS",
    "METHODS",
    "ONE",
    "ZERO",
    "Acceleration",
    "Analysis",
    "AnalysisOutput",
    "AnalysisTable",
    "Angle",
    "Articulation",
    "Axis",
    "AxisPair",
    "Bearing",
    "BladeSpeed",
    "BodyName",
    "BodyPair",
    "Component",
    "Correction",
    "Descriptor",
    "Direction",
    "Distance",
    "Dot",
    "Effort",
    "Force",
    "FormulaMatrix",
    "FormulaScalar",
    "FormulaVector",
    "Holonomic",
    "Integrator",
    "IntegratorParameter",
    "Iteration",
    "Joint",
    "LinkStretch",
    "Marker",
    "Method",
    "MethodOption",
    "MethodParameter",
    "MultiplierMethod",
    "Nonholonomic",
    "Option",
    "Point",
    "PointPair",
    "PointSpeed",
    "Registry",
    "RimHeight",
    "RollingSpeed",
    "Scalar",
    "Scope",
    "Setup",
    "Sizes",
    "Span",
    "Spin",
    "State",
    "StateFunction",
    "Sum",
    "System",
    "Tableau",
    "Text",
    "TimeFunction",
    "Turn",
    "Vector",
    "abi",
    "augmented_iteration",
    "axes",
    "call",
    "copied",
    "evaluate",
    "law_functions",
    "load_plugin",
    "loop",
    "multiplier_law",
    "number",
    "padded",
    "part",
    "types",
]
