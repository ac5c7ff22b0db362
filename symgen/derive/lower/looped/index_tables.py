"""Tables of a mechanism: the numbers that generic code and kernels read."""

from __future__ import annotations

from array import array
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from symgen.base.ir.program import CARRYING, JAMMING, MODE_NUMBERS, STATUS, size_of_carrying
from symgen.derive.lower.looped.forms import FormInfo
from symgen.derive.lower.looped.instances import Instance
from symgen.derive.lower.looped.layout import BESIDE, DRAG_RECORD, GENERIC, HEAD, SECTIONS, STAGES
from symgen.derive.lower.looped.looped_law import LoopedLawInfo
from symgen.derive.lower.looped.shape import KernelGroup, LoopedShape, RowBlock
from symgen.derive.lower.recorded_law import BEHIND


@dataclass(frozen=True)
class IndexTables:
    """Tables for generic code: numbers, and the functions of kernels whose addresses they hold.

    Parameters
    ----------
    numbers : array of uint32
        The tables, with room for addresses.
    functions : tuple of (module, function)
        Functions whose addresses begin at `addresses`, as 64-bit numbers.
    addresses : int
        Index of the first address, in 64-bit numbers from the beginning of the tables: generic code, then functions.
    sections : mapping
        Sections of ``w``: offset and size.
    nw : int
        Length of ``w``.
    groups : tuple of (module, function ``prepare`` or not, index of its table)
        In the order of preparation.
    unknowns : int
        Unknowns of a stage of the descriptor form; 0 without one.
    tangent : tuple of (int, int)
        Equation and unknown of each number that ``tangent`` writes.
    """

    numbers: array[int]
    functions: tuple[tuple[str, str], ...]
    addresses: int
    sections: Mapping[str, tuple[int, int]]
    nw: int
    groups: tuple[tuple[str, bool, int], ...]
    unknowns: int = 0
    tangent: tuple[tuple[int, int], ...] = ()


@dataclass
class Builder:
    """Builds the tables of a mechanism for a law.

    Parameters
    ----------
    shape : LoopedShape
        The mechanism.
    law : LoopedLawInfo
        The law's own sections, whose offsets follow the head, and the stages that it calls.
    level : str
        Of the descriptor form for implicit integrators; empty without one.
    parts : mapping of str to (str, FormInfo)
        The parts of that form: module and metadata by the module of an element's kernel.
    """

    shape: LoopedShape
    law: LoopedLawInfo
    level: str
    parts: Mapping[str, tuple[str, FormInfo]]

    def __post_init__(self) -> None:
        self.tangent: list[tuple[int, int]] = []
        self.beside = 0  # where the head of further tables is
        self.head: dict[str, int] = {}
        self.stages = STAGES if self.law.positions else STAGES | {"full": ()}
        if self.shape.drag_index:
            self.stages = self.stages | {"press": (("drag", "press"),)}
        self.functions = tuple(
            dict.fromkeys(
                key
                for stage in self.stages.values()
                for kind, function in stage
                for group in self.shape.groups
                if group.info.kind == kind and (key := self.kernel_function(group, function)) is not None
            )
        )
        length = len(HEAD) + len(self.law.sections)
        length += length % 2
        self.addresses = length // 2
        self.numbers = [0] * (length + 2 * (len(GENERIC) + len(self.functions)))

    def kernel_function(self, group: KernelGroup, function: str) -> tuple[str, str] | None:
        """Return module and name of a function of a group's kernel or of its part of the descriptor form, if any."""
        if function in group.info.functions:
            return group.stem, function
        part = self.parts.get(group.stem)
        return (part[0], function) if part is not None and function in part[1].functions else None

    @property
    def unknowns(self) -> int:
        """Unknowns of a stage."""
        shape = self.shape
        rows = {"": 0, "stabilised": 2}.get(self.level, 1)
        return shape.nq + shape.nv + rows * shape.m + len(shape.state_index) if self.level else 0

    def finished_tables(self) -> IndexTables:
        """Return the finished tables."""
        shape, head = self.shape, self.head
        head |= {"nq": shape.nq, "nv": shape.nv, "m": shape.m}
        head |= {"jacobian_size": shape.jacobian, "gram_size": shape.gram.size}
        head |= {"driven": shape.driven, "joint_coordinates": shape.coordinates}
        head["method_parameters"] = shape.parameters + shape.hoisted
        head["mass_diagonal"] = shape.mass_diagonal
        head["inverse_mass"] = shape.mass_diagonal + shape.nv
        head["gram_base"] = shape.gram_base
        head["generic"] = self.addresses
        head["unknowns"] = self.unknowns
        head["equations"] = self.unknowns + BEHIND.get(self.level, 0) * shape.m
        places = {group.stem: self.write_group(group) for group in shape.groups}
        for group in shape.groups:
            if group.stem in self.parts:
                stem, info = self.parts[group.stem]
                places[stem] = self.write_part(group, info)
        for name, stage in self.stages.items():
            self.write_stage(name, stage, places)
        self.write_matrices()
        sizes = shape.sizes(self.law.augmented) | {"unknowns": self.unknowns}
        sections: dict[str, tuple[int, int]] = {"status": (0, len(STATUS))}
        offset = len(STATUS) + shape.windings
        sections["winding"] = (len(STATUS), shape.windings)
        if shape.mode_index:
            sections["modes"] = (offset, MODE_NUMBERS * len(shape.mode_index))
            offset += MODE_NUMBERS * len(shape.mode_index)
        for name, length in ((JAMMING, 1), ("drag_record", DRAG_RECORD)) if shape.drag_index else ():
            sections[name] = (offset, length * len(shape.drag_index))
            offset += sections[name][1]
        if carrying := size_of_carrying(len(shape.mode_index), any(shape.signed_drags)):
            sections[CARRYING] = (offset, carrying)
            offset += carrying
        for name, size in (*SECTIONS, *self.law.sections):
            sections[name] = (offset, sizes[size])
            # rotors are rows after those of D where D M^-1 D^T is solved with
            offset += sizes[size] + (len(shape.rotors) if size == "m" else 0)
        sections["vectors"] = (offset, self.law.vectors * sizes["longest"])
        head["vectors"], head["vector_size"] = offset, sizes["longest"]
        offset += self.law.vectors * sizes["longest"]
        for name, length in self.sections_beside:
            sections[name] = (offset, length)
            offset += length
        head["tables"] = offset
        for i, name in enumerate(HEAD):
            self.numbers[i] = head[name] if name in head else sections[name][0]
        for i, name in enumerate(BESIDE if self.beside else ()):
            self.numbers[self.beside + i] = sections[name][0] if name in sections else head.get(name, 0)
        for i, (name, _) in enumerate(self.law.sections):
            self.numbers[len(HEAD) + i] = sections[name][0]
        self.numbers += [0] * (len(self.numbers) % 2)
        sections["tables"] = (offset, len(self.numbers) // 2 + 1)
        offset += len(self.numbers) // 2 + 1
        groups = tuple((g.stem, "prepare" in g.info.functions, places[g.stem]) for g in shape.groups)
        numbers, tangent = array("I", self.numbers), tuple(self.tangent)
        return IndexTables(numbers, self.functions, self.addresses, sections, offset, groups, self.unknowns, tangent)

    def begin_table(self, name: str) -> None:
        """Begin a table here."""
        self.head[name] = len(self.numbers)

    def write_group(self, group: KernelGroup) -> int:
        """Write the table of a kernel's instances; return its beginning."""
        shape, info, at = self.shape, group.info, len(self.numbers)
        self.numbers.append(len(group.members))
        constants, computed = shape.first_constant, shape.first_computed
        index = shape.constant_index
        for k in group.members:
            instance = shape.instances[k]
            bodies = [shape.body[name] for name in instance.frames]
            self.numbers += [b[2] for b in bodies]
            if info.kind == "body":
                self.numbers += bodies[0][:2]
            elif info.kind == "joint":
                self.numbers += [shape.row_of[k], shape.entry_of[k], shape.coordinate_of[k]]
            elif info.kind == "bound":
                self.numbers += [shape.row_of[k], shape.entry_of[k], *(b[1] for b in bodies)]
            elif info.kind == "drag":
                record = len(STATUS) + shape.windings + MODE_NUMBERS * len(shape.mode_index) + len(shape.drag_index)
                self.numbers += [shape.row_of[k], record + DRAG_RECORD * shape.drag_index[instance.name]]
            elif info.kind == "rotor":
                self.numbers += [shape.entry_of[k], *(b[1] for b in bodies)]
            elif info.kind == "force":
                self.numbers += [b[1] for b in bodies]
            self.numbers += [shape.angle_index[angle] for angle in instance.angles]
            self.numbers += self.places_of_states(instance)
            self.numbers += self.place_of_modes(instance.name)
            self.numbers.append(computed + shape.computed_of[k])
            self.numbers += [constants + index[c] for c in instance.constants]
        return at

    def places_of_states(self, instance: Instance) -> list[int]:
        """Return the places in the state, after the work, of the states of the file that an instance reads."""
        work = self.shape.nq + self.shape.nv
        return [work + 1 + self.shape.state_index[name] for name in instance.states]

    def place_of_modes(self, name: str) -> list[int]:
        """Return the place in ``w`` of the modes of a row that has any, in a list."""
        first = len(STATUS) + self.shape.windings
        return [first + self.shape.mode_index[name]] if name in self.shape.mode_index else []

    def write_part(self, group: KernelGroup, info: FormInfo) -> int:
        """Write the table of a group's part of the descriptor form; return its beginning."""
        shape, at = self.shape, len(self.numbers)
        self.numbers.append(len(group.members))
        own = self.unknowns - len(shape.state_index)
        owners = [[(f, i) for f, sizes in enumerate(group.info.frames) for i in range(sizes[s])] for s in (0, 1)]
        for k in group.members:
            instance = shape.instances[k]
            bodies = [shape.body[name] for name in instance.frames]
            row = shape.row_of[k] if group.info.rows or instance.joint else 0
            rows = shape.nq + shape.nv + row
            place = {("q", j): bodies[f][0] + i for j, (f, i) in enumerate(owners[0])}
            place |= {("v", j): shape.nq + bodies[f][1] + i for j, (f, i) in enumerate(owners[1])}
            for name, start in (("first", rows), ("second", rows + shape.m)):
                place |= {(name, j): start + j for j in range(len(group.info.rows))}
            place |= {("first", j): rows + j for *_, unknown, j in info.entries if unknown == "k_first"}
            place |= {("z", j): own + shape.state_index[name] for j, name in enumerate(instance.states, 1)}
            self.numbers += [b[2] for b in bodies] + [b[0] for b in bodies] + [b[1] for b in bodies]
            self.numbers += [row, len(self.tangent)]
            self.numbers += [shape.angle_index[angle] for angle in instance.angles]
            self.numbers += self.places_of_states(instance)
            self.numbers += self.place_of_modes(instance.name)
            self.numbers += [place["z", 1]] if group.info.kind == "state" else []
            self.numbers += [shape.first_constant + shape.constant_index[c] for c in instance.constants]
            for equation, i, unknown, j in info.entries:
                of_state = 0 if unknown.startswith("k_") else self.unknowns
                column = of_state + place[unknown.removeprefix("k_"), j]
                self.tangent.append((place[equation, i], column))
        return at

    def write_stage(self, name: str, stage: Sequence[tuple[str, str]], places: Mapping[str, int]) -> None:
        """Write the list of kernels of a stage: their number, then address and table of each."""
        self.begin_table(name)
        calls = [
            (self.addresses + len(GENERIC) + self.functions.index(key), places[key[0]])
            for kind, function in stage
            for group in self.shape.groups
            if group.info.kind == kind and (key := self.kernel_function(group, function)) in self.functions
        ]
        self.numbers.append(len(calls))
        for address, place in calls:
            self.numbers += [address, place]

    def write_matrices(self) -> None:
        """Write the tables of D, of D W D^T, of M and, where needed, of M + a D^T D."""
        shape = self.shape
        self.write_rows()
        self.begin_table("jacobian_columns")
        self.numbers.append(len(shape.by_body))
        for first, blocks in shape.by_body.items():
            self.numbers += [first, shape.width[first], len(blocks)]
            for b in blocks:
                self.numbers += [b.row, b.offset]
        self.begin_table("angular_rows")
        angular = [i for i, of_angles in enumerate(shape.angular) if of_angles]
        self.numbers += [len(angular), *angular, *(i for i, of_angles in enumerate(shape.angular) if not of_angles)]
        self.write_mass_blocks()
        self.begin_table("gram_terms")
        runs = shape.products.runs
        self.numbers.append(len(runs))
        for width, terms in runs.items():
            self.numbers += [width, len(terms) // (3 if width else 8), *terms]
        if shape.rotors or shape.drag_index:
            self.write_rotors_and_drags()
        self.begin_table("gram_factor")
        self.numbers += shape.gram.lists_for_code()
        if self.law.augmented:
            self.write_augmented_matrix()
        else:
            self.head |= {"augmented_terms": 0, "augmented_factor": 0, "augmented_size": 0}

    def write_rows(self) -> None:
        """Write the rows of D by the widths of their blocks: number of blocks, width (0: not alike), then rows."""
        shape, classes = self.shape, dict[tuple[int, ...], list[list[RowBlock]]]()
        position = 0
        for row in range(shape.m):
            first = position
            while position < len(shape.blocks) and shape.blocks[position].row == row:
                position += 1
            blocks = shape.blocks[first:position]
            classes.setdefault(tuple(b.width for b in blocks), []).append(blocks)
            assert blocks, "a row has entries"
        self.begin_table("jacobian_rows")
        self.numbers.append(len(classes))
        for widths, rows in classes.items():
            alike = widths[0] if len(set(widths)) == 1 else 0
            self.numbers += [len(widths), alike, len(rows)]
            for blocks in rows:
                self.numbers += [blocks[0].row, blocks[0].offset]
                for b in blocks:
                    self.numbers += [b.first] if alike else [b.first, b.width]

    def write_mass_blocks(self) -> None:
        """Write the places of blocks of M larger than one entry, and the blocks of D that they act on."""
        shape = self.shape
        large: list[tuple[int, int, int]] = []  # size, first velocity, place in p of M, followed by M^-1
        for k, (instance, stem) in enumerate(zip(shape.instances, shape.stems, strict=True)):
            info = shape.infos[stem]
            first = shape.first_computed + shape.computed_of[k] + info.hoisted
            for block in info.mass:
                if len(block) > 1:
                    large.append((len(block), shape.body[instance.name][1] + block[0], first))
                    first += 2 * len(block) ** 2
        self.begin_table("mass_blocks")
        self.numbers.append(len(large))
        for each in large:
            self.numbers += each
        self.begin_table("weights")
        plain = [x for slot, velocity in shape.products.slots.items() for x in (slot, velocity)]
        self.numbers += [len(plain) // 2, *plain]
        self.large = large
        self.write_weights(shape.blocks)

    def write_weights(self, blocks: Sequence[RowBlock]) -> None:
        """Write which blocks of rows the blocks of M act on: size, place of the entries, place in p of M^-1."""
        weights, by_body = list[int](), dict[int, list[RowBlock]]()
        for block in blocks:
            by_body.setdefault(block.first, []).append(block)
        owner = {v: first for first, width in self.shape.width.items() for v in range(first, first + width)}
        for size, velocity, place in self.large:
            for b in by_body.get(owner[velocity], ()):
                weights += [size, b.offset + velocity - b.first, place + size * size]
        self.numbers += [len(weights) // 3, *weights]

    @property
    def sections_beside(self) -> Iterator[tuple[str, int]]:
        """Sections of ``w`` that solutions with rotors and with drags need, and their lengths."""
        rotors, drags = len(self.shape.rotors), len(self.shape.drag_index)
        if rotors:
            yield from (("rotor_vector", rotors), ("rotor_lower", self.shape.rotor_gram.size))
        if drags:
            yield "drag_room", (6 + 3 * drags) * drags

    def write_rotors_and_drags(self) -> None:
        """Write the tables of rotors and of drags, and the place of their head."""
        self.beside = len(self.numbers)
        self.numbers += [0] * len(BESIDE)
        if self.shape.rotors:
            self.write_rotors()
        self.head["drags"] = len(self.shape.drag_index)
        self.begin_table("drag_modes")
        self.numbers += [place for name in self.shape.drag_index for place in self.place_of_modes(name)]
        if len(set(self.shape.signed_drags)) > 1:
            self.numbers += [int(signed) for signed in self.shape.signed_drags]
        self.numbers.append(self.beside)

    def write_rotors(self) -> None:
        """Write the rows R of rotors, the weights of their entries, and their products."""
        shape = self.shape
        self.head |= {"rotors": len(shape.rotors), "rotor_size": shape.rotor_gram.size}
        self.begin_table("rotor_rows")
        for row in shape.rotor_rows:
            self.numbers += [len(row), *(x for column, slot in row for x in (slot, column))]
        self.begin_table("rotor_weights")
        plain = [(slot, j) for row in shape.rotor_rows for j, slot in row if j not in shape.coupled]
        self.numbers += [len(plain), *(x for each in plain for x in each)]
        self.write_weights(shape.rotor_blocks)
        for name, among in (("rotor_products", False), ("rotor_beside", True)):
            self.begin_table(name)
            products = shape.rotor_products(among)
            self.numbers += [len(products) // 3, *products]
        self.begin_table("rotor_augmented")
        if self.law.augmented:
            self.write_augmented_rows(shape.rotor_rows)
        self.begin_table("rotor_factor")
        self.numbers += shape.rotor_gram.lists_for_code()

    def write_augmented_rows(self, rows: Sequence[Sequence[tuple[int, int]]]) -> None:
        """Write rows with the targets of the products of their entries in M + D^T a D."""
        elimination = self.shape.augmented
        for row in rows:
            self.numbers += [len(row), *(slot for _, slot in row)]
            self.numbers += [elimination.place_of_entry(i, j) for k, (i, _) in enumerate(row) for j, _ in row[: k + 1]]

    def write_augmented_matrix(self) -> None:
        """Write the tables of M + D^T a D: diagonal, blocks of M, then rows of D with the targets of their products."""
        shape, elimination = self.shape, self.shape.augmented
        self.head["augmented_size"] = elimination.size
        self.begin_table("augmented_terms")
        self.numbers += [elimination.place_of_entry(j, j) for j in range(shape.nv)]
        beside: list[int] = []
        at = self.head["mass_blocks"]
        for k in range(self.numbers[at]):
            size, velocity, place = self.numbers[at + 1 + 3 * k : at + 4 + 3 * k]
            for i in range(size):
                beside += [
                    x
                    for j in range(i)
                    for x in (place + size * i + j, elimination.place_of_entry(velocity + i, velocity + j))
                ]
        self.numbers += [len(beside) // 2, *beside]
        self.write_augmented_rows(shape.rows)
        self.begin_table("augmented_factor")
        self.numbers += elimination.lists_for_code()
