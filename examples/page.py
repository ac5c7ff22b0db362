"""Pages that work offline: one plays a motion with sliders, one shows the equations and the emitted code."""

from pathlib import Path

import symgen

model = symgen.load("four-bar")
model.view(until=2.0, output_step=0.02).save("motion.html")
model.inspect("lagrange").save("equations.html")
model.draw().save("four-bar.svg")

for name in ("motion.html", "equations.html", "four-bar.svg"):
    print(f"{name}: {Path(name).stat().st_size / 1e3:.0f} kB")
