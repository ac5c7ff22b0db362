"""Mode shapes as motions for pages and films: a state, and a small share of a shape that oscillates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.errors import InputError
from symgen.describe.drawing.mechanism_scene import SHARE, build_scene
from symgen.describe.formulas.evaluate import parameter_values
from symgen.result.player.motion_page import Page, motion_page
from symgen.result.player.recording import Recording, position_groups

if TYPE_CHECKING:
    from symgen.analyses.linear.eigenmodes import Modes
    from symgen.describe.mechanism import Mechanism

#: Largest displacement in parts of the picture's diagonal, and largest turn [rad].
REACH, TURN = 0.1, 0.3
#: Period that every mode is drawn with [s], and frames.
PERIOD, FRAMES = 2.0, 100


def mode_recording(
    mechanism: Mechanism, modes: Modes, number: int, parameters: Mapping[str, float] | None = None
) -> Recording:
    """Return a mode as a motion: to a tenth of the picture and back, in two seconds whatever its frequency.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    modes : Modes
        About a state of rest.
    number : int
        Number of the shape, from 1 on.
    parameters : mapping of str to float, optional
        Parameters that differ from the described ones.

    Raises
    ------
    InputError
        If the mode does not exist, or shapes have other columns than coordinates of bodies.
    """
    names = _coordinate_names(mechanism)
    if not set(names) <= set(modes.names):
        got = ", ".join(modes.names[:4]) + (", ..." if len(modes.names) > 4 else "")
        raise InputError("mode", "shapes at rest, in coordinates of bodies", f"shapes in {got}")
    if not 1 <= number <= len(modes.shapes):
        raise InputError("mode", f"a number from 1 to {len(modes.shapes)}", str(number))
    columns = [modes.names.index(name) for name in names]
    about = np.array([modes.about[name] for name in names])
    shape, values = modes.shapes[number - 1][columns], parameter_values(mechanism, parameters)
    # the phase at which most of a damped shape, whose parts are not in step, is to be seen
    shape = shape * np.exp(-0.5j * np.angle(np.sum(shape**2)))
    scene = build_scene(mechanism, about, values)
    kinds = [name.rpartition(".")[2] for name in names]
    limits = np.array([REACH * scene.unit / SHARE if kind in ("x", "y", "z") else TURN for kind in kinds])
    limits[[kind.startswith("e") for kind in kinds]] = 0.5 * TURN  # a turn moves Euler parameters by half of it
    most = float(np.max(np.abs(shape) / limits))
    turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, FRAMES + 1))[:, None]
    q = about + np.real(turn * shape / (most or 1.0))
    value, frequency = modes.of_shapes[number - 1], modes.frequencies[number - 1]
    facts = [("mode", f"{number} of {len(modes.shapes)}"), ("", f"{frequency:.6g} Hz")]
    facts += [("damping", f"{modes.damping[number - 1]:.4g}")] if value.real else []
    facts.append(("", f"drawn with a period of {PERIOD:g} s"))
    t = np.linspace(0.0, PERIOD, FRAMES + 1)
    groups = position_groups(mechanism, q)
    return Recording(mechanism, values, t, q, facts=tuple(facts), groups=tuple(groups))


def mode_page(mechanism: Mechanism, modes: Modes, number: int, parameters: Mapping[str, float] | None = None) -> Page:
    """Return the page of a mode, with its reference state drawn faintly behind; see `mode_recording`."""
    recording = mode_recording(mechanism, modes, number, parameters)
    still = replace(
        recording,
        q=np.tile([modes.about[n] for n in _coordinate_names(mechanism)], (2, 1)),
        t=recording.t[[0, -1]],
        groups=(),
    )
    return motion_page(recording, second=still)


def _coordinate_names(mechanism: Mechanism) -> list[str]:
    return [f"{b.name}.{c}" for b in mechanism.bodies for c in b.coordinates]
