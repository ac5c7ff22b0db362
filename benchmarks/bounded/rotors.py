"""Rotors in random mechanisms: on the joints of a tree, with gears, in the file and in the simulation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from benchmarks.bounded.draw import KINDS, Drawn, drawn
from benchmarks.bounded.tree import GROUND, Tree

#: Share of joints that get a rotor.
SHARE = 0.8


def geared(kind: str, seed: int, slides: bool = True) -> Drawn:
    """Return a random mechanism whose joints turn rotors, all of those between moving bodies; slides where asked."""
    mechanism = drawn(kind, seed)
    rng = np.random.default_rng([len(KINDS), KINDS.index(kind), seed])
    tables = {name: dict(table) for name, table in mechanism.raw["joints"].items()}
    links, joints = list(mechanism.tree.links), iter(list(tables))
    for number in mechanism.bodies.values():
        joint = next(joints)
        kind_of_joint, link = tables[joint]["type"], links[number]
        kinds = ("revolute", "translational") if slides else ("revolute",)
        if (rng.random() > SHARE and link.parent == GROUND) or kind_of_joint not in kinds:
            continue
        ratio = round(float(rng.choice([-1.0, 1.0]) * rng.uniform(2.0, 30.0)), 3)
        size = link.mass * (0.05 if kind_of_joint == "revolute" else 0.5)
        inertia = float(f"{size * 10 ** rng.uniform(-1.0, 1.0) / ratio**2:.4g}")
        tables[joint] |= {"rotor_inertia": inertia, "gear_ratio": ratio}
        links[number] = replace(link, rotor=inertia * ratio**2)
    raw = {**mechanism.raw, "joints": tables}
    tree = Tree(links, mechanism.tree.closures, mechanism.tree.gravity)
    return replace(mechanism, raw=raw, tree=tree, features=mechanism.features | {"rotor"})


def thrown(mechanism: Drawn, seed: int) -> Drawn:
    """Return a mechanism whose bodies are described with velocities that its joints do not allow, and its rates.

    They are nearest to the described ones, measured by the kinetic energy of the difference, rotors included.
    """
    rng, tree = np.random.default_rng([seed]), mechanism.tree
    state = tree.at(0.0, mechanism.u, np.zeros(tree.n))
    spatial = "space" in mechanism.raw["mechanism"]
    bodies = {name: dict(table) for name, table in mechanism.raw["bodies"].items()}
    mass, momentum = np.zeros((tree.n, tree.n)), np.zeros(tree.n)
    spins = {GROUND: np.zeros(3)}
    for name, k in mechanism.bodies.items():
        link, frame = tree.links[k], state.turns[k]
        plane = np.ones(3) if spatial else np.array([1.0, 1.0, 0.0])
        v, spin = rng.uniform(-1.0, 1.0, 3) * plane, rng.uniform(-1.0, 1.0, 3) * (1.0 if spatial else 1.0 - plane)
        spins[k] = spin
        bodies[name]["velocity"] = [float(x) for x in (v if spatial else v[:2])]
        bodies[name]["angular_velocity"] = [float(x) for x in frame.T @ spin] if spatial else float(spin[2])
        inertia = frame @ link.inertia @ frame.T
        along, about = state.slopes[k], state.spin_slopes[k]
        mass += link.mass * along.T @ along + about.T @ inertia @ about
        momentum += link.mass * along.T @ v + about.T @ inertia @ spin
        if link.rotor:
            mass[k, k] += link.rotor
            momentum[k] += link.rotor * float((frame @ link.axis) @ (spin - spins[link.parent]))
    closing = tree.closed(state)[1]
    m = len(closing)
    matrix = np.block([[mass, closing.T], [closing, np.zeros((m, m))]])
    rates = np.linalg.lstsq(matrix, np.concatenate([momentum, np.zeros(m)]), rcond=1e-13)[0][: tree.n]
    return replace(mechanism, raw={**mechanism.raw, "bodies": bodies}, v=rates)
