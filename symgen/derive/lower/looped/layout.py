"""Layout of the looped shape: the numbers at the head of the tables, sections of ``w`` and parts of ``p``.

Generic code contains no size: it reads sizes and offsets from the head of the tables, which are at the
end of ``w`` as unsigned 32-bit numbers; the last element of ``w`` is their beginning, as an integer.
"""

from __future__ import annotations

from symgen.base.ir.program import SECTIONS as SHARED

#: Sections of ``w`` that every law has, with their sizes in words of `symgen.derive.lower.looped.shape.Shape.sizes`.
SECTIONS = (
    *SHARED,
    *(("lower", "gram"), ("records", "records"), ("force", "nv"), ("gamma", "m"), ("phi", "m")),
    *(("left", "jacobian"), ("diagonal", "longest"), ("panel", "panel"), ("kept_rows", "m")),
    ("stage", "unknowns"),  # k of the descriptor form
)

#: Lists of kernels that are called in turn, and the functions of kernels that each calls, by kind.
STAGES: dict[str, tuple[tuple[str, str], ...]] = {
    "frames": (("body", "frame"),),
    "speeds": (("body", "speeds"),),
    "rates": (("body", "rates"), ("state", "rates")),
    "move": (("body", "move"),),
    "turn": (("body", "turn"),),
    "normalise": (("body", "normalise"),),
    "wind": (("joint", "wind"), ("force", "wind")),
    "geometry": (("joint", "geometry"), ("bound", "geometry")),
    "motion": (("body", "motion"), ("joint", "motion"), ("bound", "motion"), ("force", "motion")),
    "full": (("body", "motion"), ("joint", "full"), ("bound", "full"), ("force", "motion")),
    "energy": (("body", "energy"), ("force", "energy")),
    "report": (("joint", "report"),),
    "residuals": tuple((kind, "residual") for kind in ("body", "joint", "bound", "force", "state")),
    "slopes": tuple((kind, "tangent") for kind in ("body", "joint", "bound", "force", "state")),
}

#: Numbers at the head of the tables: sizes, parts of ``p``, sections of ``w``, then the beginnings of tables.
HEAD = (
    *("nq", "nv", "m"),
    *("method_parameters", "mass_diagonal", "inverse_mass", "gram_base"),
    *(name for name, _ in SECTIONS),
    "unknowns",  # length of k
    "equations",  # length of F with the rows after it
    "vectors",  # scratch vectors of a law, each as long as the longer of v and lambda
    "vector_size",
    *STAGES,
    *("jacobian_rows", "jacobian_columns", "jacobian_size", "angular_rows", "weights", "mass_blocks"),
    *("gram_terms", "gram_factor", "gram_size", "augmented_terms", "augmented_factor", "augmented_size"),
    *("driven", "joint_coordinates"),
    "tables",  # where the tables begin in w
    "generic",  # where the addresses of generic code begin, in 64-bit numbers
)

#: Generic functions that are called through the tables, in the order of their addresses.
GENERIC = ("rows_times", "columns_times", "blocks_times", "weigh", "gauge", "gram", "augment", "factorise", "solve")
