"""Find numbers of a machine for an aim: read what is asked for, search from several starts, and report the best."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.kinds import change_settings_checked
from symgen.analyses.search.measured_data import ColumnAim, MeasuredData, Residuals, measured_columns
from symgen.analyses.search.prices import ACTIVE, prices_of_limits
from symgen.analyses.search.sampled_motions import Aim
from symgen.analyses.search.search import Candidate, Screened, Search, screen
from symgen.base import arguments
from symgen.base.errors import InputError, enumeration, plural
from symgen.base.keywords import RunKeywords, keyword_names, make_entry
from symgen.describe.edits.new_numbers import text_with_numbers
from symgen.describe.facts.lifted import numbers_of_file
from symgen.describe.files.load import parse_toml, read_text
from symgen.describe.files.origins import Source, origin_of
from symgen.describe.files.validate import validate
from symgen.result.labelled import Labelled
from symgen.result.sensitivities import derivative_unit
from symgen.study.design.answer_remarks import (
    WatchedQuantities,
    remark_on_sign,
    remarks_on_means,
    remarks_on_values,
    sentence_on_limits,
)
from symgen.study.design.found import Design, KeptLimit, SearchFromStart
from symgen.study.design.motions import motions_of
from symgen.study.design.problem import (
    QuantityReader,
    limits_of_file,
    read_aim,
    read_keep,
    read_varied,
    sized,
)

if TYPE_CHECKING:
    from symgen import Model
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]

#: Most starts.
MOST_STARTS = 10_000
#: Settings that count: not those of outputs and checks, which the search decides.
COUNTING = tuple(
    name
    for name in keyword_names(RunKeywords)
    if name not in ("verify", "times", "output_step", "stop_when", "record_when", "events", "repeat")
)
#: Limits that are exceeded by this part of the most exceeded one contradict it.
TOGETHER = 0.5


@make_entry
def design(
    model: str | Path | Mechanism | Model,
    vary: Mapping[str, tuple[float, float]],
    aim: str | Path | Mapping[str, object],
    keep: str | Sequence[str] = (),
    starts: int = 1,
    seed: int = 0,
    settings: Settings | None = None,
    progress: Callable[[int, int], None] | None = None,
    **changes: Unpack[RunKeywords],
) -> Design:
    """Find numbers of a machine with which an aim is smallest, within bounds and limits.

    Searches follow exact derivatives of the motion. The best candidate that keeps all limits is the answer, so that it
    is never worse than a file that keeps them.

    Parameters
    ----------
    model : str, Path, Mechanism or Model
        An argument of `symgen.load`, or its result.
    vary : mapping of str to (float, float)
        Bounds by the names of parameters, of places of pins such as ``A.x``, or of numbers of the file by their paths
        such as ``bodies.crank.mass``, in SI units. The search begins with the values of the file.
    aim : str, path or mapping
        ``peak(Q)``, the largest size of a quantity over time, ``rms(Q)`` or ``max(Q)``, which become small, or
        ``min(Q)``, which becomes large; a quantity at the end of the run, such as ``integral(motor.power)``; or columns
        over ``t`` to be met by least squares, as a file or a mapping with arrays. Q is a column of results, an output
        of the file, or a formula as in ``[outputs]``.
    keep : sequence of str
        Limits, such as ``"min(ram.y) <= -598 mm"`` or ``"-0.75 <= mu <= 0.75"``, which holds at every time. Limits of
        the file, ``smallest`` and ``largest``, hold as well.
    starts : int
        Searches: the first one begins with the file, others with the best of evenly spread candidates.
    seed : int
        Of these candidates; the same one gives the same answer.
    settings : Settings, optional
        All settings at once.
    progress : callable, optional
        Called with the searches done and all of them.
    **changes
        Single settings by name, as listed above. Those of integration count where drivers do not prescribe the motion.

    Returns
    -------
    Design
        Also where no candidate keeps all limits, with the reason, and after an interruption, with the best so far.

    Raises
    ------
    InputError
        If an argument is wrong, or the machine of the file does not move.
    """
    from symgen import load

    own = change_settings_checked("design", settings, changes, COUNTING)
    count = arguments.whole_number("design: starts", starts, 1, MOST_STARTS)
    chance = arguments.whole_number("design: seed", seed, 0, 2**63 - 1)
    arguments.callable_or_none("design: progress", progress)
    return _Designing(load(model), own, vary, aim, keep).find(count, chance, progress)


class _Designing:
    """A design from its arguments to its answer."""

    def __init__(self, model: Model, settings: Settings, vary: object, aim: object, keep: object) -> None:
        origin = origin_of(model.mechanism)
        if origin is None:
            raise InputError("design: model", "a model whose file is at hand", "one without", "load the file again")
        self.model, self.settings, self.origin = model, settings, origin
        self.varied = read_varied(model.mechanism, vary, settings)
        self.reader = QuantityReader(self.varied.mechanism)
        until = settings.until
        self.aim: Aim | ColumnAim
        if isinstance(aim, str) and not aim.strip().lower().endswith((".csv", ".parquet", ".nc")):
            self.aim = read_aim(self.reader, aim)
        elif isinstance(aim, str | Path | Mapping):
            self.aim = _column_aim(self.reader, measured_columns(aim, where="design: aim"), until)
            until = until or float(self.aim.times[-1])
        else:
            expected = "a text such as peak(motor.effort), or columns over t"
            raise InputError("design: aim", expected, arguments.kind_of_value(aim))
        limits = [*limits_of_file(self.reader, self.varied, settings.parameters), *read_keep(self.reader, keep)]
        self.watched = WatchedQuantities(self.reader)
        self.until = float(until or model.mechanism.defaults.until)
        self.settings = replace(settings, until=self.until)
        motions = motions_of(self.varied.mechanism, self.settings, self.varied.keys, self.until, self.reader.quantities)
        self.search = Search(self.varied, motions, self.aim, limits, self.until)
        self.notes = list[str]()

    # -- the search ----------------------------------------------------------------------------------------------------

    def find(self, starts: int, seed: int, progress: Callable[[int, int], None] | None) -> Design:
        """Search, and return the answer."""
        search, show = self.search, progress or (lambda done, of: None)
        first = self._first_candidate(starts, seed)
        search.limits = sized(search.limits, first.fine.values)
        search.best = first = first._replace(excess=search.excess(first.fine))
        searches, interrupted = list[SearchFromStart](), False
        try:
            for k, begin in enumerate(self._starts(first, starts, seed)):
                show(k, starts)
                runs, end = search.runs, search.improve(begin)
                values = self._value(begin), self._value(end)
                whence = "candidate" if k else "file"
                searches.append(SearchFromStart(whence, *values, end.is_within, search.runs - runs))
            show(starts, starts)
            if not search.best.is_within:
                search.relax(search.best)
        except KeyboardInterrupt:
            interrupted = True
        return self._answer(first, search.best, searches, interrupted)

    def _first_candidate(self, starts: int, seed: int) -> Candidate:
        """Return the machine of the file, with its motion.

        Raises
        ------
        InputError
            If it does not move, or no number that varies changes the aim.
        """
        search, u = self.search, self.varied.parts(self.varied.start)
        first = search.check(u)
        if first is None:
            reason = next(iter(search.failed))
            screened = screen(search, 1, seed)
            hint = f"{screened.moving} of {screened.tried} candidates within the bounds move"
            raise InputError("design: vary", "values in the file with which the machine moves", reason, hint)
        places = [self.aim.quantity] if isinstance(self.aim, Aim) else [*self.aim.places]
        if not first.fine.slopes[:, places].any():
            got = f"{enumeration([self.reader.quantities[i].text for i in places])}, which none does"
            raise InputError("design: aim", "a quantity that a varied number changes", got)
        return first

    def _starts(self, first: Candidate, starts: int, seed: int) -> Iterator[Candidate]:
        """Yield where searches begin: at the file, then, when that search is done, at the best of many candidates."""
        yield first
        if starts == 1:
            return
        screened = screen(self.search, starts - 1, seed)
        self.search.runs += screened.tried
        self.search.failed.update(screened.failed)
        self._note_screened(screened)
        for u in screened.starts:
            if (found := self.search.check(u)) is not None:
                yield found

    def _note_screened(self, screened: Screened) -> None:
        move = "moves" if screened.moving == 1 else "move"
        sentence = f"{screened.moving} of {plural(screened.tried, 'candidate')} {move}"
        if self.search.limits:
            within = f"{screened.within} within all limits" if screened.within else "none within all limits"
            sentence += f", {within}"
        self.notes.append(sentence)

    def _value(self, candidate: Candidate) -> float:
        return self.aim.reached(candidate.fine).value

    # -- the answer ----------------------------------------------------------------------------------------------------

    def _answer(
        self, first: Candidate, best: Candidate, searches: Sequence[SearchFromStart], interrupted: bool
    ) -> Design:
        varied, search, aim = self.varied, self.search, self.aim
        x = varied.start if best is first else varied.values(best.u)
        limits = self._limits(first, best)
        reason = None
        if not best.is_within:
            reason = self._reason(best)
        if interrupted:
            reason = "interrupted: the values are the best so far"
        notes = [
            *self.model.remarks,
            *self.notes,
            *remarks_on_values(varied, x, best.fine),
            *self.watched.remarks(first.fine, best.fine),
        ]
        if isinstance(aim, ColumnAim):
            notes += aim.columns.gaps_in_words()
        else:
            notes += remark_on_sign(aim, best.fine)
            if aim.taken.word == "rms":
                notes += remarks_on_means(varied, aim, x, best.fine)
        if best is first and best.is_within and not interrupted:
            notes.append("no candidate is better than the file")
        text, changed = self._new_file(dict(zip(varied.names, x.tolist(), strict=True)))
        return Design(
            mechanism=self.model.name,
            aim=aim.taken.text,
            unit=aim.unit,
            values=dict(zip(varied.names, x.tolist(), strict=True)),
            start_values=dict(zip(varied.names, varied.start.tolist(), strict=True)),
            units=dict(zip(varied.names, varied.units, strict=True)),
            ranges={
                name: (float(a), float(b)) for name, a, b in zip(varied.names, varied.low, varied.high, strict=True)
            },
            before=self._value(first),
            after=self._value(best),
            limits=limits,
            starts=tuple(searches),
            runs=search.runs,
            failed=_by_cause(search.failed),
            notes=tuple(notes),
            reason=reason,
            interrupted=interrupted,
            text=text,
            first_model=self.model,
            model=changed,
            settings=self.settings,
            until=self.until,
            times=best.fine.times,
            course=self._course(first, best),
        )

    def _course(self, first: Candidate, best: Candidate) -> Labelled | None:
        """Return the quantity of the aim before and after."""
        if not isinstance(self.aim, Aim):
            return None
        name = self.aim.taken.quantity
        values = [each.fine.values[:, self.aim.quantity] for each in (first, best)]
        return Labelled(np.column_stack(values), (f"{name} before", f"{name} after"), (self.aim.unit,) * 2)

    def _limits(self, first: Candidate, best: Candidate) -> tuple[KeptLimit, ...]:
        aim, rows = self.aim, list[KeptLimit]()
        prices = prices_of_limits(aim, self.search.limits, best.u, best.fine)
        for limit, price in zip(self.search.limits, prices, strict=True):
            before, after = limit.reached(first.fine), limit.reached(best.fine)
            rows.append(
                KeptLimit(
                    **vars(limit),
                    before=before.value,
                    after=after.value,
                    t=after.t,
                    active=bool(limit.rooms(best.fine)[0].min() <= ACTIVE),
                    price=price,
                    price_unit=derivative_unit(aim.unit, limit.unit),
                )
            )
        return tuple(rows)

    def _reason(self, best: Candidate) -> str:
        """Return which limits are missed at the best, and by how much."""
        missed = list[tuple[str, str]]()
        for limit in self.search.limits:
            value = limit.reached(best.fine).value
            if limit.excess(value) > TOGETHER * best.excess:
                missed.append((limit.text, f"{abs(value - limit.bound):.4g} {limit.unit}".strip()))
        return sentence_on_limits(missed)

    def _new_file(self, values: Mapping[str, float]) -> tuple[str, Model]:
        """Return the text of the file with new numbers, and its machine."""
        from symgen import Model

        origin, pins = self.origin, self.varied.pins
        paths = {name: path for name, path, _ in numbers_of_file(origin.raw)}
        whole = {**self.settings.parameters, **values}
        moved = {name: whole.pop(name) for name in pins.keys} if pins else {}
        numbers = {paths.get(name, ("parameters", name)): value for name, value in whole.items()}
        if pins:
            numbers |= {each.path: each.at(moved, pins.before) for each in pins.moved}
        file = _file_of_source(origin.source)
        text = text_with_numbers(None if file is None else read_text(file), origin.raw, numbers)
        return text, Model(validate(parse_toml(text, origin.source), origin.source))


def _column_aim(reader: QuantityReader, data: MeasuredData, until: float | None) -> ColumnAim:
    """Return columns over time as an aim.

    Raises
    ------
    InputError
        If there are none, or they go on after the last time that is asked for [s].
    """
    if not data.columns:
        raise InputError(data.whence, "columns of the machine over t, such as coupler.x", "none")
    if until is not None and data.t[-1] > until:
        raise InputError(data.whence, f"times up to {until:g} s", f"{data.t[-1]:g} s")
    places = {name: reader.place(data.whence, name) for name in data.columns}
    units = {name: reader.quantities[place].unit for name, place in places.items()}
    return ColumnAim(Residuals([data], units, {}), tuple(places.values()))


def _file_of_source(source: str) -> Path | None:
    """Return the file of a description, None where it has none."""
    from symgen.describe import catalogue

    if isinstance(source, Source):
        return source.file
    return catalogue.file_of_entry(source) if source in catalogue.all_names() else None


def _by_cause(failed: Mapping[str, int]) -> dict[str, int]:
    """Return reasons without their figures, each with its count, the commonest first."""
    from symgen.study.ensemble.sweep_study import reason_without_figures

    counts = dict[str, int]()
    for reason, count in failed.items():
        cause = reason_without_figures(reason)
        counts[cause] = counts.get(cause, 0) + count
    return dict(sorted(counts.items(), key=lambda pair: -pair[1]))
