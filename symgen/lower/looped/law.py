"""The program of a law in the looped shape: text that is the same for all mechanisms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, cast

from symgen.errors import InputError
from symgen.ir.program import Correction
from symgen.lower.looped.forms import form_key
from symgen.lower.looped.layout import HEAD
from symgen.lower.looped.system import Block, LoopedSystem
from symgen.lower.looped.vectors import INDEX, Vector
from symgen.methods._base import Acceleration, Iteration, Method

if TYPE_CHECKING:
    from symgen.lower.algebra import System

#: Methods that need dense matrices are refused above this number of coordinates.
LARGEST_DENSE = 400


@dataclass(frozen=True)
class LoopedFunction:
    """A printed function: its parts are lines at the level of its body, names what it reads of the head."""

    name: str
    purpose: str
    begin: tuple[str, ...]
    iterate: tuple[str, ...] = ()
    finish: tuple[str, ...] = ()
    flagged: bool = False


@dataclass(frozen=True)
class LoopedLaw:
    """What a method adds in the looped shape.

    Parameters
    ----------
    method, key : str
        As in `symgen.ir.program.LawProgram`.
    functions : tuple of LoopedFunction
        ``rhs``, and ``geometry`` and ``spread`` where the metric of the correction is not the identity.
    names, helpers : tuple of str
        Sections and sizes, and generic functions, that they read.
    sections : tuple of (name, size)
        Sections of ``w`` of its own.
    vectors : int
        Scratch vectors.
    augmented : bool
        Whether M + a D^T D is factorised.
    positions : bool
        Whether ``rhs`` needs Phi.
    """

    method: str
    key: str
    functions: tuple[LoopedFunction, ...]
    names: tuple[str, ...]
    helpers: tuple[str, ...]
    sections: tuple[tuple[str, str], ...]
    vectors: int
    augmented: bool
    positions: bool
    parameters: tuple[tuple[str, float], ...]
    form: str
    correction: Correction
    options: Mapping[str, str] = field(default_factory=dict)


def refuse_dense(method: Method, options: Mapping[str, str], implicit: bool) -> None:
    """Refuse what has no looped shape.

    Raises
    ------
    InputError
        Saying in one sentence why.
    """
    if implicit:
        form_key(method, options)  # refused where constraints ask for more than their own joint
    if options.get("solver") == "dense":
        why = f"'{method.name}' with a dense factorisation of D; the straight shape is for it"
    elif method.dense:
        why = f"'{method.name}', {method.dense}; the straight shape is for it"
    elif not _is_on_whole_vectors(method, options):
        why = f"'{method.name}', whose formula asks for single elements; the straight shape is for it"
    else:
        return
    raise InputError("--shape looped", "a method whose cost grows linearly with the mechanism", why)


def _is_on_whole_vectors(method: Method, options: Mapping[str, str]) -> bool:
    """Whether a method's formula asks for nothing that whole vectors do not have; ours do not, others are tried."""
    if type(method).__module__.partition(".")[0] == "symgen":
        return True
    try:
        _Builder(method, options).law()
    except (AttributeError, TypeError, InputError):
        return False
    return True


def is_loopable(method: Method, options: Mapping[str, str], implicit: bool) -> bool:
    """Whether a method has a looped shape."""
    try:
        refuse_dense(method, options, implicit)
    except InputError:
        return False
    return True


def lower_looped(method: Method, options: Mapping[str, str], implicit: bool = False) -> LoopedLaw:
    """Lower one method to loops.

    Parameters
    ----------
    method, options : Method, mapping
        The method with its structural options, complete.
    implicit : bool
        Whether an implicit integrator asks for it.

    Raises
    ------
    InputError
        If the method needs dense algebra.
    """
    refuse_dense(method, options, implicit)
    return _Builder(method, options).law()


class _Builder:
    def __init__(self, method: Method, options: Mapping[str, str]) -> None:
        self.method, self.options = method, options
        self.system = LoopedSystem(method.name, [p.name for p in method.parameters])
        self.names: set[str] = set()
        self.helpers: set[str] = set()
        self.functions: list[LoopedFunction] = []
        self.vectors = 2
        self.form = "direct"
        self.positions = False

    def law(self) -> LoopedLaw:
        method, system = self.method, self.system
        law: Any = method.law(cast("System", system), self.options)  # the same names on whole vectors
        if isinstance(law, Acceleration):
            self.direct(law)
        elif isinstance(law, Iteration) and law.rates is None:
            self.iterated(law)
        else:
            raise system.refused("it integrates something else than v")
        correction = method.correction(self.options)
        if correction.metric == "mass":
            self.mass_metric()
        elif correction.metric == "augmented":
            self.augmented_metric()
        sections = tuple(system.sections.items())
        return LoopedLaw(
            method=method.name,
            key=method.stem(self.options),
            functions=tuple(self.functions),
            names=tuple(sorted(n for n in self.names if n in HEAD or n in system.sections)),
            helpers=tuple(sorted(self.helpers)),
            sections=sections,
            vectors=self.vectors,
            augmented=any(size == "augmented" for _, size in sections),
            positions=self.positions,
            parameters=tuple((p.name, p.default) for p in method.parameters),
            form=self.form,
            correction=correction,
            options=dict(self.options),
        )

    def close(self, *blocks: Block) -> None:
        """Take over what blocks read and need."""
        for block in blocks:
            self.names |= block.names
            self.helpers |= block.helpers
            self.vectors = max(self.vectors, block.vectors)

    def begin(self, body: Block) -> tuple[str, ...]:
        """Return the lines that evaluate the kernels that the blocks read."""
        self.positions = "phi" in body.names
        stage = "FULL" if self.positions else "MOTION"
        self.helpers |= {"run"}
        return (
            "w[POWER] = 0.0",
            "run(FRAMES, t, y, p, w, T, w)",
            "run(RATES, t, y, p, w, T, ydot)",
            f"run({stage}, t, y, p, w, T, w)",
        )

    def rates(self, block: Block, acceleration: Vector, multipliers: Vector) -> None:
        """Print v', the multipliers and the power."""
        block.deliver("multipliers", multipliers)
        block.loop("nv", f"ydot[nq + {INDEX}] = {block.text(acceleration.parts)}")
        block.lines.append("ydot[nq + nv] = w[POWER]")
        block.lines.append("if T[DRIVEN] != 0:")
        block.lines += [f"    for {INDEX} in range(m):"]
        block.lines += [f"        ydot[nq + nv] -= w[multipliers + {INDEX}] * w[nu + {INDEX}]"]
        block.names |= {"nq", "nv", "m", "multipliers", "nu"}

    def direct(self, law: Any) -> None:
        """Add a law that is a formula."""
        block = Block(self.system)
        self.rates(block, law.acceleration, law.multipliers)
        self.close(block)
        purpose = f"q', v', power and multipliers by {self.method.name}"
        if block.flagged:
            purpose += "; 1 where a pivot of S is suspicious"
        lines = (*self.begin(block), *block.lines)
        self.functions.append(LoopedFunction("rhs", purpose, lines, flagged=block.flagged))

    def iterated(self, law: Any) -> None:
        """Add a law that is iterated until v' changes no more."""
        self.form = "iterated"
        begin = Block(self.system)
        for factor in self.system.stored:
            begin.make(factor)
        for section, x in self.system.kept:
            begin.assign(section, x)
        for state in law.state:
            begin.assign(state.section, state.start)
        iterate = Block(self.system)
        following = [iterate.place(state.following) for state in law.state]
        increment = iterate.text(law.increment.dot(law.increment).parts)
        size = iterate.text(law.state[0].following.dot(law.state[0].following).parts)
        for state, target in zip(law.state, following, strict=True):
            iterate.loop(state.following.size, f"w[{state.section} + {INDEX}] = w[{target} + {INDEX}]")
            iterate.names.add(state.section)
        iterate.lines.append(f"w[INCREMENT] = math.sqrt({increment} / (1.0 + {size}))")
        finish = Block(self.system)
        final = [self.system.variable(s.section, s.following.size) for s in law.state]
        self.rates(finish, final[0], final[1])
        self.close(begin, iterate, finish)
        reads = Block(self.system)
        reads.names = begin.names | iterate.names | finish.names
        purpose = f"q', v', power and multipliers by {self.method.name}, iterated until v' changes no more"
        self.functions.append(
            LoopedFunction(
                "rhs", purpose, (*self.begin(reads), *begin.lines), tuple(iterate.lines), tuple(finish.lines)
            )
        )

    # -- metrics of corrections ----------------------------------------------------------------------------------------

    def metric(self, names: str, geometry: str, spread: str, lines: tuple[str, ...], change: tuple[str, ...]) -> None:
        """Add geometry and spread of another metric than the identity's."""
        begin = ("constrain(t, y, p, w, T)", "decide_rank(T, p, w)", *lines)
        self.functions.append(LoopedFunction("geometry", geometry, begin))
        self.functions.append(LoopedFunction("spread", spread, change))
        self.names |= set(names.split())
        self.helpers |= {"factorise", "solve", "columns_times"}

    def mass_metric(self) -> None:
        """Add geometry and spread in the metric of M: S = D M^-1 D^T, rows skipped as D D^T decides."""
        self.system.sections["law_lower"] = "gram"
        self.helpers |= {"weigh", "gram", "inverse_mass_times"}
        self.metric(
            "law_lower residual change m nv",
            "Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T",
            "the correction -D^+ times the section `residual`, of v, or of q by N",
            (
                "weigh(T, p, w)",
                "gram(T, p, w, 1, law_lower)",
                "factorise(T, p, w, GRAM_FACTOR, law_lower, KEPT_FACTOR)",
            ),
            (
                "for j in range(m):",
                "    w[x0 + j] = -w[residual + j]",
                "solve(T, p, w, GRAM_FACTOR, law_lower, x0)",
                "columns_times(T, p, w, x0, x1)",
                "inverse_mass_times(T, p, w, x1, change)",
            ),
        )

    def augmented_metric(self) -> None:
        """Add the mass-orthogonal projection by iterations with M + a D^T D; see `symgen.lower.law`."""
        self.system.sections |= {"law_lower": "augmented", "moved": "nv", "force_of_constraints": "m"}
        parts = self.system.penalties(self.system.parameter("penalty")).parts
        penalties = "".join(str(part) for part in parts)
        self.helpers |= {"augment", "mass_times"}
        self.vectors = max(self.vectors, 3)
        self.metric(
            "law_lower residual change moved force_of_constraints method_parameters mask m nv",
            "Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of M + a D^T D",
            "one iteration of the mass-orthogonal projection",
            (
                "for j in range(m):",
                f"    w[x0 + j] = {penalties}",
                "augment(T, p, w, x0, law_lower)",
                "factorise(T, p, w, AUGMENTED_FACTOR, law_lower, PLAIN_FACTOR)",
            ),
            (
                "for j in range(m):",
                f"    raised = {penalties} * w[residual + j]",
                "    w[force_of_constraints + j] += raised",
                "    w[x0 + j] = w[force_of_constraints + j] + raised",
                "columns_times(T, p, w, x0, x1)",
                "mass_times(T, p, w, moved, x2)",
                "for j in range(nv):",
                "    w[change + j] = -(w[x2 + j] + w[x1 + j])",
                "solve(T, p, w, AUGMENTED_FACTOR, law_lower, change)",
                "for j in range(nv):",
                "    w[moved + j] += w[change + j]",
            ),
        )
