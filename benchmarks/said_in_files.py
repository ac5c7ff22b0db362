"""Files of other systems' examples in `benchmarks/examples`, and what is asked of them."""

from __future__ import annotations

from pathlib import Path

#: Examples that ask for an equilibrium, and those that run in coordinates of joints.
AT_REST = frozenset(
    {
        "exudyn/ANCFtestHalfcircle",
        "exudyn/solverFunctionsTestEigenvalues",
        "exudyn-tests/ANCFBeam3Dtest",
        "exudyn-tests/ANCFcontactCircleTest",
        "exudyn-tests/LShapeGeomExactBeam2D",
        "exudyn-tests/geometricallyExactBeam2Dtest",
        "exudyn-tests/geometricallyExactBeamTest",
        "exudyn-tests/rightAngleFrame",
        "exudyn-tests/sparseMatrixSpringDamperTest",
    }
)
IN_JOINTS = frozenset(
    {
        "exudyn/kinematicTreePendulum",
        "exudyn/serialRobotKinematicTree",
        "exudyn/stiffFlyballGovernorKT",
        "exudyn-tests/MiniExamples/ObjectKinematicTree",
        "exudyn-tests/createKinematicTreeTest",
        "exudyn-tests/kinematicTreeTest",
        *(
            f"exudyn/FurtherExamples/fourBarKinematicTree{x}"
            for x in ("Gravity", "JointControl", "LoadDep", "Robot", "UF")
        ),
    }
)
#: Examples of flexible bodies whose sources load them beyond what linear modes hold: their runs say so.
DOUBTED = frozenset(
    {
        "exudyn/CMSexampleCourse",
        "exudyn/NGsolveCMStutorial",
        "exudyn/NGsolveCraigBampton",
        "exudyn/NGsolveFFRF",
        "exudyn/NGsolveModalAnalysis",
        "exudyn/NGsolvePistonEngine",
        "exudyn/NGsolvePostProcessingStresses",
        "exudyn/objectFFRFreducedOrderNetgen",
        "exudyn-tests/NGsolveCMStest",
        "exudyn-tests/objectFFRFreducedOrderAccelerations",
        "exudyn-tests/objectFFRFreducedOrderTest",
        "exudyn-tests/objectGenericODE2Test",
        "exudyn-tests/perfObjectFFRFreducedOrder",
    }
)
_FOLDER = Path(__file__).parent / "examples"
#: Set and name of an example -> the path of its file.
FILES = {file.relative_to(_FOLDER).with_suffix("").as_posix(): str(file) for file in _FOLDER.rglob("*.toml")}
#: An example whose mechanism has the numbers of another one: a second script, solver or search on it.
SAME = {
    "exudyn/FurtherExamples/spotReinforcementLearning": "exudyn/FurtherExamples/spotModel",
    "exudyn/dispyParameterVariationExample": "exudyn/parameterVariationExample",
    "exudyn/geneticOptimizationExample": "exudyn/parameterVariationExample",
    "exudyn/minimizeExample": "exudyn/parameterVariationExample",
    "exudyn/springDamperTutorialNew": "exudyn/parameterVariationExample",
    "exudyn-tests/geneticOptimizationTest": "exudyn/parameterVariationExample",
    "exudyn-tests/perfSpringDamperExplicit": "exudyn/parameterVariationExample",
    "exudyn/testGymCartpoleEnv": "exudyn/testGymCartpole",
    "exudyn/testGymCartpoleEnvSlow": "exudyn/testGymCartpole",
    "exudyn/testGymDoublePendulumEnv": "exudyn/testGymDoublePendulum",
    "exudyn/openAIgymInterfaceTest": "exudyn/testGymDoublePendulum",
    "modelica/MultiBody/Loops/Engine1b_analytic": "modelica/MultiBody/Loops/Engine1b",
    "modelica/MultiBody/Loops/EngineV6_analytic": "modelica/MultiBody/Loops/EngineV6",
    "modelica/MultiBody/Loops/Fourbar_analytic": "modelica/MultiBody/Loops/Fourbar2",
}
