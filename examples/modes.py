"""Frequencies and shapes: a chain of three rods about its rest, and what stays of them with a heavier tip."""

import numpy as np

import symgen

model = symgen.load("four-bar")
found = model.modes(start={"crank.theta": 4.0})
print(f"{found.degrees_of_freedom} degree of freedom, {found.frequencies[0]:.4f} Hz")
for body, share in found.participation.items():
    print(f"{body}: {share[0]:.1%} of the kinetic energy")

masses = np.linspace(4.0, 10.0, 4)
locus = model.locus(("rocker_mass", masses), start={"crank.theta": 4.0})
for mass, values in zip(masses, locus.branches.imag, strict=True):
    print(f"rocker of {mass:.0f} kg: {abs(values).max() / (2 * np.pi):.4f} Hz")
