"""The equations as a method sees them in the looped shape: the names of `symgen.lower.algebra` on whole vectors."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cached_property

from symgen.errors import InputError
from symgen.ir.program import STATUS
from symgen.lower.looped.vectors import INDEX, Factor, Inner, Matrix, Operation, Part, Root, Scalar, Vector

_LEAF = re.compile(rf"w\[(\w+) \+ {INDEX}\]")


def leaf(section: str, size: str) -> Vector:
    """Return a section of ``w`` as a vector."""
    return Vector(size, (f"w[{section} + {INDEX}]",), True)


class LoopedSystem:
    """Named blocks and the operations that a method's formula may use, recorded as formulas on whole vectors.

    Attributes
    ----------
    D : Matrix
    f, gamma, nu, phi, v : Vector
        As in the notation; `phi` is zero in nonholonomic rows.
    """

    def __init__(self, method: str, parameter_names: Sequence[str]) -> None:
        self.method, self.parameter_names = method, tuple(parameter_names)
        self.D = Matrix()
        self.f, self.v = leaf("force", "nv"), Vector("nv", (f"y[nq + {INDEX}]",), True)
        self.gamma, self.nu, self.phi = leaf("gamma", "m"), leaf("nu", "m"), leaf("phi", "m")
        self.sections: dict[str, str] = {}  # sections of the law's own and their sizes
        self.kept: list[tuple[str, Vector]] = []
        self.stored: list[Factor] = []

    def parameter(self, name: str) -> Scalar:
        """Return a parameter of the method."""
        return Scalar((f"p[method_parameters + {self.parameter_names.index(name)}]",))

    # -- mass matrix -------------------------------------------------------------------------------------------------

    def minv(self, x: Vector) -> Vector:
        """Return M^-1 x."""
        return self._operation("inverse_mass", x)

    def mass(self, x: Vector) -> Vector:
        """Return M x."""
        return self._operation("mass", x)

    def _operation(self, kind: str, x: Vector) -> Vector:
        return x if x.is_zero else Vector("nv", (Operation(kind, x, "nv"),), True)

    @property
    def free_acceleration(self) -> Vector:
        """Return M^-1 f, the start of iterations; where a mass is 0 its part is 0."""
        return self.minv(self.f)

    @property
    def heavy_penalty(self) -> Scalar:
        """Return 1e5 times the mean of M's diagonal: few iterations, and few digits lost."""
        return 1e5 * Scalar(("p[mean_mass]",))

    @property
    def inverse_mass_root(self) -> Root:
        """Return L^-T with M = L L^T, of which only products with its transposed are ever formed."""
        return Root()

    def inverse(self, x: Scalar) -> Scalar:
        """Return 1 / x."""
        return Scalar(("1.0 / (", *x.parts, ")"))

    @property
    def inverse_step(self) -> Scalar:
        """Return one over the step that is being taken."""
        return Scalar((f"1.0 / w[{STATUS.index('step')}]",))

    # -- factorisations ----------------------------------------------------------------------------------------------

    def _factor(self, kind: str, penalties: Vector | None = None) -> Factor:
        lower = f"{kind}_lower"
        self.sections[lower] = "augmented" if kind == "augmented" else "gram"
        return Factor(kind, lower, penalties)

    @cached_property
    def schur(self) -> Factor:
        """Factor of S = D M^-1 D^T; rows masked by the runtime are left out, small pivots raise the flag."""
        return self._factor("schur")

    def pseudoinverse_factor(self, matrix: Matrix) -> Factor:
        """Return the factor of B B^T for B = D L^-T, which is that of D M^-1 D^T."""
        assert matrix.weighted, "B is D times the inverse root of M"
        return self.schur

    def penalties(self, penalty: Scalar) -> Vector:
        """Return the penalty of each row, 0 for rows that the runtime leaves out."""
        return Vector("m", (*penalty.wrapped(), f" * (1.0 * (1.0 > w[mask + {INDEX}]))"))

    def augmented_factor(self, penalties: Vector) -> Factor:
        """Return the factor of ``M + D^T a D``, a by rows."""
        return self._factor("augmented", penalties)

    def solve(self, factor: Factor, right: Vector) -> Vector:
        """Return the solution for a right-hand side."""
        return right if right.is_zero else Vector(right.size, (Operation("solve", right, right.size, factor),), True)

    def solve_schur(self, right: Vector) -> Vector:
        """Return lambda with S lambda = right."""
        return self.solve(self.schur, right)

    # -- what an iterated law keeps in w between its parts -------------------------------------------------------------

    def keep(self, section: str, x: Vector) -> Vector:
        """Store a vector once per evaluation; return it as the iteration reads it."""
        found = re.fullmatch(_LEAF, x.parts[0]) if len(x.parts) == 1 and isinstance(x.parts[0], str) else None
        if found or x.is_zero:
            return x
        self.sections[section] = x.size
        self.kept.append((section, x))
        return leaf(section, x.size)

    def keep_constraints(self) -> Matrix:
        """Return D as the iteration reads it: where it is."""
        return self.D

    def keep_factor(self, factor: Factor) -> Factor:
        """Make a factor before the iteration; return it as the iteration reads it."""
        self.stored.append(factor)
        return Factor(factor.kind, factor.lower, factor.penalties, stored=True)

    def variable(self, section: str, size: str) -> Vector:
        """Return a vector that the iteration changes, as it reads it."""
        if section != "multipliers":
            self.sections[section] = size
        return leaf(section, size)

    def zeros(self, size: str) -> Vector:
        """Return the zero vector."""
        return Vector(size, ())

    # -- what whole vectors do not give --------------------------------------------------------------------------------

    def at_velocity(self, x: Vector, v: Vector) -> Vector:
        """Refuse: kernels are evaluated at the velocities of the state."""
        raise self.refused("it evaluates forces at velocities that are not those of the state")

    def constraint_rate_transposed(self, y: Vector, v: Vector) -> Vector:
        """Refuse: kernels do not give the rate of D."""
        raise self.refused("it needs the rate of D")

    def refused(self, why: str) -> InputError:
        """Return the error of a method that has no looped shape."""
        return InputError("--shape looped", "a method that works on whole vectors", f"'{self.method}': {why}")


class Block:
    """Prints formulas as loops and calls of generic code, each operation once."""

    def __init__(self, system: LoopedSystem, first_vector: int = 0) -> None:
        self.system = system
        self.lines: list[str] = []
        self.vectors = first_vector
        self.names: set[str] = set()  # sections and sizes that are read
        self.helpers: set[str] = set()
        self.flagged = False
        self._placed: dict[int, str] = {}
        self._scalars: dict[int, str] = {}
        self._made: set[str] = set()
        self._alive: list[object] = []  # ids are only unique while their objects live

    def text(self, parts: Sequence[Part]) -> str:
        """Return an expression, what it needs computed before."""
        result = ""
        for part in parts:
            if isinstance(part, Operation):
                result += f"w[{self.operation(part)} + {INDEX}]"
            elif isinstance(part, Inner):
                result += self.inner(part)
            else:
                result += part
        for name in re.findall(r"[a-z_]+", result):
            self.names.add(name)
        return result

    def inner(self, product: Inner) -> str:
        """Return the name of an inner product, computed by a loop."""
        name = self._scalars.get(id(product))
        if name is None:
            name = self._scalars[id(product)] = f"dot{len(self._scalars)}"
            self._alive.append(product)
            a, b = self.text(product.a.parts), self.text(product.b.parts)
            self.loop(product.a.size, f"{name} += ({a}) * ({b})", before=f"{name} = 0.0")
        return name

    def loop(self, size: str, statement: str, before: str = "") -> None:
        """Print a loop over the elements of a vector."""
        self.names.add(size)
        if before:
            self.lines.append(before)
        self.lines += [f"for {INDEX} in range({size}):", f"    {statement}"]

    def new(self) -> str:
        """Return the name of a new scratch vector."""
        self.vectors += 1
        return f"x{self.vectors - 1}"

    def assign(self, target: str, x: Vector) -> None:
        """Print the assignment of a vector to a section."""
        self.loop(x.size, f"w[{target} + {INDEX}] = {self.text(x.parts) if not x.is_zero else '0.0'}")
        self.names.add(target)

    def place(self, x: Vector) -> str:
        """Return the section that holds a vector, computed first if it does not stand in one."""
        if len(x.parts) == 1:
            part = x.parts[0]
            if isinstance(part, Operation):
                return self.operation(part)
            found = re.fullmatch(_LEAF, part) if isinstance(part, str) else None
            if found:
                self.names.add(found[1])
                return found[1]
        target = self.new()
        self.assign(target, x)
        return target

    def deliver(self, section: str, x: Vector) -> None:
        """Put a vector into a section, an operation's result without a copy."""
        part = x.parts[0] if len(x.parts) == 1 else ""
        self.names.add(section)
        if isinstance(part, Operation) and id(part) not in self._placed:
            self.operation(part, section)
        elif part != f"w[{section} + {INDEX}]":
            self.assign(section, x)

    def operation(self, op: Operation, section: str | None = None) -> str:
        """Return the section that holds the result of an operation: `section`, where one is given and it is new."""
        target = self._placed.get(id(op))
        if target is not None:
            return target
        self._alive.append(op)
        if op.kind == "solve":
            assert op.factor is not None, "a solution has a factor"
            target = section or self.new()
            self.assign(target, op.operand)
            half = self.make(op.factor, target)  # while numbers of the factor are at hand they are used
            table = "AUGMENTED_FACTOR" if op.factor.kind == "augmented" else "GRAM_FACTOR"
            self.call("solve_rest" if half else "solve", f"T, p, w, {table}, {op.factor.lower}, {target}")
            self.names.add(op.factor.lower)
        else:
            source, target = self.place(op.operand), section or self.new()
            self.call(f"{op.kind}_times", f"T, p, w, {source}, {target}")
        self._placed[id(op)] = target
        return target

    def call(self, helper: str, arguments: str) -> None:
        """Print a call of generic code."""
        self.helpers.add(helper)
        self.lines.append(f"{helper}({arguments})")

    def make(self, factor: Factor, target: str = "") -> bool:
        """Print the factorisation of a matrix, unless it was made before.

        Parameters
        ----------
        factor : Factor
            What is factorised.
        target : str
            A section of which half of the solution is computed on the way.

        Returns
        -------
        bool
            Whether that was done.
        """
        if factor.stored or factor.lower in self._made:
            return False
        self._made.add(factor.lower)
        self.names.add(factor.lower)
        name, last = ("factorise_forward", f", {target}") if target else ("factorise", "")
        self.helpers.add(name)
        if factor.kind == "augmented":
            assert factor.penalties is not None, "a is given"
            self.call("augment", f"T, p, w, {self.place(factor.penalties)}, {factor.lower}")
            self.call(name, f"T, p, w, AUGMENTED_FACTOR, {factor.lower}, PLAIN_FACTOR{last}")
            return bool(target)
        self.call("weigh", "T, p, w")
        self.call("gram", f"T, p, w, 1, {factor.lower}")
        self.lines.append(f"suspicious = {name}(T, p, w, GRAM_FACTOR, {factor.lower}, MASKED_FACTOR{last})")
        self.flagged = True
        return bool(target)
