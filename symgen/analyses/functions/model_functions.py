"""A mechanism's dynamics as compiled functions of the state, and frames on its bodies.

Each function is derived, emitted and compiled at its first use, and kept in the cache. Called with arrays it returns an
array; many states at once are arrays with one state a row.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.functions.array_function import ArrayFunction
from symgen.base import arguments
from symgen.base.errors import InputError, suggest
from symgen.base.vocabulary.expressions import ZERO
from symgen.run.compiling.functions import compile_function
from symgen.run.loops import projection
from symgen.run.planning.state_model import StateModel

if TYPE_CHECKING:
    from symgen.analyses.functions.body_frame import Frame
    from symgen.derive.lower.function_programs import StateFunctions, Values
    from symgen.describe.mechanism import Mechanism, Vec

Array = NDArray[np.float64]
WHERE = "functions"
#: Arguments of the functions before ``p``.
_VECTORS = {
    **dict.fromkeys(("mass_matrix", "constraint_jacobian", "violation", "potential_energy"), ("q",)),
    **dict.fromkeys(("bias", "gamma", "kinetic_energy", "rates"), ("q", "v")),
    "nu": ("q",),
    "inverse_dynamics": ("q", "v", "a"),
    "forward_dynamics": ("q", "v", "e"),
}
#: Functions that rows are solved in.
SOLVED = ("forward_dynamics", "inverse_dynamics")
#: What derivatives are taken by, as arguments of `Functions.derivative` and as spaces.
BY = {"q": "q", "v": "v", "a": "a", "effort": "e", "p": "p"}


class Functions:
    """Compiled functions of the state of a mechanism: M v' + h = efforts - D^T lambda, D v' = gamma, q' = N v.

    Arguments are arrays: coordinates `q`, velocities `v`, accelerations or efforts along the velocities, then, where
    they differ from `p`, the numbers that `values` returns, or a mapping of changed ones. A further array takes the
    result. With rows of states, shape (k, ...), results have the shape (k, ...) as well. Units are SI; signs and axes
    are those of the state.

    Attributes
    ----------
    mechanism : Mechanism
        The mechanism, with its tree in joint coordinates; no row with bounds is in force.
    coordinates, velocities : tuple of Quantity
        Names and units of q and v.
    parameters : tuple of str
        Names of the numbers `p`: parameters and inputs of the file, its own states, and the time ``t``.
    p : Array
        Their values by default.
    rows : tuple of str
        Names of the constraint rows.
    """

    def __init__(
        self, mechanism: Mechanism, coordinates: str = "auto", parameters: Mapping[str, float] | None = None
    ) -> None:
        self._model = StateModel(WHERE, mechanism, coordinates, parameters or {})
        self.mechanism, self.rows = self._model.mechanism, self._model.rows
        self.coordinates, self.velocities = self._model.coordinates, self._model.velocities
        self.parameters = self._model.parameters
        self._functions: dict[object, ArrayFunction] = {}
        self.p = self.values()

    def __repr__(self) -> str:
        sizes = f"{len(self.coordinates)} coordinates, {len(self.velocities)} velocities, {len(self.rows)} rows"
        return f"<Functions of {self.mechanism.name} in {self._model.kind} coordinates: {sizes}>"

    def values(self, changed: Mapping[str, float] | None = None, **numbers: float) -> Array:
        """Return the numbers `p` with changed parameters, inputs, own states or the time ``t``.

        Parameters that follow others by formulas of the file follow them here.

        Raises
        ------
        InputError
            If there is no such name, or a value is not finite.
        """
        return self._model.values({**(changed or {}), **numbers})

    @property
    def start(self) -> tuple[Array, Array]:
        """Coordinates and velocities at the start of a run: closed, and along the rows.

        Raises
        ------
        AssemblyError
            If the mechanism cannot be closed.
        """
        return self._model.start

    @cached_property
    def _derived(self) -> StateFunctions:
        from symgen.derive.lower.function_programs import StateFunctions

        return StateFunctions(self.mechanism)

    # -- dynamics ------------------------------------------------------------------------------------------------------

    @property
    def mass_matrix(self) -> ArrayFunction:
        """``M(q)``, shape (nv, nv) [kg, kg m, kg m^2]: efforts per acceleration, rotors included."""
        return self._quantity_function("mass_matrix", "the mass matrix")

    @property
    def bias(self) -> ArrayFunction:
        """``h(q, v)``, shape (nv,) [N, N m]: efforts that keep v' at 0, against all forces of the file."""
        return self._quantity_function("bias", "gyroscopic terms less forces")

    @property
    def forward_dynamics(self) -> ArrayFunction:
        """``v'(q, v, effort)``, shape (nv,) [m/s^2, rad/s^2], with all rows in force; efforts are along v [N, N m].

        Raises
        ------
        InputError
            If a velocity has no inertia there, or D has a smaller rank than at the start of the mechanism.
        """
        if not self.rows:
            return self._quantity_function("forward_dynamics", "accelerations")
        n, m = len(self.velocities), len(self.rows)
        return self._function_by_kernel(
            "system", ("q", "v", "e"), (n, m, self._model.rank), projection.project_accelerations, (n,)
        )

    @property
    def inverse_dynamics(self) -> ArrayFunction:
        """``M a + h`` of (q, v, a), shape (nv,) [N, N m]; with rows the shortest efforts that make `a`.

        See `actuated` for efforts of named actuators.

        Raises
        ------
        InputError
            If D has a smaller rank than at the start of the mechanism.
        """
        if not self.rows:
            return self._quantity_function("inverse_dynamics", "efforts")
        n, m = len(self.velocities), len(self.rows)
        return self._function_by_kernel(
            "balance", ("q", "v", "a"), (n, m, self._model.rank, 0, 0), projection.project_efforts, (n,)
        )

    def actuated(self, *names: str | Sequence[str]) -> ArrayFunction:
        """Return the function (q, v, a) of the values of named actuators that make `a`, shape (number of names,).

        It does not check rows: of an `a` that breaks D a = gamma it returns what M a + h asks of the motions that the
        rows allow. Limits of inputs and of their forces, written with ``min`` and ``max``, do not act: values may be
        beyond them.

        Parameters
        ----------
        *names : str or sequence of str
            Inputs of the file in which forces are affine, such as those of servos; coordinates of joints such as
            ``hip.angle``, or joints that have one. Of more than are needed the values are the shortest.

        Raises
        ------
        InputError
            If a name is not valid; from the function, if they cannot make `a`.
        """
        listed = [name for each in names for name in arguments.words("actuated", each)]
        chosen = tuple(self._actuator_name(name) for name in listed)
        if not chosen or len(set(chosen)) < len(chosen):
            raise InputError("actuated", "names of actuators, each once", ", ".join(listed) or "none")
        n, m, k = len(self.velocities), len(self.rows), len(chosen)
        sizes = (n, m, self._model.rank, k, 1)
        return self._function_by_kernel("balance", ("q", "v", "a"), sizes, projection.project_efforts, (k,), chosen)

    def _actuator_name(self, name: str) -> str:
        """Return the input, or the coordinate of a joint, that a name means."""
        inputs = [p.name for p in self.mechanism.parameters if p.input]
        joints = {joint.name: [f"{joint.name}.{x}" for x, _ in joint.coordinates] for joint in self.mechanism.joints}
        coordinates = [x for each in joints.values() for x in each]
        if name in (*inputs, *coordinates):
            return name
        if len(joints.get(name, ())) == 1:
            return joints[name][0]
        expected = "an input of the file or a coordinate of a joint"
        hint = f"one of {', '.join(joints[name])}" if joints.get(name) else suggest(name, {*inputs, *coordinates})
        raise InputError("actuated", expected, f"'{name}'", hint)

    @property
    def constraint_jacobian(self) -> ArrayFunction:
        """``D(q)``, shape (m, nv): the rows of D v = nu."""
        return self._quantity_function("constraint_jacobian", "the Jacobian of the rows")

    @property
    def gamma(self) -> ArrayFunction:
        """``gamma(q, v)``, shape (m,): the right-hand side of D v' = gamma."""
        return self._quantity_function("gamma", "accelerations of the rows")

    @property
    def nu(self) -> ArrayFunction:
        """``nu(q)``, shape (m,): the right-hand side of D v = nu, 0 without drivers."""
        return self._quantity_function("nu", "velocities of the rows")

    @property
    def violation(self) -> ArrayFunction:
        """``Phi(q)``, shape (m,) [m, rad]: 0 where loops are closed."""
        return self._quantity_function("violation", "violations of the rows")

    @property
    def rates(self) -> ArrayFunction:
        """``q' = N v`` of (q, v), shape (nq,): the velocities, but for Euler parameters."""
        return self._quantity_function("rates", "rates of the coordinates")

    @property
    def kinetic_energy(self) -> ArrayFunction:
        """``T(q, v)`` [J]."""
        return self._quantity_function("kinetic_energy", "the kinetic energy")

    @property
    def potential_energy(self) -> ArrayFunction:
        """``V(q)`` [J] of gravity and springs."""
        return self._quantity_function("potential_energy", "the potential energy")

    def derivative(self, name: str, by: str) -> ArrayFunction:
        """Return the derivative of a function, exact, of the same arguments.

        Parameters
        ----------
        name : str
            Such as ``"bias"``.
        by : {"q", "v", "a", "effort", "p"}
            One of its arguments; elements of `q` count as independent, Euler parameters too. Rows that depend on others
            at the start are left out.

        Returns
        -------
        ArrayFunction
            Its result has one more axis; matrices are flat: shape (rows * columns, number of elements).

        Raises
        ------
        InputError
            If there is no such function or argument.
        """
        name = arguments.one_word_of("derivative", name, tuple(_VECTORS))
        by = arguments.one_word_of("derivative: by", by, tuple(BY))
        if BY[by] != "p" and BY[by] not in _VECTORS[name]:
            taken = ", ".join(x for x, space in BY.items() if space in (*_VECTORS[name], "p"))
            raise InputError("derivative: by", f"an argument of {name} ({taken})", by)
        solved = name in SOLVED and self.rows
        quantity = f"{name} of rows" if solved else name
        rows = self._model.kept if solved else ()
        return self.function(
            *(f"{name}_by_{BY[by]}", f"{name} differentiated by {by}", _VECTORS[name]),
            lambda f: f.derivative(quantity, BY[by], rows),
            rows,
        )

    def reduction(self, q: object, independent: Sequence[str] = (), p: object = None) -> tuple[tuple[str, ...], Array]:
        """Return names of independent velocities, and T of v = T u for these u, shape (nv, number of u).

        Parameters
        ----------
        q : array
            One position.
        independent : sequence of str
            Their names; by default the rows decide.
        p : array or mapping, optional
            As of the functions.

        Raises
        ------
        InputError
            If a name is not valid, or the velocities are not independent or not all that are.
        """
        names = tuple(x.name for x in self.velocities)
        d = np.asarray(self.constraint_jacobian(q) if p is None else self.constraint_jacobian(q, p))
        basis = np.eye(len(names))
        if d.size:
            _, sizes, rows = np.linalg.svd(d)
            basis = rows[np.count_nonzero(sizes > 1e-10 * sizes[0]) :].T
        if not independent:
            from scipy.linalg import qr

            independent = tuple(names[i] for i in sorted(qr(basis.T, pivoting=True)[2][: basis.shape[1]]))
        for name in arguments.words("independent", independent):
            if name not in names:
                raise InputError("independent", "names of velocities", f"'{name}'", suggest(name, set(names)))
        own = basis[[names.index(name) for name in independent]]
        if own.shape[0] != own.shape[1] or np.linalg.cond(own) > 1e10:
            expected = f"{basis.shape[1]} velocities that are independent there"
            raise InputError("independent", expected, ", ".join(independent))
        return tuple(independent), np.asarray(np.linalg.solve(own.T, basis.T).T, dtype=np.float64)

    # -- frames --------------------------------------------------------------------------------------------------------

    def frame(self, name: str) -> Frame:
        """Return the frame of a body, or of a named point with the axes of its body.

        Parameters
        ----------
        name : str
            A body, whose frame has its origin, a point such as ``arm.tip``, or ``tip`` where one body has such a point.

        Raises
        ------
        InputError
            If there is no such frame, or several bodies have such a point.
        """
        name, bodies = arguments.text("frame", name), self.mechanism.bodies
        places: dict[str, tuple[str, Vec]] = {b.name: (b.name, (ZERO,) * len(self.mechanism.gravity)) for b in bodies}
        places |= {f"{b.name}.{point}": (b.name, at) for b in bodies for point, at in b.points}
        having = [key for key in places if key.partition(".")[2] == name]
        if name not in places and len(having) > 1:
            raise InputError(f"frame '{name}'", "a point that one body has", "several", ", ".join(having))
        key = name if name in places else having[0] if having else ""
        if not key:
            short = {key.rpartition(".")[2] for key in places}
            expected = f"a body or a point of {self.mechanism.name}"
            raise InputError(f"frame '{name}'", expected, "none of that name", suggest(name, {*places, *short}))
        from symgen.analyses.functions.body_frame import Frame

        return Frame(self, key, *places[key])

    # -- making --------------------------------------------------------------------------------------------------------

    def _quantity_function(self, name: str, purpose: str) -> ArrayFunction:
        return self.function(name, purpose, _VECTORS[name], lambda f: f.values(name))

    def function(
        self,
        name: str,
        purpose: str,
        vectors: Sequence[str],
        values: Callable[[StateFunctions], Values],
        identity: Sequence[object] = (),
    ) -> ArrayFunction:
        """Return the function of some values, compiled at its first use.

        Parameters
        ----------
        name, purpose : str
            What it is called in its module, and what its first line says.
        vectors : sequence of str
            Arguments before ``p``, by their spaces.
        values : callable
            Makes the values.
        identity : sequence
            What they depend on besides the mechanism and the name.
        """
        key = name, *identity
        if key not in self._functions:
            function = compile_function(
                *(self.mechanism, lambda: self._derived, name, purpose, vectors, values), identity
            )
            self._functions[key] = ArrayFunction(function, self.p, self.values)
        return self._functions[key]

    def _function_by_kernel(
        self,
        name: str,
        vectors: Sequence[str],
        sizes: Sequence[int],
        kernel: object,
        shape: tuple[int, ...],
        actuators: tuple[str, ...] = (),
    ) -> ArrayFunction:
        """Return a function that a kernel makes of what the state determines."""
        key = name, *actuators
        if key not in self._functions:
            n, m, k = sizes[0], sizes[1], len(actuators)
            make = (lambda f: f.values(name)) if not k else (lambda f: f.balance_of_actuators(actuators))
            inputs = compile_function(
                *(self.mechanism, lambda: self._derived, name, f"what {name} solves", vectors, make), actuators
            )
            function = inputs.with_kernel(
                _NAMES[name], kernel, np.array(sizes, dtype=np.int64), projection.projection_room(n, m, k), shape
            )
            self._functions[key] = ArrayFunction(function, self.p, self.values)
        return self._functions[key]


_NAMES = {"system": "forward_dynamics", "balance": "inverse_dynamics"}
