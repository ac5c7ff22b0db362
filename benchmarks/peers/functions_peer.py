"""Dynamics as functions of Pinocchio and MuJoCo, called from Python and evaluated alone, for `benchmarks.functions`."""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from benchmarks.closed_leg import LOOP, RELATIVE
from symgen.api import Model

#: Names of the functions, of Pinocchio's without and with rows, and of MuJoCo's.
FUNCTIONS = {
    "mass_matrix": ("crba", "crba", ""),
    "bias": ("nonLinearEffects", "nonLinearEffects", ""),
    "forward_dynamics": ("aba", "constraintDynamics", "mj_forward"),
    "inverse_dynamics": ("rnea", "", "mj_inverse"),
}
#: Calls of a batch.
CALLS = 100
_LOOP = """typedef void (*function)(const void *, void *);
void repeat(function f, const void *m, void *d, long n) { for (long k = 0; k < n; k++) f(m, d); }
typedef void (*of)(const void *, void *, const void *, const void *, const void *, const void *);
void evaluate(of f, const void *m, void *d, const void *x, const void *y, const void *z, const void *c, long n)
{ for (long k = 0; k < n; k++) f(m, d, x, y, z, c); }
"""
#: Pinocchio's functions in its compiled library: the beginning of a name, arguments behind model and data, and the
#: result. Numbers are conventions, 0 of the world and 1 local: those that are faster.
COMPILED: dict[str, tuple[str, tuple[str | int, ...], str]] = {
    "mass_matrix": ("_ZN9pinocchio4crbaI", ("q", 1), "M"),
    "bias": ("_ZN9pinocchio4impl16nonLinearEffectsI", ("q", "v"), "nle"),
    "forward_dynamics": ("_ZN9pinocchio3abaI", ("q", "v", "effort", 0), "ddq"),
    "inverse_dynamics": ("_ZN9pinocchio4impl4rneaI", ("q", "v", "a"), "tau"),
}
_TYPE = "N9pinocchio{}TplIdLi0ENS_25JointCollectionDefaultTplEEE"
_QUERY = "_ZN5boost6python9converter8registry5queryENS0_9type_infoE"
_ADDRESS = "_ZN5boost6python9converter22get_lvalue_from_pythonEP7_objectRKNS1_12registrationE"

Array = np.ndarray[Any, np.dtype[np.float64]]
#: What makes evaluations, and how many.
Batch = tuple[Callable[[], object], int]


class Subject(NamedTuple):
    """A robot in three programs, and how their velocities follow from those of symgen."""

    model: Model
    urdf: str
    mjcf: str
    loop: bool


class State(NamedTuple):
    """Coordinates, velocities, accelerations and efforts."""

    q: Array
    v: Array
    a: Array
    effort: Array

    def along(self, ways: Array) -> State:
        """Return the state along other velocities, which are the product of a matrix with these."""
        return State(
            ways @ self.q,
            ways @ self.v,
            ways @ self.a,
            np.asarray(np.linalg.solve(ways.T, self.effort), dtype=np.float64),
        )


def called(function: Callable[..., object], *arguments: object, count: int = CALLS) -> Callable[[], object]:
    """Return a batch of calls."""

    def batch() -> None:
        for _ in range(count):
            function(*arguments)

    return batch


Added = tuple[Callable[[State], Array], Array]


def add_pinocchio(own: Subject, names: list[str], state: State, table: dict[str, dict[str, Batch]]) -> Added:
    """Add batches of Pinocchio; return its accelerations, and the matrix of its velocities by those of symgen."""
    import pinocchio as pin

    model = pin.buildModelFromXML(own.urdf)
    if own.loop:
        model.gravity.linear = np.array([0.0, -9.81, 0.0])
    data = model.createData()
    places = {joint: model.joints[model.getJointId(joint)].idx_v for joint in names}
    ways = _ways(own, names, places)
    q, v, a, effort = state.along(ways)
    forward: Callable[..., Any] = pin.aba
    more: tuple[Any, ...] = ()
    if own.loop:
        (one, at), (other, there) = ((model.getJointId(x), pin.SE3(np.eye(3), np.array(y))) for x, y in LOOP)
        closures = [pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, model, one, at, other, there, pin.LOCAL)]
        memory = [closure.createData() for closure in closures]
        pin.initConstraintDynamics(model, data, closures, memory)
        forward, more = pin.constraintDynamics, (closures, memory, pin.ProximalSettings(1e-12, 1e-8, 5))
    row, tool = table, "pinocchio"
    row["mass_matrix"][tool] = called(pin.crba, model, data, q), CALLS
    row["bias"][tool] = called(pin.nonLinearEffects, model, data, q, v), CALLS
    row["forward_dynamics"][tool] = called(forward, model, data, q, v, effort, *more), CALLS
    if not own.loop:
        row["inverse_dynamics"][tool] = called(pin.rnea, model, data, q, v, a), CALLS
    for key, batch in _compiled(model, data, State(q, v, a, effort)).items():
        if key not in row or (own.loop and key == "forward_dynamics"):  # its rows are objects of Python
            continue
        if _differs(row[key][tool][0], batch, data, COMPILED[key][2]):
            raise ArithmeticError(f"{key}: expected the numbers of the call from Python, got others")
        row[key][f"{tool}, alone"] = batch, CALLS
    return lambda x: np.array(forward(model, data, x.q, x.v, x.effort, *more)), ways


class _Reference(ctypes.Structure):
    """A vector as the library takes it: ``Eigen::Ref`` begins with the address of the elements and their number."""

    _fields_ = (("elements", ctypes.c_void_p), ("rows", ctypes.c_long), ("rest", ctypes.c_long * 8))
    numbers: Array  # kept as long as this is


def _reference(x: Array) -> _Reference:
    """Return a vector for the library."""
    numbers = np.ascontiguousarray(x)
    reference = _Reference(numbers.ctypes.data, len(numbers))
    reference.numbers = numbers
    return reference


def _compiled(model: Any, data: Any, state: State) -> dict[str, Callable[[], object]]:
    """Return batches of Pinocchio's functions by a loop in C, which enters the code that its wheel has of them.

    Headers would take a quarter of an hour to compile. Names of the library and addresses of model and data are enough.
    """
    path = next(x for x in _loaded("libpinocchio_default.so"))
    listed = subprocess.run(["nm", "-D", "--defined-only", path], check=True, capture_output=True, text=True).stdout
    names = [line.split()[-1] for line in listed.splitlines() if "ForceTpl" not in line]
    library, loop = ctypes.CDLL(path), _c_loop()
    objects = [ctypes.c_void_p(_address(x, _TYPE.format(kind))) for x, kind in ((model, "8Model"), (data, "7Data"))]

    def argument(x: str | int) -> Any:
        if isinstance(x, int):  # it goes through the register of an address
            return ctypes.c_void_p(x)
        return ctypes.byref(_reference(getattr(state, x)))

    batches = dict[str, Callable[[], object]]()
    for key, (begin, wanted, _) in COMPILED.items():
        name = next(x for x in names if x.startswith(begin))
        function = ctypes.cast(getattr(library, name), ctypes.c_void_p)
        arguments = [*map(argument, wanted), *[ctypes.c_void_p(0)] * (4 - len(wanted))]
        batches[key] = called(loop.evaluate, function, *objects, *arguments, ctypes.c_long(CALLS), count=1)
    return batches


def _loaded(name: str) -> list[str]:
    """Return the paths of libraries of this process."""
    lines = Path("/proc/self/maps").read_text(encoding="utf-8").splitlines()
    return [line.split()[-1] for line in lines if Path(line.split()[-1]).name.startswith(name)]


def _address(x: Any, kind: str) -> int:
    """Return where an object of C++ lies that Python has, by the name of its type."""
    python = ctypes.PyDLL(_loaded("libboost_python")[0])
    query, address = getattr(python, _QUERY), getattr(python, _ADDRESS)
    query.argtypes, address.argtypes = [ctypes.c_char_p], [ctypes.py_object, ctypes.c_void_p]
    query.restype = address.restype = ctypes.c_void_p
    return int(address(x, query(kind.encode())))


def _differs(one: Callable[[], object], other: Callable[[], object], data: Any, result: str) -> bool:
    """Whether two batches leave other numbers in Pinocchio's data."""
    left = list[Array]()
    for batch in (one, other):
        getattr(data, result)[:] = 0.0
        batch()
        left.append(np.triu(getattr(data, result)) if result == "M" else np.array(getattr(data, result)))
    own, theirs = left
    return bool(np.abs(own - theirs).max() > 1e-9 * np.abs(own).max())


def add_mujoco(own: Subject, names: list[str], state: State, table: dict[str, dict[str, Batch]]) -> Added:
    """Add batches of MuJoCo, as `add_pinocchio` does."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(own.mjcf)
    data = mujoco.MjData(model)
    places = {joint: int(model.joint(joint).dofadr[0]) for joint in names}
    ways = _ways(own, names, places)

    def put(x: State) -> None:
        data.qpos[:], data.qvel[:], data.qacc[:], data.qfrc_applied[:] = x

    def accelerations(x: State) -> Array:
        put(x)
        mujoco.mj_forward(model, data)
        return np.array(data.qacc)

    put(state.along(ways))
    library, loop = ctypes.CDLL(str(next(Path(mujoco.__file__).parent.glob("libmujoco.so*")))), _c_loop()
    for key, row in table.items():
        if name := FUNCTIONS[key][2]:
            row["mujoco"] = called(getattr(mujoco, name), model, data), CALLS
            pointers = ctypes.cast(getattr(library, name), ctypes.c_void_p), model._address, data._address
            numbers = pointers[0], *(ctypes.c_void_p(x) for x in pointers[1:]), ctypes.c_long(CALLS)
            row["mujoco, alone"] = called(loop.repeat, *numbers, count=1), CALLS
    return accelerations, ways


def _c_loop() -> ctypes.CDLL:
    """Return a loop over calls in C."""
    with tempfile.TemporaryDirectory() as place:
        source, library = Path(place) / "loop.c", Path(place) / "loop.so"
        source.write_text(_LOOP, encoding="utf-8")
        subprocess.run(["gcc", "-O2", "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
        return ctypes.CDLL(str(library))


def _ways(own: Subject, names: list[str], places: dict[str, int]) -> Array:
    """Return the matrix of another program's velocities by those of symgen, which has angles of bodies in the leg."""
    ways = np.zeros((len(names), len(names)))
    for k, name in enumerate(names):
        ways[places[name], k] = 1.0
        if own.loop and name in RELATIVE:
            ways[places[name], names.index(RELATIVE[name])] = -1.0
    return ways


def versions() -> dict[str, str]:
    """Return the versions of both."""
    import mujoco
    import pinocchio as pin

    return {"pinocchio": pin.__version__, "mujoco": mujoco.__version__}
