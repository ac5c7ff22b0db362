"""Random mechanisms: drawn, given velocities, and looked over by the reference before anybody else sees them."""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from benchmarks.mechanisms import loads, plane, space
from benchmarks.mechanisms.draft import GROUND, Draft
from benchmarks.plain.moving import Array
from benchmarks.plain.start import CannotClose, Start, projected, start
from benchmarks.plain.system import System, read, scaled

#: A start whose smallest singular value (rows of D of length 1) or margin is below this is not taken.
LEAST = 0.06


@dataclass(frozen=True)
class Drawn:
    """A random mechanism.

    Attributes
    ----------
    raw : dict
        Its file.
    features : tuple of str
        Words for what it has.
    """

    raw: dict[str, Any]
    features: tuple[str, ...] = field(default=())


class Refused(Exception):
    """What was drawn is of no use: not regular, or nothing moves."""


def draw(seed: int, index: int, spatial: bool | None = None, most: int = 60) -> Drawn:
    """Return mechanism number `index` of a seed: the same one in every process.

    Parameters
    ----------
    seed, index : int
        Which one.
    spatial : bool, optional
        In space or in the plane; by turns unless given.
    most : int
        How many drafts may be thrown away.
    """
    space_ = index % 2 == 1 if spatial is None else spatial
    for attempt in range(most):
        rng = random.Random(f"{seed}/{index}/{attempt}")
        draft = Draft(rng, space_)
        try:
            _draw(draft)
            return _finished(draft)
        except (Refused, CannotClose, np.linalg.LinAlgError):
            continue
    raise Refused(f"no regular mechanism in {most} drafts of {seed}/{index}")


def _draw(draft: Draft) -> None:
    module = space if draft.spatial else plane
    if draft.chance(0.1 if draft.spatial else 0.15):
        draft.rng.choice(module.SPECIAL)(draft)
    else:
        _tree(draft, module)
        for _ in range(draft.rng.choice([0, 0, 1, 1, 2])):
            _closed(draft, module)
    if draft.chance(0.35):
        _further(draft, module)
    if draft.chance(0.06):
        _twin(draft)
    if draft.chance(0.25):
        loads.drive(draft)
    kinds, shares = list(loads.KINDS), list(loads.KINDS.values())
    for _ in range(draft.rng.choice([0, 1, 1, 2, 3])):
        draft.rng.choices(kinds, shares)[0](draft)
    if draft.chance(0.12):
        _light(draft)


def _tree(draft: Draft, module: Any) -> None:
    for _ in range(draft.rng.choice([1, 1, 2, 2, 3, 3, 4] if draft.spatial else [1, 2, 2, 3, 3, 4, 5])):
        body = draft.body()
        parent = draft.pick(other=(body,), rigid=not draft.poses[body].rigid)
        if parent is None or draft.chance(0.12):
            draft.features.add("free")
            if draft.poses[body].rigid and draft.chance(0.5):
                _touching(draft, module, body)
            continue
        pair = (parent, body) if draft.chance(0.7) else (body, parent)
        _joined(draft, module, *pair, kinds=module.TREE)


def _touching(draft: Draft, module: Any, body: str) -> None:
    """Let a free body roll, or stand on a blade."""
    kinds = [kind for kind in ("rolling", "rolling-disc", "rolling-sphere", "knife-edge") if kind in module.KINDS]
    kind = draft.rng.choice(kinds)
    if module.KINDS[kind][0](draft, body, GROUND):
        draft.features.discard("free")


def _closed(draft: Draft, module: Any) -> None:
    a = draft.pick()
    b = draft.pick(other=(a,)) if a else None
    if a is not None and b is not None and _joined(draft, module, a, b, kinds=list(module.KINDS)):
        draft.features.add("closed")


def _further(draft: Draft, module: Any) -> None:
    """Put a joint of the kinds that hold no body by themselves: gears, racks, blades, what rolls."""
    kinds = [kind for kind in module.KINDS if kind not in module.TREE]
    for _ in range(20):
        kind = draft.rng.choice(kinds)
        a = draft.pick(rigid=True)
        b = draft.pick(rigid=True, other=(a,)) if a else None
        if a is not None and b is not None and module.KINDS[kind][0](draft, a, b):
            return


def _joined(draft: Draft, module: Any, a: str, b: str, kinds: list[str]) -> bool:
    """Put a joint between two bodies; return whether one was found that fits."""
    for _ in range(10):
        kind = draft.rng.choices(kinds, [module.KINDS[k][2] for k in kinds])[0]
        make, rigid, _ = module.KINDS[kind]
        fits = all(body == GROUND or draft.poses[body].rigid or not r for body, r in zip((a, b), rigid, strict=True))
        if fits and make(draft, a, b):
            return True
    return False


def _twin(draft: Draft) -> None:
    """Write a joint twice, once in other words: rows that repeat others for ever."""
    kinds = ("revolute", "spherical", "distance", "rigid", "point-on-plane", "pin-in-slot")
    joints = [name for name, table in draft.raw["joints"].items() if table["type"] in kinds]
    if not joints:
        return
    table = dict(draft.raw["joints"][draft.rng.choice(joints)])
    if draft.chance(0.5):
        table["at"] = [[f"1*{x!r}" for x in p] if isinstance(p, list) and i else p for i, p in enumerate(table["at"])]
    draft.joint(table.pop("type"), **table)
    draft.features |= {"redundant", "twin"}


def _light(draft: Draft) -> None:
    """Make one body very light, or massless."""
    name = draft.rng.choice(list(draft.raw["bodies"]))
    table = draft.raw["bodies"][name]
    massless = draft.chance(0.5)
    factor = 0.0 if massless else 10.0 ** -draft.rng.randint(4, 9)
    draft.features.add("massless" if massless else "light")
    rigid = "inertia" in table
    table["mass"] = 0 if massless else factor
    for key in ("inertia_at", "inertia_axes"):
        table.pop(key, None)
    if rigid and draft.spatial:
        table["inertia"] = [0, 0, 0] if massless else [factor * x for x in (0.10, 0.12, 0.15)]
    elif rigid:
        table["inertia"] = 0 if massless else 0.1 * factor


def _finished(draft: Draft) -> Drawn:
    """Give velocities that satisfy the constraints, and refuse what is not regular."""
    system = read(draft.raw)
    at = start(system)
    if at.moved > 1e-9:
        raise Refused("does not close as it stands")
    c = system.constraints(system.at(0.0, at.q, at.v))
    rank = system.rank(c.d)
    if rank == system.nv and not c.nu.any():
        raise Refused("nothing moves")
    if rank < len(c.d):
        _lasting(draft, system, at, rank)
    _regular(system, at, c.d, rank)
    _velocities(draft, system, at, rank)
    if rank == len(c.d) and draft.chance(0.1):
        _approximate(draft)
    return Drawn({k: v for k, v in draft.raw.items() if v or k == "bodies"}, tuple(sorted(draft.features)))


def _lasting(draft: Draft, system: System, at: Start, rank: int) -> None:
    """Refuse rows that depend on others by accident, as they stand, and not on closed positions nearby."""
    draft.features.add("redundant")
    shift = np.array([0.02 * draft.rng.gauss(0.0, 1.0) for _ in range(system.nv)])
    q = system.moved(at.q, shift)
    for _ in range(4):
        q, v = projected(system, 0.0, q, at.v, rank)
    c = system.constraints(system.at(0.0, q, v))
    if system.rank(c.d) != rank or np.abs(c.phi).max() > 1e-9 or np.abs(c.d @ v - c.nu).max() > 1e-8:
        raise Refused("redundant by accident")


def _regular(system: System, at: Start, d: Array, rank: int) -> None:
    if rank:
        sizes = np.linalg.svd(scaled(d)[0], compute_uv=False)
        if sizes[rank - 1] < LEAST:
            raise Refused("near a singular position")
    state = system.at(0.0, at.q, at.v)
    if any(margin(state) < 0.2 for joint in system.joints for margin in joint.margins):
        raise Refused("near a singular position of a joint")
    _, _, vt = np.linalg.svd(d) if len(d) else (None, None, np.eye(system.nv))
    free = vt[rank:].T
    if free.shape[1]:
        sizes = np.linalg.eigvalsh(free.T @ system.mass @ free)
        if sizes[0] < 1e-9 * max(1.0, sizes[-1]):
            raise Refused("masses do not determine the motion")


def _velocities(draft: Draft, system: System, at: Start, rank: int) -> None:
    """Write velocities: none, all of them, or those of some bodies, always ones that do not contradict."""
    v = np.array([draft.rng.gauss(0.0, 1.5) for _ in range(system.nv)])
    _, v = projected(system, 0.0, at.q, v, rank)
    way = draft.rng.random()
    if way < 0.2 and not system.constraints(system.at(0.0, at.q, 0.0 * v)).nu.any():
        return  # at rest
    dimension = system.document.dimension
    for name, body in system.bodies.items():
        if way < 0.4 and draft.chance(0.5):
            draft.features.add("completed")
            continue
        own = v[body.first_v : body.first_v + len(body.velocities)]
        table = draft.raw["bodies"][name]
        table["velocity"] = own[:dimension].tolist()
        if body.rigid:
            table["angular_velocity"] = own[dimension:].tolist() if draft.spatial else float(own[dimension])


def _approximate(draft: Draft) -> None:
    """Move the described start a little off, so that it has to be assembled."""
    draft.features.add("approximate")
    without = draft.chance(0.5)
    for table in draft.raw["bodies"].values():
        table["position"] = [x + draft.number(-0.02, 0.02) for x in table["position"]]
        if "angle" in table:
            table["angle"] += draft.number(-0.02, 0.02)
        vector = table.get("orientation", {}).get("rotation_vector")
        if vector:
            table["orientation"] = {"rotation_vector": [x + draft.number(-0.02, 0.02) for x in vector]}
        if without:
            table.pop("velocity", None)
            table.pop("angular_velocity", None)
    system = read(draft.raw)
    at = start(system)
    _regular(system, at, system.constraints(system.at(0.0, at.q, at.v)).d, len(system.rows))
