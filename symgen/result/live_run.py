"""The live part of a page: emitted code that works out other motions in the coordinates of a run."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import AssemblyError, InputError
from symgen.derive.methods import METHODS
from symgen.describe.facts.pulled import Pulled, pull_bodies
from symgen.describe.formulas.evaluate import independent_values, parameter_values
from symgen.describe.parts.event_sections import DOES
from symgen.result.labelled import Array
from symgen.result.live_columns import live_columns
from symgen.result.player.live import NONE, Live, live_part
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.run.planning.prepare import Prepared
    from symgen.run.planning.tree import TreeRun

#: The scheme of pages.
LIVE_INTEGRATOR = "rk4"
#: Bodies of a mechanism above which pages have looped code: straight code is long, and takes seconds to derive.
MOST_STRAIGHT = 20
#: Characters of emitted code for the spring by which a hand pulls a body, about.
A_SPRING = 1300


def is_live(method: str) -> bool:
    """Whether pages can run a method: its law has to be one for their scheme."""
    return bool(set(METHODS.get(method).forms) & set(INTEGRATORS.get(LIVE_INTEGRATOR).forms))


def live_of_run(
    mechanism: Mechanism, run: Mapping[str, Any], method: str = "", fixed: Collection[str] = ()
) -> tuple[Live | None, str]:
    """Return the live part of a page with coordinates, start, parameters and inputs of a run, by their names in JSON.

    Formulas of inputs are part of the mechanism. Inputs jump where one has other words, or is held by switches.
    Parameters that are `fixed` have no sliders. The code has a spring on each body, by which a hand pulls it.
    """
    from symgen.base.settings import Settings

    inputs, formulas, initial = run["inputs"], dict(mechanism.input_formulas), run["start"]
    if any(isinstance(x, str) and name not in formulas for name, x in inputs.items()) or (
        not set(mechanism.inputs) <= set(inputs)
    ):
        return None, f"{NONE}: what the run gave its inputs jumps, and pages do not look for times"
    if initial["t"]:
        return None, f"{NONE}: the run went on from another one at t = {initial['t']:.6g} s"
    own = {event.name for event in mechanism.events}
    for name, action in run["watched"]:
        if action in DOES and name not in own:
            return None, f"{NONE}: the event '{name}' {DOES[action]}, and pages look only for events of the file"
    pulled = pull_bodies(mechanism)
    mechanism = mechanism if pulled is None else pulled.mechanism
    numbers = {name: x for name, x in inputs.items() if not isinstance(x, str)}
    parameters = independent_values(mechanism, parameter_values(mechanism, {**run["parameters"], **numbers}))
    step = run["step"] or mechanism.defaults.step
    settings = Settings(shape="straight", coordinates=run["coordinates"], parameters=parameters, step=step)
    settings = replace(settings, method=method) if method else settings
    if mechanism.has_modes:  # whose run is the loop of this scheme
        settings = replace(settings, integrator=LIVE_INTEGRATOR)
    state = {**initial["q"], **initial["v"]}
    names = [f"{b.name}.{c}" for b in mechanism.bodies for c in b.coordinates]
    names += [f"{b.name}.{c}" for b in mechanism.bodies for c in b.speeds]
    begin = np.array([state[n] for n in names]) if set(names) <= set(state) else None

    def part_of(prepared: Prepared) -> tuple[Live | None, str]:
        if prepared.tree is not None:
            return _live_part_on_tree(prepared, prepared.tree, step, begin, run["until"], fixed, pulled)
        live, note = live_part(
            *(mechanism, prepared.compiled, prepared.start, step, begin, fixed),
            acting=prepared.mechanism,
            run=prepared,
            room=_room_for_springs(pulled),
        )
        return _add_columns(live, mechanism, prepared, run["until"], pulled), note

    live: Live | None = None
    note = ""
    for prepared in _ways_to_run(mechanism, settings):
        live, note = part_of(prepared)
        if live is not None:
            break
    return live, note


def _ways_to_run(mechanism: Mechanism, settings: Settings) -> Iterator[Prepared]:
    """Yield runs of the same motion whose code may fit into a page, each prepared where those before it do not fit."""
    from symgen.run.planning.plan import Purpose
    from symgen.run.planning.prepare import prepare

    absolute = settings.coordinates == "absolute"
    many = absolute and len(mechanism.bodies) > MOST_STRAIGHT
    if many and (in_loops := _in_loops(mechanism, settings)) is not None:
        yield in_loops
        return
    yield prepare(mechanism, settings, Purpose.STATE)
    if absolute:  # a tree has a tenth of the operations, or less
        on_tree = prepare(mechanism, replace(settings, coordinates="joint"), Purpose.STATE)
        if on_tree.tree is not None:
            yield on_tree
    if absolute and not many and (in_loops := _in_loops(mechanism, settings)) is not None:
        yield in_loops


def _in_loops(mechanism: Mechanism, settings: Settings) -> Prepared | None:
    """Return a run by looped code, whose length does not depend on the number of bodies; None where there is none."""
    from symgen.run.planning.plan import Purpose
    from symgen.run.planning.prepare import prepare

    try:
        return prepare(mechanism, replace(settings, shape="looped"), Purpose.STATE)
    except InputError:
        return None


def _live_part_on_tree(
    run: Prepared,
    tree: TreeRun,
    step: float,
    initial: Array | None,
    until: float,
    fixed: Collection[str],
    pulled: Pulled | None,
) -> tuple[Live | None, str]:
    """Return the live part in joint coordinates, which cannot close bodies: without sliders that move their start."""
    from symgen.run.planning.plan import Purpose
    from symgen.run.planning.prepare import prepare
    from symgen.run.planning.start_lines import exported_start
    from symgen.run.planning.tree_starts import begin_on_tree, map_to_tree

    mechanism, settings, start = run.plan.mechanism, run.plan.settings, run.start
    values, moving, info = parameter_values(mechanism, run.plan.parameters), list[str](), run.compiled.info
    turns = start.w[abi.WINDING :][: info.windings].tolist()
    own_start = exported_start(run.mechanism, run.compiled, start.datum or (), turns)
    springs = frozenset[str]() if pulled is None else pulled.names
    for name, x in values.items():
        if name in fixed or name in springs:
            continue
        parameters = {**settings.parameters, name: 1.01 * x if x else 0.01}
        try:
            other = prepare(mechanism, replace(settings, parameters=parameters), Purpose.STATE).start
        except (AssemblyError, InputError):
            moving.append(name)
            continue
        y, v = start.y.copy(), start.y[info.nq : info.nq + info.nv]
        y[info.nq : info.nq + info.nv] = 0.0
        own_start.close(y, v, other.p.copy())
        if np.abs(y - other.y)[: info.work].max() > 1e-7 * np.abs(y).max(initial=1.0):
            moving.append(name)
    if initial is not None:
        y = np.concatenate([initial, tree.body_start.y[len(initial) :]])
        of_bodies = replace(tree.body_start, y=y)
        carried = map_to_tree(mechanism, tree.mechanism, tree.bodies, tree.compiled)
        start = begin_on_tree(mechanism, tree.mechanism, carried, of_bodies, run.plan.method_parameters).start
    live, note = live_part(
        *(mechanism, run.compiled, start, step),
        still=[*moving, *fixed],
        acting=run.mechanism,
        run=run,
        room=_room_for_springs(pulled),
    )
    if live is not None and moving:
        note = f"no sliders for {', '.join(moving)}: they move the start, which pages close in coordinates of bodies"
    return _add_columns(live, mechanism, run, until, pulled), note


def _room_for_springs(pulled: Pulled | None) -> int:
    return 0 if pulled is None else A_SPRING * len(pulled.springs)


def _add_columns(
    live: Live | None, mechanism: Mechanism, run: Prepared, until: float, pulled: Pulled | None
) -> Live | None:
    """Return a live part of motions until a time [s], also where an event ended the run before, with all columns."""
    if live is None:
        return None
    if pulled is not None:
        mechanism = pulled.without_springs(mechanism)
    law = run.compiled.law
    units = {parameter.name: parameter.unit for parameter in METHODS.get(law.method).parameters}
    gains = [
        {"name": f"method.{name}", "unit": units[name], "value": float(x), "follows": False, "place": place}
        for place, ((name, _), x) in enumerate(
            zip(law.parameters, run.start.p[law.parameter_offset :], strict=False), law.parameter_offset
        )
        if name in units and not name.endswith("tolerance")
    ]
    bodies = None if run.tree is None else run.tree.bodies
    text, spec = live_columns(mechanism, run.compiled, run.start, bodies, run.mechanism)
    own = live.spec["parameters"]
    springs = frozenset[str]() if pulled is None else pulled.names
    parameters = [{**p, "place": i} for i, p in enumerate(own) if p["name"] not in springs] + gains
    places = {p["name"]: i for i, p in enumerate(own)}
    hand = None if pulled is None else _hand_in_page(pulled, places)
    further = {"until": float(until), "parameters": parameters, "columns": spec, "hand": hand}
    return replace(live, columns=text, spec={**live.spec, **further})


def _hand_in_page(pulled: Pulled, places: Mapping[str, int]) -> dict[str, Any]:
    """Return the places of the parameters by which a page pulls bodies."""
    return {
        "at": [places[name] for name in pulled.at],
        "to": [places[name] for name in pulled.to],
        "bodies": [[body, *(places[name] for name in spring)] for body, spring in pulled.springs.items()],
    }
