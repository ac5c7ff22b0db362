"""The study that symgen began with: six methods, error against run time, as a page and a CSV file.

python sources_study.py [MODEL [UNTIL]]
"""

import sys

import symgen

model = sys.argv[1] if len(sys.argv) > 1 else "pendulum"
until = float(sys.argv[2]) if len(sys.argv) > 2 else 1.0

# the six methods of the source are the default
study = symgen.compare(model, integrators=["rk4"], steps=[5e-3, 2.5e-3], until=until)
for row in study.rows:
    outcome = row.reason if row.error is None else f"error {row.error:.1e} m in {row.run_seconds * 1e6:.1f} us"
    print(f"{row.method:27} {row.step:g} s  {row.status}: {outcome}")
print(f"reference: {study.how}")

study.save("study.html")
study.save("study.csv")
study.plot("study.pdf")
