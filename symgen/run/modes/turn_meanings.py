"""What names mean in the turns of runs, by what their rows with bounds have.

`symgen.run.modes.turn` is one source; a run whose gaps strike, or with contacts, has other functions at some of its
names.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from symgen.compile.loopcode.loop_instances import Meanings, exact_instance
from symgen.run.effects.resets import apply_resets
from symgen.run.modes.catching import HOLDING
from symgen.run.modes.choice import measure_margins
from symgen.run.modes.choosing import choose_modes
from symgen.run.modes.contact_impacts import find_struck_contacts, gather_contacts, strike_contacts
from symgen.run.modes.pin_impulses import BY_REACTIONS
from symgen.run.modes.strikes import find_struck, strike
from symgen.run.modes.transition_log import log_changes
from symgen.run.modes.turn_impacts import put_gaps_to_zero, rest_gaps, strike_gaps, strike_past_corners

WITHOUT_LOADS = Meanings(
    "runs in which no bound depends on a force",
    choose_modes=exact_instance(choose_modes, {"LOADS": False}),
    find_struck=exact_instance(find_struck, {"LOADS": False}),
    strike=exact_instance(strike, {"LOADS": False}),
)
STRIKING = Meanings(
    "runs with bounded rows, of which gaps strike or events change the state",
    meet_impacts=strike_gaps,
    lay_gaps=put_gaps_to_zero,
    gather_impacts=rest_gaps,
    change_state=apply_resets,
)
CORNERED = Meanings("runs with corners of gaps", meet_impacts=strike_past_corners)
PRESSED = Meanings(
    "runs with bounds that depend on reactions",
    SEEKS=True,
    choose_modes=exact_instance(choose_modes, BY_REACTIONS),
)
IN_PIECES = Meanings("runs with gaps of several pieces", PIECES=True)
TOUCHED = Meanings(
    "runs with contacts",
    CONTACTS=True,
    SEEKS=True,
    choose_modes=choose_modes,
    find_struck=find_struck_contacts,
    strike=strike_contacts,
    gather=gather_contacts,
)
#: Contacts or stops beside bounds by reactions: one choice of modes, and one impact, for all.
REACTING = Meanings(
    "runs with one-sided rows beside bounds that depend on reactions",
    REACTIONS=True,
    SEEKS=True,
    choose_modes=exact_instance(choose_modes, BY_REACTIONS),
    find_struck=exact_instance(find_struck_contacts, BY_REACTIONS),
    strike=exact_instance(strike_contacts, BY_REACTIONS),
    gather=exact_instance(gather_contacts, BY_REACTIONS),
)
#: Slip of contacts has two rows; their laws are the same.
IN_PAIRS = {"PAIRED": True}
PAIRED_ROWS = Meanings(
    "runs with slip of contacts in space",
    choose_modes=exact_instance(choose_modes, IN_PAIRS),
    measure_margins=exact_instance(measure_margins, IN_PAIRS),
    find_struck=exact_instance(find_struck_contacts, IN_PAIRS),
    strike=exact_instance(strike_contacts, IN_PAIRS),
    gather=exact_instance(gather_contacts, IN_PAIRS),
    log_changes=exact_instance(log_changes, IN_PAIRS),
)
BY_POISSON = Meanings(
    "runs whose restitutions are ratios of impulses",
    strike=exact_instance(strike_contacts, BY_REACTIONS | {"POISSON": True}),
)
#: Keys of `TURNING`.
CONTACTS, CORNERS = "contacts", "corners"
#: Meanings for what a run's rows have (`symgen.run.loops.run_spec.Watched.turning`).
TURNING = {
    **{"pressed": PRESSED, CORNERS: CORNERED, "pieces": IN_PIECES, CONTACTS: TOUCHED, "reactions": REACTING},
    **{"poisson": BY_POISSON, "holding": HOLDING},
    "paired": PAIRED_ROWS,
}


def meanings_of_turn(strikes: bool, turning: Sequence[str]) -> dict[str, Any]:
    """Return the meanings of names in the turns of a run with bounded rows, or with joints that hold for a while.

    Parameters
    ----------
    strikes : bool
        Whether events change the run, or gaps strike.
    turning : sequence of str
        Keys of `TURNING`.
    """
    meanings: dict[str, Any] = WITHOUT_LOADS | (STRIKING if strikes else {})
    for kind in turning:
        meanings |= TURNING[kind]
    return meanings
