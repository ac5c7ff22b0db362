"""Formulas of a mechanism file: text to a tree, by recursive descent, and the tree's value.

The grammar is that of docs/file-format: numbers, names with at most one dot, ``+ - * / **``, comparisons and their
chains, ``and or not``, ``a if c else b``, calls. A tree is a tuple whose first item says what it is.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from benchmarks.plain.series import NAN, Number, called, divided, plain, power

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z]\w*(?:\s*\.\s*[A-Za-z]\w*)?)"
    r"|(?P<sign>\*\*|<=|>=|[-+*/<>(),]))"
)
Tree = tuple[Any, ...]


@dataclass(frozen=True)
class Lines:
    """A function of one argument: straight lines between points, constant beyond the ends."""

    x: tuple[float, ...]
    y: tuple[float, ...]

    def __call__(self, at: float) -> float:
        """Return the value at a number."""
        return float(np.interp(at, self.x, self.y))


@lru_cache(maxsize=4096)
def parsed(text: str) -> Tree:
    """Return the tree of a formula.

    Raises
    ------
    ValueError
        If the text is no formula.
    """
    return _Reader(text).whole()


class _Reader:
    def __init__(self, text: str) -> None:
        self.tokens: list[tuple[str, str]] = []
        position = 0
        text = text.strip()
        while position < len(text):
            match = _TOKEN.match(text, position)
            if match is None:
                raise ValueError(f"no formula: {text!r} at {position}")
            kind = str(match.lastgroup)
            self.tokens.append((kind, re.sub(r"\s", "", match.group(kind))))
            position = match.end()
        self.tokens.append(("end", ""))
        self.at = 0

    def word(self) -> str:
        return self.tokens[self.at][1]

    def take(self, *words: str) -> str | None:
        if self.tokens[self.at][0] != "number" and self.word() in words:
            self.at += 1
            return self.tokens[self.at - 1][1]
        return None

    def need(self, word: str) -> None:
        if self.take(word) is None:
            raise ValueError(f"expected {word!r}, found {self.word()!r}")

    def whole(self) -> Tree:
        tree = self.choice()
        if self.tokens[self.at][0] != "end":
            raise ValueError(f"{self.word()!r} stands behind a formula")
        return tree

    def choice(self) -> Tree:
        yes = self.disjunction()
        if self.take("if") is None:
            return yes
        condition = self.disjunction()
        self.need("else")
        return ("if", condition, yes, self.choice())

    def disjunction(self) -> Tree:
        tree = self.conjunction()
        while self.take("or"):
            tree = ("or", tree, self.conjunction())
        return tree

    def conjunction(self) -> Tree:
        tree = self.negation()
        while self.take("and"):
            tree = ("and", tree, self.negation())
        return tree

    def negation(self) -> Tree:
        return ("not", self.negation()) if self.take("not") else self.comparison()

    def comparison(self) -> Tree:
        left = self.sum()
        tree: Tree | None = None
        while sign := self.take("<", "<=", ">", ">="):
            right = self.sum()
            link = (sign, left, right)
            tree = link if tree is None else ("and", tree, link)
            left = right
        return left if tree is None else tree

    def sum(self) -> Tree:
        tree = self.product()
        while sign := self.take("+", "-"):
            tree = (sign, tree, self.product())
        return tree

    def product(self) -> Tree:
        tree = self.signed()
        while sign := self.take("*", "/"):
            tree = (sign, tree, self.signed())
        return tree

    def signed(self) -> Tree:
        if sign := self.take("-", "+"):
            inner = self.signed()
            return ("minus", inner) if sign == "-" else inner
        base = self.atom()
        return ("**", base, self.signed()) if self.take("**") else base

    def atom(self) -> Tree:
        kind, word = self.tokens[self.at]
        if self.take("("):
            tree = self.choice()
            self.need(")")
            return tree
        self.at += 1
        if kind == "number":
            return ("number", float(word))
        if kind != "name":
            raise ValueError(f"{word!r} is no number and no name")
        if self.take("("):
            arguments = [self.choice()]
            while self.take(","):
                arguments.append(self.choice())
            self.need(")")
            return ("call", word, tuple(arguments))
        return ("name", word)


def value(tree: Tree, names: Mapping[str, Number], tables: Mapping[str, Lines] | None = None) -> Number:
    """Return the value of a tree.

    Parameters
    ----------
    tree : tuple
        From `parsed`.
    names : mapping
        A number, or a series, for every name.
    tables : mapping, optional
        The tables that may be called; their values carry no derivatives.
    """
    kind = tree[0]
    if kind == "number":
        return float(tree[1])
    if kind == "name":
        return np.pi if tree[1] == "pi" else names[tree[1]]
    if kind in ("if", "or", "and", "not", "<", "<=", ">", ">="):
        return _chosen(tree, names, tables)
    if kind == "call":
        return _call(tree[1], tree[2], names, tables)
    a = value(tree[1], names, tables)
    if kind == "minus":
        return -a
    b = value(tree[2], names, tables)
    if kind == "+":
        return a + b
    if kind == "-":
        return a - b
    if kind == "*":
        return a * b
    if kind == "/":
        return divided(a, b) if isinstance(a, float) and isinstance(b, float) else a / b
    return power(a, b)


def _chosen(tree: Tree, names: Mapping[str, Number], tables: Mapping[str, Lines] | None) -> Number:
    """Return a choice, or a condition as 1, 0 or nan: what is asked of nan has no answer."""
    kind = tree[0]
    if kind == "if":
        condition = plain(value(tree[1], names, tables))
        if np.isnan(condition):
            return NAN
        return value(tree[2] if condition else tree[3], names, tables)
    a = plain(value(tree[1], names, tables))
    if kind == "not":
        return NAN if np.isnan(a) else float(not a)
    b = plain(value(tree[2], names, tables))
    if np.isnan(a) or np.isnan(b):
        return NAN
    if kind in ("and", "or"):
        return float(bool(a) and bool(b)) if kind == "and" else float(bool(a) or bool(b))
    return float({"<": a < b, "<=": a <= b, ">": a > b, ">=": a >= b}[kind])


def _call(
    name: str, arguments: tuple[Tree, ...], names: Mapping[str, Number], tables: Mapping[str, Lines] | None
) -> Number:
    if name == "piecewise":
        tree = arguments[-1]
        for condition, result in zip(arguments[-3::-2], arguments[-2::-2], strict=True):
            tree = ("if", condition, result, tree)
        return value(tree, names, tables)
    if tables is not None and name in tables:
        return tables[name](plain(value(arguments[0], names, tables)))
    return called(name, [value(argument, names, tables) for argument in arguments])
