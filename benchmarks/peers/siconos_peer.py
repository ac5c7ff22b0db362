"""Siconos: stacks of boxes, discs in a bin and a gripper, by time stepping of Moreau and Jean with Newton's impact law.

Boxes of 1 kg and 0.2 m on a floor have a contact at each lower corner, whose distances are linear, as boxes that stay
upright have them. The gripper is one system of twelve coordinates with joints as equalities; their functions are C, as
a user writes them for speed (gcc). Siconos is a package of Debian for the interpreter of the system, so this file
imports nothing else:

    OPENBLAS_NUM_THREADS=1 /usr/bin/python3 benchmarks/peers/siconos_peer.py ROWS.jsonl
"""

from __future__ import annotations

import ctypes
import json
import os
import subprocess
import sys
import tempfile
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


#: The gripper: masses and inertias of slide, link, jaw and finger, their start, and the pins between them (-1: ground).
MASSES = np.array([0.3, 0.3, 0.01, 0.1, 0.1, 1e-4, 0.4, 0.4, 2e-3, 0.15, 0.15, 2e-4])
START = np.array([0.0, 0.0, 0.0, 0.03, 0.04, 0.0, 0.18, 0.09, 0.0, 0.34, 0.1, 0.0])
PINS = ((0, 1, (0.0, 0.0)), (1, 2, (0.06, 0.08)), (-1, 2, (0.12, 0.06)), (2, 3, (0.3, 0.12)))
TIP, FLOOR, SPRING, DAMPER, PUSH, GAP, SPRINGS_BACK = (0.36, 0.06), 0.05, 4.0, 0.004, 12.0, 0.03, 0.3


def function(name: str, size: int, lines: list[str]) -> str:
    """Return a C function of Siconos' form that fills an array."""
    head = f"void {name}(unsigned m, const double *q, unsigned k, double *out, unsigned l, double *z) {{ double c, s; "
    return head + f"for (int i = 0; i < {size}; i++) out[i] = 0.0; " + " ".join(lines) + " }"


def joint_functions() -> str:
    """Return the C functions of pins and of the finger's tip: what is 0 or a gap, and its Jacobian by columns."""
    text = ["#include <math.h>"]
    for n, (one, other, place) in enumerate(PINS):
        values, slopes = ([f"out[{i}] = {x!r};" for i, x in enumerate(place)] if one < 0 else []), list[str]()
        for sign, body in ((1, one), (-1, other)):
            if body >= 0:
                k, a, b = 3 * body, place[0] - float(START[3 * body]), place[1] - float(START[3 * body + 1])
                turn = f"c = cos(q[{k + 2}]); s = sin(q[{k + 2}]);"
                values += [turn, f"out[0] += {sign} * (q[{k}] + c * {a!r} - s * {b!r});"]
                values += [f"out[1] += {sign} * (q[{k + 1}] + s * {a!r} + c * {b!r});"]
                slopes += [turn, f"out[{2 * k}] = out[{2 * k + 3}] = {sign};"]
                slopes += [f"out[{2 * k + 4}] = {sign} * (-s * {a!r} - c * {b!r});"]
                slopes += [f"out[{2 * k + 5}] = {sign} * (c * {a!r} - s * {b!r});"]
        text += [function(f"value{n}", 2, values), function(f"slope{n}", 24, slopes)]
    turn, (a, b) = "c = cos(q[11]); s = sin(q[11]);", (TIP[0] - float(START[9]), TIP[1] - float(START[10]))
    text.append(function("value_tip", 1, [turn, f"out[0] = q[10] + s * {a!r} + c * {b!r} - {FLOOR!r};"]))
    text.append(function("slope_tip", 12, [turn, f"out[10] = 1.0; out[11] = c * {a!r} - s * {b!r};"]))
    return "\n".join(text) + "\n"


def gripper(until: float, step: float) -> tuple[Any, float]:
    """Return places and angles of a gripper whose finger bounces on its workpiece, with smooth pins."""
    springs = [np.zeros((12, 12)), np.zeros((12, 12))]
    for matrix, size in zip(springs, (SPRING, DAMPER), strict=True):
        matrix[8:12:3, 8:12:3] = size * np.array([[1.0, -1.0], [-1.0, 1.0]])
    force = np.zeros(12)
    force[1::3], force[0] = -G * MASSES[1::3], PUSH
    model = sk.NonSmoothDynamicalSystem(0.0, until)
    whole = sk.LagrangianLinearTIDS(START.copy(), np.zeros(12), np.diag(MASSES), *springs)
    whole.setFExtPtr(force)
    model.insertDynamicalSystem(whole)
    rail, stop = np.zeros((2, 12)), np.zeros((1, 12))
    rail[0, 1] = rail[1, 2] = 1.0
    stop[0, 0] = -1.0
    relations = [(sk.LagrangianLinearTIR(rail, np.zeros(2)), 2), (sk.LagrangianLinearTIR(stop, np.array([GAP])), 0)]
    names = [(str(n), 2) for n in range(len(PINS))] + [("_tip", 0)]
    relations += [(sk.LagrangianScleronomousR(f"joints:value{x}", f"joints:slope{x}"), n) for x, n in names]
    kept = list[Any]()
    for relation, equalities in relations:
        law = sk.EqualityConditionNSL(equalities) if equalities else sk.NewtonImpactNSL(SPRINGS_BACK)
        kept.append(sk.Interaction(law, relation))
        model.link(kept[-1], whole)
    scheme = sk.TimeStepping(model, sk.TimeDiscretisation(0.0, step), sk.MoreauJeanOSI(0.5), sk.MLCP())
    begin = time.process_time()
    while scheme.hasNextEvent():
        scheme.computeOneStep()
        scheme.nextStep()
    return np.array(whole.q()).reshape(-1, 3).tolist(), time.process_time() - begin


def grippers() -> list[dict[str, Any]]:
    """Return the rows of the gripper; Siconos finds its functions by the name of a library that is loaded."""
    with tempfile.TemporaryDirectory() as folder:
        source, library = os.path.join(folder, "joints.c"), os.path.join(folder, "joints.so")
        with open(source, "w", encoding="utf-8") as file:
            file.write(joint_functions())
        shared = ["-O2", "-shared", "-fPIC", "-Wl,-soname,joints.so"]
        subprocess.run(["gcc", *shared, source, "-o", library, "-lm"], check=True)
        ctypes.CDLL(library)
        made = [(step, *gripper(0.25, step)) for step in STEPS]
    return [
        {"scene": "gripper", "setting": "as it comes", "step": step, "seconds": seconds, "ends": ends}
        for step, ends, seconds in made
    ]


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
        for row in grippers():
            file.write(json.dumps(row) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
