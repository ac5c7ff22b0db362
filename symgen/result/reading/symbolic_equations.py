"""Derived equations as SymPy objects: converted from the graph that is compiled, not derived a second time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from html import escape
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import sympy as sp

from symgen.base import arguments
from symgen.base.errors import InputError, plural, sizes_in_words, suggest
from symgen.derive.formulate.formulate import formulate
from symgen.describe.formulas.evaluate import parameter_values
from symgen.result.reading import boxes
from symgen.result.reading.free_modes import free_modes
from symgen.result.reading.notations import latex
from symgen.result.reading.quantity_names import OF_DRIVERS, QUANTITIES, Entries, nodes_of_quantities, table_functions
from symgen.result.reading.structure import nodes_with_names, shared_terms
from symgen.result.reading.symbolic import Boxed, Symbolic

if TYPE_CHECKING:
    from symgen.derive.formulate.equations import Equations
    from symgen.describe.mechanism import Mechanism
    from symgen.result.reading.law_steps import Law

#: Quantities with more operations, written out without sharing, are written with shared terms.
LARGEST = 30_000


T = TypeVar("T")


class _Lazy(cached_property[T], Generic[T]):
    """A value that is computed at its first use, with its docstring and type."""

    def __init__(self, doc: str, make: Callable[[Any], T]) -> None:
        super().__init__(make)
        self.__doc__ = doc


@dataclass(frozen=True)
class SymbolicEquations:
    """Equations of motion of a mechanism as SymPy matrices and symbols with the names of the file.

    ``M v' + D^T lambda = f``, ``D v' = gamma``, ``q' = N v``; `Phi`, `D`, `nu`, `gamma`, `N`, `M`, `f`, `T`, `V` and
    `power` are computed at their first use, in coordinates of joints also `b` and `c`. Quantities with
    more than `LARGEST` operations are written with shared terms, which `definitions` defines; `notes` says
    which.

    Parameters
    ----------
    mechanism : Mechanism
        The description, with its tree where coordinates are those of joints.
    sharing : bool
        Whether everything is written with shared terms; see `shared`.
    values : mapping
        Replacements of symbols; see `subs`.
    """

    mechanism: Mechanism
    sharing: bool = False
    values: Mapping[Any, Any] = field(default_factory=dict)

    # -- what was derived ------------------------------------------------------------------------------------------

    @cached_property
    def derived(self) -> Equations:
        """The equations as nodes of the graph that is compiled."""
        return formulate(self.mechanism)

    @cached_property
    def _written(self) -> Equations:
        """The equations with a graph of their own, to which N is added."""
        return replace(self.derived, graph=self.derived.graph.copy())

    @property
    def coordinates(self) -> str:
        """Whose coordinates q holds: ``absolute``, of bodies, or ``joint``."""
        return "absolute" if self.mechanism.topology is None else "joint"

    @property
    def rows(self) -> tuple[str, ...]:
        """Names of the rows of `Phi`, `D`, `nu` and `gamma`."""
        return tuple(row.name for row in self.derived.rows)

    @property
    def t(self) -> sp.Symbol:
        """The symbol of time."""
        return self._plain.symbols["t", 0]

    q = _Lazy[Mapping[str, sp.Symbol]]("Symbols of the coordinates, by name.", lambda e: e._symbols("q"))
    v = _Lazy[Mapping[str, sp.Symbol]]("Symbols of the velocities, by name.", lambda e: e._symbols("v"))
    parameters = _Lazy[Mapping[str, sp.Symbol]](
        "Symbols of the parameters and inputs, by name.", lambda e: e._symbols("p")
    )
    turned = _Lazy[Mapping[str, sp.Symbol]](
        "Symbols of angles as they were last, for measures that count turns: these are on the nearest branch.",
        lambda e: e._symbols("winding"),
    )
    states = _Lazy[Mapping[str, sp.Symbol]]("Symbols of the states of the file, by name.", lambda e: e._symbols("z"))
    modes = _Lazy[Mapping[str, sp.Symbol]](
        "Symbols of the numbers of rows that may be off (those with bounds too), by name: ``ROW.sign`` is the "
        "sign of the rate in motion, 0 at rest; ``held`` is 1 where the row is in force.",
        lambda e: e._symbols("modes"),
    )
    joint_rates = _Lazy[Mapping[str, sp.Expr]](
        "Rates of the coordinates of joints, by the names of the coordinates.", lambda e: e._joint_rates()
    )
    # -- quantities ------------------------------------------------------------------------------------------------

    Phi = _Lazy[sp.ImmutableDenseMatrix](
        "Constraints, a matrix of shape (m, 1); 0 in nonholonomic rows, which have none.", lambda e: e._matrix("Phi")
    )
    D = _Lazy[sp.ImmutableDenseMatrix]("Jacobian of the constraints, shape (m, nv).", lambda e: e._matrix("D"))
    nu = _Lazy[sp.ImmutableDenseMatrix](
        "Right-hand side of the velocity constraints D v = nu, shape (m, 1).", lambda e: e._matrix("nu")
    )
    gamma = _Lazy[sp.ImmutableDenseMatrix](
        "Right-hand side of the acceleration constraints D v' = gamma, shape (m, 1).", lambda e: e._matrix("gamma")
    )
    N = _Lazy[sp.ImmutableDenseMatrix]("Kinematic map of q' = N v, shape (nq, nv).", lambda e: e._matrix("N"))
    M = _Lazy[sp.ImmutableDenseMatrix]("Mass matrix, shape (nv, nv).", lambda e: e._matrix("M"))
    f = _Lazy[sp.ImmutableDenseMatrix]("Forces, shape (nv, 1).", lambda e: e._matrix("f"))
    T = _Lazy[sp.Expr]("Kinetic energy [J].", lambda e: e._matrix("T")[0, 0])
    V = _Lazy[sp.Expr]("Potential energy [J].", lambda e: e._matrix("V")[0, 0])
    power = _Lazy[sp.Expr](
        "Power of the forces without potential [W]; that of drivers of prescribed coordinates is no part of it.",
        lambda e: e._matrix("power")[0, 0],
    )
    b = _Lazy[sp.ImmutableDenseMatrix](
        "What v' is multiplied by in the power of the drivers that prescribe coordinates, b v' + c; shape (1, nv).",
        lambda e: e._matrix("b"),
    )
    c = _Lazy[sp.Expr](
        "The power of the drivers that prescribe coordinates where v' is 0 [W]; 0 without such drivers.",
        lambda e: e._matrix("c")[0, 0],
    )

    @cached_property
    def _quantities(self) -> tuple[str, ...]:
        """Names of the quantities; quantities of drivers only where there are drivers."""
        return tuple(k for k in QUANTITIES if self.derived.driving is not None or k not in OF_DRIVERS)

    def quantity(self, name: str) -> Any:
        """Return one of `Phi`, `D`, `nu`, `gamma`, `N`, `M`, `f`, `T`, `V`, `power`, `b` and `c` by its name.

        Raises
        ------
        InputError
            If no quantity has that name.
        """
        return getattr(self, arguments.one_word_of("quantity", name, tuple(QUANTITIES)))

    # -- shared terms ----------------------------------------------------------------------------------------------

    def shared(self) -> SymbolicEquations:
        """Return the same equations with named shared terms; `definitions` defines them.

        Names are those of the structure, ``BODY.c`` and ``BODY.s`` for cosine and sine of a body's angle and
        ``BODY.a00`` to ``BODY.a22`` for its rotation matrix, and numbers for what else is used more than once.
        """
        return replace(self, sharing=True)

    @cached_property
    def definitions(self) -> Mapping[Any, Any]:
        """Definitions of shared terms, by symbol, each written with earlier ones; empty without any."""
        return MappingProxyType(self._definitions_needed(()))

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """A sentence about each quantity that is written with shared terms because it would be too large."""
        large = [] if self.sharing else [name for name in self._quantities if self._is_large(name)]
        return tuple(
            f"{name} would have {self._operations_of(name)} operations written out, more than {LARGEST}: "
            "it is written with "
            "shared terms, see definitions"
            for name in large
        )

    # -- computing -------------------------------------------------------------------------------------------------

    def subs(self, values: Mapping[Any, Any]) -> SymbolicEquations:
        """Return the equations with symbols replaced, all of them at once.

        Parameters
        ----------
        values : mapping
            By symbol or name, what is put in its place: numbers or SymPy expressions. A symbol that was replaced before
            and is named again gets the new value.

        Raises
        ------
        InputError
            If a name is not one of the equations.
        """
        symbols = {s.name: s for s in (*self._plain.symbols.values(), *self._named.named.values())}
        new = dict[Any, Any]()
        for key, value in values.items():
            name = key.name if isinstance(key, sp.Symbol) else str(key)
            if name not in symbols:
                raise InputError("subs", "a name of the equations", f"'{name}'", suggest(name, symbols))
            new[symbols[name]] = sp.sympify(value)
        left = {symbol for value in self.values.values() for symbol in value.free_symbols}
        replaced = {key: value.xreplace(new) for key, value in self.values.items()}
        replaced |= {key: value for key, value in new.items() if key not in replaced or key not in left}
        return replace(self, values=replaced)

    def lambdify(self, *names: str, modules: str | Sequence[Any] = "numpy") -> Callable[..., Any]:
        """Return a function ``(t, q, v, p=None, turned=None, states=None, modes=None)`` that computes quantities.

        Shared terms are computed once.

        Parameters
        ----------
        *names : str
            Quantities, such as ``"D"`` and ``"gamma"``.
        modules : str or sequence
            As `sympy.lambdify` takes them.

        Returns
        -------
        callable
            Takes the time [s] and sequences of q, v, `parameters`, `turned`, `states` and `modes`; gives what `names`
            say, a tuple where they are several. By default parameters have their values in the file, `turned` and
            `states` are 0, rows with bounds are off, their signs those of the rates in v, and joints hold.
        """
        import numpy as np

        quantities = names or ("Phi",)
        shared = self if self.sharing else self.shared()
        definitions = shared._definitions_needed(quantities)
        terms = {symbol: sp.Symbol(f"_term{i}", real=True) for i, symbol in enumerate(definitions)}
        outputs = [shared.quantity(name).xreplace(terms) for name in quantities]
        written = [(terms[symbol], value.xreplace(terms)) for symbol, value in definitions.items()]
        tables = table_functions(self.derived.tables)
        libraries = [tables, *([modules] if isinstance(modules, str) else modules)]
        compute = sp.lambdify(self.arguments, outputs, libraries, cse=lambda unchanged: (written, unchanged))
        described = list(parameter_values(self.mechanism).values())
        free = free_modes(self, libraries)

        def computed(
            t: float,
            q: object,
            v: object,
            p: object = None,
            turned: object = None,
            states: object = None,
            modes: object = None,
        ) -> Any:
            """Return the quantities at a state."""
            last = [0.0] * len(self.turned) if turned is None else turned
            own = [0.0] * len(self.states) if states is None else states
            values = (t, q, v, described if p is None else p, last, own)
            with np.errstate(all="ignore"):  # both branches of a condition are computed, one of which may be undefined
                results = compute(*values, free(*values) if modes is None else modes)
            return results[0] if len(quantities) == 1 else tuple(results)

        return computed

    @property
    def arguments(self) -> list[Any]:
        """Symbols of the arguments of a function of `lambdify`, in their order."""
        groups = (self.q, self.v, self.parameters, self.turned, self.states, self.modes)
        return [self.t, *(list(group.values()) for group in groups)]

    def law(self, method: str = "direct-correction", **options: str) -> Law:
        """Return the law of a method as the steps that are solved.

        Parameters
        ----------
        method : str
            Name of the method.
        **options
            Its structural options, such as ``weight="mass"``.

        Raises
        ------
        InputError
            If there is no such method or option.
        """
        from symgen.result.reading.law_steps import law_as_steps

        return law_as_steps(method, options, self.derived.driving is not None)

    # -- writing ---------------------------------------------------------------------------------------------------

    def latex(self, *names: str) -> str:
        """Return quantities as LaTeX, one equation ``NAME = ...`` a line; all by default.

        Lines are as long as they are: a document with broken lines is what ``symgen inspect --document`` writes.
        """
        sides = [({"power": "P"}.get(name, name), self.quantity(name)) for name in names or self._quantities]
        sides += [(symbol.name, value) for symbol, value in self._definitions_needed(names).items()]
        box = Boxed().box
        return " \\\\\n".join(f"{latex(boxes.name_box(left))} = {latex(box(right))}" for left, right in sides)

    def _repr_latex_(self) -> str:
        """Return the plain text for a notebook."""
        if not self.derived.m:
            sizes = rf"q \in \mathbb{{R}}^{{{self.derived.nq}}},\ v \in \mathbb{{R}}^{{{self.derived.nv}}}"
            return rf"$\displaystyle M \dot v = f,\quad \dot q = N v,\quad {sizes}$"
        return (
            r"$\displaystyle M \dot v + D^T \lambda = f,\quad D \dot v = \gamma,\quad \dot q = N v,\quad "
            rf"q \in \mathbb{{R}}^{{{self.derived.nq}}},\ v \in \mathbb{{R}}^{{{self.derived.nv}}},\ "
            rf"\lambda \in \mathbb{{R}}^{{{self.derived.m}}}$"
        )

    def _repr_html_(self) -> str:
        """Return the HTML for a notebook: sizes, and the quantities folded."""
        e = self.derived
        sizes = f"{sizes_in_words(e)}, in {self.coordinates} coordinates"
        parts = [f"<p><b>{escape(e.name)}</b>: {escape(sizes)}</p>"]
        for name in self._quantities:
            words, count = QUANTITIES[name], self._operations_of(name)
            head = f"<summary><code>{name}</code>: {escape(words)}, {plural(count, 'operation')}</summary>"
            text = f"$$\\begin{{gathered}}{self.latex(name)}\\end{{gathered}}$$" if count <= 400 else "too long to show"
            parts.append(f"<details>{head}{escape(text)}</details>")
        return "\n".join(parts)

    def __repr__(self) -> str:
        e = self.derived
        return f"<equations of {e.name}: nq = {e.nq}, nv = {e.nv}, m = {e.m}, {self.coordinates} coordinates>"

    # -- from nodes ------------------------------------------------------------------------------------------------

    @cached_property
    def nodes(self) -> Mapping[str, Entries]:
        """For each quantity its shape, and row, column and node of its entries."""
        return nodes_of_quantities(self._written)

    @cached_property
    def _plain(self) -> Symbolic:
        return Symbolic(self._written)

    @cached_property
    def _named(self) -> Symbolic:
        ends = [node for _, entries in self.nodes.values() for *_, node in entries]
        symbols = {symbol.name for symbol in self._plain.symbols.values()}
        names = shared_terms(self._written.graph, ends, nodes_with_names(self.mechanism, self._written), symbols)
        return Symbolic(self._written, names)

    def _symbols(self, space: str) -> Mapping[str, sp.Symbol]:
        symbols = [s for (kind, _), s in self._plain.symbols.items() if kind == space]
        return MappingProxyType({s.name: s for s in symbols})

    def _joint_rates(self) -> Mapping[str, Any]:
        written = {x.name: self._put_values(self._plain.expression(x.rate)) for x in self.derived.joint_coordinates}
        return MappingProxyType(written)

    @cached_property
    def rates_of_bounded_rows(self) -> Mapping[str, Any]:
        """Rates along the rows with bounds, by the names of the rows: D v - nu, whether a row is in force or not."""
        g, rows = self._written.graph, [row for row in self.derived.rows if row.bounded]
        velocities = (g.sum_of(g.mul(n, g.input("v", j)) for j, n in row.entries) for row in rows)
        nodes = (g.sub(rate, row.nu) for rate, row in zip(velocities, rows, strict=True))
        written = (self._put_values(self._plain.expression(node)) for node in nodes)
        return MappingProxyType(dict(zip((row.name for row in rows), written, strict=True)))

    def _operations_of(self, name: str) -> int:
        return self._written.graph.count_tree_operations(n for *_, n in self.nodes[name][1])

    def _is_large(self, name: str) -> bool:
        return self._operations_of(name) > LARGEST

    def _matrix(self, name: str) -> sp.ImmutableDenseMatrix:
        shape, entries = self.nodes[name]
        display = self._named if self.sharing or self._is_large(name) else self._plain
        values = {(i, j): self._put_values(display.expression(node)) for i, j, node in entries}
        return sp.ImmutableDenseMatrix(*shape, lambda i, j: values.get((int(i), int(j)), sp.S.Zero))

    def _put_values(self, expression: Any) -> Any:
        return expression.xreplace(self.values) if self.values else expression

    def _definitions_needed(self, names: Iterable[str]) -> dict[Any, Any]:
        """Return the definitions that quantities need, in evaluation order; of all quantities by default."""
        display, used = self._named, [x for x in names or self._quantities if self.sharing or self._is_large(x)]
        operations = self._written.graph.required_nodes(n for name in used for *_, n in self.nodes[name][1])
        named = [n for n in operations if n in display.named and display.named[n] not in self.values]
        return {display.named[n]: self._put_values(display.definition(n)) for n in named}
