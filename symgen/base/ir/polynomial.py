"""Normal form of sums and products in sines, cosines and other numbers: like terms together, sin^2 = 1 - cos^2.

Entries of reduced matrices hold constants that only such a form shows: sums of squares of sines and cosines, and
differences of equal terms. Sums that contain coordinates stay whole: a small difference of positions, multiplied by a
large number, is not taken apart. Coefficients are whatever depends on no state, as nodes.
"""

from __future__ import annotations

from collections.abc import Iterable

from symgen.base.ir.graph import PARAMETER, Graph

#: Powers of nodes, in increasing order of node.
Monomial = tuple[tuple[int, int], ...]
#: Coefficients, as nodes, of monomials.
Polynomial = dict[Monomial, int]

#: Most terms of a polynomial; longer ones stay as they are.
MOST_TERMS = 40
#: Most products of terms that are tried for one product of polynomials.
_MOST_PRODUCTS = 4 * MOST_TERMS


class NormalForms:
    """Normal forms of the nodes of a graph."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self._polynomials: dict[int, Polynomial | None] = {}
        self._whole: dict[int, bool] = {}
        self._simpler: dict[int, int] = {}

    def simpler(self, node: int) -> int:
        """Return the cheaper of a node and its normal form."""
        if node not in self._simpler:
            polynomial, result = self._polynomial(node), node
            if polynomial is not None:
                written = self._write_polynomial(polynomial)
                if self._cost(written) < self._cost(node):
                    result = written
            self._simpler[node] = self._simpler[result] = result
        return self._simpler[node]

    def _is_coefficient(self, node: int) -> bool:
        return self.graph.depends[node] in (0, PARAMETER)

    def _is_sine_or_cosine(self, node: int) -> bool:
        return self.graph.nodes[node].op in ("sin", "cos")

    def _cost(self, node: int) -> int:
        """Return the operations of a node, without sines and what depends on no state."""
        leaves = {
            n
            for n in self.graph.required_nodes([node], self._is_leaf)
            if self._is_leaf(n) or self.graph.nodes[n].op == "input"
        }
        return len(self.graph.required_nodes([node], self._is_leaf)) - len(leaves)

    def _is_leaf(self, node: int) -> bool:
        return self._is_coefficient(node) or self._is_sine_or_cosine(node)

    # -- from nodes ----------------------------------------------------------------------------------------------------

    def _polynomial(self, node: int) -> Polynomial | None:
        """Return the polynomial of a node, None where it is too long."""
        for n in self.graph.required_nodes([node], lambda n: n in self._polynomials or self._is_coefficient(n)):
            if n not in self._polynomials:
                self._polynomials[n] = self._polynomial_of_operation(n)
        return self._polynomials[node]

    def _polynomial_of_operation(self, node: int) -> Polynomial | None:
        g = self.graph
        if node == g.zero:
            return {}
        if self._is_coefficient(node):
            return {(): node}
        op, args, _ = g.nodes[node]
        if op not in ("add", "sub", "mul", "neg") or (op in ("add", "sub") and self._holds_position(node)):
            return {((node, 1),): g.one}
        parts = [self._polynomials[a] for a in args]
        first = parts[0]
        if first is None or any(p is None for p in parts):
            return None
        if op == "neg":
            return {monomial: g.neg(c) for monomial, c in first.items()}
        second = parts[1]
        assert second is not None
        if op == "mul":
            return self._multiply_polynomials(first, second)
        signed = second.items() if op == "add" else ((m, g.neg(c)) for m, c in second.items())
        return self._add_polynomials(first, signed)

    def _holds_position(self, node: int) -> bool:
        """Whether a coordinate, or a number that a run sets, is in a node outside of sines."""
        g = self.graph
        for n in g.required_nodes([node], lambda n: n in self._whole):
            if n not in self._whole:
                op, args, payload = g.nodes[n]
                if op == "input":
                    self._whole[n] = isinstance(payload, tuple) and payload[0] in ("q", "status", "parameter")
                else:
                    self._whole[n] = not self._is_sine_or_cosine(n) and any(self._whole[a] for a in args)
        return self._whole[node]

    def _add_polynomials(self, first: Polynomial, terms: Iterable[tuple[Monomial, int]]) -> Polynomial | None:
        result = dict(first)
        for monomial, coefficient in terms:
            total = self.graph.add(result.get(monomial, self.graph.zero), coefficient)
            if total == self.graph.zero:
                result.pop(monomial, None)
            else:
                result[monomial] = total
        return result if len(result) <= MOST_TERMS else None

    def _multiply_polynomials(self, first: Polynomial, second: Polynomial) -> Polynomial | None:
        if len(first) * len(second) > _MOST_PRODUCTS:
            return None
        g, terms = self.graph, list[tuple[Monomial, int]]()
        for a, x in first.items():
            for b, y in second.items():
                coefficient = g.mul(x, y)
                terms += (
                    (m, coefficient if sign > 0 else g.neg(coefficient)) for m, sign in self._multiply_monomials(a, b)
                )
        return self._add_polynomials({}, terms)

    def _multiply_monomials(self, a: Monomial, b: Monomial) -> list[tuple[Monomial, int]]:
        """Return the product of two monomials as monomials with signs, squares of sines replaced."""
        powers = dict(a)
        for node, power in b:
            powers[node] = powers.get(node, 0) + power
        self._cancel_reciprocals(powers)
        done: list[tuple[Monomial, int]] = []
        waiting = [(powers, 1)]
        while waiting:
            powers, sign = waiting.pop()
            sine = next((n for n, p in powers.items() if p >= 2 and self.graph.nodes[n].op == "sin"), None)
            if sine is None:
                done.append((tuple(sorted(powers.items())), sign))
                continue
            rest = powers | {sine: powers[sine] - 2}
            if not rest[sine]:
                del rest[sine]
            cosine = self.graph.call("cos", self.graph.nodes[sine].args[0])
            waiting += [(rest | {cosine: rest.get(cosine, 0) + 2}, -sign), (rest, sign)]
        return done

    def _cancel_reciprocals(self, powers: dict[int, int]) -> None:
        """Take numbers and their reciprocals out of a product in pairs."""
        for node in list(powers):
            op, args, _ = self.graph.nodes[node]
            if op == "div" and args[0] == self.graph.one and args[1] in powers:
                pairs = min(powers[node], powers[args[1]])
                for x in (node, args[1]):
                    powers[x] -= pairs
                    if not powers[x]:
                        del powers[x]

    # -- to nodes ------------------------------------------------------------------------------------------------------

    def _write_polynomial(self, polynomial: Polynomial) -> int:
        """Return the node of a polynomial, written with common factors: equal sums of sines are formed once."""
        g = self.graph
        sums: dict[tuple[int, Monomial], dict[Monomial, int]] = {}
        for monomial, coefficient in polynomial.items():
            turning = tuple(x for x in monomial if self._is_sine_or_cosine(x[0]))
            others = tuple(x for x in monomial if not self._is_sine_or_cosine(x[0]))
            sign, size = self._sign_and_size(coefficient)
            sums.setdefault((size, others), {})[turning] = sign
        factors: dict[tuple[tuple[Monomial, int], ...], list[tuple[int, int, Monomial]]] = {}
        for (size, others), terms in sums.items():
            items = sorted(terms.items())
            sign = items[0][1]
            factors.setdefault(tuple((m, s * sign) for m, s in items), []).append((sign, size, others))
        products = list[tuple[int, int]]()
        for turned, multiples in factors.items():
            inner = self._signed_sum((sign, self._power_product(m)) for m, sign in turned)
            if len(multiples) == 1:  # coefficient and sines first, which may be multiplied by other velocities, too
                ((sign, size, others),) = multiples
                if len(factors) == 1:  # a difference that depends on no state takes the sign
                    sign, size = 1, size if sign > 0 else g.neg(size)
                products.append((sign, g.mul(g.mul(size, inner), self._power_product(others))))
            else:
                outer = self._signed_sum((sign, g.mul(size, self._power_product(m))) for sign, size, m in multiples)
                products.append((1, g.mul(outer, inner)))
        return self._signed_sum(products)

    def _signed_sum(self, terms: Iterable[tuple[int, int]]) -> int:
        """Return the sum of nodes with signs, positive ones first, so that it needs no sign of its own."""
        g, total = self.graph, self.graph.zero
        for sign, node in sorted(terms, key=lambda term: -term[0]):
            total = g.add(total, node) if sign > 0 else g.sub(total, node)
        return total

    def _power_product(self, monomial: Monomial) -> int:
        g, product = self.graph, self.graph.one
        for node, power in monomial:
            for _ in range(power):
                product = g.mul(product, node)
        return product

    def _sign_and_size(self, coefficient: int) -> tuple[int, int]:
        """Return sign and size of a coefficient; of two opposite differences one has the sign -1."""
        g = self.graph
        value, (op, args, _) = g.value(coefficient), g.nodes[coefficient]
        if value is not None:
            return (-1, g.neg(coefficient)) if value < 0.0 else (1, coefficient)
        if op == "neg":
            return -1, args[0]
        if op == "sub" and args[0] > args[1]:
            return -1, g.neg(coefficient)
        return 1, coefficient
