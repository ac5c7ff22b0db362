"""Siconos: stacks of boxes and discs in a bin, by the time stepping of Moreau and Jean with Newton's impact law.

Boxes of 1 kg and 0.2 m on a floor have a contact at each lower corner, whose distances are linear, as boxes that stay
upright have them. Siconos is a package of Debian for the interpreter of the system, so this file imports nothing else:

    OPENBLAS_NUM_THREADS=1 /usr/bin/python3 benchmarks/peers/siconos_peer.py ROWS.jsonl
"""

from __future__ import annotations

import json
import sys
import time
from typing import Any

import numpy as np
import siconos.kernel as sk
import siconos.numerics as sn
from siconos.mechanics.collision.bodies import Disk, DiskDiskR, DiskPlanR

G, HALF, RADIUS, MU, BIN_MU = 9.81, 0.1, 0.05, 0.2, 0.3
#: Largest number of iterations of the solver of contacts.
MOST = 2000
#: Constant steps [s].
STEPS = (1e-2, 1e-3, 1e-4)
#: Tolerance of the solver of contacts, None for Siconos' own, and how deep contacts are at the start [m].
SETTINGS = {"as it comes": (None, 0.0), "1e-10, begun 1 nm deep": (1e-10, 1e-9)}


def integrate(model: Any, step: float, tolerance: float | None) -> float:
    """Integrate a model to its end; return the processor time [s]."""
    solver = sk.FrictionContact(2, sn.SICONOS_FRICTION_2D_NSGS)
    options = solver.numericsSolverOptions()
    if tolerance is not None:
        options.dparam[sn.SICONOS_DPARAM_TOL], options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = tolerance, MOST
    scheme = sk.TimeStepping(model, sk.TimeDiscretisation(0.0, step), sk.MoreauJeanOSI(0.5), solver)
    begin = time.process_time()
    while scheme.hasNextEvent():
        scheme.computeOneStep()
        scheme.nextStep()
    return time.process_time() - begin


def stack(count: int, drop: float, push: float, until: float, step: float, setting: str) -> tuple[Any, float]:
    """Return places and angles of boxes, each dropped by a height [m], the last one pushed by a force [N]."""
    tolerance, depth = SETTINGS[setting]
    model, law = sk.NonSmoothDynamicalSystem(0.0, until), sk.NewtonImpactFrictionNSL(0.0, 0.0, MU, 2)
    boxes, kept = list[Any](), list[Any]()
    for i in range(count):
        place = np.array([0.0, HALF + (2.0 * HALF + drop - depth) * i + drop - depth, 0.0])
        boxes.append(sk.LagrangianLinearTIDS(place, np.zeros(3), np.diag([1.0, 1.0, 2.0 / 3.0 * HALF**2])))
        kept.append(np.array([push if i == count - 1 else 0.0, -G, 0.0]))
        boxes[-1].setFExtPtr(kept[-1])
        model.insertDynamicalSystem(boxes[-1])
        for side in (-HALF, HALF):
            rows, beyond = np.array([[0.0, 1.0, side], [1.0, 0.0, HALF]]), np.array([-HALF, 0.0])
            if i > 0:
                rows = np.hstack([rows, np.array([[0.0, -1.0, -side], [-1.0, 0.0, HALF]])])
                beyond = np.array([-2.0 * HALF, 0.0])
            relation = sk.LagrangianLinearTIR(rows, beyond)
            contact = sk.Interaction(law, relation)
            kept += [rows, beyond, relation, contact]
            model.link(contact, *((boxes[i], boxes[i - 1]) if i > 0 else (boxes[i],)))
    seconds = integrate(model, step, tolerance)
    return [list(map(float, box.q())) for box in boxes], seconds


def bin_of_discs(count: int, until: float, step: float, setting: str) -> tuple[Any, float]:
    """Return places and angles of discs that fall into a bin 0.36 m wide."""
    model, law = sk.NonSmoothDynamicalSystem(0.0, until), sk.NewtonImpactFrictionNSL(0.0, 0.0, BIN_MU, 2)
    discs, kept = list[Any](), list[Any]()
    for i in range(count):
        place = np.array([0.12 * (i % 3) + 0.006 * (i // 3), RADIUS + 0.02 + 0.13 * (i // 3), 0.0])
        discs.append(Disk(RADIUS, 1.0, place, np.zeros(3)))
        kept.append(np.array([0.0, -G, 0.0]))
        discs[-1].setFExtPtr(kept[-1])
        model.insertDynamicalSystem(discs[-1])
        walls = ((0.0, 1.0, 0.0), (1.0, 0.0, 0.06), (1.0, 0.0, -0.3))
        pairs = [(DiskPlanR(RADIUS, *wall), (discs[i],)) for wall in walls]
        pairs += [(DiskDiskR(RADIUS, RADIUS), (discs[i], discs[k])) for k in range(i)]
        for relation, between in pairs:
            contact = sk.Interaction(law, relation)
            kept += [relation, contact]
            model.link(contact, *between)
    seconds = integrate(model, step, SETTINGS[setting][0])
    return [list(map(float, disc.q())) for disc in discs], seconds


def main(path: str) -> None:
    """Write a row for each scene, setting and step: where bodies end, and the processor time."""
    with open(path, "w", encoding="utf-8") as file:
        for step in STEPS:
            for setting in SETTINGS:
                made = [("discs 8", bin_of_discs(8, 0.2, step, setting))]
                for count in (3, 5, 10):
                    made.append((f"pushed {count}", stack(count, 0.0, 3.0, 0.3, step, setting)))
                    made.append((f"dropped {count}", stack(count, 1e-3, 0.0, 0.3, step, setting)))
                for scene, (ends, seconds) in made:
                    row = {"scene": scene, "setting": setting, "step": step, "seconds": seconds, "ends": ends}
                    file.write(json.dumps(row) + "\n")
                file.flush()


if __name__ == "__main__":
    main(sys.argv[1])
