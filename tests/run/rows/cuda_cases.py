"""Sweeps that a device runs as a processor does. Run as a script under Numba's simulator, it writes both results.

NUMBA_ENABLE_CUDASIM=1 python cuda_cases.py OUT CASE ...
"""

import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]

EVERYTHING = (
    "q",
    "v",
    "crank.ax",
    "coupler.alpha",
    "joint_coordinates",
    "lam",
    "energy",
    "violations",
    "smallest_pivot",
)
SHORT = {"until": 0.01, "step": 2e-3}
MASSES = {"crank_mass": [2.0, 3.0, -1.0]}


def motor():
    """Return a wheel whose motor has a current of its own."""
    from symgen import MechanismBuilder

    return (
        MechanismBuilder("motor")
        .parameter("R", 1.2)
        .body("wheel", mass=1.0, inertia=0.04)
        .joint("pin", "revolute", between=["ground", "wheel"], at=[[0.0, 0.0], [0.0, 0.0]])
        .force("drive", "torque", body="wheel", torque="0.7*i")
        .state("i", "(3 - R*i - 0.7*pin.rate)/0.02", 0.1)
        .build()
    )


#: Name -> (model or what makes one, what varies, settings).
CASES = {
    "planar": ("four-bar", MASSES, {**SHORT, "quantities": EVERYTHING, "times": (0.0, 0.0011, 0.01)}),
    # three steps of 0.1 s add up to something else than 0.3 s
    "grid": ("pendulum", {"bob_mass": [1.0, 2.0]}, {"until": 0.3, "step": 0.1, "max_energy_error": 1.0}),
    "spatial": ("spatial-slider-crank", {"crank.wx": [5.0, 6.0]}, SHORT),
    "lagrange": (
        "four-bar",
        {"crank.omega": [3.0, 4.0]},
        {"until": 1e-3, "step": 1e-5, "method": "lagrange", "integrator": "euler"},
    ),
    "baumgarte": (
        "four-bar",
        {"crank.omega": [0.0, 8.0]},
        {"method": "baumgarte", "integrator": "dopri5", "until": 0.2, "output_step": 0.06},
    ),
    "partition": ("four-bar", MASSES, {**SHORT, "method": "coordinate-partitioning", "integrator": "heun"}),
    "tangent": ("four-bar", MASSES, {**SHORT, "method": "null-space", "quantities": ("q", "lam")}),
    "dense": ("four-bar", MASSES, {**SHORT, "method": "lagrange", "options": {"method.solver": "dense"}}),
    "iterated": ("four-bar", MASSES, {**SHORT, "method": "index1-augmented-lagrangian", "quantities": ("v", "lam")}),
    "momenta": ("four-bar", MASSES, {**SHORT, "method": "augmented-hamiltonian", "quantities": ("crank.ax",)}),
    "redundant": ("bricard", {"rod1.wx": [0.0]}, {"until": 0.02, "step": 0.01, "quantities": ("q", "lam")}),
    "rolling": ("rolling-disc", {"disc.wz": [1.0, 2.0]}, {**SHORT, "method": "baumgarte"}),
    "light": ("four-bar", {"coupler_mass": [1e-14, 8.0]}, {**SHORT, "method": "coordinate-partitioning"}),
    "passage": ("n-four-bar:1", {"coupler0.omega": [0.0]}, {"until": 1.3, "step": 0.01, "quantities": ("energy",)}),
    "violated": ("slider-crank", {"crank.omega": [0.0, 20.0]}, {"until": 0.6, "step": 0.01, "method": "lagrange"}),
    "explicit-fine": (
        "heavy-top",
        {"top.wz": [20.0, 30.0]},
        {"method": "lagrange", "integrator": "dop853", "rtol": 1e-9, "until": 0.2, "times": (0.05, 0.11, 0.2)},
    ),
    "states": (motor, {"R": [1.2, 2.0], "i": [0.1, 0.4]}, {**SHORT, "quantities": ("i", "wheel.omega")}),
    "table": (ROOT / "examples" / "gear-pair.toml", {"pinion.omega": [5.0, 30.0]}, SHORT),
}


def dirty_memory() -> None:
    """Let local and device memory of the simulator begin with nonsense, as that of a device may."""
    from numba import cuda
    from numba.cuda.simulator import kernelapi

    def nonsense(shape, dtype):
        dtype = np.dtype(dtype if isinstance(dtype, type) else str(dtype))
        return np.full(shape, -7.7e77 if dtype.kind == "f" else 987654321, dtype=dtype)

    kernelapi.FakeCUDALocal.array = lambda self, shape, dtype: nonsense(shape, dtype)
    cuda.device_array = lambda shape, dtype: cuda.to_device(nonsense(shape, dtype))


def as_a_device_asks() -> None:
    """Refuse what the simulator lets pass and no device takes: other types than announced, an array as result."""
    import numba
    from numba import cuda

    from symgen.run.rows import device

    def kind(value, expected):
        if isinstance(value, tuple):
            assert len(value) == len(expected.types) and type(value) is expected.instance_class, expected
            return expected if all(kind(v, e) == e for v, e in zip(value, expected.types, strict=True)) else value
        found = numba.typeof(value.copy_to_host() if hasattr(value, "copy_to_host") else value)
        # whole numbers and arrays that are only read are converted
        return expected if found == expected or (found.cast_python_value and found == numba.int64) else found

    class Checked:
        def __init__(self, kernel, signature):
            self.kernel, self.signature = kernel, signature

        def __getitem__(self, configuration):
            def launch(*arguments):
                for value, expected in zip(arguments, self.signature.args, strict=True):
                    assert kind(value, expected) == expected, (kind(value, expected), expected)
                self.kernel[configuration](*arguments)

            return launch

    plain_jit, compiled = cuda.jit, device._compile_kernel

    def jit(*words, **options):
        if words and isinstance(words[0], numba.core.typing.Signature):
            return lambda function: Checked(plain_jit(*words, **options)(function), words[0])
        return plain_jit(*words, **options)

    class Strict:
        def __init__(self, function, name):
            self.function, self.name = function, name

        def __call__(self, *arguments):
            result = self.function(*arguments)
            assert getattr(result, "shape", ()) == (), f"{self.name} returns an array and is not marked as viewing"
            return result

    def strict(copy, original):
        made = compiled(copy, original)
        return made if hasattr(original, "viewing") else Strict(made, copy.__name__)

    cuda.jit, device._compile_kernel = jit, strict


def launched(sweep) -> bool:
    """Whether a kernel for a device was made for a sweep."""
    from symgen.study.ensemble.kernel import kernel_of_recipe

    return "_kernel" in vars(kernel_of_recipe(sweep.ensemble.recipe).first_model.runs)


def main(out: str, *names: str) -> None:
    """Run the cases for both targets and write ``OUT/CASE.npz``."""
    import symgen
    from symgen.study.ensemble.device_runs import DeviceRuns

    dirty_memory()
    as_a_device_asks()
    DeviceRuns._runs_at_once = lambda self: 2  # little memory: three runs take two launches
    for name in names:
        model, vary, settings = CASES[name]
        model = model() if callable(model) else model
        found = {}
        for target in ("cpu", "cuda"):
            sweep = symgen.sweep(model, vary, target=target, jobs=2, **{"integrator": "rk4", **settings})
            found[f"{target}_values"], found[f"{target}_summary"] = sweep.values, sweep.summary
            found[f"{target}_status"] = sweep.status
            found[f"{target}_reason"] = np.array([str(reason) for reason in sweep.reason])
            assert sweep.attributes["target"] == target and (target == "cuda") == launched(sweep)
        np.savez(Path(out) / f"{name}.npz", **found)


if __name__ == "__main__":
    main(*sys.argv[1:])
