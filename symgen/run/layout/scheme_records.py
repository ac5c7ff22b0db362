"""Records of schemes for loops: their coefficients and the Newton matrices that they factorise."""

from __future__ import annotations

from symgen.compile.native.annotations import Array, Integers, Record, record_type
from symgen.run.layout import abi


class TableauRecord(Record):
    """An explicit Runge-Kutta scheme.

    Attributes
    ----------
    start, column, value : Array
        Nonzero coefficients row by row: the stages, b, the stages of dense output, then the error weights. Row r has
        the entries from ``start[r]`` to ``start[r + 1]``.
    nodes : Array
        c of all stages, 1 for the end of the step after those of the scheme.
    dense : Array, shape (degree, padded stages), flat
        y(t + x h) = y + h sum_k K_k sum_j dense[j, k] x^(j + 1); empty without dense output.
    count : Array of int64
        0, 1, 2, ... for all stages.
    stages, estimates, order, degree : int
        Stages of a step, error estimates, the order of the estimate, and the degree of dense output.
    ends : int
        1 where an error estimate needs the stage at the end of the step.
    """

    start: Integers
    column: Integers
    value: Array
    nodes: Array
    dense: Array
    count: Integers
    stages: int
    estimates: int
    order: int
    degree: int
    ends: int


class Rotations(Record):
    """A tableau applied to rotation vectors.

    Attributes
    ----------
    tableau : TableauRecord
        The scheme.
    spins : Array of int64
        First index of the angular velocity of each body in v.
    width : int
        Length of a stage.
    """

    tableau: TableauRecord
    spins: Integers
    width: int


class Screws(Record):
    """A tableau applied to screws: as `Rotations`, and first indices of Euler parameters and omega of free bodies."""

    tableau: TableauRecord
    spins: Integers
    bodies: Integers
    width: int


class Multistep(Record):
    """An Adams scheme: its highest order, and Gauss' quadrature on (-1, 1); `count` holds 0, 1, 2, ..."""

    nodes: Array
    factors: Array
    count: Integers
    order: int


class Stages(Record):
    """An implicit Runge-Kutta scheme on the descriptor form.

    Attributes
    ----------
    a, b, c : Array
        The tableau, `a` row by row.
    errors : Array, shape (s + 1,)
        Weights of the error estimate on the derivatives at the beginning of the step and of the stages.
    filtered : float
        The estimate is filtered by ``(dF/dk + h filtered dF/dy)^-1 dF/dk``; 0: it is not filtered.
    stages, together, order : int
        Stages, 1 where they are solved together, and the order of the estimate.
    entries : Array of int64
        Equation of each number that ``tangent`` writes, then its unknown.
    slopes : Array
        Output of ``tangent`` in each stage; the last element is 1.
    numbers, plan, filter_numbers, filter_plan : Array
        Of the Newton matrix, and of one stage's matrix (`symgen.run.loops.newton.stage_plan`).
    """

    a: Array
    b: Array
    c: Array
    errors: Array
    filtered: float
    stages: int
    together: int
    order: int
    entries: Integers
    slopes: Array
    numbers: Array
    plan: Integers
    filter_numbers: Array
    filter_plan: Integers


class Backward(Stages):
    """A backward differentiation scheme on the descriptor form, with the implicit scheme that starts it.

    Its one stage has the pattern of the starter's filter, whose plan and numbers it takes.

    Attributes
    ----------
    highest : int
        Highest order.
    """

    highest: int


class Linear(Stages):
    """A linearly implicit scheme: `filtered` is its gamma, one stage has the pattern of the filter.

    Attributes
    ----------
    carried : Array, shape (s * s,)
        Weights c_ij of the stages before, over h.
    drifts : Array, shape (s,)
        Weights of the derivative with respect to t.
    """

    carried: Array
    drifts: Array


class Alpha(Record):
    """A scheme of Newmark's family, with the sources, numbers and plan of its Newton matrix."""

    alpha_m: float
    alpha_f: float
    gamma: float
    beta: float
    slopes: Array
    numbers: Array
    plan: Integers


class Projection(Record):
    """The trapezoidal rule with projections.

    Attributes
    ----------
    penalty : int
        Index of the requested penalty in ``p``.
    slopes, numbers, plan : Array
        Of W, see `symgen.run.loops.newton.projection_plan`.
    pulls : Array of int64
        Row, velocity and source of each entry of D^T.
    nonholonomic : Array
        1 for rows without Phi, else 0.
    """

    penalty: int
    slopes: Array
    numbers: Array
    plan: Integers
    pulls: Integers
    nonholonomic: Array


class ConstrainedStages(Record):
    """An explicit scheme whose stages meet constraints by forces along D^T.

    Attributes
    ----------
    a, c : Array
        The tableau, row by row, its last row being b, and the nodes, the last one 1.
    stages : int
        Number of stages.
    spins : Array of int64
        First index of the angular velocity of each body in v.
    nonholonomic : Array
        1 for rows without Phi, else 0.
    slopes, numbers, plan : Array
        Of M and D, see `symgen.run.loops.newton.acceleration_plan`.
    """

    a: Array
    c: Array
    stages: int
    spins: Integers
    nonholonomic: Array
    slopes: Array
    numbers: Array
    plan: Integers


class PartitionedStages(Record):
    """An explicit pair whose stages close states of their own.

    Attributes
    ----------
    a, c : Array
        Stages row by row, and their nodes.
    closing, closed : Array
        States that the multipliers of the stages close, row by row, the last one at the end, and their nodes.
    embedded : Array
        Weights of the embedded scheme on the stages and on the rate at the end.
    stages, order : int
        Number of stages, and order of the estimate.
    spins : Array of int64
        First index of the angular velocity of each body in v.
    slopes, numbers, plan : Array
        Of M and D, see `symgen.run.loops.newton.acceleration_plan`.
    """

    a: Array
    c: Array
    closing: Array
    closed: Array
    embedded: Array
    stages: int
    order: int
    spins: Integers
    slopes: Array
    numbers: Array
    plan: Integers


class Symmetric(Record):
    """A symmetric scheme between projections of its model.

    Attributes
    ----------
    geometry, measure, spread : function
        Emitted functions of the model.
    share, residual : int
        Index in ``p`` of the part of the projection at the beginning, and the first one of the section in ``w``.
    nonholonomic : Array
        1 for rows without Phi, else 0.
    """

    geometry: abi.Measure
    measure: abi.Measure
    spread: abi.Move
    share: int
    residual: int
    nonholonomic: Array


class Nodes(Record):
    """A collocation scheme whose rates are unknown at all nodes of a step at once.

    Attributes
    ----------
    derive : function
        ``derive(t, y, p, w, ydot)``, the right-hand side at all nodes (`symgen.compile.native.node_functions`).
    vector : int
        1 where this function exists, 0 where the right-hand side is evaluated at one node after another.
    rows : Array of int64
        As for `symgen.compile.loopcode.nodes`.
    table, middle : Array
        Coefficients of states at the nodes, and at points between them.
    share : Array
        Weights of the nodes in an integral over the step.
    legendre : Array, shape (9, 16), flat
        Coefficients of Legendre polynomials from rates.
    dense : Array, shape (200,)
        Table of `symgen.compile.loopcode.nodes.refine`.
    degree : int
        Of the polynomial by which rates of a step are predicted from those of the step before.
    tableau : TableauRecord
        The scheme of steps across singular positions.
    """

    derive: abi.Derive
    vector: int
    rows: Integers
    table: Array
    middle: Array
    share: Array
    legendre: Array
    dense: Array
    degree: int
    tableau: TableauRecord


#: Fields of schemes' records that belong to the state of a run.
KEPT = ("numbers", "plan", "filter_numbers", "filter_plan")

#: Types of the records in compiled loops.
TABLEAU, ROTATIONS, SCREWS, MULTISTEP = map(record_type, (TableauRecord, Rotations, Screws, Multistep))
STAGES, ALPHA, NODES, CONSTRAINED = map(record_type, (Stages, Alpha, Nodes, ConstrainedStages))
PARTITIONED, SYMMETRIC, PROJECTION = map(record_type, (PartitionedStages, Symmetric, Projection))
BACKWARD, LINEAR = map(record_type, (Backward, Linear))
