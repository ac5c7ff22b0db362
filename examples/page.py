"""Pages and pictures: one page plays a motion with sliders, offline; a drawing shows four positions."""

from pathlib import Path

import symgen

model = symgen.load("four-bar")
model.simulate(until=2.0, output_step=0.02).view().save("motion.html")
model.draw().save("four-bar.svg")

for name in ("motion.html", "four-bar.svg"):
    print(f"{name}: {Path(name).stat().st_size / 1e3:.0f} kB")
