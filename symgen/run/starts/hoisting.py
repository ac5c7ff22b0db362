"""What looped code computes once a run besides its kernels: constant parts of D D^T, and the diagonal of M."""

from __future__ import annotations

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers


@exact(entry=True, once=True)
def sum_products(
    places: Integers, targets: Integers, velocities: Integers, products: Array, ones: Integers, p: Array
) -> int:
    """Write the entries of D D^T and D M^-1 D^T that are constant.

    `places`: where both begin, their length, and where the diagonal of M^-1 begins. A product of `products` belongs to
    an entry of `targets` and to a velocity of `velocities`; `ones` are the diagonal elements of rotors.
    """
    plain, weighed, size, inverse = places[0], places[1], places[2], places[3]
    for k in range(size):
        p[plain + k] = 0.0
        p[weighed + k] = 0.0
    for k in range(targets.shape[0]):
        p[plain + targets[k]] += products[k]
        p[weighed + targets[k]] += products[k] * p[inverse + velocities[k]]
    for k in range(ones.shape[0]):
        p[plain + ones[k]] = 1.0
        p[weighed + ones[k]] = 1.0
    return 0


@exact(entry=True, once=True)
def copy_masses(places: Integers, added: Integers, p: Array, w: Array) -> int:
    """Write the diagonal of M to its section.

    `places`: where it is in `p`, where the section begins, its size. `added`: pairs of an element and the number of `p`
    that is added to it.
    """
    first, offset, size = places[0], places[1], places[2]
    for k in range(size):
        w[offset + k] = p[first + k]
    for k in range(added.shape[0] // 2):
        w[offset + added[2 * k]] += p[added[2 * k + 1]]
    return 0
