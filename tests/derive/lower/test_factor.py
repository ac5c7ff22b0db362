"""The factorisation for known patterns, against dense linear algebra."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from support.checks import RANDOM, close
from support.graph_values import node_values

from symgen.base.ir.graph import Graph
from symgen.derive.lower.factor import factorise_symmetric, minimum_degree


def neighbours(pattern: np.ndarray) -> list[frozenset[int]]:
    return [frozenset(int(j) for j in np.flatnonzero(row) if j != i) for i, row in enumerate(pattern)]


def random_matrix(rng, n: int, density: float) -> np.ndarray:
    """Symmetric and positive definite with a random sparse pattern."""
    a = rng.normal(size=(n, n)) * (rng.random((n, n)) < density)
    a = np.tril(a, -1)
    a = a + a.T
    return a + np.diag(np.abs(a).sum(axis=1) + rng.uniform(0.1, 2.0, n))


def nodes_of(graph: Graph, a: np.ndarray, constants: np.ndarray | None = None):
    """Entries as inputs, or as literals where `constants` says so, and the values of the inputs."""
    matrix, values = {}, {}
    for i, j in np.argwhere(a != 0.0):
        low, high = sorted((int(i), int(j)))
        if constants is not None and constants[low, high]:
            matrix[int(i), int(j)] = graph.constant(float(a[i, j]))
        else:
            matrix[int(i), int(j)] = graph.input("a", low * len(a) + high)
            values["a", low * len(a) + high] = float(a[i, j])
    return matrix, values


@RANDOM
@given(seed=st.integers(0, 10**6), n=st.integers(1, 14), density=st.floats(0.0, 1.0), literal=st.floats(0.0, 1.0))
def test_factor_and_solve(seed, n, density, literal):
    rng = np.random.default_rng(seed)
    a, b, graph = random_matrix(rng, n, density), rng.normal(size=n), Graph()
    matrix, values = nodes_of(graph, a, rng.random((n, n)) < literal)
    order, _ = minimum_degree(neighbours(a != 0.0))
    factor = factorise_symmetric(graph, matrix, order, lambda _, pivot, __: graph.div(graph.one, pivot))
    right = [graph.input("b", i) for i in range(n)]
    found = node_values(graph, factor.solve(graph, right), values | {("b", i): x for i, x in enumerate(b)})
    close(found, np.linalg.solve(a, b), "x")
    # the factors themselves: P A P^T = L D L^T
    place = {row: k for k, row in enumerate(order)}
    lower, diagonal = np.eye(n), np.zeros(n)
    for k in order:
        entries = node_values(graph, [node for _, node in factor.lower[k]], values)
        for (i, _), x in zip(factor.lower[k], entries, strict=True):
            assert place[i] > place[k]
            lower[place[i], place[k]] = x
        diagonal[place[k]] = node_values(graph, [factor.pivots[k]], values)[0]
    close(lower @ np.diag(diagonal) @ lower.T, a[np.ix_(order, order)], "L D L^T")


@RANDOM
@given(seed=st.integers(0, 10**6), n=st.integers(1, 40), density=st.floats(0.0, 0.4))
def test_minimum_degree_is_a_permutation_and_the_same_again(seed, n, density):
    pattern = random_matrix(np.random.default_rng(seed), n, density) != 0.0
    order, below = minimum_degree(neighbours(pattern))
    assert sorted(order) == list(range(n))
    shuffled = [frozenset(sorted(s, reverse=True)) for s in neighbours(pattern)]
    assert minimum_degree(shuffled) == (order, below)


@RANDOM
@given(seed=st.integers(0, 10**6), n=st.integers(1, 25), density=st.floats(0.0, 0.6))
def test_each_pivot_has_the_fewest_rows_left_and_waits_least(seed, n, density):
    """The order by its definition, searched among all rows at every pivot; and the rows below each."""
    near = neighbours(random_matrix(np.random.default_rng(seed), n, density) != 0.0)
    graph, level, expected, rows = [set(s) for s in near], [0] * n, [], []
    while len(expected) < n:
        pivot = min(set(range(n)) - set(expected), key=lambda i: (len(graph[i]), level[i], i))
        expected.append(pivot)
        rows.append(graph[pivot])
        for i in graph[pivot]:
            graph[i] = (graph[i] | graph[pivot]) - {i, pivot}
            level[i] = max(level[i], level[pivot] + 1)
    order, below = minimum_degree(near)
    assert list(order) == expected and [set(s) for s in below] == rows


@RANDOM
@given(seed=st.integers(0, 10**6), n=st.integers(2, 40))
def test_trees_are_eliminated_without_fill(seed, n):
    rng = np.random.default_rng(seed)
    pattern = np.eye(n, dtype=bool)
    for i in range(1, n):
        j = int(rng.integers(i))
        pattern[i, j] = pattern[j, i] = True
    assert fill(pattern) == 0


def fill(pattern: np.ndarray) -> int:
    """Entries of L beyond those of the lower triangle."""
    graph = Graph()
    matrix = {(int(i), int(j)): graph.input("a", min(i, j) * len(pattern) + max(i, j)) for i, j in np.argwhere(pattern)}
    order, _ = minimum_degree(neighbours(pattern))
    factor = factorise_symmetric(graph, matrix, order, lambda _, pivot, __: graph.div(graph.one, pivot))
    return sum(map(len, factor.lower.values())) - (len(matrix) - len(pattern)) // 2
