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

#: Kinds of elements, in the order of instances.
KINDS = ("body", "joint", "bound", "drag", "rotor", "force", "state")

#: Lists of kernels that are called in turn, and the functions of kernels that each calls, by kind.
STAGES: dict[str, tuple[tuple[str, str], ...]] = {
    "frames": (("body", "frame"),),
    "speeds": (("body", "speeds"),),
    "rates": (("body", "rates"), ("state", "rates")),
    "move": (("body", "move"),),
    "turn": (("body", "turn"),),
    "normalise": (("body", "normalise"),),
    "wind": (("joint", "wind"), ("bound", "wind"), ("force", "wind")),
    "geometry": (("joint", "geometry"), ("bound", "geometry"), ("rotor", "geometry")),
    "motion": (("body", "motion"), *((kind, "motion") for kind in ("joint", "bound", "rotor", "force"))),
    "full": (("body", "motion"), ("joint", "full"), ("bound", "full"), ("rotor", "motion"), ("force", "motion")),
    "energy": (("body", "energy"), ("rotor", "energy"), ("force", "energy")),
    "report": (("joint", "report"),),
    "residuals": tuple((kind, "residual") for kind in KINDS),
    "slopes": tuple((kind, "tangent") for kind in KINDS),
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

#: Numbers at the head of further tables, of rotors and of drags, which begin where the number before the table of the
#: factorisation of D W D^T says. Of rotors: how many there are, and the length of a factor; the sections of ``w`` for a
#: vector of them and for the factor; then the beginnings of tables.
ROTORS = (
    *("rotors", "rotor_size", "rotor_vector", "rotor_lower"),
    *("rotor_rows", "rotor_weights", "rotor_products", "rotor_beside", "rotor_augmented", "rotor_factor"),
)
#: Of drags, efforts that depend on reactions: how many there are, the list of their kernels, then sections of ``w``:
#: what kernels write of each, squares of jamming numbers, numbers for their solution; the table of their modes.
DRAGS = ("drags", "press", "drag_record", "jamming", "drag_room", "drag_modes")
BESIDE = (*ROTORS, *DRAGS)
#: Numbers that the kernel of a drag writes: its bound in motion over the reaction, with the sign of the rate, and two
#: components of the reaction.
DRAG_RECORD = 3

#: Ends of the stems of laws that find efforts which depend on reactions, on forces of gaps, whose signs count, and on
#: both; which are of gaps is in tables after the modes.
PRESSED, TOUCHED, BOTH = "_pressed", "_touched", "_pressed_and_touched"
