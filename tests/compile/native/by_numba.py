"""Short runs in which Numba compiles everything, as judge of symgen's own compiler; run apart.

python -m compile.native.by_numba straight pendulum lagrange rk4 four-bar ggl radau5
"""

import os
import sys

if __name__ == "__main__":
    os.environ["SYMGEN_COMPILER"] = "numba"
    from .loops import main

    main(sys.argv[1:])
