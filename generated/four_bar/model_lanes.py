"""Model `four-bar` in lanes, for 8 runs at once: functions that are no calls. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a1bfe8da2fcb1eac
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"}, inline="always")
def reduced(x):
    """Return x less the nearest multiple of pi/2 as a number and its rest, and that multiple (Cody and Waite)."""
    n = (x*0.6366197723675814 + 6755399441055744.0) - 6755399441055744.0
    first = x - n*1.5707963267341256
    rest = n*6.077100506506192e-11
    z = first - rest
    return z, (first - z) - rest, n


@njit(error_model="numpy", fastmath={"contract"}, inline="always")
def turned(z, rest, n):
    """Return the sine of n quarters of a turn and z + rest, |z| <= pi/4, to one unit of the last place (fdlibm's polynomials)."""
    zz = z*z
    s = 1.58969099521155010221e-10*zz - 2.50507602534068634195e-8
    s = (s*zz + 2.75573137070700676789e-6)*zz - 1.98412698298579493134e-4
    s = s*zz + 8.33333333332248946124e-3
    v = zz*z
    sine = z - ((zz*(0.5*rest - v*s) - rest) + v*1.66666666666666324348e-1)
    c = 2.08757232129817482790e-9 - 1.13596475577881948265e-11*zz
    c = (c*zz - 2.75573143513906633035e-7)*zz + 2.48015872894767294178e-5
    c = (c*zz - 1.38888888888741095749e-3)*zz + 4.16666666666666019037e-2
    half = 0.5*zz
    near = 1.0 - half
    cosine = near + (((1.0 - near) - half) + (zz*zz*c - z*rest))
    k = n - 4.0*((0.25*n + 6755399441055744.0) - 6755399441055744.0)
    found = cosine if abs(k) == 1.0 else sine
    return -found if abs(k - 0.5) > 1.0 else found


@njit(error_model="numpy", fastmath={"contract"}, inline="always")
def sine(x):
    """Sine of moderate angles."""
    z, rest, n = reduced(x)
    return turned(z, rest, n)


@njit(error_model="numpy", fastmath={"contract"}, inline="always")
def cosine(x):
    """Cosine of moderate angles."""
    z, rest, n = reduced(x)
    return turned(z, rest, n + 1.0)
