"""Directions through passages: how the state after an event depends on all numbers, the time of the event among them.

At an event g = 0 its time changes by ``dt = -dg / g'``, and the state there by ``dy + y' dt``. What the event changes
is differentiated there: velocities by the equations of the smallest impulse
(`symgen.run.directions.reset_directions`), the value at which a row is held, and the bounds of its force. From this
``y' dt`` with the rates after the event is taken back, so that a transition alone changes a direction by the jump of
the rates times dt.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.bounds.bounded_modes import HIT
from symgen.describe.parts.passing_ropes import BEYOND, PASSES, RETURNS
from symgen.run.directions.free_directions import TOGETHER, Free, constraint_directions
from symgen.run.directions.mode_directions import ModeDirections, name_of_switch
from symgen.run.directions.moments import Directions, Moment, Moments
from symgen.run.directions.push_directions import PushDirections, push_state, rows_of_velocities, tied_impact
from symgen.run.directions.reset_directions import ResetDirections
from symgen.run.directions.series_directions import ImpactDirections, SeriesDirections
from symgen.run.directions.slips_in_space import SlipsInSpace
from symgen.run.loops.table_points import ROUNDING_OF_SWITCH

if TYPE_CHECKING:
    from symgen.run.directions.passages import RunPassage, Struck
    from symgen.run.loops.run_spec import BoundedRows, RunSpec, Watched

Array = NDArray[np.float64]

#: Part of a time up to which two times are the same, beside the tolerance of steps; least derivative of a time that is
#: no rounding, over the largest.
_NEAR, _LEAST = 1e-11, 1e-12
#: Part of a time to which events are located.
_CROSSES = 1e-9
#: Roundings of a switching function over its change in the whole run from which on it is met without speed.
_GRAZES = 1e-6


@dataclass
class Transfer:
    """Takes directions through passages.

    Parameters
    ----------
    moments : Moments
        The code; its last direction is the motion.
    spec : RunSpec
        Of the run.
    consistent : bool
        Whether directions satisfy the constraints; else they are all directions there are.

    Attributes
    ----------
    doubts : list of str
        What is in doubt of the directions.
    impacts : ImpactDirections
        Directions of the latest impacts of contacts.
    """

    moments: Moments
    spec: RunSpec
    consistent: bool = True
    doubts: list[str] = field(default_factory=list)
    impacts: ImpactDirections = field(default_factory=ImpactDirections)
    _last: tuple[RunPassage, Array] | None = None

    def begin_anew(self) -> None:
        """Forget the last passage and all doubts."""
        self._last = None
        self.doubts.clear()
        self.impacts.latest.clear()

    @property
    def watched(self) -> Watched | None:
        """Switching functions of the run."""
        return self.spec.events

    @cached_property
    def _slips(self) -> SlipsInSpace | None:
        """Contacts whose slip has a direction; None without any."""
        watched = self.watched
        paired = watched is not None and watched.bounded is not None and watched.bounded.paired
        return SlipsInSpace(self.moments, watched) if watched is not None and paired else None

    @property
    def _modes(self) -> ModeDirections:
        return ModeDirections(self.moments, self.watched, self.consistent, self.doubts)

    def transfer_through(self, passage: RunPassage, y: Array, modes: Array) -> tuple[Array, Array]:
        """Return the directions of state and modes after a passage from those before it.

        Parameters
        ----------
        passage : Passage
            The passage.
        y, modes : Array, shapes (ny, k), (numbers of modes, k)
            Directions at the same time, without that of the motion.
        """
        rate = self._rate_before(passage) if passage.numbers else np.zeros(len(y))
        y, modes, later = self.transfer_at_event(passage, y, modes, rate)
        if passage.numbers:
            y = y - np.outer(self.moments.rates(self._plain(passage.after)), later)
        return (self._corrected(passage, y, modes) if self._passes_station(passage) else y), modes

    def _rate_before(self, passage: RunPassage) -> Array:
        """Return the rates before events.

        Formulas of curves change with the place, which is on the far side already: theirs go on from a little earlier.
        """
        before = self._plain(passage.before)
        rate = self.moments.rates(before)
        if not self._passes_station(passage):
            return rate
        width, watched = self.moments.count - 1, self.watched
        assert watched is not None, "the run has events"
        nothing = self._with(np.zeros((len(before.y), width)), rate), self._with(np.zeros((self._count, width)))
        by = Directions(nothing[0], np.append(np.zeros(width), 1.0), nothing[1])
        _, slopes = self.moments.observe(watched.function, 3 * (len(watched.names) + len(watched.switches)), before, by)
        earlier = 2.0 * BEYOND / np.abs(slopes[list(passage.numbers), -1]).max()
        near, far = (
            self.moments.rates(before._replace(t=before.t - part * earlier, y=before.y - part * earlier * rate))
            for part in (1.0, 2.0)
        )
        return np.asarray(2.0 * near - far)

    def _passes_station(self, passage: RunPassage) -> bool:
        """Whether a point passes a station of its curve."""
        watched = self.watched
        return watched is not None and any(watched.words[number] in (PASSES, RETURNS) for number in passage.numbers)

    def _corrected(self, passage: RunPassage, y: Array, modes: Array) -> Array:
        """Return directions whose velocities satisfy the rows after a passage.

        A correction of the state at the event, on the far side, has changed them as the jump of the rates does.
        """
        info, after = self.moments.compiled.info, self._plain(passage.after)
        by = Directions(self._with(y), self._with(np.zeros(y.shape[1])), self._with(modes))
        d, by_d, _, nu = constraint_directions(self.moments, after, by)
        off = self.moments.compiled.off(after.w)
        force, place = [i for i, row in enumerate(info.rows) if row.name not in off], slice(info.nq, info.work)
        left = np.einsum("ijk,j->ik", by_d[force], after.y[place]) + d[force] @ y[place] - nu[force]
        corrected = y.copy()
        corrected[place] -= np.linalg.lstsq(d[force], left, rcond=1e-11)[0]
        return corrected

    def transfer_impacts_alone(self, passage: RunPassage, y: Array, modes: Array) -> tuple[Array, Array]:
        """Return the directions after a passage whose state before has none, but earlier impacts; shapes are given."""
        last, known = self._last, len(self.doubts)
        after = self.transfer_through(passage, np.zeros_like(y), np.zeros_like(modes))
        self._last = last
        del self.doubts[known:]
        return after

    def transfer_at_event(self, passage: RunPassage, y: Array, modes: Array, rate: Array) -> tuple[Array, Array, Array]:
        """Return the directions of state, modes and time of a passage after it, at its own time.

        Parameters
        ----------
        passage, y, modes
            As for `transfer_through`: directions before at a time that has none.
        rate : Array, shape (ny,)
            How the state before changes with the time of its events.
        """
        before, after = (self._plain(x) for x in (passage.before, passage.after))
        free = Free(self.moments, before, Directions(*(self._with(x) for x in (y, np.zeros(y.shape[1]), modes))))
        later = np.zeros(y.shape[1])
        turned = self._slips is not None and self._slips.going_on(before, after).issuperset(passage.numbers)
        if passage.numbers and not turned:
            later = self._later(passage, before, y, modes, rate, free)
            y = y + np.outer(rate, later)
            if self._slips is not None:
                here = Directions(self._with(y), self._with(later), self._with(modes))
                y = self._slips.bring_to_rest(before, after, here)[:, :-1]
        if not (passage.numbers and turned):
            self._compare(passage, later, free)
        known, here = len(self.doubts), Directions(self._with(y), self._with(later), self._with(modes))
        changed = self._through_effects(passage, here, None)
        found = self._modes.directions_of_modes(passage, before, after, changed, free)
        if any(struck.ties is not None and struck.ties.series is not None for struck in passage.effects):
            # what is left out of a series reads accelerations at rest, whose directions need those of the state there
            del self.doubts[known:]
            rows = self._rows_with_bounds
            by = changed._replace(modes=self._with(found))
            values, slopes = self.moments.observe(rows.accelerations.function, len(rows.names), after, by)
            changed = self._through_effects(passage, here, (values, slopes[:, :-1]))
            found = self._modes.directions_of_modes(passage, before, after, changed, free)
        self._remember(passage, after, changed)
        return changed.y[:, :-1], found, later

    def _plain(self, x: Moment) -> Moment:
        """Return a state without the directions after its arrays."""
        return self.moments.plain(x)

    @staticmethod
    def _with(columns: Array, last: Array | None = None) -> Array:
        """Return directions with the motion as the last one, zero where it plays no part."""
        own = np.zeros(columns.shape[:-1]) if last is None else last
        return np.concatenate([columns, own[..., np.newaxis]], axis=-1)

    # -- the time of events --------------------------------------------------------------------------------------------

    def _later(self, passage: RunPassage, now: Moment, y: Array, modes: Array, rate: Array, free: Free) -> Array:
        """Return the directions of the time of events, shape (k,)."""
        watched, numbers = self.watched, list(passage.numbers)
        assert watched is not None, "the run has events"
        if self._slips is not None:
            on = self._slips.going_on(now, self._plain(passage.after))
            numbers = [number for number in numbers if number not in on]
        count = len(watched.names) + len(watched.switches)
        times = np.append(np.zeros(y.shape[1]), 1.0)
        by = Directions(self._with(y, rate), times, self._with(modes))
        values, slopes = self.moments.observe(watched.function, 3 * count, now, by)
        if self._slips is not None:
            for number, (i, way) in self._slips.turned(now.w).items():
                slopes[number] = self._slips.along(i, way, now, by)
        own, speeds = slopes[numbers, :-1], slopes[numbers, -1]
        rounding = ROUNDING_OF_SWITCH * values[2 * count :][numbers]
        resolved = np.abs(speeds) * _CROSSES * max(1.0, abs(now.t)) + rounding / _GRAZES
        if np.any(np.abs(values[numbers]) > resolved):  # a jump has carried it beyond zero
            if not self._seams_near(now.t):
                self.doubts.append(
                    f"the event {name_of_switch(self.watched, passage)} at t = {now.t:.6g} s happens by a jump"
                )
            return np.zeros(y.shape[1])
        if not np.all(np.abs(speeds) * self.spec.until * _GRAZES > rounding):
            where = f"the event {name_of_switch(self.watched, passage)} at t = {now.t:.6g} s"
            self.doubts.append(f"{where} is met without speed: its time has no derivative")
        with np.errstate(divide="ignore", invalid="ignore"):
            later = -own / speeds[:, np.newaxis]
        if len(numbers) > 1 and self._rates_differ(later[1:] - later[0], later, now.t, free):
            names = name_of_switch(watched, passage)
            self.doubts.append(f"the events {names} at t = {now.t:.6g} s are together for these numbers only")
        return np.asarray(later[int(np.argmax(np.abs(speeds) / np.where(rounding > 0.0, rounding, 1.0)))])

    def _seams_near(self, t: float) -> bool:
        """Whether inputs or formulas jump at a time."""
        near = (_NEAR + self.spec.rtol * self.spec.adaptive) * max(1.0, abs(t))
        return any(abs(seam.t - t) <= near and seam.t > 0.0 for seam in self.spec.seams)

    def _rates_differ(self, rows: Array, of: Array, t: float, free: Free) -> bool:
        """Whether differences of times do not vanish in directions that satisfy the constraints."""
        if not np.all(np.isfinite(rows)):
            return False
        if not self.consistent:
            return free.has_free_motion(rows, of)
        size = np.abs(of).max(axis=0)
        return bool(
            np.any(np.abs(rows) > np.maximum(TOGETHER * size, _LEAST * max(1.0, t, float(size.max(initial=0.0)))))
        )

    def _compare(self, passage: RunPassage, later: Array, free: Free) -> None:
        """Doubt directions where the passage before is at the same time for these numbers only."""
        near = (_NEAR + self.spec.rtol * self.spec.adaptive) * max(1.0, abs(passage.before.t))
        last, self._last = self._last, (passage, later)
        t = passage.before.t
        if passage.numbers and self._seams_near(t):
            if self._rates_differ(later[np.newaxis], later[np.newaxis], t, free):
                what = f"the event {name_of_switch(self.watched, passage)}"
                self.doubts.append(f"{what} and a jump at t = {t:.6g} s are together for these numbers only")
            return
        if last is None or not (passage.numbers and last[0].numbers):
            return
        if abs(t - last[0].before.t) <= near and passage.numbers != last[0].numbers:
            both = np.stack([last[1], later])
            if not self.consistent or self._rates_differ(both[1:] - both[:1], both, t, free):
                names = f"{name_of_switch(self.watched, last[0])} and {name_of_switch(self.watched, passage)}"
                self.doubts.append(f"the events {names} at t = {t:.6g} s are together for these numbers only")

    # -- what events change --------------------------------------------------------------------------------------------

    def _through_effects(self, passage: RunPassage, by: Directions, rests: tuple[Array, Array] | None) -> Directions:
        """Return the directions after the effects of events in their order; `rests` as of `SeriesDirections.slopes`."""
        for struck in passage.effects:
            by = by._replace(y=self._with(self._through_effect(struck, self._plain(struck.at), by, rests)))
        return by

    def _through_effect(
        self, struck: Struck, now: Moment, here: Directions, rests: tuple[Array, Array] | None
    ) -> Array:
        """Return the directions of the state after an effect of events."""
        watched, numbers, width = self.watched, struck.numbers, here.y.shape[1]
        assert watched is not None, "the run has events"
        effects = watched.effects
        work = effects.memory(len(now.y), len(now.w))
        state, scratch = now.y.copy(), now.w.copy()
        by, lanes = here._replace(modes=np.zeros((self._count, width))), self.moments.model.lanes
        kept = struck.ties
        if kept is None:
            impact, ties = effects.apply_to_state(numbers, now.t, state, now.p.copy(), scratch, work), None
        else:
            ties = tied_impact(watched, kept, now)
            tied = ties, rows_of_velocities(watched)
            parts = np.pad(self._slopes_of_parts(struck, now, by, rests), ((0, 0), (0, lanes)))
            impact = push_state(effects, numbers, now, (state, scratch), work, tied, self._slips is not None)
        chosen, columns = effects.chosen(numbers), list[Array]()
        for first, own, p, w in self.moments.chunks_of_states(now, by):
            given = effects, self.moments.model, chosen, now.t, own, p, w, work, impact, self._losses
            if kept is None or ties is None:
                columns.append(ResetDirections(*given).directions())
            else:
                tied_by = ties, watched, parts[:, first : first + lanes], kept.pins
                columns.append(PushDirections(*given, *tied_by).directions())
        return np.concatenate(columns, axis=1)[:, : width - 1]

    @property
    def _rows_with_bounds(self) -> BoundedRows:
        assert self.watched is not None and self.watched.bounded is not None, "a run with contacts"
        return self.watched.bounded

    def _slopes_of_parts(self, struck: Struck, now: Moment, by: Directions, rests: tuple[Array, Array] | None) -> Array:
        """Return the directions of what velocities have of a series that is left out, zero without one."""
        watched, kept = self.watched, struck.ties
        assert watched is not None and kept is not None, "an impact of contacts"
        if kept.series is None:
            return np.zeros((len(kept.held), by.y.shape[1]))
        series = SeriesDirections(watched, kept, self.impacts)
        parts = series.slopes(now.t, by.t[:-1], self._slopes_of_rates(now, by), rests)
        if parts is None:
            names = " and ".join(self._rows_with_bounds.names[series.hits.index(event)] for event in struck.numbers)
            self.doubts.append(
                f"what is left out of impacts that accumulate at {names} at t = {now.t:.6g} s does not follow from the "
                "impacts before, so that its derivatives are unknown; take differences"
            )
            return np.zeros((len(kept.held), by.y.shape[1]))
        return self._with(parts)

    def _remember(self, passage: RunPassage, after: Moment, by: Directions) -> None:
        """Remember the directions of an impact of contacts."""
        events = sorted({event for struck in passage.effects if struck.ties is not None for event in struck.numbers})
        if events:
            self.impacts.remember(events, after.t, np.vstack([by.t[:-1], self._slopes_of_rates(after, by)]))

    def _slopes_of_rates(self, now: Moment, by: Directions) -> Array:
        """Return the directions of the rates of all rows with bounds."""
        rows, k = self._rows_with_bounds, len(self._rows_with_bounds.names)
        _, slopes = self.moments.evaluate_moment(rows.state.function, rows.values, now, by)
        return slopes[k : 2 * k, :-1]

    @property
    def _losses(self) -> dict[int, int]:
        """By number of the event, the place in the state of the energy that its impacts, or its catch, take."""
        watched = self.watched
        caught = {} if watched is None or watched.effects is None else watched.effects.losses
        if watched is None or watched.bounded is None:
            return caught
        rows = watched.bounded
        hits = watched.events_of_rows(HIT, len(rows.names))
        places = zip(hits[rows.dry :], rows.losses[rows.dry :], strict=True)
        return caught | {hit: place for hit, place in places if place is not None}

    @property
    def _count(self) -> int:
        """Number of numbers of modes."""
        place = self.moments.place_of_modes()
        return int(place.stop - place.start)
