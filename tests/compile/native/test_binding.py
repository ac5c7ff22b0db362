"""Functions bound to one model: what is constant for it is folded, every bit stays, and the code is small."""

import ctypes
import subprocess
from functools import cached_property

import pytest

from compile.native import printed
from symgen import load
from symgen.compile.loopcode.exact import plain_form
from symgen.compile.native import language as lang
from symgen.compile.native.binding import bind_functions
from symgen.compile.native.c99 import c_functions
from symgen.compile.native.folding import walk_statements
from symgen.run.compiling.checked import checked_function
from symgen.run.compiling.printed_meanings import meanings_of_names, source_of_piece
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.probe import Ready
from symgen.run.starts import assembler, decisions
from symgen.run.starts.assembler import Assembly
from symgen.run.starts.starting import close_row

KINDS = (abi.MEASURE, abi.MEASURE, abi.MOVE, abi.MOVE, None, None, None, None, abi.RHS, abi.OBSERVE)
NAMES = ("geometry", "measure", "move", "spread", "solve", "formulas", "project", "turns", "rhs")
HEAD = printed.HEAD + "#define FINE(x, y) x\n"


class Bound:
    """The bound start of a model as C, with its memory."""

    def __init__(self, compiled, layout, table, others, folder):
        joints, now, conditions, work = others
        *own, observe = Assembly(compiled).own
        emitted = {
            id(f): checked_function(f, kind)
            for f, kind in zip((*own, observe), KINDS, strict=True)
            if hasattr(f, "read")
        }
        arguments = ((layout, table, *own), observe, joints), now, conditions, work

        def room(name):
            owner, _, own = name.partition(".")
            return own if owner == "now" else f"{owner}_{own}" if owner in ("work", "conditions") else None

        meanings = meanings_of_names(close_row, arguments, emitted, room)
        passed = frozenset(f.key for f in emitted.values())
        self.functions = bind_functions({"close_row": (source_of_piece(close_row), meanings)}, passed)
        names = {f.name: f for f in emitted.values()}
        self.source, self.object = folder / "bound.c", folder / "bound.o"
        members = " ".join(
            f"{'real' if kind == 'float' else 'int'} {name}[{size}];"
            for name, (kind, size) in self.functions.memory.items()
        )
        text = c_functions(names, self.functions, "struct memory")
        start = "int start(struct memory *model) { return close_row(model); }\n"
        for name, function in names.items():
            kinds = [f"{'real *' if p.array else 'real '}{p.name}" for p in function.parameters]
            own = ", ".join(p.name for p in function.parameters)
            start += f"int call_{name}({', '.join(kinds)}) {{ return {name}({own}); }}\n" if name != "rhs" else ""
        self.source.write_text(f"{HEAD}struct memory {{ {members} }};\n{text}\n{start}")

    def compile(self, *options):
        command = ["cc", "-std=c99", "-ffp-contract=off", "-Wall", "-Wextra", "-Wno-unused-function", *options]
        built = subprocess.run(
            [*command, str(self.source), "-o", str(self.object), "-lm"], capture_output=True, text=True
        )
        assert built.returncode == 0 and not built.stderr, built.stderr
        return self.object

    def size(self):
        """Size of the code [bytes]."""
        lines = subprocess.run(["size", str(self.compile("-Os", "-c"))], capture_output=True, text=True, check=True)
        return int(lines.stdout.splitlines()[1].split()[0])

    @cached_property
    def library(self):
        """The printed functions."""
        return ctypes.CDLL(str(self.compile("-O1", "-shared", "-fPIC")))

    def printed(self, name, function):
        """A function of the runtime, or the printed form of an emitted one."""
        own = getattr(self.library, f"call_{name}", None)
        if own is None or not isinstance(function, Ready):
            return function

        def call(*arguments):
            kinds = (ctypes.c_double if isinstance(a, float) else ctypes.c_void_p for a in arguments)
            values = (a if isinstance(a, float) else a.ctypes.data for a in arguments)
            return own(*(kind(value) for kind, value in zip(kinds, values, strict=True)))

        return call

    def close(self, now, conditions):
        """Close the arrays of a start in place; return the code."""
        kinds = {"float": ctypes.c_double, "int": ctypes.c_int}
        memory = self.functions.memory

        class Memory(ctypes.Structure):
            _fields_ = [(name, kinds[kind] * size) for name, (kind, size) in memory.items()]

        room = Memory()
        given = {**now._asdict(), **{f"conditions_{k}": x for k, x in conditions._asdict().items()}}
        for name, array in given.items():
            if name in memory:
                getattr(room, name)[:] = array.tolist()
        code = self.library.start(ctypes.byref(room))
        for name, array in given.items():
            if name in memory:
                array[:] = getattr(room, name)[:]
        return code


def starts_of(name, tmp_path, monkeypatch, compare):
    """Make the start of a mechanism in plain Python; `compare` has the bound one and what both begin from."""
    model = load(name)
    compiled = model.compile("lagrange", shape="straight")

    def both(*arguments):
        ((layout, table, *_), _, joints), now, conditions, work = printed.copied(arguments[:4])
        bound = Bound(compiled, layout, table, (joints, now, conditions, work), tmp_path)
        (first, second, *functions), *others = arguments[0]
        functions = [bound.printed(n, f) for n, f in zip(NAMES, functions, strict=True)]
        done = plain(((first, second, *functions), *others), *arguments[1:])
        compare(bound, (now, conditions), printed.arrays(arguments[1:3]))
        return done

    plain = plain_form(assembler.close_alone)
    monkeypatch.setattr(assembler, "close_alone", both)
    monkeypatch.setattr(decisions, "LARGEST_INTERPRETED", 10**9)
    model.assemble(compiled)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "pendulum", "driven-four-bar", "spatial-slider-crank"])
def test_bits_are_those_of_plain_python(name, tmp_path, monkeypatch):
    def compare(bound, given, after):
        assert bound.close(*given) == e.ASSEMBLED
        printed.assert_same_bits(printed.arrays(given), after)

    starts_of(name, tmp_path, monkeypatch, compare)


#: Code of a start with the emitted functions that it calls, at -Os, and without them [bytes].
SIZES = {"four-bar": 14_000, "bricard": 90_000}


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", SIZES)
def test_code_is_small(name, tmp_path, monkeypatch):
    def compare(bound, given, after):
        assert bound.size() < SIZES[name]
        for function in bound.functions.functions.values():
            assert not function.parameters

    starts_of(name, tmp_path, monkeypatch, compare)


@pytest.mark.slow
def test_what_is_constant_is_no_argument(tmp_path, monkeypatch):
    """Without held coordinates nothing is left of them; one function serves all arrays that it is called with."""

    def compare(bound, given, after):
        (own,) = bound.functions.functions.values()
        every, called = {}, [own]
        while called:
            function = called.pop()
            every[function.name] = function
            called += function.called
        assert {"close_positions", "least_norm_above", "mask_redundant"} < every.keys()
        assert not {"close_at_once", "fill_further", "is_light", "choose_turns"} & every.keys()
        assert [p.name for p in every["least_norm_above"].parameters if not p.array] == []
        lengths = [
            x for f in every.values() for x in walk_statements(f.body) if isinstance(x, lang.ArrayLength | lang.Invoke)
        ]
        assert not lengths

    starts_of("four-bar", tmp_path, monkeypatch, compare)
