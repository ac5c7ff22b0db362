"""Short runs, run apart: what they give, and whether Numba was imported.

python -m compile.native.loops straight pendulum lagrange rk4 four-bar ggl radau5
"""

import json
import sys
from typing import Any

import numpy as np
from support.emitted import mechanism_of
from support.models import EVERYTHING, ROUGH

from symgen.api import load

OWN = {"everything": EVERYTHING, "rough": ROUGH}


def run(model: str, method: str, integrator: str, shape: str) -> dict[str, Any]:
    """Return the numbers of a run of a model of the tests or of the catalogue."""
    subject = load(mechanism_of(OWN[model])) if model in OWN else load(model)
    result = subject.simulate(method=method, integrator=integrator, until=0.5, output_step=0.07, shape=shape)
    assert result.status == "ok" and result.steps > 2
    arrays = {"t": result.t, "q": result.q.values, "v": result.v.values, "kinetic": result.kinetic}
    return {
        "states": {name: np.asarray(array).tolist() for name, array in arrays.items()},
        "steps": [result.steps, result.rejected],
    }


def main(arguments: list[str]) -> None:
    """Print the numbers of runs."""
    shape, *words = arguments
    runs = [run(*words[i : i + 3], shape) for i in range(0, len(words), 3)]
    print(json.dumps({"runs": runs, "numba": "numba" in sys.modules}))


if __name__ == "__main__":
    main(sys.argv[1:])
