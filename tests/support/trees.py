"""Rooted trees and the order conditions of Runge-Kutta schemes (Hairer, Norsett, Wanner I, section II.2)."""

from functools import cache

import numpy as np

Tree = tuple  # a tree is the sorted tuple of the trees that hang on its root


@cache
def trees(order: int) -> tuple[Tree, ...]:
    """All rooted trees with `order` nodes."""
    return forests(order - 1, order - 1)


@cache
def forests(nodes: int, largest: int) -> tuple[tuple[Tree, ...], ...]:
    """All multisets of trees with `nodes` nodes together, none larger than `largest`."""
    if nodes == 0:
        return ((),)
    found = {
        tuple(sorted((*rest, tree)))
        for size in range(1, min(nodes, largest) + 1)
        for tree in trees(size)
        for rest in forests(nodes - size, size)
    }
    return tuple(sorted(found))


def size(tree: Tree) -> int:
    return 1 + sum(map(size, tree))


def density(tree: Tree) -> int:
    """gamma(tree): its size times the densities of its branches."""
    result = size(tree)
    for branch in tree:
        result *= density(branch)
    return result


def stage_weights(tree: Tree, a: np.ndarray) -> np.ndarray:
    """Elementary weights of the stages: the product over the branches of A times theirs."""
    result = np.ones(len(a))
    for branch in tree:
        result = result * (a @ stage_weights(branch, a))
    return result


def largest_defect(a: np.ndarray, b: np.ndarray, order: int, x: float = 1.0, scale: float = 1.0) -> float:
    """Largest |b . weights - scale x^order / density| over all trees of one order."""
    return max(abs(float(b @ stage_weights(t, a)) - scale * x**order / density(t)) for t in trees(order))
